#include "synth/speech/xsampa.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

std::string phone_text(const PhoneLabel& phone) {
    const char* const mark = phone.stress == Stress::primary     ? "'"
                             : phone.stress == Stress::secondary ? ","
                                                                 : "";
    return mark + phone.symbol;
}

TEST(XSampa, ReadsAsIpa) {
    EXPECT_EQ(phone_text(read_xsampa("o~")), "o\u0303");
    EXPECT_EQ(phone_text(read_xsampa("9~")), "œ\u0303");
    EXPECT_EQ(phone_text(read_xsampa("2:")), "øː");
    EXPECT_EQ(phone_text(read_xsampa("tS")), "tʃ");
    EXPECT_EQ(phone_text(read_xsampa("t_S")), "tʃ") << "a tie";
    EXPECT_EQ(phone_text(read_xsampa("OY")), "ɔʏ");
    EXPECT_EQ(phone_text(read_xsampa("@U")), "əʊ");
    EXPECT_EQ(phone_text(read_xsampa("{")), "æ");
    EXPECT_EQ(phone_text(read_xsampa("@`")), "ɚ");
    EXPECT_EQ(phone_text(read_xsampa("r\\")), "ɹ");
    EXPECT_EQ(phone_text(read_xsampa("p\\")), "ɸ");
    EXPECT_EQ(phone_text(read_xsampa("n=")), "n\u0329");
    EXPECT_EQ(phone_text(read_xsampa("t_h")), "tʰ");
    EXPECT_EQ(phone_text(read_xsampa("t'")), "tʲ");
    EXPECT_EQ(phone_text(read_xsampa(" m ")), "m");
}

TEST(XSampa, TakesStressOffTheSymbol) {
    EXPECT_EQ(phone_text(read_xsampa("\"E")), "'ɛ");
    EXPECT_EQ(phone_text(read_xsampa("%i:")), ",iː");
    EXPECT_EQ(phone_text(read_xsampa("'a")), "'a");
}

TEST(XSampa, ReadsWhatIsNoPhoneme) {
    EXPECT_EQ(phone_text(read_xsampa("<p:>")), "_");
    EXPECT_EQ(phone_text(read_xsampa("<nib>")), "_");
    EXPECT_EQ(phone_text(read_xsampa("")), "_");
    EXPECT_EQ(phone_text(read_xsampa("<usb>")), "ə");
}

TEST(XSampa, IsKnownByItsSigns) {
    EXPECT_TRUE(are_xsampa({"<p:>", "b", "O~", "Z", "u", "R"}));
    EXPECT_TRUE(are_xsampa({"d", "@"}));
    EXPECT_TRUE(are_xsampa({"t", "E", "s", "t"}));
    EXPECT_TRUE(are_xsampa({"a:", "m"}));
    EXPECT_FALSE(are_xsampa({"m", "a", "m", "a"})) << "the same in IPA";
    EXPECT_FALSE(are_xsampa({"b", "ɔ̃", "@"})) << "IPA";
    EXPECT_FALSE(are_xsampa({"HH", "AH0", "E"})) << "ARPAbet";
    EXPECT_FALSE(are_xsampa({"hh", "ah", "{LG}", "<p:>"})) << "a laugh among ARPAbet";
    EXPECT_FALSE(are_xsampa({}));
}

}  // namespace
}  // namespace chironomia
