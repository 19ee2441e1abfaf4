#include "synth/features/speech_units.h"

#include <gmock/gmock.h>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;

std::vector<std::string> words_in(const SpeechUnit& unit) {
    std::vector<std::string> texts;
    for (const CorpusWord& word : unit.words) texts.push_back(word.text);
    return texts;
}

TEST(SpeechUnits, EndAtSilencesOfOverAFifthOfASecond) {
    const std::vector<CorpusWord> words{{"we", 0.1, 0.3}, {"know", 0.5, 0.8}, {"this", 1.01, 1.2}};
    const std::vector<SpeechUnit> units = speech_units(words, "talk");
    ASSERT_EQ(units.size(), 2u);
    EXPECT_THAT(words_in(units[0]), ElementsAre("we", ",", "know"));
    EXPECT_EQ(units[0].start, 0.1);
    EXPECT_EQ(units[0].end, 0.8);
    EXPECT_THAT(words_in(units[1]), ElementsAre("this"));
}

TEST(SpeechUnits, HaveNoGaps) {
    const std::vector<CorpusWord> words{{"a", 0, 0.1}, {"b", 0.105, 0.2}, {"c", 0.2, 0.3}, {"d", 0.35, 0.4}};
    const std::vector<SpeechUnit> units = speech_units(words, "talk");
    ASSERT_EQ(units.size(), 1u);
    EXPECT_THAT(words_in(units[0]), ElementsAre("a", "b", "c", ",", "d"));
    for (std::size_t i = 1; i < units[0].words.size(); ++i)
        EXPECT_EQ(units[0].words[i].start, units[0].words[i - 1].end);
}

TEST(SpeechUnits, TakeAnotherLimit) {
    const std::vector<CorpusWord> words{{"a", 0, 0.1}, {"b", 0.5, 0.6}};
    EXPECT_EQ(speech_units(words, "talk", 0.4).size(), 1u);
    EXPECT_EQ(speech_units(words, "talk", 0.39).size(), 2u);
    EXPECT_TRUE(speech_units({}, "talk").empty());
}

TEST(SpeechUnits, RefuseWordsOutOfOrder) {
    const std::vector<CorpusWord> empty{{"a", 0.2, 0.2}};
    EXPECT_THAT(refusal_of([&] { speech_units(empty, "talk.csv"); }),
                HasSubstr("talk.csv: word 0 \"a\" lasts from 0.2 to 0.2 s; every word must end"));
    const std::vector<CorpusWord> overlapping{{"a", 0, 0.3}, {"b", 0.25, 0.5}};
    EXPECT_THAT(refusal_of([&] { speech_units(overlapping, "talk.csv"); }),
                HasSubstr("talk.csv: word 1 \"b\" starts at 0.25 s, before word 0 \"a\" ends at 0.3 s"));
}

}  // namespace
}  // namespace chironomia
