#include "synth/motor/arm_path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synth/body/agent_body.h"
#include "tests/synth/motor/gestures_for_tests.h"

namespace chironomia {
namespace {

ArmKey key_at(double time, const Vec3& wrist, bool stops = true) {
    ArmState state;
    state.wrist = wrist;
    return {
        .time = time, .state = state, .phase = GesturePhase::stroke, .path = {}, .stops = stops, .placed = 0};
}

TEST(ArmPath, RestsBeforeItsFirstKeyAndBehindItsLast) {
    const ArmPath path({key_at(1, {0, 1, 0}), key_at(2, {0.4f, 1, 0})}, {{}, {}}, ArmSide::left);
    EXPECT_EQ(path.at(0.5).wrist, glm::dvec3(0, 1, 0));
    EXPECT_NEAR(path.at(1.5).wrist.x, 0.2, 1e-6);
    EXPECT_NEAR(path.at(3).wrist.x, 0.4, 1e-6);
    EXPECT_EQ(path.segment_at(0.5), 0u);
    EXPECT_EQ(path.segment_at(1.5), 1u);
    EXPECT_EQ(path.segment_at(3), 2u);
}

TEST(ArmPath, TakesTheShapeOfItsKeys) {
    const std::vector<ArmKey> keys = {key_at(0, {0, 1, 0}), key_at(1, {0.3f, 1, 0}, false),
                                      key_at(2, {0.3f, 1.3f, 0})};
    const auto speed_at_corner = [&](const TcbShape& shape) {
        const ArmPath path(keys, {shape, shape, shape}, ArmSide::left);
        return distance(path.at(1.001).wrist, path.at(0.999).wrist) / 0.002;
    };
    EXPECT_LT(speed_at_corner({.tension = 1}), 0.01);
    EXPECT_NEAR(speed_at_corner({}), 0.15 * std::sqrt(2.0), 0.01);
    EXPECT_GT(speed_at_corner({.tension = -1}), 0.25 * std::sqrt(2.0));
}

// Two turns about the body's x axis: the wrist keeps to a plane, comes round at equal shares, and ends where
// it began.
TEST(ArmPath, GoesRoundInCircles) {
    std::vector<ArmKey> keys = {key_at(0, {0.2f, 1.2f, 0.3f}), key_at(2, {0.2f, 1.2f, 0.3f})};
    keys[1].path = {.shape = WristShape::circle, .radius = 0.1f, .turns = 2, .axis = {1, 0, 0}};
    const ArmPath path(keys, {{}, {}}, ArmSide::right);
    const double radius = 0.1 * agent_arm_length();
    const glm::dvec3 top = path.at(0).wrist, centre = top - glm::dvec3(0, radius, 0);
    for (double time = 0.1; time < 2; time += 0.1) {
        EXPECT_NEAR(distance(path.at(time).wrist, centre), radius, 1e-6);
        EXPECT_NEAR(path.at(time).wrist.x, top.x, 1e-9);
    }
    EXPECT_LT(distance(path.at(1).wrist, top), 1e-6);
    EXPECT_LT(distance(path.at(2).wrist, top), 1e-6);
    // To one who looks along the outstretched right arm, backward lies to the right of the top.
    EXPECT_LT(path.at(0.3).wrist.z, top.z - 0.01);
}

TEST(ArmPath, EasesFingersFromShapeToShape) {
    std::vector<ArmKey> keys = {key_at(0, {0, 1, 0}), key_at(1, {0.3f, 1, 0})};
    keys[0].state.fingers = testing::bent_hand("open", 0).turns;
    keys[1].state.fingers = testing::bent_hand("fist", 1).turns;
    const ArmPath path(keys, {{}, {}}, ArmSide::right);
    const auto bend = [&](double time) { return angle_between(kNoTurn, path.fingers_at(time)[3]); };
    EXPECT_FLOAT_EQ(bend(-1), 0);
    EXPECT_NEAR(bend(0.5), 0.7f, 1e-4f);
    EXPECT_LT(bend(0.1), 0.06f);
    EXPECT_NEAR(bend(4), 1.4f, 1e-4f);
}

}  // namespace
}  // namespace chironomia
