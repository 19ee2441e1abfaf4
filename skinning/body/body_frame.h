// How a body stands in a space with unknown axes and unit: which way is up, where it looks, how tall it is.
#pragma once

#include <optional>
#include <vector>

#include "core/body/motion.h"
#include "core/math.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {

// Places of landmarks over some frames, in any axes and any unit. Frame t, landmark l: places[t][l].
using LandmarkFrame = std::vector<std::optional<Vec3>>;  // (kLandmarks); nothing: missing

struct BodyFrame {
    std::optional<Vec3> up;       // mean direction from the hips to the head, unit
    std::optional<Vec3> forward;  // where hips and shoulders face if the axes are right-handed, unit, at
                                  // right angles to `up`
    std::optional<float> height;  // from the lengths of arms, legs and trunk, in the unit of the places
    float front = 0;  // in [-1, 1]: how far nose, toes, knees and elbows agree that `forward` is the front;
                      // below 0 they lie behind, as in a mirrored (left-handed) space. Without legs only the
                      // nose counts, as arms may bend either way. 0: unknown
};

inline constexpr float kMirrored = -0.2f;  // ours: below this `front` says that the front is behind

// What shows which way an upper body without hips is up, over some frames.
struct UpperBodyFrame {
    Vec3 head{0};  // mean direction from the shoulders to the head, unit; a nose lies above and in front
    std::optional<Vec3> arms;  // mean direction from shoulders to elbows, up to 1 long; they mostly hang
};

// Nothing if hips are seen in any frame, or no head is.
std::optional<UpperBodyFrame> find_upper_body_frame(const std::vector<LandmarkFrame>& frames);

// Up and height from all frames, facing from the first `beginning` of them (at least 1).
BodyFrame find_body_frame(const std::vector<LandmarkFrame>& frames, size_t beginning);

// The same with `up` known.
BodyFrame find_body_frame(const std::vector<LandmarkFrame>& frames, size_t beginning, const Vec3& up);

}  // namespace chironomia
