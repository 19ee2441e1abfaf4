#include "study/junit.h"

#include <algorithm>
#include <cstdint>

#include "core/text.h"

namespace chironomia {
namespace {

// The bytes of the UTF-8 character at the beginning of `text` that XML 1.0 allows; 0 if there is none.
std::size_t xml_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    if (byte(0) < 0x80) return byte(0) >= 0x20 || byte(0) == '\t' || byte(0) == '\n' ? 1 : 0;
    const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
    std::uint32_t code = byte(0) & (0xffu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return overlong || surrogate || code == 0xfffe || code == 0xffff || code > 0x10ffff ? 0 : length;
}

// "walk/00012.png" belongs to the class "compare.walk".
std::string class_of(const CompareCase& one) {
    const std::size_t slash = one.name.rfind('/');
    if (slash == std::string::npos) return "compare";
    std::string folder = one.name.substr(0, slash);
    std::replace(folder.begin(), folder.end(), '/', '.');
    return "compare." + folder;
}

std::string details_of(const CompareCase& one) {
    std::string text = one.message + "\n";
    if (!one.expected.empty()) text += "expected:   " + one.expected.string() + "\n";
    if (!one.actual.empty()) text += "actual:     " + one.actual.string() + "\n";
    if (!one.difference.empty()) text += "difference: " + one.difference.string() + "\n";
    return text;
}

std::string case_element(const CompareCase& one) {
    const std::string head = format("    <testcase name=\"{}\" classname=\"{}\" time=\"0\"",
                                    escape_xml(one.name), escape_xml(class_of(one)));
    if (one.outcome == CaseOutcome::same) return head + "/>\n";
    const char* element = one.outcome == CaseOutcome::unreadable ? "error" : "failure";
    return format("{}>\n      <{} message=\"{}\" type=\"{}\">{}</{}>\n    </testcase>\n", head, element,
                  escape_xml(one.message), to_text(one.outcome), escape_xml(details_of(one)), element);
}

}  // namespace

std::string escape_xml(std::string_view text) {
    std::string escaped;
    while (!text.empty()) {
        const std::size_t length = xml_character(text);
        const char c = text.front();
        if (length == 0) {
            escaped += "\xef\xbf\xbd";
        } else if (c == '&') {
            escaped += "&amp;";
        } else if (c == '<') {
            escaped += "&lt;";
        } else if (c == '>') {
            escaped += "&gt;";
        } else if (c == '"') {
            escaped += "&quot;";
        } else {
            escaped += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return escaped;
}

std::string make_junit(const std::string& suite, const CompareSet& set) {
    const std::size_t errors = set.count(CaseOutcome::unreadable);
    const std::size_t failures = set.cases.size() - set.count(CaseOutcome::same) - errors;
    const std::string counts =
        format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"0\"", set.cases.size(), failures, errors);
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    xml += format("<testsuites name=\"chironomia compare\" {}>\n", counts);
    xml += format("  <testsuite name=\"{}\" {} skipped=\"0\">\n", escape_xml(suite), counts);
    for (const CompareCase& one : set.cases) xml += case_element(one);
    return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace chironomia
