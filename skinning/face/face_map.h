// How an avatar shows a face: which morphs and joints stand for which action units and for the gaze.
#pragma once

#include <string>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/face.h"
#include "skinning/face/face_joints.h"
#include "skinning/face/face_names.h"

namespace chironomia {

struct MorphShare {
    int morph = 0;     // index into Pose::morph_weights
    float weight = 1;  // where the shape is whole
    bool eyeball = false;
};

// A shape that shows a unit. One for both sides is driven by the mean of the two. A morph that several
// shapes or units move takes the largest of what they ask for, so that none goes further than it was drawn.
struct UnitShape {
    int unit = 0;
    FaceSide side = FaceSide::both;
    float weight = 1;   // of the shape at intensity 5
    std::string shape;  // its name
    NameFamily family = NameFamily::facs;
    std::vector<MorphShare> morphs{};
};

// A shape that makes one eye or both look somewhere. Where joints turn the eyes it only moves the lids.
struct LookShape {
    FaceSide side = FaceSide::both;
    Look look = Look::none;
    float whole = 0;  // where it makes an eye look at weight 1 [rad]; measured, 30 degrees if it cannot be
    std::string shape;
    std::vector<MorphShare> morphs{};
};

struct FaceMap {
    std::vector<UnitShape> units{};  // by unit, then side
    std::vector<LookShape> looks{};
    FaceJoints joints{};
    bool lips_close = false;      // a morph shows AU8; otherwise the jaw drops less by as much
    bool jaw_drops = false;       // no morph shows AU26, and the jaw joint does
    bool jaw_opens_lips = false;  // no morph shows AU25, and the jaw joint does
    bool lids_close = false;      // no morph shows AU45, and joints of the lids do
    bool lids_look = false;       // a look shape moves the lids with the gaze; otherwise AU45, 5 and 7 do
    size_t morphs = 0;            // the avatar's
};

// Found from names (face_names.h) and joints. Of several families that could show a unit on a side, the first
// does; of a shape with sides and its namesake for both, the one with sides. A unit that an avatar could only
// hint at (all its shapes under a quarter) is left out. The avatar must be a humanoid.
FaceMap map_face(const Avatar& avatar);

// The names of what shows a unit on one side: shapes, or "joint jaw"; empty if nothing does.
std::vector<std::string> shown_by(const FaceMap& map, const Avatar& avatar, const FaceChannel& channel);

bool turns_eyes(const FaceMap& map);

}  // namespace chironomia
