// How a Model 2 is built. No torch here.
#pragma once

#include <cstdint>

#include "synth/learned/face_units.h"

namespace chironomia {

struct Model2Options {
    std::int64_t width = 64;  // d
    std::int64_t heads = 4;
    std::int64_t hidden = 400;
    std::int64_t encoder_layers = 4;
    std::int64_t decoder_layers = 4;
    double dropout = 0.1;
    FaceLevels levels = face_levels(101, 101);

    // Of all designs with as many numbers as the thesis counts, the one that MODELS A44 names.
    bool counted = false;

    bool pitch_tokens = true;     // A40: the pitch's tokens are embedded, or its values are read as they are
    bool attention_layer = true;  // A41: A is a decoder layer, or eq. (5.12) as it is printed
    bool attended_memory =
        true;  // A42: the face's decoders look at H_att, or at X2 with H_att added to their input

    // What an ablation takes away.
    bool with_speech = true;
    bool with_text = true;
    bool with_cross = true;   // A
    bool with_frames = true;  // D_face^(1)
};

}  // namespace chironomia
