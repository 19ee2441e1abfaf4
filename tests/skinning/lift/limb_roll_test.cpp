#include "skinning/lift/limb_roll.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr double kFps = 30;
constexpr float kDegrees = kPi / 180;

// A left arm that points forward and bends by so much, upward, or where `aside` turns the bend about the arm.
LimbCourse forward_arm(float bend_deg, float aside_deg = 0) {
    const Quat aside = glm::angleAxis(aside_deg * kDegrees, Vec3(0, 0, 1));
    const float bend = bend_deg * kDegrees;
    return {.upper = {0, 0, 0.3f}, .lower = 0.25f * (aside * Vec3(0, std::sin(bend), std::cos(bend)))};
}

float largest_step(const std::vector<Quat>& turns) {
    float largest = 0;
    for (size_t t = 1; t < turns.size(); ++t)
        largest = std::max(largest, angle_between(turns[t - 1], turns[t]));
    return largest / kDegrees;
}

TEST(RollLimb, KeepsTheRollOfAnArmThatStretchesAndBendsAgain) {
    std::vector<LimbCourse> courses;
    for (int t = 0; t <= 60; ++t) {
        const float bend = 40 * std::abs(std::cos(static_cast<float>(t) * kPi / 60));
        // While it is straight to 4 degrees, noise shows the bend on every side.
        courses.push_back(forward_arm(bend, bend < 4 ? static_cast<float>(t * 130 % 360) : 0));
    }
    const std::vector<Quat> turns = roll_limb(courses, arm_hinge(true), kFps);
    for (const Quat& turn : turns) EXPECT_LT(angle_between(turn, turns.front()), 4 * kDegrees);
}

TEST(RollLimb, GoesAlongWithTheBendOfABentArm) {
    std::vector<LimbCourse> courses;
    for (int t = 0; t < 60; ++t) courses.push_back(forward_arm(70, -60 + 2 * static_cast<float>(t)));
    const std::vector<Quat> turns = roll_limb(courses, arm_hinge(true), kFps);
    for (size_t t = 0; t < courses.size(); ++t) {
        const Vec3 bend = cross(courses[t].upper, courses[t].lower);
        EXPECT_LT(angle_between(turns[t] * arm_hinge(true).axis, bend), 5 * kDegrees) << t;
    }
}

TEST(RollLimb, PointsWhereTheUpperBoneDoes) {
    std::vector<LimbCourse> courses;
    for (int t = 0; t < 40; ++t) {
        const float angle = 0.15f * static_cast<float>(t);
        courses.push_back({.upper = {std::sin(angle), std::cos(angle), 0.4f}, .lower = {0.1f, 0.5f, 0.2f}});
    }
    const std::vector<Quat> turns = roll_limb(courses, arm_hinge(false), kFps);
    for (size_t t = 0; t < courses.size(); ++t)
        EXPECT_LT(angle_between(turns[t] * arm_hinge(false).along, courses[t].upper), 0.01f);
}

TEST(RollLimb, TurnsAStraightLimbWithWhatCarriesIt) {
    std::vector<LimbCourse> courses;
    for (int t = 0; t < 45; ++t) {
        courses.push_back({.base = glm::angleAxis(2 * static_cast<float>(t) * kDegrees, Vec3(0, 1, 0)),
                           .upper = {0, -0.4f, 0},
                           .lower = {0, -0.4f, 0}});
    }
    const std::vector<Quat> turns = roll_limb(courses, leg_hinge(), kFps);
    for (size_t t = 0; t < courses.size(); ++t) EXPECT_LT(angle_between(turns[t], courses[t].base), 0.01f);
}

TEST(RollLimb, HoldsALimbThatHasNoDirection) {
    std::vector<LimbCourse> courses(20, forward_arm(50));
    for (size_t t = 8; t < 12; ++t) courses[t].upper = courses[t].lower = Vec3(0);
    EXPECT_LT(largest_step(roll_limb(courses, arm_hinge(true), kFps)), 0.5f);
}

TEST(RollLimb, DoesNotTurnALegOverForAKneeThatIsBentTheWrongWayALittle) {
    std::vector<LimbCourse> courses;
    for (int t = 0; t < 30; ++t) {
        const float bend = (t > 12 && t < 18 ? 8.0f : -20.0f) * kDegrees;
        courses.push_back({.upper = {0, -0.4f, 0}, .lower = 0.4f * Vec3(0, -std::cos(bend), std::sin(bend))});
    }
    for (const Quat& turn : roll_limb(courses, leg_hinge(), kFps))
        EXPECT_LT(angle_between(turn, kNoTurn), 5 * kDegrees);
}

}  // namespace
}  // namespace chironomia
