#include "core/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ParseNumber, TakesWholeNumbersOnly) {
    EXPECT_EQ(parse_number(" -1.5e2 "), -150.0);
    EXPECT_EQ(parse_number("+.25"), 0.25);
    EXPECT_EQ(parse_number("1,5"), std::nullopt);
    EXPECT_EQ(parse_number("3x"), std::nullopt);
    EXPECT_EQ(parse_number(""), std::nullopt);
    EXPECT_EQ(parse_integer("12"), 12);
    EXPECT_EQ(parse_integer("1.0"), std::nullopt);
}

TEST(Split, KeepsEmptyPartsAndWordsDoNot) {
    EXPECT_THAT(split("a,,b", ','), ElementsAre("a", "", "b"));
    EXPECT_THAT(split("", ','), ElementsAre(""));
    EXPECT_THAT(split_words("  a\t b\r\n"), ElementsAre("a", "b"));
    EXPECT_THAT(split_words(" \n"), IsEmpty());
}

TEST(NearestName, GuessesATypoButNotAnotherWord) {
    EXPECT_EQ(nearest_name("rendr", {"study", "render"}), "render");
    EXPECT_EQ(nearest_name("banana", {"study", "render"}), std::nullopt);
}

TEST(LabelledList, BreaksLinesUnderTheFirstWord) {
    EXPECT_EQ(labelled_list("images", {}), "images        none\n");
    EXPECT_EQ(labelled_list("mesh", {"a", "b"}), "mesh          a, b\n");
    const std::string word(60, 'x');
    EXPECT_EQ(labelled_list("long", {word, word}),
              "long          " + word + ",\n              " + word + "\n");
}

TEST(Text, TrimsLowersAndJoins) {
    EXPECT_EQ(trim(" a b \n"), "a b");
    EXPECT_EQ(to_lower("LeftArm01"), "leftarm01");
    EXPECT_EQ(join({"a", "b"}), "a, b");
}

}  // namespace
}  // namespace chironomia
