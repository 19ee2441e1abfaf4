// The bundled motions of assets/samples, as every user meets them first.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "skinning/body/joint_landmarks.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::source_dir;

std::vector<size_t> all_frames(const Motion& motion) {
    std::vector<size_t> frames(motion.frames);
    for (size_t t = 0; t < frames.size(); ++t) frames[t] = t;
    return frames;
}

class SampleMotion : public ::testing::TestWithParam<const char*> {
  protected:
    const Motion motion_ = read_motion(source_dir() / "assets/samples" / GetParam());
};

TEST_P(SampleMotion, FacesTheFrontAndKeepsItsFeetPlanted) {
    const std::vector<LandmarkFrame> frames = landmarks_of(*motion_.joints, all_frames(motion_));
    const auto at = [&](size_t t, Landmark landmark) { return *frames[t][static_cast<size_t>(landmark)]; };
    EXPECT_DOUBLE_EQ(motion_.fps, 30);
    EXPECT_GT(at(0, Landmark::left_shoulder).x, at(0, Landmark::right_shoulder).x + 0.3f);
    EXPECT_NEAR(at(0, Landmark::left_ankle).y, 0.085, 0.001);
    for (size_t t = 0; t < frames.size(); ++t) {
        EXPECT_LT(distance(at(t, Landmark::left_ankle), at(0, Landmark::left_ankle)), 1e-3f) << "frame " << t;
        EXPECT_LT(distance(at(t, Landmark::right_ankle), at(0, Landmark::right_ankle)), 1e-3f)
            << "frame " << t;
    }
}

INSTANTIATE_TEST_SUITE_P(Bvh, SampleMotion,
                         ::testing::Values("expressive/two-ways.bvh", "expressive/simple-idea.bvh",
                                           "restrained/two-ways.bvh", "restrained/simple-idea.bvh"));

// The maker writes keypoints from its own kinematics: two independent ways to the same places.
TEST(Samples, KeypointsAreThePlacesOfTheBvhJoints) {
    const Motion bvh = read_motion(source_dir() / "assets/samples/expressive/two-ways.bvh");
    const Motion points = read_motion(source_dir() / "assets/samples/keypoints/two-ways.npz");
    ASSERT_EQ(bvh.frames, points.frames);
    const std::vector<LandmarkFrame> from_joints = landmarks_of(*bvh.joints, all_frames(bvh));
    const KeypointTrack& track = *points.keypoints;
    float worst = 0;
    size_t compared = 0;
    for (size_t k = 0; k < track.names.size(); ++k) {
        const auto landmark = static_cast<size_t>(*landmark_named(track.names[k]));
        for (size_t t = 0; t < points.frames; ++t) {
            if (!from_joints[t][landmark]) continue;
            worst = std::max(worst,
                             distance(*from_joints[t][landmark], track.points[t * track.names.size() + k]));
            ++compared;
        }
    }
    EXPECT_GT(compared, 15 * points.frames);
    EXPECT_LT(worst, 2e-4f);
}

}  // namespace
}  // namespace chironomia
