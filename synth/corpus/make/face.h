// What a face tracker would measure on an agent: the rotations of eyes and head in OpenFace's convention, and
// action units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/face.h"
#include "core/random.h"

namespace chironomia {

struct TrackedFace {
    static constexpr std::size_t kGaze = 2, kHead = 3;

    std::vector<float> gaze;            // (T, kGaze) gaze_angle_x, gaze_angle_y [rad]
    std::vector<float> head;            // (T, kHead) pose_Rx, pose_Ry, pose_Rz [rad]
    std::vector<float> units;           // (T, number of units); in [0, 5] once it is cleaned
    std::vector<std::uint8_t> success;  // (T) 0: the frame was lost
    std::vector<float> confidence;      // (T) in [0, 1]

    std::size_t frames() const { return success.size(); }  // T
};

// What a tracker writes. Without noise what the face does; with it angles with a standard deviation of 0.5
// degrees, units with 0.15, and frames that are lost, all of whose numbers are 0 (noise.h).
TrackedFace track_face(const FaceTrack& face, std::span<const int> units, bool noise, Random random);

// As the corpora were cleaned: the median of 7 frames, lines over what was lost (synth/features/contour.h),
// and units in their range.
TrackedFace cleaned(TrackedFace tracked);

}  // namespace chironomia
