// XML as a tree of elements and texts that know where they stood.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct XmlAttribute {
    std::string name;
    std::string value;  // entities replaced
};

// An element, or, where `name` is empty, a text between tags.
struct XmlNode {
    std::string name;
    std::string text;    // of a text: entities replaced
    bool raw = false;    // a text of a CDATA section
    std::size_t at = 0;  // byte in the source of the element's name, or of the text
    std::vector<XmlAttribute> attributes;
    std::vector<XmlNode> children;

    bool is_text() const { return name.empty(); }
};

// The value of an attribute, or nothing.
std::optional<std::string> find_attribute(const XmlNode& node, std::string_view name);

// A document, and the name and text that its messages refer to.
struct XmlSource {
    std::string_view text;
    std::string_view name;
};

// Where a node stood. Lines are counted when a message needs them, not before.
struct Place {
    const XmlNode& node;
    const XmlSource& source;

    std::string to_text() const;  // "name:3:14"
};

// The root element. Comments, processing instructions and the document type are left out. Throws Error with
// line and column if the text is not well-formed, refers to an entity other than XML's five and characters by
// number, has an attribute twice, text outside the root, or elements more than 64 deep.
XmlNode parse_xml(const XmlSource& source);

// Whether the text begins, after white space, a declaration and comments, with this element; "" if with
// none.
std::string root_name(std::string_view text);

// One past the end of the tag, comment or instruction at text[at], which is "<"; text.size() if it has
// none.
std::size_t end_of_tag(std::string_view text, std::size_t at);

// The character that "lt" or "#233" stands for between "&" and ";"; "" if for none.
std::string character_of(std::string_view reference);

}  // namespace chironomia
