#include "synth/text/word_class.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/text.h"
#include "synth/markup/vocabulary.h"

namespace chironomia {
namespace {

constexpr std::string_view kArticles = "a an the this that these those each every some any no";
constexpr std::string_view kPronouns =
    "i me my mine you your yours he him his she her hers it its we us our ours they them their theirs myself "
    "yourself himself herself itself ourselves themselves who whom somebody someone something nobody nothing "
    "everybody everyone everything anybody anyone anything";
constexpr std::string_view kPrepositions =
    "of in to for with on at from by about as into like through after over between out against during "
    "without "
    "before under around among across behind beyond above below near off up down toward towards upon within";
constexpr std::string_view kNumbers =
    "zero one two three four five six seven eight nine ten eleven twelve twenty thirty forty fifty hundred "
    "thousand million billion first second third once twice half";
constexpr std::string_view kNegations =
    "no not never none nobody nothing nor neither cannot can't don't doesn't didn't won't isn't aren't "
    "wasn't "
    "weren't wouldn't couldn't shouldn't haven't hasn't";

// The words that English talk is mostly made of, from the commonest on.
constexpr std::string_view kCommonWords =
    "the i you and to a it that of in is we so this they have but what on for not be do are was with there "
    "if "
    "just like can all he as one about my people at now or out because when your up then know how me an get "
    "our by from very more them were see who she think had going has here really would go time don't right "
    "want which no us some well these yes other actually could way make thing things say his into want their "
    "it's that's i'm you're we're where take good back need did lot look first new her two mean work little "
    "much come years every something world life year even over also been will only than why him day put kind "
    "those let great still any got always through down never long around big three same off part own tell "
    "find give before most should last after made use different love better again next many being feel "
    "another problem does today start show between place home idea person believe change help keep fact "
    "thought able story week under might must men women money house water hand old big small number group";

bool is_in(std::string_view list, std::string_view word) {
    const std::vector<std::string_view> words = split_words(list);
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool ends_with_any(std::string_view word, const std::vector<std::string_view>& endings) {
    // A stem of three letters at least: "king" is no verb.
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) {
        return word.size() >= ending.size() + 3 && word.ends_with(ending);
    });
}

bool is_number(std::string_view word) {
    return parse_number(word).has_value() || is_in(kNumbers, word);
}

std::unordered_map<std::string_view, double> ranks() {
    std::unordered_map<std::string_view, double> ranks;
    for (const std::string_view word : split_words(kCommonWords))
        ranks.emplace(word, static_cast<double>(ranks.size() + 1));
    return ranks;
}

}  // namespace

std::vector<bool> answers_about(std::string_view word) {
    const Vocabulary& english = Vocabulary::of("en");
    return {english.is_function_word(word),
            english.is_auxiliary(word),
            english.is_conjunction(word),
            english.is_imperative(word),
            english.is_question_word(word),
            english.is_hesitation(word),
            english.is_intensifier(word),
            is_in(kArticles, word),
            is_in(kPronouns, word),
            is_in(kPrepositions, word),
            is_number(word),
            is_in(kNegations, word),
            ends_with_any(word, {"ing"}),
            ends_with_any(word, {"ed"}),
            ends_with_any(word, {"ly"}),
            ends_with_any(word, {"tion", "sion", "ness", "ment", "ity", "ance", "ence", "ism", "ist"})};
}

double rank_of(std::string_view word) {
    static const std::unordered_map<std::string_view, double> common = ranks();
    const auto found = common.find(word);
    if (found != common.end()) return found->second;
    return static_cast<double>(common.size()) * std::exp2(static_cast<double>(word.size()) / 2);
}

}  // namespace chironomia
