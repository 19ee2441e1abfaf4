// A plain humanoid built joint by joint, in any rest pose and with any local axes.
#pragma once

#include "core/body/avatar.h"
#include "core/body/humanoid.h"
#include "core/body/skeleton.h"

namespace chironomia::testing {

struct FigureShape {
    float arms_down = 0;       // how far the arms hang below the T-pose [radians]
    float elbows_bent = 0;     // forearms brought forward [radians]
    float arms_forward = 0;    // whole arms brought forward [radians]
    bool turned_axes = false;  // every joint's own axes point anywhere
    bool lying = false;        // on its back, the head towards -z
    int spine_joints = 3;      // 1 to 3 named parts; any more in between have no name
    bool low_neck = false;     // a joint without a name between the chest and the neck
    bool clavicles = true;
    bool twist_joints = false;  // one more joint in each upper arm, forearm and thigh
    bool fingers = true;
    bool legs = true;
    float size = 1;
};

struct Figure {
    Skeleton skeleton;
    HumanoidMap parts;
};

// About 1.7 m tall, standing on the floor, facing +z.
Figure make_figure(const FigureShape& shape);

// The same figure with every bone along its joint's own +x and a rest pose without turns, as some files store
// it: all bones in one line. `axes` make a person of it.
struct LinedUpFigure {
    Figure figure;
    std::vector<Quat> axes;  // (J) world_from_joint in the T-pose
};
LinedUpFigure line_up(const Figure& figure);

// An avatar of that figure without any surface.
Avatar avatar_of(const Figure& figure);

}  // namespace chironomia::testing
