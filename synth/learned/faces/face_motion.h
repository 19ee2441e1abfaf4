// From what a model says of each frame of each word to the motion of a face. No torch here.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "synth/learned/faces/face_units.h"

namespace chironomia {

// What was said of the frames of one unit's words, end to end: (F, kFaceChannels) in [0, 1].
struct SaidFace {
    const FaceUnit* unit = nullptr;
    std::vector<float> values;
};

// (T, kFaceChannels) in [0, 1], and which of the frames were spoken of. A word that was thinned is spread
// over its own frames again.
struct FaceMotion {
    std::vector<float> values;
    std::vector<std::uint8_t> said;  // (T) 0: the frame is in no word

    std::size_t frames() const { return said.size(); }
};
FaceMotion lay_out(std::span<const SaidFace> units, std::size_t frames);

// (T, width) each frame as the mean of its neighbours, weighted by a Gaussian of `deviation` frames, the
// first and last frame going on beyond the ends. Symmetric, so that nothing comes earlier or later; 0 changes
// nothing.
std::vector<float> smoothed(std::span<const float> values, std::size_t width, double deviation);

}  // namespace chironomia
