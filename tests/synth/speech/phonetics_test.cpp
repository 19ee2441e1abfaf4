#include "synth/speech/phonetics.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

std::string phone_text(const std::optional<PhoneLabel>& phone) {
    if (!phone) return "none";
    return (phone->stress == Stress::primary     ? "'"
            : phone->stress == Stress::secondary ? ","
                                                 : "") +
           phone->symbol;
}

TEST(Phonetics, ReadArpabet) {
    EXPECT_EQ(phone_text(read_arpabet("AH1")), "'ʌ");
    EXPECT_EQ(phone_text(read_arpabet("AH0")), "ə");
    EXPECT_EQ(phone_text(read_arpabet("ah")), "ʌ");
    EXPECT_EQ(phone_text(read_arpabet("ER0")), "ɚ");
    EXPECT_EQ(phone_text(read_arpabet("OY2")), ",ɔɪ");
    EXPECT_EQ(phone_text(read_arpabet("hh")), "h");
    EXPECT_EQ(phone_text(read_arpabet("pau")), "_");
    EXPECT_EQ(phone_text(read_arpabet("")), "_");
    EXPECT_EQ(phone_text(read_arpabet("HH1")), "none") << "no consonant is stressed";
    EXPECT_EQ(phone_text(read_arpabet("ʃ")), "none");
    EXPECT_EQ(phone_text(read_arpabet("x")), "none");
}

TEST(Phonetics, ReadIpa) {
    EXPECT_EQ(phone_text(read_ipa("ˈa")), "'a");
    EXPECT_EQ(phone_text(read_ipa("ˌɔ̃")), ",ɔ̃");
    EXPECT_EQ(phone_text(read_ipa(" ʃ ")), "ʃ");
    EXPECT_EQ(phone_text(read_ipa("spn")), "_");
    EXPECT_EQ(phone_text(read_ipa("{LG}")), "_") << "a laugh";
    EXPECT_EQ(phone_text(read_ipa("<nib>")), "_") << "a noise";
}

TEST(Phonetics, KnowVowelsFromConsonants) {
    for (const char* vowel : {"a", "õ", "o\u0303", "aɪ", "ɑ̃", "øː", "ᵻ", "ɚ", "l̩", "y"})
        EXPECT_TRUE(is_vowel(vowel)) << vowel;
    for (const char* consonant : {"p", "tʃ", "ɥ", "w", "l", "ʁ", "_", "", "ŋ"})
        EXPECT_FALSE(is_vowel(consonant)) << consonant;
}

}  // namespace
}  // namespace chironomia
