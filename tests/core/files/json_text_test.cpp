#include "core/files/json_text.h"

#include <gtest/gtest.h>

#include "tests/support/support.h"

namespace chironomia {
namespace {

TEST(ParseJsonLines, ReadsAnObjectALine) {
    const std::string text = "{\"a\": 1}\r\n\n{\"a\": 2}\n{\"a\": 3}\n\n";
    EXPECT_TRUE(is_json_lines(text));
    EXPECT_EQ(parse_json_lines(text, "a.jsonl").dump(), R"([{"a":1},{"a":2},{"a":3}])");
    EXPECT_FALSE(is_json_lines("{\"a\": 1}\n"));
    EXPECT_FALSE(is_json_lines("{\n  \"a\": {}\n}\n"));
    EXPECT_EQ(testing::refusal_of([] { parse_json_lines("{\"a\": 1}\n{\"a\": 2}\n{\"a\": ", "a.jsonl"); }),
              "a.jsonl:3:6: this is no valid JSON; check the quotes, commas and brackets around this place");
}

// As json.dump of Python writes it.
TEST(ParseJson, TakesNanForNull) {
    EXPECT_EQ(parse_json(R"({"a": [NaN, 1], "NaN \" NaN": "\\", "b": NaN})", "a.json").dump(),
              R"({"a":[null,1],"NaN \" NaN":"\\","b":null})");
    EXPECT_EQ(testing::refusal_of([] { parse_json("[NaN, Infinity]", "a.json"); }),
              "a.json:1:8: this is no valid JSON; check the quotes, commas and brackets around this place");
}

}  // namespace
}  // namespace chironomia
