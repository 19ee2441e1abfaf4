#include "synth/motor/performable_gesture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "synth/body/agent_body.h"
#include "synth/gestures/lexicon.h"
#include "tests/synth/motor/gestures_for_tests.h"

namespace chironomia {
namespace {

using testing::test_lexicon;

Manner with(Expressivity dimension, double value) {
    Manner manner;
    manner[dimension] = value;
    return manner;
}

struct Performance {
    Manner manner{};
    Speaker speaker{};
    Variants variants{};
    bool left_hand = false;
};

// The stroke's end of a gesture of the test lexicon.
ArmState stroke_of(std::size_t gesture, const Performance& how, ArmSide side = ArmSide::right) {
    const Lexicon lexicon = test_lexicon();
    const PerformableGesture performable =
        make_performable(lexicon.gestures[gesture], how.left_hand, how.manner,
                         {.lexicon = lexicon, .speaker = how.speaker, .variants = how.variants});
    return *performable.stroke_end().arms[index_of(side)];
}

void expect_place(const Vec3& wrist, const Vec3& gesture_space, ArmSide side = ArmSide::right) {
    EXPECT_LT(distance(wrist, wrist_in_body(gesture_space, side)), 1e-5f)
        << wrist.x << " " << wrist.y << " " << wrist.z;
}

// The beat of the test lexicon ends at (0.4, 0.05, 0.6).
TEST(PerformableGesture, IsWhatTheLexiconSaysForTheGenericAgent) {
    const ArmState state = stroke_of(testing::kBeat, {});
    expect_place(state.wrist, {0.4f, 0.05f, 0.6f});
    EXPECT_FLOAT_EQ(state.swivel, 0.35f);
    EXPECT_EQ(state.fingers, test_lexicon().shapes[3].turns);
}

TEST(PerformableGesture, ScalesTheSpaceOfGesturesAboutTheSolarPlexus) {
    // 1 + 0.5 (1.3, 0.6, 0.25) times (0.4, 0.05 - 0.15, 0.6).
    expect_place(stroke_of(testing::kBeat, {.manner = with(Expressivity::spatial_extent, 0.5)}).wrist,
                 {0.4f * 1.65f, 0.15f - 0.1f * 1.3f, 0.6f * 1.125f});
    // 1 - (0.7, 0.25, 0.25).
    expect_place(stroke_of(testing::kBeat, {.manner = with(Expressivity::spatial_extent, -1)}).wrist,
                 {0.4f * 0.3f, 0.15f - 0.1f * 0.75f, 0.6f * 0.75f});
    Speaker tall;
    tall.spatial_above = {0, 2, 0};
    tall.height = 0.1;
    expect_place(
        stroke_of(testing::kBeat, {.manner = with(Expressivity::spatial_extent, 0.5), .speaker = tall}).wrist,
        {0.4f, 0.15f - 0.1f * 2 + 0.1f, 0.6f});
}

TEST(PerformableGesture, ShiftsTheSpaceWhereTheMatrixIsReadAsPrinted) {
    expect_place(stroke_of(testing::kBeat, {.manner = with(Expressivity::spatial_extent, -0.5),
                                            .variants = {.spatial_matrix = SpatialMatrix::translate}})
                     .wrist,
                 {0.4f - 0.35f, 0.05f - 0.125f, 0.6f - 0.125f});
    expect_place(stroke_of(testing::kBeat, {.variants = {.spatial_matrix = SpatialMatrix::translate}}).wrist,
                 {0.4f, 0.05f, 0.6f});
}

TEST(PerformableGesture, OpensAndClosesTheElbowBySwivel) {
    const auto swivel = [](double extent) {
        return stroke_of(testing::kBeat, {.manner = with(Expressivity::spatial_extent, extent)}).swivel;
    };
    EXPECT_FLOAT_EQ(swivel(1), 0.35f * 1.5f);
    EXPECT_FLOAT_EQ(swivel(-1), 0.35f * 0.5f);
    Lexicon lexicon = test_lexicon();
    Gesture& beat = lexicon.gestures[testing::kBeat];
    beat.poses.back().right->swivel = 1.4f;
    const PerformableGesture wide = make_performable(beat, false, with(Expressivity::spatial_extent, 1),
                                                     {.lexicon = lexicon, .speaker = {}, .variants = {}});
    EXPECT_FLOAT_EQ(wide.stroke_end().arms[1]->swivel, kPi / 2);
}

TEST(PerformableGesture, LeavesWhatIsFixed) {
    const ArmState plain = stroke_of(testing::kPoint, {});
    Manner loud;
    loud.values = {1, 1, 1, 1, 1, 1};
    Speaker tall;
    tall.height = 0.2;
    const ArmState loudest = stroke_of(testing::kPoint, {.manner = loud, .speaker = tall});
    EXPECT_EQ(plain.wrist, loudest.wrist);
    EXPECT_EQ(plain.swivel, loudest.swivel);
    EXPECT_EQ(plain.fingers, loudest.fingers);
}

TEST(PerformableGesture, BringsAWristOutOfReachNearerOnItsLineToTheShoulder) {
    const Vec3 wrist = stroke_of(testing::kGreet, {.manner = with(Expressivity::spatial_extent, 1)}).wrist;
    const Vec3 shoulder = rest_shoulder(ArmSide::right);
    EXPECT_NEAR(distance(wrist, shoulder), 0.98f * agent_arm_length(), 1e-5f);
    const Vec3 wanted = wrist_in_body({0.4f * 2.3f, 0.15f + 0.65f * 1.6f, 0.35f * 1.25f}, ArmSide::right);
    EXPECT_LT(angle_between(wrist - shoulder, wanted - shoulder), 1e-3f);
}

TEST(PerformableGesture, ClosesTheHandWithPowerAndLetsItGoWithoutIt) {
    const auto first_bend = [](double power, double gain = 0.7) {
        const ArmState state = stroke_of(
            testing::kBeat, {.manner = with(Expressivity::power, power), .variants = {.fist_gain = gain}});
        return angle_between(kNoTurn, state.fingers[6]);  // of the middle finger
    };
    // Shares of a fist of 1.4 rad: the cup 0.45, the relaxed hand 0.3.
    EXPECT_NEAR(first_bend(0), 1.4f * 0.45f, 1e-4f);
    EXPECT_NEAR(first_bend(1), 1.4f * (0.45f + 0.7f * 0.55f), 1e-4f);
    EXPECT_NEAR(first_bend(0.5, 1), 1.4f * (0.45f + 0.5f * 0.55f), 1e-4f);
    EXPECT_NEAR(first_bend(-1), 1.4f * (0.45f - 0.5f * 0.15f), 1e-4f);
}

// An open palm that is held out stays open, and a loose hand that beats does not.
TEST(PerformableGesture, ClosesOnlyHandsWhoseShapeCarriesNoMeaning) {
    const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    const auto bend = [&](const char* id, double power) {  // of the middle finger, to the fist's 1 [rad]
        const Gesture& gesture = lexicon.gestures[*find_gesture(lexicon, id)];
        const PerformableGesture made = make_performable(gesture, false, with(Expressivity::power, power),
                                                         {.lexicon = lexicon, .speaker = {}, .variants = {}});
        const HandShape& fist = lexicon.shapes[*find_shape(lexicon, "fist")];
        return angle_between(kNoTurn, made.stroke_end().arms[1]->fingers[6]) /
               angle_between(kNoTurn, fist.turns[6]);
    };
    for (const char* open : {"open_offer", "push_away", "hold_floor", "beat_chop"})
        EXPECT_EQ(bend(open, 1), bend(open, 0)) << open;
    EXPECT_LT(bend("open_offer", 1), 0.2f);
    EXPECT_GT(bend("beat_down", 1), 0.7f);
    EXPECT_LT(bend("beat_down", 0), 0.4f);
}

TEST(PerformableGesture, DoesItWithTheOtherHandInItsMirrorImage) {
    const ArmState right = stroke_of(testing::kBeat, {});
    const ArmState left = stroke_of(testing::kBeat, {.left_hand = true}, ArmSide::left);
    EXPECT_LT(distance(left.wrist, right.wrist * Vec3(-1, 1, 1)), 1e-6f);
    EXPECT_NEAR(left.twist, right.twist, 1e-4f);
    EXPECT_NEAR(left.flexion, right.flexion, 1e-4f);
    EXPECT_NEAR(left.deviation, right.deviation, 1e-4f);
}

TEST(PerformableGesture, RefusesAGestureWithoutAWayToItsStroke) {
    Lexicon lexicon = test_lexicon();
    Gesture& beat = lexicon.gestures[testing::kBeat];
    beat.poses.erase(beat.poses.begin());
    try {
        make_performable(beat, false, {}, {.lexicon = lexicon, .speaker = {}, .variants = {}});
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(
            error.what(),
            "gesture \"beat\": 0 of its key poses lead to the stroke and 1 are of it; it needs at least one "
            "of each");
    }
}

// Known by thought: twist, flexion and deviation give the orientation that they were solved from.
TEST(ArmState, TurnsTheHandAsItsTargetAsked) {
    for (const ArmSide side : kArmSides) {
        const ArmPose pose{.wrist = {0.4f, 0.3f, 0.55f}, .palm = {-1, 0, 0}, .fingers = {0, 0, 1}};
        const ArmTarget target = target_of(pose, side);
        const ArmTurns turns = turns_of(state_of(target, side, {}), side);
        const ArmTurns solved = solve_arm(target, side);
        EXPECT_TRUE(turns.reached);
        EXPECT_LT(angle_between(turns.lower_arm, solved.lower_arm), 1e-3f);
        EXPECT_LT(angle_between(turns.hand, solved.hand), 1e-3f);
        const ArmChain chain = chain_of(turns, side);
        EXPECT_LT(distance(chain.wrist, target.wrist), 1e-6f);
        EXPECT_LT(angle_between(chain.hand, target.hand), 2e-3f);
    }
}

TEST(ArmState, StopsAtTheLimitsOfForearmAndWrist) {
    ArmState state = resting_arm(ArmSide::left, {});
    state.twist = 3;
    state.flexion = -3;
    const ArmAngles angles = turns_of(state, ArmSide::left).angles;
    EXPECT_FLOAT_EQ(angles.twist, kArmLimits.most_twist);
    EXPECT_FLOAT_EQ(angles.flexion, -kArmLimits.most_flexion);
}

// Whether the middle of a hand of 18 cm is seen before the eyes, the nose or the mouth from in front.
bool is_before_the_face(const ArmPose& pose, const Vec3& wrist, ArmSide side) {
    const Vec3 fingers = pose.fingers * Vec3(side == ArmSide::left ? 1 : -1, 1, 1);
    for (int step = 0; step <= 18; ++step) {
        const Vec3 place = wrist + 0.01f * static_cast<float>(step) * fingers;
        if (std::abs(place.x) < 0.07f && std::abs(place.y - 1.63f) < 0.08f && place.z > 0.1f) return true;
    }
    return false;
}

TEST(PerformableGesture, KeepsHandsOffTheFaceOfASmallManner) {
    const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    const auto hidden = [&](double extent, const Variants& variants) {
        std::vector<std::string> found;
        for (const Gesture& gesture : lexicon.gestures) {
            const PerformableGesture performable =
                make_performable(gesture, false, with(Expressivity::spatial_extent, extent),
                                 {.lexicon = lexicon, .speaker = {}, .variants = variants});
            for (std::size_t p = 0; p < gesture.poses.size(); ++p) {
                const auto& arm = performable.poses[p].arms[index_of(ArmSide::right)];
                if (arm && gesture.poses[p].right &&
                    is_before_the_face(*gesture.poses[p].right, arm->wrist, ArmSide::right))
                    found.push_back(gesture.id);
            }
        }
        return found;
    };
    const std::vector<std::string> meant = hidden(0, {});
    EXPECT_EQ(hidden(-1, {}), meant);
    EXPECT_THAT(hidden(-1, {.keeps_face_free = false}), ::testing::Contains("tall"));
    EXPECT_THAT(meant, ::testing::Not(::testing::Contains("tall")));
}

}  // namespace
}  // namespace chironomia
