// How a Model 1 is built. No torch here.
#pragma once

#include <cstddef>
#include <cstdint>

#include "synth/learned/faces/face_units.h"

namespace chironomia {

struct Model1Options {
    std::int64_t hidden = 100;  // N_hid of the auto-encoders and of the upper encoders
    bool per_direction = true;  // A34: so many units in each direction of an LSTM, or in both together
    bool shared_trunk = false;  // one decoder below the nine heads, or nine
    // A35: one auto-encoder of faces for all channels, or one for each, from which its decoder begins; not
    // with a shared trunk.
    bool nine_autoencoders = false;
    std::size_t most_frames = kMostFrames;  // of a word
    FaceLevels levels = face_levels(101, 101);
};

}  // namespace chironomia
