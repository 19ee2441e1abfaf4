// Talks as Models 1 and 2 read them: word by word, how the voice's pitch runs and how nine channels of the
// upper face and the head run (Fares 2023, section 5.4). No torch here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "synth/corpus/records.h"

namespace chironomia {

inline constexpr std::size_t kFaceChannels = 9;
inline constexpr std::array<std::string_view, kFaceChannels> kFaceChannelNames{
    "AU1", "AU2", "AU4", "AU5", "AU6", "AU7", "Rx", "Ry", "Rz"};
inline constexpr std::size_t kMostSamples = 100;  // of a word's pitch, at 100 Hz; section 5.6.2
inline constexpr std::size_t kMostFrames = 124;   // of a word's face; section 5.6.2
inline constexpr std::size_t kMostWords = 128;    // of a unit
inline constexpr double kUnitSilence = 0.2;       // a longer one ends a unit [s]; section 4.1

// How many steps a channel's contour is quantised to: 101, but where a design has other counts.
using FaceLevels = std::array<std::int64_t, kFaceChannels>;
FaceLevels face_levels(std::int64_t of_action_units, std::int64_t of_angles);

// Which samples of an even series lie within a word: [first, first + count).
struct Stretch {
    std::size_t first = 0;
    std::size_t count = 0;
};

struct FaceWord {
    Stretch samples;              // of the voice
    Stretch frames;               // of the face
    std::vector<float> f0;        // (S) [Hz], S at most kMostSamples; none in a word under 10 ms
    std::vector<float> contours;  // (L, kFaceChannels) in [0, 1], none if not known
    std::size_t length = 0;       // L, which may be 0: a word between two frames
};

// What the elements of a unit are (A45 of docs/learned_faces.md): words, or frames, of which each gets the word
// that it lies in and the pitch at its time.
struct UnitCut {
    std::size_t most_frames = kMostFrames;  // of a word
    bool by_frames = false;

    std::size_t most_elements() const { return by_frames ? kMostFrames : kMostWords; }
    // As many elements as `words` usual words have, of a third of a second or 8 frames each.
    std::size_t elements_in(std::size_t words) const { return by_frames ? 8 * words : words; }
};

// A stretch of speech of at most so many elements; a record of more is several.
struct FaceUnit {
    std::string id;  // of the record
    std::string speaker;
    std::vector<FaceWord> words;  // (N) or frames, by the cut
    std::vector<float> vectors;   // (N, kWordVector)
};

// Speech whose face is to be found.
struct SpokenWords {
    std::vector<CorpusWord> words;  // (N)
    std::vector<float> vectors;     // (N, kWordVector)
    std::vector<float> f0;          // (S) [Hz] at IpuRecord::kSpeechRate
    double fps = 24;
    std::size_t frames = 0;  // T
    UnitCut cut;
};

// The units of the words from `begin` to before `end`. A word of more samples or frames than are read is
// thinned linearly.
std::vector<FaceUnit> spoken_units(const SpokenWords& speech, std::size_t begin, std::size_t end);

// With the contours, normalised: an action unit's 0 to 5 and a turn's -1 to 1 rad become 0 to 1, what lies
// outside is held at the border.
std::vector<FaceUnit> face_units(const IpuRecord& record, const UnitCut& cut = {});

// (T, kFaceChannels) of the whole record, normalised as above.
std::vector<float> normalised_face(const IpuRecord& record);

// What 0 and 1 of each channel stand for: intensities, then radians.
std::array<std::array<double, 2>, kFaceChannels> face_scale();

// `count` rows spread evenly over those of `rows` (R, width), the first and last kept.
std::vector<float> resampled_rows(std::span<const float> rows, std::size_t width, std::size_t count);

}  // namespace chironomia
