#include "synth/speech/align.h"

#include <gmock/gmock.h>

#include "tests/support/support.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using testing::phonemes_of;
using testing::refusal_of;
using testing::script;
using testing::texts_of;

// One second for each word, and one phoneme for each half of it.
Speech recording(const std::vector<std::string>& words) {
    Speech speech{.audio = {.rate = 100, .channels = 1, .samples = std::vector<float>(100 * words.size())}};
    double time = 0;
    for (const std::string& word : words) {
        speech.words.push_back({.text = word, .start = time, .end = time + 1});
        speech.phonemes.push_back({.symbol = "a", .start = time, .end = time + 0.5});
        speech.phonemes.push_back({.symbol = "b", .start = time + 0.5, .end = time + 1});
        time += 1;
    }
    return speech;
}

TEST(Align, CarriesWordsAndMarksOntoARecording) {
    MarkedText text = script("Don’t, re-enter!");
    text.marks = {{.kind = MarkKind::rheme, .first_word = 1, .end_word = 2}};
    const Speech speech = align(text, recording({"DON'T", "re-enter"}));
    EXPECT_THAT(texts_of(speech), ElementsAre("Don’t", "re-enter"));
    EXPECT_EQ(speech.words[1].start, 1);
    EXPECT_EQ(speech.words[1].end, 2);
    EXPECT_EQ(speech.words[1].first_phoneme, 2u);
    EXPECT_EQ(speech.words[1].end_phoneme, 4u);
    EXPECT_EQ(speech.marks, text.marks);
}

TEST(Align, FoldsTheCaseOfLettersWithAccents) {
    EXPECT_THAT(texts_of(align(script("ÉLAN Ça Größe ΩΣ ДОМ Łódź ŽIVOT Ÿ"),
                               recording({"élan", "ça", "GRÖßE", "ωσ", "дом", "łÓDŹ", "život", "Ÿ"}))),
                ElementsAre("ÉLAN", "Ça", "Größe", "ΩΣ", "ДОМ", "Łódź", "ŽIVOT", "Ÿ"));
}

TEST(Align, SharesTheTimeWhereWordsAreCutInAnotherWay) {
    const Speech joined = align(script("you re-enter it"), recording({"you", "re", "enter", "it"}));
    EXPECT_EQ(joined.words[1].start, 1);
    EXPECT_EQ(joined.words[1].end, 3);
    EXPECT_EQ(joined.words[2].start, 3);
    const Speech parted = align(script("you know it"), recording({"youknow", "it"}));
    EXPECT_NEAR(parted.words[0].end, 3.0 / 7, 1e-12);
    EXPECT_NEAR(parted.words[1].start, 3.0 / 7, 1e-12);
    EXPECT_EQ(parted.words[1].end, 1);
    EXPECT_EQ(phonemes_of(parted, 0), "a");
    EXPECT_EQ(phonemes_of(parted, 1), "b");
}

TEST(Align, GivesAWordWithoutLettersAShareOfTheWordBeforeIt) {
    MarkedText text = script("& well - then");
    const Speech speech = align(text, recording({"--", "well", "then", "..."}));
    ASSERT_EQ(speech.words.size(), 4u);
    EXPECT_EQ(speech.words[0].start, 1);
    EXPECT_LT(speech.words[0].end, speech.words[1].end);
    EXPECT_LT(speech.words[1].end, speech.words[2].end);
    EXPECT_EQ(speech.words[2].end, 2);
    EXPECT_EQ(speech.words[3].start, 2);
    EXPECT_EQ(speech.words[3].end, 3);
}

TEST(Align, RefusesTheFirstWordThatDiffers) {
    EXPECT_EQ(
        refusal_of([] {
            align(script("one two 3"), recording({"one", "two", "three"}));
        }),
        "text and recording: at 2.00 s the text says \"3\" (word 3) and the recording says \"three\" (word 3); "
        "write the text as it is said");
    EXPECT_EQ(
        refusal_of([] { align(script("one two"), recording({"one"})); }),
        "text and recording: at 1.00 s the text says \"two\" (word 2) and the recording ends; write the text "
        "as it is said");
    EXPECT_EQ(
        refusal_of([] {
            align(script("one"), recording({"one", "two"}));
        }),
        "text and recording: at 1.00 s the text ends and the recording says \"two\" (word 2); write the text "
        "as it is said");
    EXPECT_EQ(
        refusal_of([] { align(script("-"), recording({})); }),
        "text and recording: at 0.00 s the text says \"-\" (word 1) and the recording ends; write the text as it "
        "is said");
}

TEST(Align, LeavesNothingAloneWithNothing) {
    EXPECT_TRUE(align(script(""), recording({})).words.empty());
}

}  // namespace
}  // namespace chironomia
