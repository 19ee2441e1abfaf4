// The depth of an arm or a leg of which only the picture is known.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skinning/lift/body_scale.h"
#include "skinning/lift/learned_depth.h"
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
    double swing = 5;     // cutoff of the zero-phase low-pass over its angles [Hz]; 0: none
};

// What a camera sees of a limb and of its trunk over a clip, (T) each.
struct LimbSight {
    std::span<const SeenLimb> limb;
    std::span<const Trunk> trunks;
    PinholeCamera camera;
    double fps = 30;
};

struct LimbPlace {
    glm::dvec3 mid{0};  // [m]
    glm::dvec3 tip{0};
};

// The places of a limb and of the limb on the other side from an earlier round (T each), or both empty.
struct EarlierPlaces {
    std::span<const LimbPlace> own{};
    std::span<const LimbPlace> other{};
};

// Elbows and wrists, or knees and ankles, in space (T). A bone that looks shorter than it is points towards the camera
// or away from it. A Viterbi path over the whole clip decides between both. A posture costs if it is rare or impossible
// (limb_cost.h), or if the learned directions are others; a step costs by its speed and the change of its speed. The
// angles of the path are then refined. A limb that is not seen hangs at rest. If `earlier` is given, limbs tend to
// mirror each other, because people gesture with both hands alike, and to repeat the postures that they take most
// (frequent_postures.h). After Lee and Chen, "Determination of 3D human body postures from a single view", CVGIP 30,
// 1985, who found the two ways that each bone can point; we choose among them over time.
std::vector<LimbPlace> lift_limb(const LimbSight& sight, const LimbShape& shape,
                                 const EarlierPlaces& earlier = {});

// `shape` with the bones as long as they look at their longest. `places` correct for the distance to the camera. At
// most 15 % longer and 20 % shorter than in `shape`.
LimbShape measured_shape(std::span<const SeenLimb> seen, std::span<const LimbPlace> places,
                         const LimbShape& shape);

// The same of a leg, before it is lifted: people stand most of the time, so its bones are as long as they usually look
// in the frames that show them at length (at least 0.8 of `shape`).
LimbShape standing_shape(std::span<const SeenLimb> seen, const LimbShape& shape, const PinholeCamera& camera);

}  // namespace chironomia
