// The bundled motions of assets/samples, as every user meets them first.
#include <gtest/gtest.h>

#include "skinning/joint_landmarks.h"
#include "skinning/motion_file.h"
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

}  // namespace
}  // namespace chironomia
