#include "synth/speech/utf8.h"

#include <gmock/gmock.h>

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::Eq;

TEST(Utf8, KnowsWholeCharacters) {
    for (const char* text :
         {"", "abc", "é", "€", "😀", "\x7f", "\xc2\x80", "\xef\xbf\xbf", "\xf4\x8f\xbf\xbf"})
        EXPECT_THAT(fault_in_utf8(text), Eq(std::nullopt)) << text;
}

TEST(Utf8, FindsTheFirstByteOfNoCharacter) {
    EXPECT_EQ(fault_in_utf8("ab\xff"), 2u);
    EXPECT_EQ(fault_in_utf8("a\xc3"), 1u);
    EXPECT_EQ(fault_in_utf8("é\x80"), 2u);
    EXPECT_EQ(fault_in_utf8("\xe2\x82"), 0u);
    EXPECT_EQ(fault_in_utf8("\xc0\xaf"), 0u) << "overlong";
    EXPECT_EQ(fault_in_utf8("\xe0\x80\xaf"), 0u) << "overlong";
    EXPECT_EQ(fault_in_utf8("\xed\xa0\x80"), 0u) << "a surrogate";
    EXPECT_EQ(fault_in_utf8("\xf4\x90\x80\x80"), 0u) << "behind the last character";
}

TEST(Utf8, TellsWhereCharactersBegin) {
    EXPECT_THAT(starts_of_characters("aé€😀b"), ElementsAre(0, 1, 3, 6, 10, 11));
    EXPECT_THAT(starts_of_characters(""), ElementsAre(0));
}

}  // namespace
}  // namespace chironomia
