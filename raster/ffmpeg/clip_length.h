// How long a clip is when its motion and its sound differ: nothing is ever cut.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/audio.h"
#include "core/render/rate.h"

namespace chironomia {

struct ClipLength {
    size_t frames = 0;       // of the clip
    size_t held_frames = 0;  // of these, repeats of the last pose at the end
    double silence_s = 0;    // to add to the end of the sound
    std::vector<std::string> warnings = {};
};

// Sound that ends before the picture is filled up with silence to its very end. Motion that ends more than
// one frame before the sound holds its last pose until the sound is over. A difference of more than one frame
// is worth a warning. `motion_frames` is at least 1; without sound (null) the motion alone decides.
ClipLength match_lengths(size_t motion_frames, const Rate& fps, const Audio* sound);

// The sound with silence added so that it lasts at least `seconds`, rounded to the nearest sample.
Audio pad_with_silence(const Audio& sound, double seconds);

}  // namespace chironomia
