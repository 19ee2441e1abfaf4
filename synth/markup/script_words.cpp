#include "synth/markup/script_words.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "core/utf8.h"

namespace chironomia {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";

// White space of Unicode besides ASCII's, and the space without width.
constexpr std::array<std::string_view, 19> kSpaces = {
    "\u0085", "\u00a0", "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006", "\u2007",
    "\u2008", "\u2009", "\u200a", "\u2028", "\u2029", "\u202f", "\u205f", "\u3000", "\u200b"};
constexpr std::array<std::string_view, 2> kHyphens = {"\u2010", "\u2011"};

// Soft hyphens, byte order marks, word joiners, and what sets the direction of writing.
constexpr std::array<std::string_view, 15> kInvisible = {"\u00ad", "\ufeff", "\u2060", "\u200e", "\u200f",
                                                         "\u061c", "\u202a", "\u202b", "\u202c", "\u202d",
                                                         "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"};

// What parts words wherever it stands besides spaces, and what is cut from their ends besides what is invisible.
constexpr std::array<std::string_view, 36> kBreaks = {
    " ",      "\t",     "\r",     "\n",     "\f",     "\v",     "\u2014", "\u2013", "\u2026",
    "\"",     "(",      ")",      "[",      "]",      "{",      "}",      "/",      "\u00ab",
    "\u00bb", "\u201c", "\u201d", "\u201e", "<",      ">",      "\u3002", "\u0964", "\u06d4",
    "\uff1f", "\u061f", "\uff01", "\uff1b", "\uff1a", "\u061b", "\uff0c", "\u3001", "\u060c"};
constexpr std::array<std::string_view, 27> kTrimmed = {
    ".", ",", ";", ":", "!", "?",  "'",      "`",      "-",      "\u2010", "\u2011", "*",      "_",     "~",
    "|", "^", "#", "=", "+", "\\", "\u2018", "\u2019", "\u201a", "\u2039", "\u203a", "\u00bf", "\u00a1"};

template <std::size_t N>
std::size_t starts_with_any(std::string_view text, const std::array<std::string_view, N>& candidates) {
    for (const std::string_view candidate : candidates)
        if (text.starts_with(candidate)) return candidate.size();
    return 0;
}

template <std::size_t N>
std::size_t ends_with_any(std::string_view text, const std::array<std::string_view, N>& candidates) {
    for (const std::string_view candidate : candidates)
        if (text.ends_with(candidate)) return candidate.size();
    return 0;
}

// How many bytes at the beginning of `text` part words there. Two full stops in a row are an ellipsis.
std::size_t break_length(std::string_view text) {
    if (text.starts_with("..")) return std::min(text.find_first_not_of('.'), text.size());
    const std::size_t space = starts_with_any(text, kSpaces);
    return space > 0 ? space : starts_with_any(text, kBreaks);
}

void add_word(std::string_view script, std::size_t begin, std::size_t end, std::vector<ScriptWord>& words) {
    const auto piece = [&] { return script.substr(begin, end - begin); };
    const auto cut_at_start = [&] {
        return std::max(starts_with_any(piece(), kTrimmed), starts_with_any(piece(), kInvisible));
    };
    const auto cut_at_end = [&] {
        return std::max(ends_with_any(piece(), kTrimmed), ends_with_any(piece(), kInvisible));
    };
    while (const std::size_t cut = cut_at_start()) begin += cut;
    while (const std::size_t cut = cut_at_end()) end -= cut;
    if (begin < end) words.push_back({with_plain_signs(piece()), begin, end});
}

constexpr std::string_view kJoiner = "\u200d";

enum class EmojiPart {
    none,
    picture,
    joined,  // if it follows a part: a joiner, a selector of its colours, a tag
};

EmojiPart emoji_part(std::string_view character) {
    const auto between = [&](std::string_view first, std::string_view last) {
        return character.size() == first.size() && first <= character && character <= last;
    };
    // The colours of skin vary what is before them.
    if (between("\U0001f3fb", "\U0001f3ff")) return EmojiPart::joined;
    // Symbols of weather and games to dingbats, without signs of music and digits; clocks and players, stars and
    // squares; pictographs and flags.
    for (const auto& [first, last] :
         std::to_array<std::array<std::string_view, 2>>({{"\u2600", "\u2668"},
                                                         {"\u2670", "\u2775"},
                                                         {"\u2794", "\u27bf"},
                                                         {"\u231a", "\u231b"},
                                                         {"\u23e9", "\u23fa"},
                                                         {"\u2b1b", "\u2b1c"},
                                                         {"\u2b50", "\u2b55"},
                                                         {"\U0001f000", "\U0001faff"}}))
        if (between(first, last)) return EmojiPart::picture;
    const bool is_joined = character == kJoiner || between("\ufe0e", "\ufe0f") || character == "\u20e3" ||
                           between("\U000e0020", "\U000e007f");
    return is_joined ? EmojiPart::joined : EmojiPart::none;
}

}  // namespace

bool holds_any(std::string_view text, std::span<const std::string_view> signs) {
    return std::ranges::any_of(
        signs, [&](std::string_view sign) { return text.find(sign) != std::string_view::npos; });
}

bool ends_sentence(std::string_view sign) {
    return holds_any(sign, kStops) || holds_any(sign, kQuestions) || holds_any(sign, kExclamations);
}

bool is_punctuated(std::string_view text) {
    return ends_sentence(text) || holds_any(text, kSemicolons) || holds_any(text, kCommas);
}

std::vector<ScriptWord> find_words(std::string_view script) {
    std::vector<ScriptWord> words;
    std::size_t begin = 0;
    for (std::size_t at = 0; at < script.size();) {
        const std::size_t cut = break_length(script.substr(at));
        if (cut == 0) {
            ++at;
            continue;
        }
        add_word(script, begin, at, words);
        at = begin = at + cut;
    }
    add_word(script, begin, script.size(), words);
    return words;
}

bool starts_with_break(std::string_view script) {
    return break_length(script) > 0;
}

bool ends_with_break(std::string_view script) {
    return ends_with_any(script, kSpaces) > 0 || ends_with_any(script, kBreaks) > 0;
}

std::string with_plain_signs(std::string_view text) {
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view rest = text.substr(at);
        const std::size_t space = starts_with_any(rest, kSpaces), hyphen = starts_with_any(rest, kHyphens),
                          invisible = starts_with_any(rest, kInvisible);
        const std::size_t length = std::max({space, hyphen, invisible});
        if (length == 0)
            plain += text[at];
        else if (invisible == 0)
            plain += space > 0 ? ' ' : '-';
        at += std::max<std::size_t>(1, length);
    }
    return plain;
}

std::string plain_letters(std::string_view word) {
    std::string letters;
    letters.reserve(word.size());
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (word.substr(i).starts_with("\u2019")) {
            letters += '\'';
            i += 2;
        } else if (word[i] == '\xc3' && i + 1 < word.size()) {
            // A with grave to Thorn, less the sign of multiplication.
            const auto second = static_cast<unsigned char>(word[++i]);
            const bool is_capital = second >= 0x80 && second <= 0x9e && second != 0x97;
            letters += '\xc3';
            letters += static_cast<char>(is_capital ? second + 0x20 : second);
        } else {
            letters += word[i];
        }
    }
    return to_lower(letters);
}

BlankedEmoji blank_emoji(std::string_view text) {
    BlankedEmoji blanked{.text = std::string(text)};
    EmojiPart before = EmojiPart::none;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = first_character(text.substr(at)).value_or(Utf8Character{}).bytes;
        EmojiPart part = emoji_part(text.substr(at, length));
        if (part == EmojiPart::joined && before == EmojiPart::none) part = EmojiPart::none;
        // A picture that is joined to the one before is a part of it.
        const bool is_new = part == EmojiPart::picture && !text.substr(0, at).ends_with(kJoiner);
        blanked.count += is_new ? 1 : 0;
        if (part != EmojiPart::none) blanked.text.replace(at, length, length, ' ');
        before = part;
        at += length;
    }
    return blanked;
}

void refuse_bad_text(std::string_view text, std::string_view name) {
    for (std::size_t at = 0; at < text.size();) {
        const std::optional<Utf8Character> character = first_character(text.substr(at));
        const auto byte = static_cast<unsigned char>(text[at]);
        if (!character)
            throw Error(format("{}: byte 0x{:02x} is no UTF-8; save the text as UTF-8",
                               place_in(text, at, name), byte));
        if (byte == 0x7f || (byte < 0x20 && kSpace.find(text[at]) == std::string_view::npos))
            throw Error(format("{}: control character 0x{:02x} cannot be spoken; remove it",
                               place_in(text, at, name), byte));
        at += character->bytes;
    }
}

std::string place_in(std::string_view text, std::size_t byte, std::string_view name) {
    const std::string_view before = text.substr(0, byte);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1;  // 0 where there is none
    return format("{}:{}:{}", name, line, count_characters(before.substr(line_start)) + 1);
}

}  // namespace chironomia
