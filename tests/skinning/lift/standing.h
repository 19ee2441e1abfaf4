// A person in a picture, for tests of what is read of it.
#pragma once

#include <map>

#include "skinning/lift/picture_body.h"

namespace chironomia::testing {

// With hanging arms, turned to the left, 4 m before the camera, 100 pixels a metre there.
inline PictureBody standing(double yaw_deg, size_t frames = 30) {
    const std::map<Landmark, Vec3> places = {
        {Landmark::nose, {0, 0.2f, 0.17f}},
        {Landmark::left_ear, {0.074f, 0.2f, 0.05f}},
        {Landmark::right_ear, {-0.074f, 0.2f, 0.05f}},
        {Landmark::thorax, {0, 0, 0}},
        {Landmark::left_shoulder, {0.18f, 0, 0}},
        {Landmark::right_shoulder, {-0.18f, 0, 0}},
        {Landmark::left_elbow, {0.22f, -0.28f, 0}},
        {Landmark::right_elbow, {-0.22f, -0.28f, 0}},
        {Landmark::left_wrist, {0.23f, -0.53f, 0}},
        {Landmark::right_wrist, {-0.23f, -0.53f, 0}},
        {Landmark::pelvis, {0, -0.5f, 0}},
        {Landmark::left_hip, {0.1f, -0.5f, 0}},
        {Landmark::right_hip, {-0.1f, -0.5f, 0}},
    };
    const Quat turn = glm::angleAxis(radians(static_cast<float>(yaw_deg)), Vec3(0, 1, 0));
    PictureBody body;
    body.places.resize(frames);
    body.there.resize(frames);
    for (size_t t = 0; t < frames; ++t) {
        for (const auto& [landmark, place] : places) {
            const Vec3 turned = turn * place;
            const float scale = 400 / (4 - turned.z);
            body.places[t][static_cast<size_t>(landmark)] =
                Vec2(300 + scale * turned.x, 200 - scale * turned.y);
            body.there[t].set(static_cast<size_t>(landmark));
            body.known.set(static_cast<size_t>(landmark));
        }
    }
    return body;
}

inline void hide(PictureBody& body, size_t frame, Landmark landmark) {
    body.there[frame].reset(static_cast<size_t>(landmark));
}

}  // namespace chironomia::testing
