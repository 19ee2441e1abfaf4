#include "skinning/face/face_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "core/body/arkit.h"
#include "core/text.h"

namespace chironomia {
namespace {

struct KnownShape {
    std::string_view key;
    UnitShare share;
};

// ARKit, "ARFaceAnchor.BlendShapeLocation": its shapes are drawn after FACS. A lip that another shape moves
// on the way parts the lips (AU25) a little.
constexpr std::array kArkit = {
    KnownShape{"browinnerup", {1, 1}},       KnownShape{"browouterup", {2, 1}},
    KnownShape{"browdown", {4, 1}},          KnownShape{"eyewide", {5, 1}},
    KnownShape{"cheeksquint", {6, 1}},       KnownShape{"eyesquint", {7, 1}},
    KnownShape{"nosesneer", {9, 1}},         KnownShape{"mouthupperup", {10, 1}},
    KnownShape{"mouthupperup", {25, .15f}},  KnownShape{"mouthsmile", {12, 1}},
    KnownShape{"mouthdimple", {14, 1}},      KnownShape{"mouthfrown", {15, 1}},
    KnownShape{"mouthlowerdown", {16, 1}},   KnownShape{"mouthlowerdown", {25, .5f}},
    KnownShape{"mouthshruglower", {17, 1}},  KnownShape{"mouthshrugupper", {17, .5f}},
    KnownShape{"mouthpucker", {18, 1}},      KnownShape{"mouthpucker", {23, .25f}},
    KnownShape{"tongueout", {19, 1}},        KnownShape{"mouthstretch", {20, 1}},
    KnownShape{"mouthfunnel", {22, 1}},      KnownShape{"mouthpress", {23, .6f}},
    KnownShape{"mouthpress", {24, 1}},       KnownShape{"mouthrollupper", {23, .3f}},
    KnownShape{"mouthrollupper", {28, 1}},   KnownShape{"mouthrolllower", {23, .3f}},
    KnownShape{"mouthrolllower", {28, 1}},   KnownShape{"jawopen", {25, .08f}},
    KnownShape{"jawopen", {26, kWholeDrop}}, KnownShape{"mouthclose", {8, kWholeDrop}},
    KnownShape{"jawforward", {29, 1}},       KnownShape{"jawleft", {30, 1}},
    KnownShape{"jawright", {30, 1}},         KnownShape{"cheekpuff", {34, 1}},
    KnownShape{"eyeblink", {45, 1}},
};

constexpr std::array kOther = {
    // faceshift: "BrowsD_L", "BrowsU_C", "LipsStretch_L"
    KnownShape{"browsuc", {1, 1}},
    KnownShape{"browsu", {2, 1}},
    KnownShape{"browsd", {4, 1}},
    KnownShape{"eyeopen", {5, 1}},
    KnownShape{"sneer", {9, 1}},
    KnownShape{"lipsupperup", {10, 1}},
    KnownShape{"lipslowerdown", {16, 1}},
    KnownShape{"lipslowerdown", {25, .5f}},
    KnownShape{"chinlowerraise", {17, 1}},
    KnownShape{"lipspucker", {18, 1}},
    KnownShape{"lipsstretch", {20, 1}},
    KnownShape{"lipsfunnel", {22, 1}},
    KnownShape{"lipsupperclose", {28, 1}},
    KnownShape{"lipslowerclose", {28, 1}},
    KnownShape{"jawfwd", {29, 1}},
    KnownShape{"puff", {34, 1}},
    // Mixamo: "BrowsUp_Left" raises the whole brow
    KnownShape{"browsup", {1, .6f}},
    KnownShape{"browsup", {2, 1}},
    KnownShape{"browsdown", {4, 1}},
    KnownShape{"browsin", {4, .5f}},
    KnownShape{"eyeswide", {5, 1}},
    KnownShape{"squint", {7, 1}},
    KnownShape{"nosescrunch", {9, 1}},
    KnownShape{"upperlipup", {10, 1}},
    KnownShape{"smile", {12, 1}},
    KnownShape{"mouthcornerpull", {12, 1}},
    KnownShape{"frown", {15, 1}},
    KnownShape{"lowerlipdown", {16, 1}},
    KnownShape{"lowerlipdown", {25, .5f}},
    KnownShape{"jawup", {17, .6f}},
    KnownShape{"mouthnarrow", {18, .8f}},
    KnownShape{"mouthnarrow", {23, .5f}},
    KnownShape{"jawdown", {26, .7f}},
    KnownShape{"mouthopen", {26, .7f}},
    KnownShape{"upperlipin", {28, 1}},
    KnownShape{"lowerlipin", {28, 1}},
    KnownShape{"jawforeward", {29, 1}},
    KnownShape{"blink", {45, 1}},
    // Character Creator: "Brow_Raise_Inner_L", "Mouth_Up_Upper_L"
    KnownShape{"browraiseinner", {1, 1}},
    KnownShape{"browraiseouter", {2, 1}},
    KnownShape{"browdrop", {4, 1}},
    KnownShape{"browcompress", {4, .5f}},
    KnownShape{"cheekraise", {6, 1}},
    KnownShape{"mouthupupper", {10, 1}},
    KnownShape{"mouthdownlower", {16, 1}},
    KnownShape{"mouthdownlower", {25, .5f}},
    KnownShape{"mouthpuckerup", {18, 1}},
    KnownShape{"mouthpuckerdown", {18, 1}},
    KnownShape{"mouthfunnelup", {22, 1}},
    KnownShape{"mouthfunneldown", {22, 1}},
    KnownShape{"mouthrollinupper", {23, .3f}},
    KnownShape{"mouthrollinupper", {28, 1}},
    KnownShape{"mouthrollinlower", {23, .3f}},
    KnownShape{"mouthrollinlower", {28, 1}},
    KnownShape{"cheekblow", {34, 1}},
    // Daz and Autodesk: "h_expressions.LsmileClose_h"
    KnownShape{"browup", {1, .6f}},
    KnownShape{"browup", {2, 1}},
    KnownShape{"lowlid", {7, .7f}},
    KnownShape{"disgust", {9, 1}},
    KnownShape{"lipup", {10, 1}},
    KnownShape{"smileclose", {12, 1}},
    KnownShape{"lipcorner", {14, 1}},
    KnownShape{"mouthsad", {15, 1}},
    KnownShape{"lipdown", {16, 1}},
    KnownShape{"lipdown", {25, .5f}},
    KnownShape{"chin", {17, 1}},
    KnownShape{"kiss", {18, 1}},
    KnownShape{"lipside", {20, .6f}},
    KnownShape{"jawcompress", {24, 1}},
    KnownShape{"jawfront", {29, 1}},
    KnownShape{"jaw", {30, 1}},
    KnownShape{"eyeclose", {45, 1}},
    KnownShape{"eyeclosed", {45, 1}},
    KnownShape{"eyeupperclose", {45, 1}},
    KnownShape{"eyelowerclose", {45, 1}},
    KnownShape{"eyeupperwide", {5, 1}},
    KnownShape{"eyesclosed", {45, 1}},
    // VRoid: "Fcl_BRW_Angry"
    KnownShape{"fclbrwsorrow", {1, 1}},
    KnownShape{"fclbrwsurprised", {2, 1}},
    KnownShape{"fclbrwangry", {4, 1}},
    KnownShape{"fcleyespread", {5, 1}},
    KnownShape{"fclmthfun", {12, 1}},
    KnownShape{"fclmthdown", {15, 1}},
    KnownShape{"fclmthu", {18, 1}},
    KnownShape{"fclmthi", {20, .6f}},
    KnownShape{"fclmtho", {22, 1}},
    KnownShape{"fclmtha", {26, .7f}},
    KnownShape{"fcleyeclose", {45, 1}},
    // MakeHuman's targets: "eye-left-closure", "mouth-corner-puller"
    KnownShape{"eyebrowsinnerup", {1, 1}},
    KnownShape{"eyebrowsexternup", {2, 1}},
    KnownShape{"eyebrowsdown", {4, 1}},
    KnownShape{"eyeopenedup", {5, 1}},
    KnownShape{"eyeslit", {7, 1}},
    KnownShape{"mouthcornerpuller", {12, 1}},
    KnownShape{"mouthdepression", {15, 1}},
    KnownShape{"mouthelevation", {17, 1}},
    KnownShape{"mouthpursing", {18, 1}},
    KnownShape{"mouthretraction", {20, 1}},
    KnownShape{"mouthcompression", {23, 1}},
    KnownShape{"mouthparling", {25, 1}},
    KnownShape{"eyeclosure", {45, 1}},
};

// VRM: a whole expression stands for its most typical unit. AU1 also uses half of "sad", for its brows, and AU5 half of
// "surprised", for its eyes: half, because the mouth should stay nearly still. "viseme_aa" and its like are Oculus's.
constexpr std::array kExpressions = {
    KnownShape{"sad", {1, .5f}},
    KnownShape{"surprised", {2, 1}},
    KnownShape{"angry", {4, 1}},
    KnownShape{"surprised", {5, .5f}},
    KnownShape{"happy", {12, 1}},
    KnownShape{"sad", {15, 1}},
    KnownShape{"ou", {18, 1}},
    KnownShape{"ih", {20, .7f}},
    KnownShape{"oh", {22, 1}},
    KnownShape{"aa", {25, .3f}},
    KnownShape{"aa", {26, 1}},
    KnownShape{"blink", {45, 1}},
    KnownShape{"visemeu", {18, 1}},
    KnownShape{"visemei", {20, .7f}},
    KnownShape{"visemeo", {22, 1}},
    KnownShape{"visemeaa", {25, .3f}},
    KnownShape{"visemeaa", {26, 1}},
    // VRM 0
    KnownShape{"joy", {12, 1}},
    KnownShape{"sorrow", {1, .5f}},
    KnownShape{"sorrow", {15, 1}},
    // its vowels, and VRChat's "vrc.v_aa"
    KnownShape{"u", {18, 1}},
    KnownShape{"i", {20, .7f}},
    KnownShape{"o", {22, 1}},
    KnownShape{"a", {25, .3f}},
    KnownShape{"a", {26, 1}},
    KnownShape{"vou", {18, 1}},
    KnownShape{"vih", {20, .7f}},
    KnownShape{"voh", {22, 1}},
    KnownShape{"vaa", {25, .3f}},
    KnownShape{"vaa", {26, 1}},
};

// The usual morphs of MikuMikuDance, and a name from above that means the same.
struct MmdShape {
    std::string_view name, meaning;
};
constexpr std::array kMmd = {
    MmdShape{"あ", "aa"},
    MmdShape{"い", "ih"},
    MmdShape{"う", "ou"},
    MmdShape{"お", "oh"},
    MmdShape{"まばたき", "blink"},
    MmdShape{"ウィンク", "blink_l"},
    MmdShape{"ウィンク右", "blink_r"},
    MmdShape{"ウィンク２", "blink_l"},
    MmdShape{"ウィンク２右", "blink_r"},
    MmdShape{"ｳｨﾝｸ２右", "blink_r"},
    MmdShape{"びっくり", "eyeWide"},
    MmdShape{"じと目", "eyeSquint"},
    MmdShape{"上", "browsUp"},
    MmdShape{"下", "browDown"},
    MmdShape{"怒り", "browDown"},
    MmdShape{"困る", "browInnerUp"},
    MmdShape{"にやり", "mouthSmile"},
    MmdShape{"口角上げ", "mouthSmile"},
    MmdShape{"口角下げ", "mouthFrown"},
};

struct KnownLook {
    std::string_view key;
    Look look;
};
constexpr std::array kLooks = {
    KnownLook{"eyelookup", Look::up},      KnownLook{"eyelookdown", Look::down},
    KnownLook{"eyelookin", Look::in},      KnownLook{"eyelookout", Look::out},
    KnownLook{"eyelookleft", Look::left},  KnownLook{"eyelookright", Look::right},
    KnownLook{"eyeslookup", Look::up},     KnownLook{"eyeslookdown", Look::down},
    KnownLook{"eyeslookleft", Look::left}, KnownLook{"eyeslookright", Look::right},
    KnownLook{"lookup", Look::up},         KnownLook{"lookdown", Look::down},
    KnownLook{"lookleft", Look::left},     KnownLook{"lookright", Look::right},
    KnownLook{"eyeup", Look::up},          KnownLook{"eyedown", Look::down},
    KnownLook{"eyein", Look::in},          KnownLook{"eyeout", Look::out},
};

constexpr size_t kShortestEnding = 5;  // letters

bool is_upper(char c) {
    return c >= 'A' && c <= 'Z';
}
bool is_lower(char c) {
    return c >= 'a' && c <= 'z';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Whether a new word begins at `i`: "eyeBlink", "BRWAngry", "BlinkL".
bool begins_word(std::string_view text, size_t i) {
    if (i == 0 || !is_upper(text[i])) return false;
    return !is_upper(text[i - 1]) || (i + 1 < text.size() && is_lower(text[i + 1]));
}

// In lower case.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words(1);
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool counts = is_upper(c) || is_lower(c) || is_digit(c);
        if (!counts || begins_word(text, i)) {
            if (!words.back().empty()) words.emplace_back();
        }
        if (counts) words.back() += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

std::optional<FaceSide> side_named(std::string_view word) {
    if (word == "l" || word == "left") return FaceSide::left;
    if (word == "r" || word == "right") return FaceSide::right;
    return std::nullopt;
}

// "h_expressions.LsmileClose_h": the side leans on the first word, and the last one is the level of detail. Blender's
// "mouthSmile.L" and "jawOpen.001" have no group before the dot.
std::string without_daz_marks(std::string_view name) {
    const auto is_group_end = [&](size_t at) {
        const std::string behind = to_lower(name.substr(at + 1));
        return !side_named(behind) && !std::all_of(behind.begin(), behind.end(), is_digit);
    };
    size_t at = name.find_last_of(".:");
    while (at != std::string_view::npos && !is_group_end(at))
        at = at == 0 ? std::string_view::npos : name.find_last_of(".:", at - 1);
    std::string stem(name.substr(at == std::string_view::npos ? 0 : at + 1));
    if (!stem.ends_with("_h")) return stem;
    stem.resize(stem.size() - 2);
    const bool sided = stem.size() > 2 && (stem[0] == 'L' || stem[0] == 'R') && is_lower(stem[1]);
    return sided ? stem.substr(0, 1) + "_" + stem.substr(1) : stem;
}

// The number after an "au" that begins a word, and where it ends.
struct UnitNumber {
    int unit = 0;
    size_t end = 0;
};
std::optional<UnitNumber> unit_number_in(std::string_view lower, size_t from = 0) {
    for (size_t at = lower.find("au", from); at != std::string_view::npos; at = lower.find("au", at + 1)) {
        const bool begins = at == 0 || !is_lower(lower[at - 1]) || lower.substr(0, at).ends_with("facs");
        size_t i = at + 2;
        while (i < lower.size() && (lower[i] == '_' || lower[i] == '-' || lower[i] == ' ')) ++i;
        int number = 0;
        const size_t digits = i;
        for (; i < lower.size() && i < digits + 3 && is_digit(lower[i]); ++i)
            number = 10 * number + (lower[i] - '0');
        if (begins && i > digits) return UnitNumber{.unit = number, .end = i};
    }
    return std::nullopt;
}

// "AU12_L", "FACS_AU12", "AU_12_left", "AU_12_L_LipCornerPuller"; not what mixes two units.
std::optional<ShapeMeaning> read_unit_name(std::string_view name) {
    const std::string lower = to_lower(name);
    const auto number = unit_number_in(lower);
    if (!number || name_of_unit(number->unit).empty()) return std::nullopt;
    if (unit_number_in(lower, number->end)) return std::nullopt;
    ShapeMeaning meaning{.family = NameFamily::facs, .key = format("au{}", number->unit)};
    meaning.units = {{.unit = number->unit, .weight = 1}};
    for (const std::string& word : words_of(name.substr(number->end))) {
        if (const auto side = side_named(word)) meaning.side = *side;
    }
    return meaning;
}

template <typename Table>
void add_units(ShapeMeaning& meaning, const Table& table, NameFamily family) {
    if (!meaning.units.empty()) return;
    for (const KnownShape& known : table) {
        if (known.key != meaning.key) continue;
        meaning.family = family;
        meaning.units.push_back(known.share);
    }
}

// "lipcornerpuller", or what it does: "lipcornerpull", "cheekraise", "lippress"
bool names_unit(std::string_view key, std::string_view name) {
    if (key == name) return true;
    for (const std::string_view ending : {"r", "er", "or"})
        if (name.ends_with(ending) && key == name.substr(0, name.size() - ending.size())) return true;
    return false;
}

void add_unit_by_its_name(ShapeMeaning& meaning) {
    for (const int unit : known_action_units()) {
        std::string squashed(name_of_unit(unit));
        std::erase(squashed, ' ');
        if (!names_unit(meaning.key, squashed) || !meaning.units.empty()) continue;
        meaning.family = NameFamily::facs;
        meaning.units = {{.unit = unit, .weight = 1}};
    }
}

// The meaning of words without sides, or of their last few; "jawleft" is the only shape whose side is its
// meaning.
ShapeMeaning meaning_of_key(const std::string& key, bool expression) {
    ShapeMeaning meaning{.key = key};
    for (const KnownLook& known : kLooks) {
        if (known.key != key) continue;
        meaning.look = known.look;
        meaning.family = expression ? NameFamily::expression : NameFamily::arkit;
        return meaning;
    }
    if (expression) add_units(meaning, kExpressions, NameFamily::expression);
    add_unit_by_its_name(meaning);
    add_units(meaning, kArkit, NameFamily::arkit);
    add_units(meaning, kOther, NameFamily::other);
    if (!expression) add_units(meaning, kExpressions, NameFamily::expression);
    if (key == "jawleft") meaning.side = FaceSide::left;
    if (key == "jawright") meaning.side = FaceSide::right;
    if (key == "jawleft" || key == "jawright") meaning.key = "jawside";
    return meaning;
}

size_t length_of_all(const std::vector<std::string>& words) {
    size_t length = 0;
    for (const std::string& word : words) length += word.size();
    return length;
}

ShapeMeaning meaning_of_words(const std::vector<std::string>& words, bool expression) {
    // Snap's "ca_jawOpen" corrects what the joint of the jaw does.
    if (!words.empty() && words[0] == "ca") return {};
    for (size_t first = 0; first < words.size(); ++first) {
        std::string key;
        for (size_t w = first; w < words.size(); ++w) key += words[w];
        // A short word ends many others that mean something else ("doublechin"), and a side is never dropped.
        if (first > 0 && (key.size() < kShortestEnding || side_named(words[first - 1]))) break;
        ShapeMeaning meaning = meaning_of_key(key, expression);
        if (!meaning.is_known()) continue;
        // "jawOpen_mouthSmile" corrects where both are shown; one of them alone must not move it.
        const std::vector<std::string> before(words.begin(),
                                              words.begin() + static_cast<std::ptrdiff_t>(first));
        if (length_of_all(before) >= kShortestEnding && meaning_of_words(before, expression).is_known())
            return {};
        return meaning;
    }
    return {};
}

// The first word that is a side, taken out; a second one is a direction ("Eye_L_Look_R").
struct Sided {
    std::vector<std::string> words{};
    FaceSide side = FaceSide::both;
};
Sided without_side(const std::vector<std::string>& words) {
    Sided sided;
    for (const std::string& word : words) {
        const auto side = side_named(word);
        if (side && sided.side == FaceSide::both) {
            sided.side = *side;
        } else if (side) {
            sided.words.emplace_back(*side == FaceSide::left ? "left" : "right");
        } else if (!std::all_of(word.begin(), word.end(), is_digit)) {
            sided.words.push_back(word);
        }
    }
    return sided;
}

// "eyeblinkleft", all in lower case.
Sided without_ending(std::vector<std::string> words) {
    Sided sided{.words = std::move(words)};
    if (sided.words.empty()) return sided;
    std::string& last = sided.words.back();
    for (const auto& [ending, side] : {std::pair(std::string_view("left"), FaceSide::left),
                                       std::pair(std::string_view("right"), FaceSide::right)}) {
        if (last.size() <= ending.size() || !last.ends_with(ending)) continue;
        last.resize(last.size() - ending.size());
        sided.side = side;
        break;
    }
    return sided;
}

ShapeMeaning read_name(std::string_view name, bool expression) {
    for (const MmdShape& known : kMmd)
        if (known.name == name) name = known.meaning;
    if (const auto unit = read_unit_name(name)) return *unit;
    const std::vector<std::string> words = words_of(without_daz_marks(name));
    // "Cheek_Raise_R" is the right side's, not a "cheekraiser".
    const bool has_letter = std::any_of(words.begin(), words.end(),
                                        [](const std::string& word) { return word == "l" || word == "r"; });
    if (ShapeMeaning whole = meaning_of_words(words, expression); !has_letter && whole.is_known())
        return whole;
    for (const Sided& sided : {without_side(words), without_ending(words)}) {
        ShapeMeaning meaning = meaning_of_words(sided.words, expression);
        if (!meaning.is_known()) continue;
        meaning.side = sided.side;
        return meaning;
    }
    return {};
}

}  // namespace

ShapeMeaning read_shape_name(std::string_view name) {
    return read_name(name, false);
}

ShapeMeaning read_expression_name(std::string_view name) {
    return read_name(name, true);
}

}  // namespace chironomia
