#include "synth/presence/turns.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

// `seconds` of a constant sound with a word in its second half.
Speech one_word(const std::string& text, double seconds, float level) {
    Speech speech;
    speech.audio.rate = 1000;
    speech.audio.samples.assign(static_cast<std::size_t>(seconds * 1000), level);
    speech.language = "en-gb";
    speech.words = {
        {.text = text, .start = seconds / 2, .end = seconds, .first_phoneme = 0, .end_phoneme = 1}};
    speech.phonemes = {{.symbol = "a", .start = seconds / 2, .end = seconds}};
    speech.marks = {{.kind = MarkKind::rheme, .value = "", .first_word = 0, .end_word = 1}};
    speech.marks[0].times.start = {.word = 0, .offset = 0.1};
    speech.marks[0].times.end = {.word = 1, .offset = -0.1};
    speech.marks[0].times.stroke = {.word = std::nullopt, .offset = 0.2};
    return speech;
}

TEST(PlaceTurns, LaysSpeechesOneAfterTheOther) {
    const std::vector<SpokenTurn> turns = {
        {0, one_word("one", 2, 0.1f)}, {1, one_word("two", 1, 0.2f)}, {0, one_word("three", 4, 0.3f)}};
    const auto [first, second] = place_turns(turns, {.between = 0.5, .at_edges = 1});
    EXPECT_EQ(first.audio.samples.size(), 10000u);  // 1 + 2 + 0.5 + 1 + 0.5 + 4 + 1 s
    EXPECT_EQ(second.audio.samples.size(), 10000u);
    EXPECT_EQ(first.language, "en-gb");
    ASSERT_EQ(first.words.size(), 2u);
    EXPECT_NEAR(first.words[0].start, 2, 1e-9);
    EXPECT_NEAR(first.words[1].start, 5 + 2, 1e-9);
    EXPECT_NEAR(second.words.at(0).end, 4.5, 1e-9);
    EXPECT_EQ(first.words[1].first_phoneme, 1u);
    EXPECT_EQ(first.words[1].end_phoneme, 2u);
    EXPECT_NEAR(first.phonemes.at(1).end, 9, 1e-9);
    for (std::size_t i = 0; i < 10000; ++i) {
        const double time = (static_cast<double>(i) + 0.5) / 1000;
        const float one = time > 1 && time < 3 ? 0.1f : time > 5 && time < 9 ? 0.3f : 0;
        ASSERT_EQ(first.audio.samples[i], one) << i;
        ASSERT_EQ(second.audio.samples[i], time > 3.5 && time < 4.5 ? 0.2f : 0) << i;
    }
}

TEST(PlaceTurns, KeepsActsAtTheirWords) {
    const std::vector<SpokenTurn> turns = {{0, one_word("one", 2, 0.1f)}, {0, one_word("two", 1, 0.2f)}};
    const Speech speech = place_turns(turns, {.between = 0.5, .at_edges = 0.5})[0];
    ASSERT_EQ(speech.marks.size(), 2u);
    EXPECT_EQ(speech.marks[1].first_word, 1u);
    EXPECT_EQ(speech.marks[1].end_word, 2u);
    const auto when = [&](std::size_t mark, std::optional<SyncPoint> MarkTimes::*point) {
        return time_of(*(speech.marks[mark].times.*point), speech);
    };
    EXPECT_NEAR(when(0, &MarkTimes::start), 1.6, 1e-9);
    EXPECT_NEAR(when(0, &MarkTimes::end), 2.4, 1e-9);  // of its own last word, not of the next turn's first
    EXPECT_NEAR(when(1, &MarkTimes::start), 3.6, 1e-9);
    EXPECT_NEAR(when(1, &MarkTimes::end), 3.9, 1e-9);
    EXPECT_NEAR(when(1, &MarkTimes::stroke), 3.2, 1e-9);
}

TEST(FloorTimes, GoFromOnesFirstWordToTheOthers) {
    const std::vector<FloorTime> floors = floor_times({{{{1, 2}, {2.5, 4}, {9, 10}}, {{5, 6}, {6.5, 8}}}});
    ASSERT_EQ(floors.size(), 3u);
    EXPECT_EQ(floors[0].person, 0u);
    EXPECT_EQ(floors[0].start, 1);
    EXPECT_EQ(floors[0].silent, 4);
    EXPECT_EQ(floors[0].end, 5);
    EXPECT_EQ(floors[1].person, 1u);
    EXPECT_EQ(floors[1].end, 9);
    EXPECT_EQ(floors[2].person, 0u);
    EXPECT_EQ(floors[2].end, 10);
    EXPECT_TRUE(floor_times({}).empty());
}

}  // namespace
}  // namespace chironomia
