#include "core/utf8.h"

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

TEST(Utf8, CountsCharacters) {
    EXPECT_EQ(count_characters("aé€😀b"), 5u);
    EXPECT_EQ(count_characters(""), 0u);
}

TEST(Utf8, KnowsWhereCharactersBegin) {
    EXPECT_THAT(starts_of_characters("aé€😀b"), ElementsAre(0, 1, 3, 6, 10, 11));
    EXPECT_THAT(starts_of_characters(""), ElementsAre(0));
}

TEST(Utf8, IsReadAndWritten) {
    EXPECT_EQ(characters_of("aé€😀"), U"aé€😀");
    EXPECT_EQ(to_utf8(U"aé€😀"), "aé€😀");
}

TEST(Utf8, ComesFromUtf16) {
    EXPECT_EQ(utf8_from_utf16(std::string_view("a\0\xac\x20\x3d\xd8\x00\xde", 8), false), "a€😀");
    EXPECT_EQ(utf8_from_utf16(std::string_view("\0a\x20\xac\xd8\x3d\xde\x00", 8), true), "a€😀");
    EXPECT_THAT(utf8_from_utf16("abc", false), Eq(std::nullopt));
    EXPECT_THAT(utf8_from_utf16("\x3d\xd8", false), Eq(std::nullopt)) << "half a pair";
    EXPECT_THAT(utf8_from_utf16("\x3d\xd8\x3d\xd8", false), Eq(std::nullopt)) << "two first halves";
    EXPECT_THAT(utf8_from_utf16("\x01\xde", false), Eq(std::nullopt)) << "a second half alone";
}

}  // namespace
}  // namespace chironomia
