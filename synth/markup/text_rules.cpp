#include "synth/markup/text_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "core/text.h"
#include "core/utf8.h"
#include "synth/markup/functions.h"
#include "synth/markup/letters.h"
#include "synth/markup/script_words.h"
#include "synth/markup/vocabulary.h"

namespace chironomia {
namespace {

// What parts a word from the next one.
struct Pause {
    enum class Depth { none, comma, clause, sentence, paragraph } depth = Depth::none;
    bool asks = false;
    bool exclaims = false;
};
using Depth = Pause::Depth;

// How much news a word has: longer words have more (Zipf), words that were said before less. Numbers ours.
struct News {
    double per_letter = 0.07;
    double offset = 0.03;
    double repeated = 0.22;
};
constexpr News kNews{};

// A stretch of words [first, end).
struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
    Pause pause;  // after it

    std::size_t size() const { return end - first; }
};

class Marker {
  public:
    Marker(const MarkedText& text, std::string_view language);
    std::vector<Mark> marks();

  private:
    Pause find_pause(std::size_t word) const;
    std::vector<Stretch> sentences() const;
    std::vector<Stretch> clauses_of(const Stretch& sentence) const;
    std::size_t clause_end(std::size_t first, const Stretch& sentence) const;
    bool opens_formula(std::size_t word) const;
    bool is_negated(const Stretch& clause, std::size_t word) const;
    bool is_content(std::size_t word) const { return !vocabulary_.is_function_word(letters_[word]); }
    std::size_t count_content(std::size_t first, std::size_t end) const {
        return content_before_[end] - content_before_[first];
    }
    std::size_t rheme_start(const Stretch& clause) const;
    std::size_t nuclear_word(const Stretch& clause, std::size_t rheme) const;
    bool is_shouted(std::size_t word) const;
    bool is_at_start(const Stretch& clause, std::size_t word) const;

    void mark_sentence(const Stretch& sentence);
    double mark_clause(const Stretch& clause);
    void mark_emphasis(const Stretch& clause, const std::vector<double>& news, std::size_t rheme);
    void mark_boundary(const Stretch& clause, bool asks_openly);
    bool mark_cues(const Stretch& clause);
    bool is_repeated_pointing(const Cue& cue, std::size_t word);
    void add(MarkKind kind, std::string_view value, const Stretch& words, double weight);
    void thin_out();
    std::size_t word_of(const Mark& mark) const;
    double news_in(std::size_t word);

    const MarkedText& text_;
    const Vocabulary& vocabulary_;
    std::vector<std::string> letters_;                                // of each word
    std::vector<Pause> pauses_;                                       // after each word
    std::vector<std::size_t> content_before_{0};                      // content words before each word
    std::unordered_set<std::string> said_;                            // beginnings of content words
    std::unordered_map<std::string_view, std::size_t> last_pointed_;  // value of a deictic -> word
    std::vector<std::size_t> nuclear_;                                // word of the clause of each word
    std::vector<Mark> marks_;
    std::vector<Mark> numbers_;  // of ordinals: shown whenever the enumeration is
};

double rounded(double weight) {
    return std::round(std::clamp(weight, 0.0, 1.0) * 1000) / 1000;
}

Marker::Marker(const MarkedText& text, std::string_view language)
    : text_(text), vocabulary_(Vocabulary::of(language)) {
    for (const ScriptWord& word : text.words) letters_.push_back(plain_letters(word.text));
    for (std::size_t word = 0; word < letters_.size(); ++word) {
        pauses_.push_back(find_pause(word));
        content_before_.push_back(content_before_.back() + (is_content(word) ? 1 : 0));
    }
}

void Marker::add(MarkKind kind, std::string_view value, const Stretch& words, double weight) {
    marks_.push_back({.kind = kind,
                      .value = std::string(value),
                      .first_word = words.first,
                      .end_word = words.end,
                      .weight = rounded(weight)});
}

// The depth of a pause that tags of SSML stand for.
Depth depth_of_tags(std::string_view gap) {
    if (gap.find("</p>") != std::string_view::npos) return Depth::paragraph;
    if (gap.find("</s>") != std::string_view::npos) return Depth::sentence;
    return gap.find("<break") != std::string_view::npos ? Depth::clause : Depth::none;
}

// The signs between the words of SSML, without tags and entities.
std::string without_tags(std::string_view gap) {
    std::string text;
    char until = 0;
    for (const char c : gap) {
        if (until == 0 && c == '<')
            until = '>';
        else if (until == 0 && c == '&')
            until = ';';
        else if (until == 0)
            text += c;
        else if (c == until)
            until = 0;
    }
    return text;
}

bool is_blank_line(std::string_view gap) {
    const std::size_t first = gap.find('\n');
    if (first == std::string_view::npos) return false;
    const std::size_t next = gap.find_first_not_of(" \t\r", first + 1);
    return next != std::string_view::npos && gap[next] == '\n';
}

constexpr std::array<std::string_view, 2> kEllipses = {"..", "\u2026"};
constexpr std::array<std::string_view, 4> kDashes = {"\u2014", "\u2013", " - ", "--"};
constexpr std::array<std::string_view, 2> kBrackets = {"(", ")"};

bool is_small(char letter) {
    return letter >= 'a' && letter <= 'z';
}

// "u.s"
bool are_initials(std::string_view letters) {
    for (std::size_t i = 0; i < letters.size(); ++i)
        if (i % 2 == 0 ? !is_small(letters[i]) : letters[i] != '.') return false;
    return letters.size() >= 3;
}

// Whether a word is written large because a sentence begins with it; "I" is so everywhere.
bool begins_as_a_sentence(std::string_view word) {
    const std::string letters = plain_letters(word);
    return is_capital(characters_of(word).front()) && letters != "i" && !letters.starts_with("i'");
}

Pause Marker::find_pause(std::size_t word) const {
    const bool is_last = word + 1 == letters_.size();
    const std::size_t from = text_.words[word].end;
    const std::size_t to = is_last ? text_.script.size() : text_.words[word + 1].begin;
    const std::string_view raw = std::string_view(text_.script).substr(from, to - from);
    const std::string gap = with_plain_signs(text_.is_ssml ? without_tags(raw) : std::string(raw));

    Pause pause{.depth = text_.is_ssml ? depth_of_tags(raw) : Depth::none};
    pause.asks = holds_any(gap, kQuestions);
    pause.exclaims = holds_any(gap, kExclamations);
    const bool is_ellipsis = holds_any(gap, kEllipses);
    const bool goes_on = !is_last && is_small(text_.words[word + 1].text.front());
    const bool is_short = vocabulary_.is_abbreviation(letters_[word]) || letters_[word].size() == 1 ||
                          (goes_on && are_initials(letters_[word]));
    const auto full_stop = std::span(kStops).first(1), other_stops = std::span(kStops).subspan(1);
    const bool is_stop =
        (holds_any(gap, full_stop) && !is_ellipsis && (!is_short || is_last)) || holds_any(gap, other_stops);
    if (is_blank_line(gap) && !is_last) pause.depth = Depth::paragraph;
    const bool trails_off = is_ellipsis && !is_last && begins_as_a_sentence(text_.words[word + 1].text);
    if (pause.asks || pause.exclaims || is_stop || trails_off || is_last)
        pause.depth = std::max(pause.depth, Depth::sentence);
    if (is_ellipsis || holds_any(gap, kSemicolons) || holds_any(gap, kDashes))
        pause.depth = std::max(pause.depth, Depth::clause);
    if (holds_any(gap, kCommas) || holds_any(gap, kBrackets))
        pause.depth = std::max(pause.depth, Depth::comma);
    return pause;
}

std::vector<Stretch> Marker::sentences() const {
    std::vector<Stretch> sentences;
    std::size_t first = 0;
    for (std::size_t word = 0; word < letters_.size(); ++word) {
        const Pause pause = pauses_[word];
        if (pause.depth < Depth::sentence) continue;
        sentences.push_back({first, word + 1, pause});
        first = word + 1;
    }
    return sentences;
}

// What is said to meet, to part, to thank and to ask for pardon stands for itself, however short it is.
bool is_formula(const Cue& cue) {
    return cue.kind == MarkKind::performative && (cue.value == "greet" || cue.value == "goodbye" ||
                                                  cue.value == "thank" || cue.value == "apologise");
}

// What a negation turns into its opposite: feelings and agreement.
bool can_be_denied(const Cue& cue) {
    return cue.kind == MarkKind::emotion || (cue.kind == MarkKind::performative && cue.value == "agree");
}

// Whether nothing but "and", "well", "um" stands between the word and a formula.
bool Marker::opens_formula(std::size_t word) const {
    while (word + 1 < letters_.size() && pauses_[word].depth < Depth::clause &&
           (vocabulary_.is_conjunction(letters_[word]) || vocabulary_.is_hesitation(letters_[word])))
        ++word;
    const Cue* cue = vocabulary_.cue_at(letters_, word);
    return cue && is_formula(*cue) && cue->place != CuePlace::clause_end;
}

// A comma or a conjunction separates clauses only if both sides have enough words, or the second is a formula.
std::size_t Marker::clause_end(std::size_t first, const Stretch& sentence) const {
    constexpr std::size_t kLeast = 3;     // words of a clause
    constexpr std::size_t kLongest = 14;  // more are parted at any comma or conjunction
    for (std::size_t end = first + 1; end < sentence.end; ++end) {
        const Depth depth = pauses_[end - 1].depth;
        if (depth >= Depth::clause) return end;
        const bool is_long = end - first >= kLeast && sentence.end - end >= kLeast;
        const bool has_news = count_content(first, end) >= 1 && count_content(end, sentence.end) >= 1;
        const bool is_cut = depth == Depth::comma || vocabulary_.is_conjunction(letters_[end]);
        if (is_cut && has_news && is_long) return end;
        const Cue* said = vocabulary_.cue_at(letters_, first);
        const bool is_act = said && said->kind == MarkKind::performative;
        if (depth == Depth::comma && is_act && sentence.end - end >= kLeast) return end;
        const bool parts_formula = depth == Depth::comma || (is_cut && said && is_formula(*said));
        if (parts_formula && opens_formula(end)) return end;
        const bool is_phrase_end = !is_content(end) && is_content(end - 1);
        if (end - first >= kLongest && (is_phrase_end || end - first >= 2 * kLongest)) return end;
    }
    return sentence.end;
}

std::vector<Stretch> Marker::clauses_of(const Stretch& sentence) const {
    std::vector<Stretch> clauses;
    for (std::size_t first = sentence.first; first < sentence.end;) {
        const std::size_t end = clause_end(first, sentence);
        clauses.push_back({first, end, end == sentence.end ? sentence.pause : pauses_[end - 1]});
        first = end;
    }
    return clauses;
}

// The theme is what stands before the first auxiliary verb, else the first content word of several;
// questions, greetings and the like have none.
std::size_t Marker::rheme_start(const Stretch& clause) const {
    constexpr std::size_t kLongestTheme = 6;
    const Cue* said = vocabulary_.cue_at(letters_, clause.first);
    const bool is_act = said && said->kind == MarkKind::performative;
    if (clause.size() < 4 || clause.pause.asks || is_act) return clause.first;
    const std::size_t last = std::min(clause.first + kLongestTheme, clause.end - 1);
    for (std::size_t word = clause.first + 1; word <= last; ++word)
        if (vocabulary_.is_auxiliary(letters_[word]) && count_content(word, clause.end) >= 1) return word;
    if (count_content(clause.first, clause.end) < 3) return clause.first;
    for (std::size_t word = clause.first; word < last; ++word)
        if (is_content(word)) return word + 1;
    return clause.first;
}

std::size_t Marker::nuclear_word(const Stretch& clause, std::size_t rheme) const {
    for (std::size_t word = clause.end; word-- > rheme;)
        if (is_content(word)) return word;
    for (std::size_t word = rheme; word-- > clause.first;)
        if (is_content(word)) return word;
    return clause.end - 1;
}

// In capitals, unlike its neighbours.
bool Marker::is_shouted(std::size_t word) const {
    const auto has_capitals = [&](std::size_t w) {
        const std::string& letters = text_.words[w].text;
        return letters.size() >= 2 &&
               std::all_of(letters.begin(), letters.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
    };
    const bool before = word > 0 && has_capitals(word - 1);
    const bool behind = word + 1 < letters_.size() && has_capitals(word + 1);
    return has_capitals(word) && text_.words[word].text.size() <= 12 && !before && !behind;
}

double Marker::news_in(std::size_t word) {
    const double length = static_cast<double>(std::min<std::size_t>(count_characters(letters_[word]), 11));
    const bool is_new = !is_content(word) || said_.insert(letters_[word].substr(0, 6)).second;
    return kNews.per_letter * length - kNews.offset - (is_new ? 0.0 : kNews.repeated);
}

// Whether nothing but "and", "well", "um" stands before the word in its clause.
bool Marker::is_at_start(const Stretch& clause, std::size_t word) const {
    for (std::size_t w = clause.first; w < word; ++w)
        if (!vocabulary_.is_conjunction(letters_[w]) && !vocabulary_.is_hesitation(letters_[w])) return false;
    return true;
}

// Pronouns and "this" occur in every sentence; people do not point each time.
bool Marker::is_repeated_pointing(const Cue& cue, std::size_t word) {
    constexpr std::size_t kApart = 12;  // words
    if (cue.kind != MarkKind::deictic || cue.value.starts_with("place")) return false;
    const auto [last, is_first] = last_pointed_.try_emplace(cue.value, word);
    if (!is_first && word - last->second < kApart) return true;
    last->second = word;
    return false;
}

// Whether a negation stands before the word, with no comma and no "but" between them: "not happy", "ne suis pas
// content", but "not only happy", "not sad but happy". In German it may also stand behind it, with no conjunction between
// them: "ich freue mich nicht".
bool Marker::is_negated(const Stretch& clause, std::size_t word) const {
    constexpr std::array<std::string_view, 3> kOnly = {"only", "seulement", "nur"};
    for (std::size_t w = word; w-- > clause.first && pauses_[w].depth == Depth::none;) {
        const Cue* cue = vocabulary_.cue_at(letters_, w);
        if (cue && cue->kind == MarkKind::belief_relation && cue->value == "contrast") return false;
        const bool is_only = std::find(kOnly.begin(), kOnly.end(), letters_[w + 1]) != kOnly.end();
        const bool is_certain = cue && cue->kind == MarkKind::certainty && length_of(*cue) > 1;  // "no doubt"
        if (vocabulary_.is_negation(letters_[w]) && !is_only && !is_certain) return true;
    }
    if (!vocabulary_.is_negated_behind(letters_[word])) return false;
    for (std::size_t w = word + 1; w < clause.end && pauses_[w - 1].depth == Depth::none; ++w) {
        if (vocabulary_.is_conjunction(letters_[w])) return false;
        const bool is_only = w + 1 < clause.end && std::ranges::find(kOnly, letters_[w + 1]) != kOnly.end();
        if (vocabulary_.is_negation_behind(letters_[w]) && !is_only) return true;
    }
    return false;
}

// Whether a whole dialog act was found.
bool Marker::mark_cues(const Stretch& clause) {
    const auto words = std::span(letters_).subspan(0, clause.end);
    bool is_act = false;
    for (std::size_t at = clause.first; at < clause.end;) {
        const Cue* cue = vocabulary_.cue_at(words, at);
        const std::size_t end = cue ? at + length_of(*cue) : at + 1;
        const bool fits = cue && (cue->place == CuePlace::anywhere ||
                                  (cue->place == CuePlace::clause_start && is_at_start(clause, at)) ||
                                  (cue->place == CuePlace::clause_end && end == clause.end));
        const bool is_denied = fits && can_be_denied(*cue) && is_negated(clause, at);
        const bool shows = fits && cue->weight > 0;
        if (shows && !is_denied && !is_repeated_pointing(*cue, at)) {
            const bool is_social = cue->kind == MarkKind::performative && cue->value != "refuse";
            const bool is_relation = cue->kind == MarkKind::belief_relation && cue->value != "enumerate";
            add(cue->kind, cue->value, {at, is_social || is_relation ? clause.end : end, {}}, cue->weight);
            is_act |= is_social;
            if (!cue->number.empty())
                numbers_.push_back({.kind = MarkKind::world,
                                    .value = cue->number,
                                    .first_word = at,
                                    .end_word = end,
                                    .weight = cue->weight});
        }
        at = fits ? end : at + 1;
    }
    return is_act;
}

// At most one word of a clause stands out: by capitals, by what is said of it ("very"), or by its news in the
// rheme.
void Marker::mark_emphasis(const Stretch& clause, const std::vector<double>& news, std::size_t rheme) {
    constexpr double kStandsOut = 0.45;
    std::size_t best = clause.first;
    double most = 0;
    bool is_loud = false;
    for (std::size_t word = clause.first; word < clause.end; ++word) {
        const bool is_intense =
            word > clause.first && is_content(word) && vocabulary_.is_intensifier(letters_[word - 1]);
        const double said = word < rheme ? 0 : news[word - clause.first];
        const double force = is_shouted(word) ? 1 : is_intense ? news[word - clause.first] + 0.3 : said;
        if (force <= most) continue;
        best = word;
        most = force;
        is_loud = is_intense || is_shouted(word);
    }
    if (most <= kStandsOut) return;
    const std::string_view level = is_loud || clause.pause.exclaims ? "high" : most > 0.6 ? "medium" : "low";
    add(MarkKind::emphasis, level, {best, best + 1, {}}, std::min(most, 0.95));
}

void Marker::mark_boundary(const Stretch& clause, bool asks_openly) {
    const bool is_end = clause.pause.depth >= Depth::sentence;
    const std::string_view tone = !is_end ? "LH" : clause.pause.asks && !asks_openly ? "HH" : "LL";
    const double weight = clause.pause.depth == Depth::paragraph ? 1 : is_end ? 0.5 : 0.3;
    add(MarkKind::boundary, tone, {clause.end, clause.end, {}}, weight);
}

// The importance of its rheme.
double Marker::mark_clause(const Stretch& clause) {
    const std::size_t rheme = rheme_start(clause);
    const std::size_t nuclear = nuclear_word(clause, rheme);
    nuclear_.insert(nuclear_.end(), clause.size(), nuclear);
    std::vector<double> news(clause.size(), 0.0);
    for (std::size_t word = clause.first; word < clause.end; ++word)
        if (is_content(word) || word == nuclear) news[word - clause.first] = news_in(word);

    const double weight =
        std::clamp(news[nuclear - clause.first] + (clause.pause.exclaims ? 0.1 : 0), 0.1, 0.85);
    if (rheme > clause.first) add(MarkKind::theme, "", {clause.first, rheme, {}}, 0);
    add(MarkKind::rheme, "", {rheme, clause.end, {}}, weight);
    mark_emphasis(clause, news, rheme);
    for (std::size_t word = clause.first; word < clause.end; ++word) {
        if (word != nuclear && !is_content(word)) continue;
        const double shown = word == nuclear ? weight - 0.05 : 0;
        add(MarkKind::pitch_accent, word < rheme ? "LplusHstar" : "Hstar", {word, word + 1, {}}, shown);
    }
    return weight;
}

void Marker::mark_sentence(const Stretch& sentence) {
    const std::string& opening = letters_[sentence.first];
    const bool asks_openly = vocabulary_.is_question_word(opening);
    bool is_act = false;
    double importance = 0;
    for (const Stretch& clause : clauses_of(sentence)) {
        const double weight = mark_clause(clause);
        if (importance == 0) importance = weight;
        is_act |= mark_cues(clause);
        mark_boundary(clause, asks_openly);
    }
    constexpr std::size_t kShort = 6;  // words: "Good morning, Mister Smith." informs of nothing
    if (sentence.pause.asks)
        add(MarkKind::performative, "ask", sentence, std::max(importance, 0.55));
    else if (vocabulary_.is_imperative(opening) && sentence.size() >= 2 && !is_act)
        add(MarkKind::performative, "order", sentence, std::max(importance, 0.5));
    else if (!is_act || sentence.size() > kShort)
        add(MarkKind::performative, "inform", sentence, importance - 0.03);
}

// Acts that only hands show; beside a heavier act they can be dropped.
bool is_shown_by_hands_alone(const Mark& mark) {
    return mark.kind == MarkKind::rheme || mark.kind == MarkKind::emphasis ||
           mark.kind == MarkKind::pitch_accent || mark.kind == MarkKind::deictic ||
           mark.kind == MarkKind::world || (mark.kind == MarkKind::performative && mark.value == "inform");
}

// The word with which an act would be shown: the nuclear one of a whole clause.
std::size_t Marker::word_of(const Mark& mark) const {
    const bool is_wide = mark.kind == MarkKind::rheme || mark.kind == MarkKind::performative ||
                         mark.kind == MarkKind::belief_relation || mark.kind == MarkKind::emotion;
    return is_wide ? nuclear_[mark.first_word] : mark.first_word;
}

// Whether the act has a content that hands can depict, more than that the word is important.
bool can_be_depicted(const Mark& mark) {
    return mark.kind == MarkKind::world ||
           (mark.kind == MarkKind::deictic && mark.value.starts_with("place"));
}

// There is not time for a gesture on every word: near a heavier act others get half their weight, next to it none.
// Acts that can be depicted outrank beats.
void Marker::thin_out() {
    constexpr std::size_t kNext = 3;    // words: about a second
    constexpr std::size_t kBeside = 6;  // words
    constexpr double kPicture = 0.3;    // added to the rank of an act that can be depicted
    std::vector<double> ranks(letters_.size(), 0.0);
    for (const Mark& mark : marks_) {
        if (mark.first_word == mark.end_word || mark.weight == 0) continue;
        double& rank = ranks[word_of(mark)];
        rank = std::max(rank, mark.weight + (can_be_depicted(mark) ? kPicture : 0));
    }
    std::vector<std::size_t> order;
    for (std::size_t word = 0; word < ranks.size(); ++word)
        if (ranks[word] > 0) order.push_back(word);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return ranks[a] > ranks[b]; });

    std::vector<double> factors(ranks.size(), 0.0);
    for (const std::size_t word : order) {
        double factor = 1;
        const std::size_t end = std::min(word + kBeside + 1, ranks.size());
        for (std::size_t other = word - std::min(word, kBeside); other < end; ++other) {
            const std::size_t distance = other < word ? word - other : other - word;
            if (factors[other] > 0) factor = std::min(factor, distance <= kNext ? 0 : 0.5);
        }
        factors[word] = factor;
    }
    for (Mark& mark : marks_)
        if (is_shown_by_hands_alone(mark)) mark.weight = rounded(mark.weight * factors[word_of(mark)]);
}

std::vector<Mark> Marker::marks() {
    add(MarkKind::turn, "take", {0, 0, {}}, default_weight(MarkKind::turn, "take"));
    for (const Stretch& sentence : sentences()) mark_sentence(sentence);
    thin_out();
    marks_.insert(marks_.end(), numbers_.begin(), numbers_.end());
    const std::size_t end = letters_.size();
    add(MarkKind::turn, "give", {end, end, {}}, default_weight(MarkKind::turn, "give"));
    sort_marks(marks_);
    return std::move(marks_);
}

}  // namespace

std::vector<Mark> marks_by_rules(const MarkedText& text, std::string_view language) {
    return Marker(text, language).marks();
}

void set_emphases(MarkedText& text, std::vector<Mark> authored) {
    std::vector<bool> is_authored(text.words.size(), false);
    for (const Mark& mark : authored)
        std::fill(is_authored.begin() + static_cast<std::ptrdiff_t>(mark.first_word),
                  is_authored.begin() + static_cast<std::ptrdiff_t>(mark.end_word), true);
    std::erase_if(text.marks, [&](const Mark& mark) {
        return mark.kind == MarkKind::emphasis && is_authored[mark.first_word];
    });
    text.marks.insert(text.marks.end(), authored.begin(), authored.end());
    sort_marks(text.marks);
}

}  // namespace chironomia
