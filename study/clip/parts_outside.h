// Which parts of a person leave the picture, where that is a fault.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia::study {

// A head must be in the picture, with its top, at every frame. What counts of hands and feet depends on what the scene
// shows of the avatar at rest, and what is gone for less than 0.2 s hardly anybody sees:
//   both feet   whole people: a foot or a hand must not leave by any edge
//   the hips    gestures: a hand must not leave by the upper edge or a side; below it is at rest
//   neither     a head: hands come and go
struct PartsOutside {
    bool shows_feet = false;
    std::vector<bool> head;   // (T)
    std::vector<bool> hands;  // (T) either of them
    std::vector<bool> feet;   // (T) either of them
};

// A person over the frames of a clip, as they are before a scene puts them somewhere.
struct PosedPerson {
    const Avatar& avatar;
    std::function<Pose(std::size_t)> pose_at;
    std::size_t frames = 0;
    double fps = 30;
};

PartsOutside find_parts_outside(const PosedPerson& person, const Mat4& clip_from_figure);

}  // namespace chironomia::study
