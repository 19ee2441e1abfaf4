#include "synth/markup/xml.h"

#include <algorithm>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/markup/script_words.h"

namespace chironomia {
namespace {

constexpr std::size_t kDeepest = 64;  // elements in one another
constexpr std::size_t kMostAttributes = 32;

[[noreturn]] void refuse(const XmlSource& source, std::size_t at, const std::string& what) {
    throw Error(format("{}: {}", place_in(source.text, at, source.name), what));
}

// One tag of the source as it stands there.
struct Tag {
    std::string_view name;
    std::size_t at = 0;   // of the name
    std::size_t end = 0;  // one past ">"
    bool closes = false;
    bool is_empty = false;
};

// The end of what begins with "<" and is no tag: comment, CDATA, instruction, document type; or nothing.
std::optional<std::size_t> end_of_aside(std::string_view text, std::size_t at) {
    const std::string_view rest = text.substr(at);
    // The signs of both ends share no letter: "<!-->" is a comment that goes on.
    const auto behind = [&](std::string_view sign, std::string_view opening = "<!") {
        const std::size_t found = text.find(sign, at + opening.size());
        return found == std::string_view::npos ? text.size() : found + sign.size();
    };
    constexpr std::string_view kComment = "<!--", kRaw = "<![CDATA[", kInstruction = "<?";
    if (rest.starts_with(kComment)) return behind("-->", kComment);
    if (rest.starts_with(kRaw)) return behind("]]>", kRaw);
    if (rest.starts_with(kInstruction)) return behind("?>", kInstruction);
    if (!rest.starts_with("<!")) return std::nullopt;
    // A document type may hold declarations of its own in brackets.
    const std::size_t bracket = text.find_first_of("[>", at);
    return bracket != std::string_view::npos && text[bracket] == '[' ? behind("]>") : behind(">");
}

Tag read_tag(std::string_view text, std::size_t at) {
    Tag tag;
    tag.closes = text.substr(at).starts_with("</");
    tag.at = at + (tag.closes ? 2 : 1);
    tag.name = text.substr(tag.at, std::min(text.find_first_of(" \t\r\n/>", tag.at), text.size()) - tag.at);
    char quote = 0;
    for (tag.end = tag.at; tag.end < text.size(); ++tag.end) {
        const char c = text[tag.end];
        if (quote == 0 && c == '>') break;
        if (quote == 0 && (c == '"' || c == '\''))
            quote = c;
        else if (c == quote)
            quote = 0;
    }
    tag.is_empty = tag.end < text.size() && text[tag.end - 1] == '/';
    tag.end = std::min(tag.end + 1, text.size());
    return tag;
}

// The elements that are open before byte `until`, outermost first.
std::vector<Tag> open_elements(std::string_view text, std::size_t until) {
    std::vector<Tag> open;
    for (std::size_t at = text.find('<'); at < until; at = text.find('<', at)) {
        if (const std::optional<std::size_t> aside = end_of_aside(text, at)) {
            at = *aside;
            continue;
        }
        const Tag tag = read_tag(text, at);
        if (tag.at >= until) break;
        if (tag.closes && !open.empty()) open.pop_back();
        if (!tag.closes && !tag.is_empty) open.push_back(tag);
        at = tag.end;
    }
    return open;
}

[[noreturn]] void refuse_mismatch(const XmlSource& source, std::size_t at) {
    const std::vector<Tag> open = open_elements(source.text, at);
    if (open.empty())
        refuse(source, at, "a tag closes an element that is not open; remove it, or open the element before");
    const Tag& last = open.back();
    const std::string opened = place_in(source.text, last.at, source.name);
    const std::size_t name_end = std::min(source.text.find_first_of(" \t\r\n>", at), source.text.size());
    if (at + 1 >= source.text.size())
        refuse(source, last.at, format("<{0}> is not closed; write </{0}> where it ends", last.name));
    refuse(source, at,
           format("</{}> closes <{}> of {}; close <{}> before", source.text.substr(at, name_end - at),
                  last.name, opened.substr(source.name.size() + 1), last.name));
}

[[noreturn]] void refuse_malformed(const XmlSource& source, const pugi::xml_parse_result& result) {
    const std::size_t at = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)),
                                    source.text.empty() ? 0 : source.text.size() - 1);
    switch (result.status) {
        case pugi::status_end_element_mismatch:
            refuse_mismatch(source, at);
        case pugi::status_bad_attribute:
            refuse(source, at, "an attribute is not written as name=\"value\"; write it so");
        case pugi::status_bad_end_element:
            refuse(source, at, "a closing tag does not end with \">\"; write </name>");
        case pugi::status_bad_comment:
            refuse(source, source.text.rfind("<!--", at), "a comment is not closed; end it with -->");
        case pugi::status_bad_cdata:
            refuse(source, source.text.rfind("<![CDATA[", at),
                   "a CDATA section is not closed; end it with ]]>");
        default:
            refuse(source, std::min(source.text.rfind('<', at), at),
                   "\"<\" begins no tag here; write &lt; for the sign itself, or close the tag with >");
    }
}

bool is_character(unsigned long code) {
    return code == 9 || code == 10 || code == 13 || (code >= 0x20 && code < 0xd800) ||
           (code >= 0xe000 && code < 0x110000 && code != 0xfffe && code != 0xffff);
}

void refuse_unknown_entities(const XmlSource& source, std::size_t begin, std::size_t end) {
    constexpr std::size_t kLongest = 10;
    const std::string_view range = source.text.substr(0, end);
    for (std::size_t at = range.find('&', begin); at < end; at = range.find('&', at + 1)) {
        const std::string_view rest = source.text.substr(at + 1, kLongest);
        const std::string_view reference = rest.substr(0, rest.find(';'));
        if (reference.size() == rest.size())
            refuse(source, at, "\"&\" begins no entity; write &amp; for the sign itself");
        if (character_of(reference).empty())
            refuse(
                source, at,
                format("&{}; is no entity of XML (lt, gt, amp, quot, apos, #233); write the character itself",
                       reference));
    }
}

void refuse_unknown_entities(const XmlSource& source) {
    for (std::size_t at = 0; at < source.text.size();) {
        const std::size_t tag = std::min(source.text.find('<', at), source.text.size());
        refuse_unknown_entities(source, at, tag);
        at = end_of_tag(source.text, tag);
        if (tag < source.text.size() && !end_of_aside(source.text, tag))
            refuse_unknown_entities(source, tag, at);
    }
}

std::size_t offset_of(const pugi::xml_node& node) {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
}

// "xmlns" and "xmlns:mstts" say where names come from, on whatever element they stand.
bool is_namespace(std::string_view attribute) {
    return attribute == "xmlns" || attribute.starts_with("xmlns:");
}

XmlNode convert(const pugi::xml_node& node, const XmlSource& source, std::size_t depth) {
    XmlNode converted{.name = node.name(), .text = node.value(), .at = offset_of(node)};
    converted.raw = node.type() == pugi::node_cdata;
    if (depth > kDeepest)
        refuse(source, converted.at,
               format("<{}> lies {} elements deep, at most {} are read; nest less", converted.name, depth,
                      kDeepest));
    for (const pugi::xml_attribute& attribute : node.attributes()) {
        if (is_namespace(attribute.name())) continue;
        if (converted.attributes.size() == kMostAttributes)
            refuse(source, converted.at,
                   format("<{}> has more than {} attributes; leave out what does not belong to it",
                          converted.name, kMostAttributes));
        for (const XmlAttribute& other : converted.attributes)
            if (other.name == attribute.name())
                refuse(source, converted.at,
                       format("<{}> has the attribute {} twice, \"{}\" and \"{}\"; keep one", converted.name,
                              other.name, other.value, attribute.value()));
        converted.attributes.push_back({attribute.name(), attribute.value()});
    }
    for (const pugi::xml_node& child : node.children())
        converted.children.push_back(convert(child, source, depth + 1));
    return converted;
}

bool is_space(std::string_view text) {
    return trim(text).empty();
}

}  // namespace

std::string Place::to_text() const {
    return place_in(source.text, node.at, source.name);
}

std::optional<std::string> find_attribute(const XmlNode& node, std::string_view name) {
    for (const XmlAttribute& attribute : node.attributes)
        if (attribute.name == name) return attribute.value;
    return std::nullopt;
}

XmlNode parse_xml(const XmlSource& source) {
    refuse_unknown_entities(source);
    pugi::xml_document document;
    constexpr unsigned kHow = pugi::parse_default | pugi::parse_ws_pcdata | pugi::parse_fragment;
    const pugi::xml_parse_result result =
        document.load_buffer(source.text.data(), source.text.size(), kHow, pugi::encoding_utf8);
    if (!result) refuse_malformed(source, result);

    std::optional<XmlNode> root;
    for (const pugi::xml_node& node : document.children()) {
        if (node.type() != pugi::node_element && is_space(node.value())) continue;
        if (node.type() != pugi::node_element)
            refuse(source, offset_of(node), "text lies outside the first element; move it into it");
        if (root)
            refuse(source, offset_of(node),
                   format("<{}> follows the end of <{}>; a text has one outermost element", node.name(),
                          root->name));
        root = convert(node, source, 1);
    }
    if (!root) refuse(source, 0, "holds no element; begin with one, such as <APLM>");
    return std::move(*root);
}

std::string root_name(std::string_view text) {
    for (std::size_t at = 0;;) {
        at = text.find_first_not_of(" \t\r\n", at);
        if (at == std::string_view::npos || text[at] != '<') return "";
        const std::optional<std::size_t> aside = end_of_aside(text, at);
        if (!aside) return std::string(read_tag(text, at).name);
        at = *aside;
    }
}

std::size_t end_of_tag(std::string_view text, std::size_t at) {
    if (at >= text.size()) return text.size();
    const std::optional<std::size_t> aside = end_of_aside(text, at);
    return aside ? *aside : read_tag(text, at).end;
}

std::string character_of(std::string_view reference) {
    constexpr std::pair<std::string_view, std::string_view> kNamed[] = {
        {"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"apos", "'"}};
    for (const auto& [name, character] : kNamed)
        if (reference == name) return std::string(character);
    if (!reference.starts_with('#') || reference.size() < 2 || reference.size() > 9) return "";
    const bool is_hex = reference[1] == 'x';
    const std::string digits(reference.substr(is_hex ? 2 : 1));
    const std::string_view allowed = is_hex ? "0123456789abcdefABCDEF" : "0123456789";
    if (digits.empty() || digits.find_first_not_of(allowed) != std::string::npos) return "";
    const unsigned long code = std::stoul(digits, nullptr, is_hex ? 16 : 10);
    return is_character(code) ? to_utf8(std::u32string(1, static_cast<char32_t>(code))) : "";
}

}  // namespace chironomia
