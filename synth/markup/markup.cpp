#include "synth/markup/markup.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <system_error>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/markup/aplm.h"
#include "synth/markup/bml.h"
#include "synth/markup/functions.h"
#include "synth/markup/letters.h"
#include "synth/markup/markdown.h"
#include "synth/markup/script_words.h"
#include "synth/markup/ssml.h"
#include "synth/markup/text_rules.h"
#include "synth/markup/vocabulary.h"
#include "synth/markup/word_spans.h"
#include "synth/markup/xml.h"

namespace chironomia {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;  // of a text: some 18 hours of speech
constexpr std::array<std::string_view, 4> kNames = {"plain", "aplm", "bml", "ssml"};

std::vector<Mark> emphases_of(const SpokenMarkdown& markdown, std::span<const ScriptWord> words) {
    std::vector<Mark> marks;
    for (const WrittenEmphasis& written : markdown.emphases) {
        const std::size_t first = word_at(words, written.begin), last = word_from(words, written.end);
        const std::string value = written.is_strong ? "high" : "medium";
        if (first < last)
            marks.push_back({.kind = MarkKind::emphasis,
                             .value = value,
                             .first_word = first,
                             .end_word = last,
                             .weight = default_weight(MarkKind::emphasis, value)});
    }
    return marks;
}

MarkedText parse_plain(const MarkupSource& source) {
    const std::optional<SpokenMarkdown> markdown =
        source.is_heard ? std::nullopt : read_markdown(source.text);
    MarkedText text{.script = markdown ? markdown->text : source.text};
    text.words = find_words(text.script);
    if (text.words.empty())
        throw Error(format("{}:1:1: holds no word; write what is to be said", source.name));
    text.marks = marks_by_rules(text, source.language);
    if (markdown) {
        set_emphases(text, emphases_of(*markdown, text.words));
        text.notes.push_back(format("{}: its signs of Markdown are not spoken", source.name));
    }
    return text;
}

MarkedText parse(const MarkupSource& source, MarkupLanguage language) {
    switch (language) {
        case MarkupLanguage::plain:
            return parse_plain(source);
        case MarkupLanguage::aplm:
            return parse_aplm(source);
        case MarkupLanguage::bml:
            return parse_bml(source);
        case MarkupLanguage::ssml:
            return parse_ssml(source);
    }
    return {};
}

bool declares_latin_1(std::string_view text) {
    if (!text.starts_with("<?xml")) return false;
    return to_lower(text.substr(0, text.find("?>"))).find("iso-8859-1") != std::string::npos;
}

// The characters of ISO 8859-1 are the first 256 of Unicode.
std::string utf8_of_latin_1(std::string_view text) {
    std::u32string characters;
    for (const char letter : text) characters += static_cast<unsigned char>(letter);
    return to_utf8(characters);
}

// In UTF-8, without the mark that some editors put before it, and composed, as lists of words are.
MarkupSource checked(const MarkupSource& source) {
    MarkupSource clean = source;
    if (declares_latin_1(clean.text) && fault_in_utf8(clean.text)) clean.text = utf8_of_latin_1(clean.text);
    if (clean.text.starts_with("\xef\xbb\xbf")) clean.text.erase(0, 3);
    if (clean.text.size() > kMostBytes)
        throw Error(format("{}: holds {} bytes, at most {} are read; part it", source.name, clean.text.size(),
                           kMostBytes));
    refuse_bad_text(clean.text, clean.name);
    clean.text = composed(clean.text);
    return clean;
}

// One word with any ending, such as "talk.docx", or any name with the ending of a text.
bool looks_like_a_file(std::string_view text) {
    const std::size_t dot = text.rfind('.');
    if (dot == std::string_view::npos || text.find('\n') != std::string_view::npos) return false;
    const std::string ending = to_lower(text.substr(dot + 1));
    for (const std::string_view known : {"txt", "xml", "aplm", "apml", "bml", "ssml"})
        if (ending == known) return true;
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_of_ending = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); };
    return text.find_first_of(" \t") == std::string_view::npos && ending.size() >= 2 && ending.size() <= 5 &&
           is_letter(ending[0]) && std::ranges::all_of(ending, is_of_ending);
}

bool is_file(const std::string& text) {
    constexpr std::size_t kLongestName = 4096;
    std::error_code none;
    return text.size() < kLongestName && text.find('\n') == std::string::npos &&
           std::filesystem::is_regular_file(text, none);
}

}  // namespace

std::string_view name_of(MarkupLanguage language) {
    return kNames[static_cast<std::size_t>(language)];
}

std::optional<MarkupLanguage> markup_language_named(std::string_view name) {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == name) return static_cast<MarkupLanguage>(i);
    return std::nullopt;
}

MarkupLanguage recognise_markup(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::string root = to_lower(root_name(text));
    if (root == "speak") return MarkupLanguage::ssml;
    if (root == "bml" || root == "fml-apml") return MarkupLanguage::bml;
    return root == "aplm" || root == "apml" ? MarkupLanguage::aplm : MarkupLanguage::plain;
}

MarkedText parse_marked_text(const MarkupSource& source, MarkupLanguage language) {
    MarkupSource clean = checked(source);
    BlankedEmoji emoji;
    if (!source.is_heard) {  // each word of a recording stands
        emoji = blank_emoji(clean.text);
        clean.text = std::move(emoji.text);
    }
    MarkedText text = parse(clean, language);
    if (emoji.count > 0)
        text.notes.push_back(format("{}: its {} emoji are not spoken", source.name, emoji.count));
    // An SSML that names languages is right about them.
    if (language != MarkupLanguage::ssml || clean.text.find("xml:lang") == std::string::npos) {
        std::vector<std::string> words;
        for (const ScriptWord& word : text.words) words.push_back(plain_letters(word.text));
        if (const auto other = describe_other_language(words, source.language))
            text.notes.push_back(format("{}: {}", source.name, *other));
    }
    return text;
}

MarkedText parse_marked_text(const MarkupSource& source) {
    const MarkupLanguage language = recognise_markup(source.text);
    if (language == MarkupLanguage::plain && !root_name(source.text).empty())
        throw Error(format(
            "{}: <{}> begins none of the input languages; they begin with <APLM>, <bml>, <fml-apml> or "
            "<speak>",
            source.name, root_name(source.text)));
    return parse_marked_text(source, language);
}

MarkupSource read_markup_source(const std::string& file_or_text, std::string_view option) {
    if (is_file(file_or_text)) return {.text = read_text(file_or_text), .name = file_or_text};
    if (looks_like_a_file(file_or_text))
        throw Error(
            format("{}: \"{}\" is no file; check the path, or write the text itself", option, file_or_text));
    return {.text = file_or_text, .name = std::string(option)};
}

}  // namespace chironomia
