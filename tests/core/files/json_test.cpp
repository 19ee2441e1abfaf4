#include "core/files/json.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/files/files.h"
#include "core/files/json_value.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

TEST(ReadJson, NamesLineAndColumnOfWhatIsWrong) {
    const testing::TemporaryFolder folder;
    write_text(folder / "plan.json", "{\n  \"title\": \"x\",\n  \"clips\": [1, 2,, 3]\n}\n");
    EXPECT_EQ(testing::refusal_of([&] { read_json(folder / "plan.json"); }),
              (folder / "plan.json").string() +
                  ":3:18: this is no valid JSON; check the quotes, commas and brackets around this place");
}

TEST(ReadJson, RefusesOtherEncodingsAndEmptyFiles) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&](const std::string& bytes) {
        write_text(folder / "plan.json", bytes);
        const std::string file = (folder / "plan.json").string();
        return testing::refusal_of([&] { read_json(file); }).substr(file.size());
    };
    EXPECT_EQ(refusal(std::string("\xff\xfe{\0}\0", 6)), ": it is UTF-16; save it as UTF-8");
    EXPECT_EQ(refusal(std::string("{\0}\0", 4)), ": it is UTF-16; save it as UTF-8");
    EXPECT_EQ(refusal(std::string("\x1f\x8b\b\0\0", 5)), ": it is packed with gzip; unpack it with gunzip");
    EXPECT_EQ(refusal("[\n\"caf\xe9\"]"), ":2:6: this byte is no UTF-8; save the file as UTF-8");
    EXPECT_EQ(refusal(" \n"), ": the file is empty; JSON is expected");
}

TEST(ReadJson, RefusesNumbersBeyondEveryRange) {
    const testing::TemporaryFolder folder;
    write_text(folder / "plan.json", "[1e999]");
    EXPECT_EQ(testing::refusal_of([&] { read_json(folder / "plan.json"); }),
              (folder / "plan.json").string() +
                  ": a number in it is too large for any computer; numbers must be below 1e308");
}

TEST(ReadJson, RefusesWhatNestsDeep) {
    const testing::TemporaryFolder folder;
    write_text(folder / "plan.json",
               "{\"a\":\"[[\\\"[\",\"b\":" + std::string(128, '[') + std::string(128, ']') + "}");
    EXPECT_EQ(testing::refusal_of([&] { read_json(folder / "plan.json"); }),
              (folder / "plan.json").string() +
                  ": its brackets nest 129 deep, at most 128 are read; write it again");
}

TEST(ReadJson, RefusesAKeyThatStandsTwiceInOneObject) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) {
        write_text(folder / "plan.json", text);
        return testing::refusal_of([&] { read_json(folder / "plan.json"); });
    };
    const std::string end = " stands there twice; one of them would be lost, delete it or rename it";
    EXPECT_EQ(refusal(R"({"a": 1, "b": 2, "a": 3})"), (folder / "plan.json").string() + ": a" + end);
    EXPECT_EQ(
        refusal(R"({"clips": [{"id": "1"}, {"id": "2", "motion": {"x": "p", "y": {"x": 1}, "x": "q"}}]})"),
        (folder / "plan.json").string() + ": clips.motion.x" + end);
    write_text(folder / "plan.json", R"([{"a": {"a": 1}}, {"a": 2}])");
    EXPECT_EQ(read_json(folder / "plan.json"), Json::parse(R"([{"a": {"a": 1}}, {"a": 2}])"));
}

// A seed is any number of 63 bits.
TEST(JsonValueInteger, IsAnyWholeNumberInItsRange) {
    constexpr long long kLargest = std::numeric_limits<long long>::max();
    const Json json = {{"seed", kLargest}, {"many", 3'000'000'000}, {"beyond", 9223372036854775808u}};
    const JsonValue value(json, "job");
    EXPECT_EQ(value.at("seed").integer(0, kLargest), kLargest);
    EXPECT_EQ(value.at("many").integer(0, kLargest), 3'000'000'000);
    EXPECT_EQ(testing::refusal_of([&] { value.at("many").integer(0, 1000); }),
              "job: many: is 3000000000, a whole number from 0 to 1000 is needed");
    EXPECT_EQ(testing::refusal_of([&] { value.at("beyond").integer(0, kLargest); }),
              "job: beyond: is 9223372036854775808, a whole number from 0 to 9223372036854775807 is needed");
}

TEST(WriteJson, KeepsTheOrderOfKeys) {
    const testing::TemporaryFolder folder;
    Json value;
    value["b"] = 1;
    value["a"] = 2;
    write_json(folder / "x.json", value);
    EXPECT_EQ(read_text(folder / "x.json"), "{\n  \"b\": 1,\n  \"a\": 2\n}\n");
    EXPECT_EQ(read_json(folder / "x.json"), value);
}

}  // namespace
}  // namespace chironomia
