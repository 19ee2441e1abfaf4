// How a Model 2 is built. No torch here.
#pragma once

#include <cstdint>

#include "synth/learned/faces/face_units.h"

namespace chironomia {

struct Model2Options {
    std::int64_t width = 64;  // d
    std::int64_t heads = 4;
    std::int64_t hidden = 400;
    std::int64_t encoder_layers = 4;
    std::int64_t decoder_layers = 4;
    std::int64_t frame_width = 64;  // of what D_face^(1) makes of a frame
    double dropout = 0.1;
    FaceLevels levels = face_levels(101, 101);

    // Of all designs with as many numbers as the thesis counts, the preset "m2_2051133" (A44).
    bool counted = false;

    // A40: what is read of a sample of the pitch: its token, embedded; its value; its distance from the
    // unit's mean with that mean and the deviation; or that distance alone.
    enum class Pitch { tokens, values, relative, rise };
    Pitch pitch = Pitch::tokens;
    bool by_frames = false;       // A45: the sequence is one of words, or of frames
    bool attention_layer = true;  // A41: A is a decoder layer, or eq. (5.12) as it is printed
    // A42: the face's decoders look at H_att, or at X2 with H_att added to their input
    bool attended_memory = true;

    // What helps where there is little to learn from (docs/learned_faces.md); the thesis has none of them.
    bool near = false;               // attention weighs a word down by its distance
    bool level_inputs = false;       // inputs are scaled to the size of the position codes added to them
    bool expected_feedback = false;  // feeds back the mean of all embedded levels, not the likeliest
    double forgotten = 0;            // share of words in training without feedback; 1: feedback is never used
    double unplaced = 0;             // share of units in training without their mean pitch and its deviation
    double unread = 0;               // share of the numbers of word vectors that are dropped in training

    // What an ablation takes away.
    bool with_speech = true;
    bool with_text = true;
    bool with_cross = true;   // A
    bool with_frames = true;  // D_face^(1)
};

}  // namespace chironomia
