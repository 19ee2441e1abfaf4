// The depth of an arm or a leg of which only the picture is known.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skinning/lift/learned_depth.h"
#include "skinning/lift/lift_camera.h"
#include "skinning/lift/trunk_lift.h"

namespace chironomia {

enum class LimbKind { arm, leg };

// What is seen of a limb in one frame.
struct SeenLimb {
    glm::dvec3 root{0};  // shoulder or hip, in space [m]
    Vec2 mid{0};         // elbow or knee, in the picture
    Vec2 tip{0};         // wrist or ankle, in the picture
    bool has_mid = false;
    bool has_tip = false;
    std::optional<LearnedArm> learned{};
};

struct LimbShape {
    LimbKind kind = LimbKind::arm;
    bool left = true;
    double upper = 0.28;  // [m]
    double lower = 0.25;  // [m]
    double swing = 5;     // cutoff of the zero-phase low-pass over its depth [Hz]; 0: none
};

struct LimbPlace {
    glm::dvec3 mid{0};  // [m]
    glm::dvec3 tip{0};
};

// What an earlier lifting found of a limb and of the one on the other side (T each), or nothing of both.
struct EarlierPlaces {
    std::span<const LimbPlace> own{};
    std::span<const LimbPlace> other{};
};

// Elbows and wrists, or knees and ankles, in space (T). A bone that looks shorter than it is points towards
// the camera or away from it; which of both is decided for the whole clip at once by the cheapest path over a
// grid of both angles, where a posture costs what it asks of joints (elbows bend one way, upper arms turn in
// and out only so far, hands are in front of the trunk that they cover and not in it) and a step what it asks
// of muscles. The path is then refined to the angles between those of the grid. A limb that is not seen hangs
// at rest. What was learned of where its bones point has its price too. If it is known what both limbs did,
// they mirror each other rather than not when nothing else decides, as people gesture with both hands alike,
// and come back to their habits (skinning/lift/limb_habits.h). After Lee and Chen, "Determination of 3D human
// body postures from a single view", CVGIP 30, 1985, who found the two ways that each bone can point; we
// choose among them over time.
std::vector<LimbPlace> lift_limb(std::span<const SeenLimb> seen, std::span<const Trunk> trunks,
                                 const LimbShape& shape, const LiftCamera& camera, double fps,
                                 const EarlierPlaces& earlier = {});

// The shape whose bones are as long as they look at their longest, once it is known how near to the camera
// they are: what is nearer looks larger. Within 15 % of `shape`.
LimbShape measured_shape(std::span<const SeenLimb> seen, std::span<const LimbPlace> places,
                         const LimbShape& shape);

}  // namespace chironomia
