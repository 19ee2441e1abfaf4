#include "skinning/lift/limb_lift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr double kFps = 30;
constexpr size_t kFrames = 240, kMisled = 110, kMisledTo = 140;  // one second in the middle

// A person who stands before the camera and holds both arms straight out, half forward and half aside. The
// learned direction of the left arm is to the camera, except for one second in which it is away from it.
struct HeldOut {
    PinholeCamera camera{.unit = 300, .distance = 4, .middle = {640, 360}};
    std::vector<Trunk> trunks = std::vector<Trunk>(kFrames);
    std::vector<SeenLimb> left, right;
    LimbShape left_shape{}, right_shape{.left = false};

    HeldOut() {
        for (Trunk& trunk : trunks) {
            trunk.left_shoulder = {0.18, 0, 0};
            trunk.right_shoulder = {-0.18, 0, 0};
        }
        for (size_t t = 0; t < kFrames; ++t) {
            const bool misled = t >= kMisled && t < kMisledTo;
            left.push_back(seen(t, left_shape, misled));
            right.push_back(seen(t, right_shape, false));
        }
    }

    SeenLimb seen(size_t t, const LimbShape& shape, bool misled) const {
        const Trunk& trunk = trunks[t];
        const glm::dvec3 along(shape.left ? std::sqrt(0.5) : -std::sqrt(0.5), 0, std::sqrt(0.5));
        SeenLimb limb{.root = shape.left ? trunk.left_shoulder : trunk.right_shoulder,
                      .has_mid = true,
                      .has_tip = true};
        limb.mid = camera.point(limb.root + shape.upper * along);
        limb.tip = camera.point(limb.root + (shape.upper + shape.lower) * along);
        const double towards = misled ? -std::sqrt(0.5) : std::sqrt(0.5);
        LearnedArm& learned = limb.learned.emplace(LearnedArm{.upper = towards, .lower = towards});
        learned.unlikely.fill(-std::log(0.1));
        learned.unlikely[misled ? 0 : kUpperToCamera + kLowerToCamera] = -std::log(0.7);
        return limb;
    }

    std::vector<LimbPlace> lift_left(const EarlierPlaces& earlier = {}) const {
        return lift_limb({left, trunks, camera, kFps}, left_shape, earlier);
    }
    std::vector<LimbPlace> lift_right(const EarlierPlaces& earlier = {}) const {
        return lift_limb({right, trunks, camera, kFps}, right_shape, earlier);
    }
};

// In how many frames the hand is behind its shoulder.
size_t behind(const std::vector<LimbPlace>& places) {
    return static_cast<size_t>(
        std::count_if(places.begin(), places.end(), [](const LimbPlace& place) { return place.tip.z < 0; }));
}

TEST(LiftLimb, FollowsTheLearnedDirections) {
    const HeldOut person;
    EXPECT_NEAR(behind(person.lift_left()), kMisledTo - kMisled, 4);
    EXPECT_EQ(behind(person.lift_right()), 0u);
}

TEST(LiftLimb, ComesBackToWhatBothArmsDoMost) {
    const HeldOut person;
    const std::vector<LimbPlace> left = person.lift_left(), right = person.lift_right();
    const std::vector<LimbPlace> again = person.lift_left({.own = left, .other = right});
    EXPECT_EQ(behind(again), 0u);
    for (const LimbPlace& place : again) {
        EXPECT_NEAR(place.mid.x, 0.18 + person.left_shape.upper * std::sqrt(0.5), 0.03);
        EXPECT_NEAR(place.mid.z, person.left_shape.upper * std::sqrt(0.5), 0.03);
    }
}

}  // namespace
}  // namespace chironomia
