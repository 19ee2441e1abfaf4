#include "synth/markup/ssml.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/files/xml_text.h"
#include "core/text.h"
#include "synth/markup/acts.h"
#include "synth/markup/script_words.h"
#include "synth/markup/text_rules.h"
#include "synth/markup/word_spans.h"
#include "synth/markup/xml.h"

namespace chironomia {
namespace {

// How an attribute's value is written, besides by one of the words.
enum class Form { word, any, time, amount };

struct SsmlAttribute {
    std::string_view name;
    Form form = Form::any;
    std::string_view words = "";  // between spaces
};

struct SsmlElement {
    std::string_view name;
    std::span<const SsmlAttribute> attributes;
};

// The part of SSML 1.1 (W3C, 2010) that espeak-ng speaks.
constexpr std::string_view kSpeeds = "x-slow slow medium fast x-fast default";
constexpr std::string_view kHeights = "x-low low medium high x-high default";
constexpr SsmlAttribute kSpeak[] = {{"version", Form::any}, {"xml:lang", Form::any}};
constexpr SsmlAttribute kLanguage[] = {{"xml:lang", Form::any}};
constexpr SsmlAttribute kProsody[] = {
    {"rate", Form::amount, kSpeeds},
    {"pitch", Form::amount, kHeights},
    {"range", Form::amount, kHeights},
    {"volume", Form::amount, "silent x-soft soft medium loud x-loud default"}};
constexpr SsmlAttribute kEmphasis[] = {{"level", Form::word, "strong moderate none reduced"}};
constexpr SsmlAttribute kBreak[] = {{"time", Form::time},
                                    {"strength", Form::word, "none x-weak weak medium strong x-strong"}};
constexpr SsmlAttribute kSayAs[] = {
    {"interpret-as", Form::any}, {"format", Form::any}, {"detail", Form::any}};
constexpr SsmlAttribute kSub[] = {{"alias", Form::any}};
constexpr SsmlAttribute kMark[] = {{"name", Form::any}};
constexpr SsmlAttribute kVoice[] = {{"xml:lang", Form::any},
                                    {"name", Form::any},
                                    {"gender", Form::any},
                                    {"age", Form::any},
                                    {"variant", Form::any}};
constexpr SsmlElement kElements[] = {
    {"speak", kSpeak},       {"p", kLanguage},   {"s", kLanguage}, {"prosody", kProsody}, {"break", kBreak},
    {"emphasis", kEmphasis}, {"say-as", kSayAs}, {"sub", kSub},    {"mark", kMark},       {"voice", kVoice}};

// Of SSML 1.1, and of Azure ("bookmark"), without a counterpart in the voice: the text in them is spoken as it is.
constexpr std::string_view kUnspoken[] = {"phoneme", "audio",  "w",    "token",   "lang",
                                          "lexicon", "lookup", "meta", "bookmark"};

const SsmlElement* element_named(std::string_view name) {
    const auto found = std::find_if(std::begin(kElements), std::end(kElements),
                                    [&](const SsmlElement& element) { return element.name == name; });
    return found == std::end(kElements) ? nullptr : found;
}

bool is_amount(std::string_view text) {
    constexpr double kMost = 1e6;  // in any unit, far more than a voice can do
    const auto number = parse_number(text);
    return number && std::abs(*number) <= kMost;
}

// "+10%", "-2st", "1.2", "500ms", "120Hz"
bool is_measure(std::string_view text, std::string_view units) {
    for (const std::string_view unit : split_words(units))
        if (text.ends_with(unit) && is_amount(text.substr(0, text.size() - unit.size()))) return true;
    return false;
}

bool fits(const SsmlAttribute& attribute, std::string_view value) {
    const std::vector<std::string_view> words = split_words(attribute.words);
    if (std::find(words.begin(), words.end(), value) != words.end()) return true;
    switch (attribute.form) {
        case Form::word:
            return false;
        case Form::any:
            return true;
        case Form::time:
            return is_measure(value, "ms s") && !value.starts_with('-');
        case Form::amount:
            return is_measure(value, "% st Hz dB") || is_amount(value);
    }
    return false;
}

std::string_view usage_of(Form form) {
    switch (form) {
        case Form::time:
            return "a time such as 500ms or 0.5s";
        case Form::amount:
            return "an amount such as +20%";
        case Form::word:
        case Form::any:
            break;
    }
    return "nothing else";
}

void check_attribute(const XmlNode& element, const SsmlElement& known, const XmlAttribute& written,
                     const XmlSource& source) {
    if (written.name.starts_with("xsi:")) return;
    std::vector<std::string> names;
    for (const SsmlAttribute& attribute : known.attributes) {
        names.emplace_back(attribute.name);
        if (attribute.name != written.name) continue;
        if (fits(attribute, written.value)) return;
        throw Error(format("{}: {} \"{}\" of <{}> cannot be spoken; write {}{}",
                           Place{element, source}.to_text(), written.name, written.value, element.name,
                           attribute.words.empty() ? "" : format("one of [{}], or ", attribute.words),
                           usage_of(attribute.form)));
    }
    throw Error(format("{}: <{}> has no attribute {}; it has {}", Place{element, source}.to_text(),
                       element.name, written.name, join(names)));
}

// What is not spoken, and yet read, is noted.
void check_element(const XmlNode& node, const XmlSource& source, std::vector<std::string>& notes) {
    if (node.is_text()) return;
    const bool is_foreign = node.name.find(':') != std::string::npos;
    if (const SsmlElement* known = element_named(node.name)) {
        for (const XmlAttribute& attribute : node.attributes)
            check_attribute(node, *known, attribute, source);
    } else if (is_foreign ||
               std::find(std::begin(kUnspoken), std::end(kUnspoken), node.name) != std::end(kUnspoken)) {
        notes.push_back(format("{}: <{}> is left out, and the text in it spoken as it is",
                               Place{node, source}.to_text(), node.name));
    } else {
        std::vector<std::string> names;
        for (const SsmlElement& element : kElements) names.emplace_back(element.name);
        refuse_element(node, source, "SSML", names);
    }
    for (const XmlNode& child : node.children) check_element(child, source, notes);
}

bool has_raw_text(const XmlNode& node) {
    return node.raw || std::any_of(node.children.begin(), node.children.end(), has_raw_text);
}

// CDATA sections as other text.
std::string with_escaped_text(std::string_view text) {
    constexpr std::string_view kOpen = "<![CDATA[", kClose = "]]>";
    std::string escaped;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = std::min(text.find('<', at), text.size());
        escaped += text.substr(at, begin - at);
        at = end_of_tag(text, begin);
        const std::string_view tag = text.substr(begin, at - begin);
        escaped += tag.starts_with(kOpen)
                       ? escape_xml(tag.substr(kOpen.size(), tag.size() - kOpen.size() - kClose.size()))
                       : std::string(tag);
    }
    return escaped;
}

// The aliases of all <sub>, in the order of their tags.
void collect_aliases(const XmlNode& element, const XmlSource& source, std::vector<std::string>& aliases) {
    if (element.name == "sub") {
        const std::optional<std::string> alias = find_attribute(element, "alias");
        if (!alias)
            throw Error(format("{}: <sub> says no alias; write alias=\"what is to be said\"",
                               Place{element, source}.to_text()));
        aliases.push_back(*alias);
    }
    for (const XmlNode& child : element.children) collect_aliases(child, source, aliases);
}

// The text with the alias in place of each <sub>: the synthesizer does not report when it says the words of one.
std::string with_aliases(std::string_view text, const std::vector<std::string>& aliases) {
    std::string spoken;
    std::size_t depth = 0;  // in <sub>
    std::size_t alias = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = std::min(text.find('<', at), text.size());
        if (depth == 0) spoken += text.substr(at, begin - at);
        at = end_of_tag(text, begin);
        const std::string_view tag = text.substr(begin, at - begin);
        const bool opens =
            tag.starts_with("<sub") && std::string_view(" \t\r\n/>").find(tag[4]) != std::string::npos;
        const bool closes = tag.starts_with("</sub") && depth > 0;
        if (opens && depth == 0) spoken += escape_xml(aliases[alias]);
        if (!opens && !closes && depth == 0) spoken += tag;
        if (opens) ++alias;
        if (opens && !tag.ends_with("/>")) ++depth;
        if (closes) --depth;
    }
    return spoken;
}

// Whether a tag is one that the voice reads, or an instruction.
bool is_spoken(std::string_view tag) {
    if (tag.starts_with("<!--")) return false;
    const std::size_t name = tag.starts_with("</") ? 2 : 1;
    return tag.starts_with("<?") ||
           element_named(tag.substr(name, tag.find_first_of(" \t\r\n/>", name) - name)) != nullptr;
}

// The root element alone, with spaces where comments and tags were that the voice does not read.
std::string spoken_part(std::string_view text, std::size_t root) {
    const std::size_t close = text.rfind('>');
    std::string script(text.substr(root, close + 1 - root));
    for (std::size_t at = script.find('<'); at < script.size(); at = script.find('<', at)) {
        const std::size_t end = end_of_tag(script, at);
        if (!is_spoken(std::string_view(script).substr(at, end - at)))
            std::fill(script.begin() + static_cast<std::ptrdiff_t>(at),
                      script.begin() + static_cast<std::ptrdiff_t>(end), ' ');
        at = end;
    }
    return script;
}

// A text between tags as it is read, and where each of its bytes came from.
struct Decoded {
    std::string text;
    std::vector<std::size_t> at;
};

Decoded decode(std::string_view raw, std::size_t offset) {
    Decoded decoded;
    const auto put = [&](std::string_view bytes, std::size_t at) {
        decoded.text += bytes;
        decoded.at.insert(decoded.at.end(), bytes.size(), at + offset);
    };
    for (std::size_t at = 0; at < raw.size();) {
        const std::size_t end = raw[at] == '&' ? raw.find(';', at) + 1 : at + 1;
        put(raw[at] == '&' ? character_of(raw.substr(at + 1, end - at - 2)) : std::string(1, raw[at]), at);
        at = end;
    }
    decoded.at.push_back(raw.size() + offset);
    return decoded;
}

// A tag parts words, and what stands in one is none.
std::vector<ScriptWord> words_between_tags(std::string_view script) {
    std::vector<ScriptWord> words;
    for (std::size_t at = 0; at < script.size();) {
        const std::size_t tag = std::min(script.find('<', at), script.size());
        const Decoded decoded = decode(script.substr(at, tag - at), at);
        for (ScriptWord& word : find_words(decoded.text))
            words.push_back({std::move(word.text), decoded.at[word.begin], decoded.at[word.end]});
        at = end_of_tag(script, tag);
    }
    return words;
}

constexpr std::string_view kNotEmphasised = "none";  // the level of words that the rules must not emphasise

class EmphasisReader {
  public:
    EmphasisReader(const MarkedText& text, std::size_t root) : text_(text), root_(root) {}

    // `end`: the byte after the element, in the source.
    void read(const XmlNode& element, std::size_t end) {
        if (element.name == "emphasis") add(element, end);
        for (std::size_t i = 0; i < element.children.size(); ++i) {
            const bool is_last = i + 1 == element.children.size();
            if (!element.children[i].is_text())
                read(element.children[i], is_last ? end : element.children[i + 1].at);
        }
    }

    std::vector<Mark> marks;

  private:
    void add(const XmlNode& element, std::size_t end) {
        const std::string level = find_attribute(element, "level").value_or("moderate");
        const std::size_t first = word_at(text_.words, element.at - root_);
        const std::size_t last = word_from(text_.words, end - root_);
        if (first >= last) return;
        const bool is_none = level == kNotEmphasised;
        const std::string value = is_none ? level : known_value(function_kind(MarkKind::emphasis), level);
        marks.push_back({.kind = MarkKind::emphasis,
                         .value = value,
                         .first_word = first,
                         .end_word = last,
                         .weight = is_none ? 0 : default_weight(MarkKind::emphasis, value)});
    }

    const MarkedText& text_;
    std::size_t root_;
};

}  // namespace

MarkedText parse_ssml(const MarkupSource& source) {
    const XmlSource xml{source.text, source.name};
    const XmlNode root = parse_xml(xml);
    if (root.name != "speak") refuse_element(root, xml, "SSML that begins a text", {"speak"});
    std::vector<std::string> notes;
    check_element(root, xml, notes);
    std::vector<std::string> aliases;
    collect_aliases(root, xml, aliases);
    if (!aliases.empty() || has_raw_text(root)) {
        MarkupSource spoken = source;
        spoken.text = with_escaped_text(source.text);
        if (!aliases.empty()) spoken.text = with_aliases(spoken.text, aliases);
        MarkedText text = parse_ssml(spoken);
        text.notes = std::move(notes);
        return text;
    }

    const std::size_t begin = root.at - 1;  // of "<"
    MarkedText text{.script = spoken_part(source.text, begin), .is_ssml = true, .notes = std::move(notes)};
    text.words = words_between_tags(text.script);
    if (text.words.empty())
        throw Error(
            format("{}: <speak> holds no word; write what is to be said inside", Place{root, xml}.to_text()));
    std::string language = source.language;
    for (const XmlAttribute& attribute : root.attributes)
        if (attribute.name == "xml:lang") language = attribute.value;
    text.marks = marks_by_rules(text, language);
    EmphasisReader emphases(text, begin);
    emphases.read(root, begin + text.script.size());
    set_emphases(text, std::move(emphases.marks));
    std::erase_if(text.marks, [](const Mark& mark) {
        return mark.kind == MarkKind::emphasis && mark.value == kNotEmphasised;
    });
    return text;
}

}  // namespace chironomia
