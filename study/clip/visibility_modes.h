// What a clip shows of a face and of hands: factors of an experiment.
#pragma once

#include <map>
#include <string>

#include "core/files/json.h"

namespace chironomia::study {

enum class FaceMode {
    au,          // as it is driven
    neutral,     // at rest: no expression, no gaze, no turn of the head but the body's own
    mask,        // under an opaque mask
    blur,        // blurred whole
    mouth_blur,  // the mouth alone blurred
};

enum class HandsMode {
    motion,   // as the motion says
    relaxed,  // the fingers curled as those of a relaxed hand, whatever the motion says
    hidden,   // in closed mitts
};

struct Modes {
    FaceMode face_mode = FaceMode::au;
    HandsMode hands = HandsMode::motion;

    bool operator==(const Modes&) const = default;
};

// The words of the command line and of plans.
const std::map<std::string, FaceMode>& face_modes();
const std::map<std::string, HandsMode>& hands_modes();
std::string to_text(FaceMode mode);
std::string to_text(HandsMode mode);

// {"face_mode": "mask", "hands": "motion"}
Json to_json(const Modes& modes);

}  // namespace chironomia::study
