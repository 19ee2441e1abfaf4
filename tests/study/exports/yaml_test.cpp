#include "study/exports/yaml.h"

#include <gtest/gtest.h>

#include "tests/study/exports/exported_sample.h"

namespace chironomia::study {
namespace {

TEST(Yaml, IsWrittenAsPeopleWriteIt) {
    EXPECT_EQ(to_yaml(Json::parse(
                  R"({"name": "x", "pages": [{"id": 1, "stimuli": {"C1": ["a", "b"]}}, {"id": 2}]})")),
              "\"name\": \"x\"\n"
              "\"pages\":\n"
              "  - \"id\": 1\n"
              "    \"stimuli\":\n"
              "      \"C1\": [\"a\",\"b\"]\n"
              "  - \"id\": 2\n");
}

// webMUSHRA's reader takes \u00e9 for two letters.
TEST(Yaml, HasLettersAsTheyAre) {
    EXPECT_EQ(to_yaml(Json{{"name", "é 漢 😀"}}), "\"name\": \"é 漢 😀\"\n");
    EXPECT_EQ(to_yaml(Json{{"name", "\u0085\u2028"}}), "\"name\": \"\\u0085\\u2028\"\n");
}

TEST(Yaml, GivesTheSameValuesBack) {
    const Json value = Json::parse(
        R"({"yes": "no", "text": "a: b # c\n\"d\"  \t \u0000 \u0007 \u007f \u0085 \u009f \u2028 \u2029 \ufeff \uffff é 漢 😀 - x", "empty": "", "none": null,
        "numbers": [1, -2.5, 1e3, true], "lists": [[1, [2, {"k": "v"}]], [], {}], "0x1": "1_000", "~": "~",
        "deep": {"a": {"b": {"c": ["x", {"d": 1}]}}}})");
    testing::TemporaryFolder folder;
    write_text(folder / "file.yaml", to_yaml(value));
    EXPECT_EQ(testing::ExportedSample({}).read_yaml(folder / "file.yaml"), value);
}

}  // namespace
}  // namespace chironomia::study
