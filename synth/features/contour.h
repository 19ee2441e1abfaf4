// Cleaning what was measured over time: smoothing, and bridging what was not seen; the pitch as models read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "synth/corpus/records.h"

namespace chironomia {

// Values over time, (T, width), and which of the frames count.
struct Measured {
    std::span<const float> values;          // (T, width)
    std::size_t width = 1;                  // columns
    std::span<const std::uint8_t> success;  // (T) 0: the frame was not seen, whatever its values say

    std::size_t frames() const { return success.size(); }  // T
};

// (T, width) the median of the frames that were seen within `window` (odd) frames about each one, the first
// and last frame going on beyond the ends; the lower and upper middle are averaged. A frame that was not seen
// keeps its value.
std::vector<float> median_filter(const Measured& measured, std::size_t window = 7);

// (T, width) frames that were not seen lie on the line between the nearest seen ones; before the first and
// after the last of those, theirs go on. Nothing if no frame was seen.
std::optional<std::vector<float>> bridge_gaps(const Measured& measured);

// The steps 3 and 4 of the TEDx corpus in their order: the filter, then the bridges (Fares 2023,
// section 4.1).
std::optional<std::vector<float>> smooth_and_bridge(const Measured& measured, std::size_t window = 7);

// The samples at `rate` [Hz] that fall into [start, end) seconds: [first, last).
struct SampleRange {
    std::size_t first = 0;
    std::size_t last = 0;
};
SampleRange samples_in(double start, double end, double rate);

// (S) a pitch at every sample, in [50, 550] Hz, of one at `rate` [Hz] that is 0 where it is not voiced.
// Within each word: lines between voiced samples; before the first and after the last of them the line
// through the two nearest ones goes on, clamped; a single one is held. A word without any, and what lies
// between words, takes the line from the last sample before it to the first one after it, held at the ends
// of the speech. Nothing if no sample of any word is voiced. Fares 2023, section 4.1; A04.
//   words  ascending, not overlapping
std::optional<std::vector<float>> fill_pitch(std::span<const float> f0, double rate,
                                             std::span<const CorpusWord> words);

// The pitch as whole numbers (A05).
inline constexpr int kPitchTokens = 503;  // 0 pads, 1 is silence or not voiced, 2 to 502 are 50 to 550 Hz
inline constexpr int kPitchUnvoiced = 1;

int token_of_pitch(double f0);       // [Hz], clamped to [50, 550]; kPitchUnvoiced for 0 or less
double normalized_pitch(double f0);  // (f0 - 50) / 500, clamped to [0, 1]

}  // namespace chironomia
