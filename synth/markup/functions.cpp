#include "synth/markup/functions.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/text.h"

namespace chironomia {
namespace {

// The words in `also` are those of APLM's own lists (De Carolis, Pelachaud, Poggi, Steedman, 2004) and of
// the FML-APML files of GRETA, each led to the nearest function that gestures show.
constexpr FunctionValue kEmphases[] = {
    {"low", 0.35, "weak reduced"}, {"medium", 0.55, "moderate normal"}, {"high", 0.8, "strong"}};
constexpr FunctionValue kAccents[] = {{"Hstar", 0.45, "H*"},        {"Lstar", 0.4, "L*"},
                                      {"LplusHstar", 0.5, "L+H*"},  {"LstarplusH", 0.45, "L*+H"},
                                      {"HplusLstar", 0.45, "H+L*"}, {"HstarplusL", 0.45, "H*+L"}};
constexpr FunctionValue kBoundaries[] = {
    {"LL", 0.5, "L-L% L L-"}, {"LH", 0.5, "L-H%"}, {"HL", 0.5, "H-L% H-"}, {"HH", 0.5, "H-H% H"}};
constexpr FunctionValue kPerformatives[] = {
    {"greet", 0.9, "welcome hello greeting"},
    {"inform", 0.45, "announce tell explain describe state remind paraphrase"},
    {"ask", 0.6, "question interrogate"},
    {"order", 0.65, "request command warn implore beg"},
    {"suggest", 0.55, "propose advice advise recommend incite encourage offer"},
    {"thank", 0.8, "thanks"},
    {"apologise", 0.75, "apologize apology"},
    {"refuse", 0.7, "disagree deny reject criticize criticise disapprove negate"},
    {"agree", 0.6, "accept approve confirm praise recognize recognise acknowledge"},
    {"goodbye", 0.9, "bye farewell"}};
constexpr FunctionValue kCertainties[] = {{"certain", 0.55, "certainly certainty sure"},
                                          {"uncertain", 0.6, "uncertainty doubt unsure maybe"}};
constexpr FunctionValue kRelations[] = {
    {"contrast", 0.65, "opposition concession"},
    {"cause-effect", 0.45, "cause effect justification solutionhood result"},
    {"enumerate", 0.6, "enumeration list sequence"},
    {"condition", 0.45, "conditional"},
    {"elaborate", 0.35, "elaboration gen-spec modifier suggestion example"}};
constexpr FunctionValue kDeictics[] = {{"place-here", 0.65, "here place"},
                                       {"place-there", 0.7, "there"},
                                       {"self", 0.55, "me speaker"},
                                       {"partner", 0.55, "you person hearer listener"},
                                       {"object", 0.6, "thing"}};
constexpr FunctionValue kProperties[] = {{"shape-round", 0.75, "round circle circular"},
                                         {"shape-flat", 0.7, "flat"},
                                         {"size-big", 0.75, "big large huge long great"},
                                         {"size-small", 0.75, "small little tiny subtle"},
                                         {"quantity-one", 0.65, "one"},
                                         {"quantity-two", 0.7, "two"},
                                         {"quantity-three", 0.7, "three"},
                                         {"quantity-many", 0.65, "many all"},
                                         {"up", 0.65, "high rise"},
                                         {"down", 0.65, "low fall"},
                                         {"time-past", 0.6, "past"},
                                         {"time-future", 0.6, "future"}};
constexpr FunctionValue kEmotions[] = {
    {"joy", 0.75,
     "happiness happy happy-for gratification gratitude satisfaction hope love pride relief liking joyStrong"},
    {"sadness", 0.7, "sad sorry-for distress disappointment remorse shame"},
    {"anger", 0.8, "angry reproach resentment hate envy jealousy irritation"},
    {"fear", 0.75, "afraid worry fears-confirmed anxiety"},
    {"surprise", 0.75, "surprised amazement"},
    {"disgust", 0.75, "contempt disliking"}};
constexpr FunctionValue kTurns[] = {{"take", 0.5, "begin"}, {"give", 0.6, "end"}, {"keep", 0.4, "hold"}};
constexpr FunctionValue kBackchannels[] = {{"agreement", 0.6, "agree accept acceptance"},
                                           {"disagreement", 0.6, "disagree refuse refusal"},
                                           {"understanding", 0.5, "understand belief believe"},
                                           {"misunderstanding", 0.5, "no-understanding disbelief"},
                                           {"interest", 0.5, "attention like liking"},
                                           {"boredom", 0.4, "no-interest dislike"}};

// In the order of MarkKind.
constexpr std::array<FunctionKind, 14> kKinds = {{
    {MarkKind::theme, "theme", "", "", 0.2, false, false, {}},
    {MarkKind::rheme, "rheme", "", "", 0.4, false, false, {}},
    {MarkKind::emphasis, "emphasis", "", "medium", 0.55, false, false, kEmphases},
    {MarkKind::pitch_accent, "pitch-accent", "pitchaccent", "Hstar", 0.45, false, false, kAccents},
    {MarkKind::boundary, "boundary", "", "LL", 0.5, false, true, kBoundaries},
    {MarkKind::performative, "performative", "", "inform", 0.5, true, false, kPerformatives},
    {MarkKind::certainty, "certainty", "", "certain", 0.5, true, false, kCertainties},
    {MarkKind::belief_relation, "belief-relation", "", "", 0.5, true, false, kRelations},
    {MarkKind::deictic, "deictic", "", "object", 0.6, true, false, kDeictics},
    {MarkKind::world, "world", "", "", 0.6, true, false, kProperties},
    {MarkKind::emotion, "emotion", "affect affective", "", 0.7, true, false, kEmotions},
    {MarkKind::turn, "turn-allocation", "turn turntaking turnallocation", "take", 0.5, false, true, kTurns},
    {MarkKind::backchannel, "backchannel", "", "", 0.5, true, false, kBackchannels},
    {MarkKind::gesture, "gesture", "", "", 1, true, false, {}},
}};

bool is_listed(std::string_view word, std::string_view list) {
    const std::vector<std::string_view> words = split_words(list);
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view listed) { return to_lower(listed) == to_lower(word); });
}

}  // namespace

std::span<const FunctionKind> function_kinds() {
    return kKinds;
}

const FunctionKind& function_kind(MarkKind kind) {
    const FunctionKind& found = kKinds[static_cast<std::size_t>(kind)];
    assert(found.kind == kind);
    return found;
}

const FunctionKind* function_of_element(std::string_view element) {
    for (const FunctionKind& kind : kKinds)
        if (element == kind.element || is_listed(element, kind.also)) return &kind;
    return nullptr;
}

std::string known_value(const FunctionKind& kind, std::string_view written) {
    for (const FunctionValue& value : kind.values)
        if (to_lower(written) == to_lower(value.value)) return std::string(value.value);
    for (const FunctionValue& value : kind.values)
        if (is_listed(written, value.also)) return std::string(value.value);
    const bool is_own = kind.is_open && (written.starts_with("x-") || kind.values.empty());
    return is_own ? std::string(written) : "";
}

std::vector<std::string> values_of(const FunctionKind& kind) {
    std::vector<std::string> values;
    for (const FunctionValue& value : kind.values) values.emplace_back(value.value);
    return values;
}

double default_weight(MarkKind kind, std::string_view value) {
    const FunctionKind& found = function_kind(kind);
    for (const FunctionValue& candidate : found.values)
        if (candidate.value == value) return candidate.weight;
    return found.weight;
}

std::string function_of(const Mark& mark) {
    return mark.value.empty() ? std::string(name_of(mark.kind))
                              : format("{}={}", name_of(mark.kind), mark.value);
}

void sort_marks(std::vector<Mark>& marks) {
    std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) {
        return a.first_word != b.first_word ? a.first_word < b.first_word : a.end_word > b.end_word;
    });
}

}  // namespace chironomia
