// Speech that a face is found for, and that face, as files (synth/learned/faces/face_jobs.h). No torch here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "synth/learned/faces/face_motion.h"

namespace chironomia {

inline constexpr double kUsualSmoothing = 0.05;  // [s]

struct SpokenFile {
    std::string text_encoder;
    SpokenWords speech;  // its pitch bridged
};
// Throws Error with the file if something is missing, of another shape, not finite, or the words are not in
// order; if nothing is voiced.
SpokenFile read_spoken(const std::filesystem::path& file);

// Its units: a silence of more than 0.2 s between two words ends one.
std::vector<FaceUnit> units_of_speech(SpokenWords speech, const UnitCut& cut);

struct FaceAnimation {
    FaceMotion motion;
    double fps = 24;
    double smooth = kUsualSmoothing;  // deviation of the Gaussian [s]
};
// Throws Error if it cannot be written.
void write_animation(const std::filesystem::path& file, const FaceAnimation& animation);

}  // namespace chironomia
