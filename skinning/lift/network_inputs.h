// What the network of learned_depth.h reads of a picture.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "skinning/lift/picture_body.h"

namespace chironomia {

// As in assets/models/make/picture.py, which says what each number is.
inline constexpr std::array kReadPoints = {
    Landmark::nose,           Landmark::left_ear,   Landmark::right_ear,   Landmark::left_shoulder,
    Landmark::right_shoulder, Landmark::left_elbow, Landmark::right_elbow, Landmark::left_wrist,
    Landmark::right_wrist,    Landmark::left_hip,   Landmark::right_hip,
};
inline constexpr size_t kParts = 6;   // shoulders, trunk, upper arms, forearms, hips, ears
inline constexpr size_t kRatios = 6;  // of upper arms, forearms, shoulders, trunk to their lengths
inline constexpr size_t kFlags = 8;   // whether nose, ears, elbows, wrists and hips are seen
inline constexpr size_t kRow = 2 * kReadPoints.size() + kRatios + kFlags;

using NetworkInput = std::array<float, kRow>;  // of one frame by itself; of no unit

struct NetworkInputs {
    std::vector<NetworkInput> rows;       // (T) a frame that lacks a shoulder has those of the frame before
    std::array<float, kParts> lengths{};  // of the clip's parts against each other and the usual

    // Mean and spread over the rows of three seconds before and after each.
    std::vector<NetworkInput> means, spreads;  // (T)
};

// Some frame must show both shoulders.
NetworkInputs network_inputs_of(const PictureBody& body, double fps);

// The picture as a mirror shows it: what was left is right.
PictureBody mirror_picture(const PictureBody& body);

}  // namespace chironomia
