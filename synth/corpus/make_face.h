// What a tracker of faces tells of an agent: the turns of its eyes and head as OpenFace has them, and its
// action units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/face.h"
#include "core/random.h"

namespace chironomia {

struct TrackedFace {
    static constexpr std::size_t kGaze = 2, kHead = 3;

    std::vector<float> gaze;            // (T, kGaze) gaze_angle_x, gaze_angle_y [rad]
    std::vector<float> head;            // (T, kHead) pose_Rx, pose_Ry, pose_Rz [rad]
    std::vector<float> units;           // (T, number of units) in [0, 5]
    std::vector<std::uint8_t> success;  // (T) 0: the frame was lost, and bridged
    std::vector<float> confidence;      // (T) in [0, 1]

    std::size_t frames() const { return success.size(); }  // T
};

// Without noise what the face does. With it: angles with a standard deviation of 0.5 degrees, units with 0.15
// as far as they stay in their range, and frames that are lost (make_noise.h); then cleaned as the corpora
// were: the median of 7 frames, and lines over what was lost (synth/features/contour.h).
TrackedFace track_face(const FaceTrack& face, std::span<const int> units, bool noise, Random random);

}  // namespace chironomia
