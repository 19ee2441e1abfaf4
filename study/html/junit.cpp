#include "study/html/junit.h"

#include <algorithm>

#include "core/files/xml_text.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

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

}  // namespace chironomia::study
