#include "study/corpus/pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Words of 0.5 s from the start on, "|" being a silence of 0.1 s and "_" one of 1 s.
std::vector<CorpusWord> words_from(double start, const std::string& pattern) {
    std::vector<CorpusWord> words;
    for (const char c : pattern) {
        const double length = c == '|' ? 0.1 : c == '_' ? 1 : 0.5;
        if (c == 'w') words.push_back({.text = "w", .start = start, .end = start + length});
        start += length;
    }
    return words;
}

// "0-4 1.7-4.3": the words and the time of each piece.
std::vector<std::string> pieces_of(const std::vector<CorpusWord>& words, const IntervalLimits& limits,
                                   const TimeRange& range = {0, 100}) {
    std::vector<std::string> texts;
    for (const SpeechPiece& piece : speech_pieces(words, range, limits))
        texts.push_back(
            format("{}-{} {:.2f}-{:.2f}", piece.first, piece.last, piece.time.start, piece.time.end));
    return texts;
}

TEST(SpeechPieces, EndAtLongSilencesAndKeepSomeOfThem) {
    const auto words = words_from(2, "ww|w_ww");  // from 2 to 3.6, and from 4.6 to 5.6 s
    EXPECT_THAT(pieces_of(words, {.most_pause_seconds = 0.9}), ElementsAre("0-3 1.70-3.90", "3-5 4.30-5.90"));
    EXPECT_THAT(pieces_of(words, {.most_pause_seconds = 1}), ElementsAre("0-5 1.70-5.90"))
        << "a silence that is as long as it may be is none to cut at";
    EXPECT_THAT(pieces_of(words, {.most_pause_seconds = 0.9, .most_edge_seconds = 3}, {1, 7}),
                ElementsAre("0-3 1.00-4.10", "3-5 4.10-7.00"))
        << "each has half of the silence between them";
}

TEST(SpeechPieces, AreCutAtTheLongestSilenceThatLeavesBothLongEnough) {
    const auto words = words_from(0, "w|wwww|ww");  // silences before the words 1 and 5, at 0.5 and 2.6 s
    const IntervalLimits limits{.least_seconds = 1, .most_seconds = 3, .most_edge_seconds = 0};
    EXPECT_THAT(pieces_of(words, limits), ElementsAre("0-5 0.00-2.60", "5-7 2.70-3.70"));
    EXPECT_THAT(pieces_of(words, {.least_seconds = 0.5, .most_seconds = 3, .most_edge_seconds = 0}),
                ElementsAre("0-5 0.00-2.60", "5-7 2.70-3.70"))
        << "of two that are equally long the one nearer to the middle";
    EXPECT_THAT(pieces_of(words_from(0, "wwwwwwww"),
                          {.least_seconds = 0.5, .most_seconds = 1, .most_edge_seconds = 0}),
                ElementsAre("0-2 0.00-1.00", "2-4 1.00-2.00", "4-6 2.00-3.00", "6-8 3.00-4.00"));
    EXPECT_THAT(pieces_of(words_from(0, "ww"), {.least_seconds = 0.4, .most_seconds = 0.8}),
                ElementsAre("0-1 0.00-0.50", "1-2 0.50-1.30"));
    EXPECT_THAT(pieces_of(words_from(0, "w"), {.least_seconds = 0.1, .most_seconds = 0.2}),
                ElementsAre("0-1 0.00-0.80"))
        << "a word is never cut";
}

TEST(SpeechPieces, HaveOnlyWordsThatLieInTheRange) {
    const auto words = words_from(0, "wwwwww");
    EXPECT_THAT(pieces_of(words, {}, {0.6, 2.45}), ElementsAre("2-5 1.00-2.45"))
        << "the last word may end up to a frame behind";
    EXPECT_THAT(pieces_of(words, {}, {0.6, 2.4}), ElementsAre("2-4 1.00-2.00"));
    EXPECT_THAT(pieces_of(words, {}, {0.6, 1.2}), IsEmpty());
    EXPECT_THAT(pieces_of({}, {}), IsEmpty());
}

}  // namespace
}  // namespace chironomia::study
