#include "synth/markup/script_words.h"

#include <gmock/gmock.h>

#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::refusal_of;

std::vector<std::string> words_of(std::string_view script) {
    std::vector<std::string> words;
    for (const ScriptWord& word : find_words(script)) words.push_back(word.text);
    return words;
}

TEST(FindWords, LeavesOutThePunctuationAroundThem) {
    EXPECT_THAT(words_of("\"Well\", he said: (don't!)  -- 3.5 kg."),
                ElementsAre("Well", "he", "said", "don't", "3.5", "kg"));
    EXPECT_THAT(words_of("«Été», dit-il… l’homme"), ElementsAre("Été", "dit-il", "l’homme"));
    EXPECT_THAT(words_of("well-known and/or Q&A & so...on"),
                ElementsAre("well-known", "and", "or", "Q&A", "&", "so", "on"));
    EXPECT_THAT(words_of(" -- ... ! \n"), IsEmpty());
}

TEST(FindWords, PartsThemAtTheSignsOfOtherScripts) {
    EXPECT_THAT(words_of("你好，世界。你去哪里？"), ElementsAre("你好", "世界", "你去哪里"));
    EXPECT_THAT(words_of("مرحبا، كيف حالك؟"), ElementsAre("مرحبا", "كيف", "حالك"));
    EXPECT_THAT(words_of("नमस्ते। आप"), ElementsAre("नमस्ते", "आप"));
}

TEST(FindWords, PartsThemAtEverySpaceOfUnicode) {
    for (const char* space :
         {"\u0085", "\u00a0", "\u2000", "\u2009", "\u200a", "\u200b", "\u202f", "\u205f", "\u3000"})
        EXPECT_THAT(words_of("Oui" + std::string(space) + "! Non" + space + "merci"),
                    ElementsAre("Oui", "Non", "merci"))
            << space;
}

TEST(FindWords, ReadsHyphensAndLeavesOutWhatIsNotSeen) {
    EXPECT_THAT(words_of("la\u0300\u2011bas co\u00adop\u2010ted"), ElementsAre("la\u0300-bas", "coop-ted"));
    EXPECT_THAT(words_of("\ufeffHello\u200f, \u2067you\u2069 \u200e \u061c- \u2060"),
                ElementsAre("Hello", "you"));
    EXPECT_THAT(words_of("حالك؟\u200f \u202bنعم\u202c"), ElementsAre("حالك", "نعم"));
    EXPECT_EQ(with_plain_signs("a\u202f\u2011\u00adb"), "a -b");
}

TEST(FindWords, GivesTheBytesOfTheScriptToWordsThatItRewrites) {
    const std::vector<ScriptWord> words = find_words("\u200fso\u00adon\u200f là");
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0].begin, 3u);
    EXPECT_EQ(words[0].end, 9u);
    EXPECT_EQ(words[1].begin, 13u);
}

TEST(FindWords, GivesTheirBytes) {
    const std::string script = " «Été» là.";
    const std::vector<ScriptWord> words = find_words(script);
    ASSERT_EQ(words.size(), 2u);
    for (const ScriptWord& word : words)
        EXPECT_EQ(script.substr(word.begin, word.end - word.begin), word.text);
    EXPECT_EQ(words[0].begin, 3u);
}

TEST(PlainLetters, AreLowerCaseWithStraightApostrophes) {
    EXPECT_EQ(plain_letters("L’ÉTÉ"), "l'été");
    EXPECT_EQ(plain_letters("Straße×Ö"), "straße×ö");
}

TEST(PlaceIn, CountsCharactersNotBytes) {
    EXPECT_EQ(place_in("été\nàb", 8, "f"), "f:2:2");
    EXPECT_EQ(place_in("x", 0, "f"), "f:1:1");
}

TEST(RefuseBadText, NamesTheByteThatIsNoUtf8) {
    for (const char* bad : {"a\xff", "a\xc3", "a\xc0\xaf", "a\xed\xa0\x80", "a\xf4\x90\x80\x80", "a\x80"}) {
        const std::string refusal = refusal_of([&] { refuse_bad_text(bad, "talk.txt"); });
        EXPECT_EQ(refusal, format("talk.txt:1:2: byte 0x{:02x} is no UTF-8; save the text as UTF-8",
                                  static_cast<unsigned char>(bad[1])));
    }
    EXPECT_EQ(refusal_of([] { refuse_bad_text("line\n\x01", "talk.txt"); }),
              "talk.txt:2:1: control character 0x01 cannot be spoken; remove it");
    EXPECT_NO_THROW(refuse_bad_text("é 漢 😀\t\r\n", "talk.txt"));
}

}  // namespace
}  // namespace chironomia
