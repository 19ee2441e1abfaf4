// Keypoints by the name of the body's landmarks, without gaps.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <vector>

#include "core/body/motion.h"
#include "core/math.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {

struct LandmarkTrack {
    std::bitset<kLandmarks> known;                     // seen in at least one frame
    std::vector<std::array<Vec3, kLandmarks>> points;  // (T) [m, world]
    std::array<size_t, kLandmarks> bridged{};          // frames in which a known landmark was not seen

    bool has(Landmark landmark) const { return known[static_cast<size_t>(landmark)]; }
    Vec3 at(size_t frame, Landmark landmark) const { return points[frame][static_cast<size_t>(landmark)]; }
};

// Some landmarks cannot lie in one place (within 5 mm): the two shoulders, the two hips, the ends of a bone, and the
// root and the end of a limb. In frames where they do, both shoulders or both hips count as not seen, and of a bone or
// limb its outer end. In a frame with all points in one place nothing is seen.
KeypointTrack without_coincident(KeypointTrack keypoints, size_t frames);

// A landmark that is not seen for a while goes straight from its last place to its next; before the first and
// after the last it stays. One that is seen in less than a tenth of the frames counts as missing. `pelvis`
// and `thorax` are added as the middle of hips and shoulders where the layout lacks them.
LandmarkTrack bridge_gaps(const KeypointTrack& keypoints, size_t frames);

}  // namespace chironomia
