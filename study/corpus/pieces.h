// Where speech is cut into intervals.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "study/corpus/manifest.h"

namespace chironomia::study {

// The part of a recording that is taken [s].
struct TimeRange {
    double start = 0;
    double end = 0;

    double seconds() const { return end - start; }
};

// Words [first, last) that become an interval.
struct SpeechPiece {
    std::size_t first = 0;
    std::size_t last = 0;
    TimeRange spoken;  // from its first word to the end of the last one
    TimeRange time;    // with the silence at its edges; those of two pieces do not overlap
};

// The words that lie in the range, cut at all silences that are longer than a pause may be. What then is longer than
// the limit is cut in two, and its parts again, at the longest silence that leaves neither part under the least
// length; of several the one that is nearest to the middle. Where there is none, the piece stays too long. To
// each of its ends a piece takes silence as far as the limit allows, and at most half of what is there.
//   words   ascending, not overlapping
std::vector<SpeechPiece> speech_pieces(std::span<const CorpusWord> words, const TimeRange& range,
                                       const IntervalLimits& limits);

}  // namespace chironomia::study
