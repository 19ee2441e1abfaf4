// docs/markup.md describes what the program does.
#include <gmock/gmock.h>

#include "core/files/files.h"
#include "core/text.h"
#include "synth/markup/functions.h"
#include "synth/markup/markup.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string guide() {
    return read_text(testing::source_dir() / "docs/markup.md");
}

std::vector<std::string> examples() {
    const std::string text = guide();
    std::vector<std::string> found;
    for (const std::string fence : {"```text\n", "```xml\n"})
        for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at + 1)) {
            const std::size_t begin = at + fence.size();
            found.push_back(text.substr(begin, text.find("```", begin) - begin));
        }
    return found;
}

TEST(MarkupGuide, ItsExamplesAreReadEachInItsLanguage) {
    std::vector<std::string_view> languages;
    for (const std::string& example : examples()) {
        languages.push_back(name_of(recognise_markup(example)));
        EXPECT_FALSE(parse_marked_text({.text = example}).marks.empty()) << example;
    }
    EXPECT_THAT(languages, ElementsAre("plain", "aplm", "bml", "bml", "ssml"));
}

TEST(MarkupGuide, ListsEveryFunctionWithItsWeight) {
    const std::string text = guide();
    for (const FunctionKind& kind : function_kinds()) {
        std::string values;
        for (const FunctionValue& value : kind.values)
            values += format("{}`{}` {}", values.empty() ? "" : ", ", value.value, value.weight);
        if (values.empty()) values = format("{}", kind.weight);
        EXPECT_THAT(text,
                    HasSubstr(format("| `{}` | `{}` | {} |", name_of(kind.kind), kind.element, values)));
    }
}

TEST(MarkupGuide, ShowsARefusalAsItIs) {
    const std::string broken = "<APLM>\n\n\n          <emotion type=\"joi\">a</emotion></APLM>";
    EXPECT_THAT(guide(), HasSubstr("```\n" + testing::refusal_of([&] {
                                       parse_marked_text({.text = broken, .name = "talk.aplm"});
                                   }) +
                                   "\n```"));
}

}  // namespace
}  // namespace chironomia
