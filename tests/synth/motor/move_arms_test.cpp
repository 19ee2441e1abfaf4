#include "synth/motor/move_arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.h"
#include "synth/body/agent_body.h"
#include "synth/corpus/make/corpus_settings.h"
#include "synth/gestures/lexicon.h"
#include "synth/motor/arm_state.h"
#include "synth/motor/body_distance.h"
#include "tests/synth/gestures/arm_support.h"
#include "tests/synth/motor/gestures_for_tests.h"

namespace chironomia {
namespace {

using testing::arm_joint;
using ::testing::ElementsAre;
using testing::planned_gesture;
using testing::RandomScore;
using testing::test_lexicon;

constexpr Clock kClock{.frames = 600, .fps = 30};

ArmTurns turns_at(const ArmMotion& motion, std::size_t frame, ArmSide side) {
    const auto turn = [&](HumanJoint left) {
        return motion.turns[frame * kAgentJoints + joint_of(arm_joint(left, side))];
    };
    ArmTurns turns;
    turns.shoulder = turn(HumanJoint::left_shoulder);
    turns.upper_arm = turn(HumanJoint::left_upper_arm);
    turns.lower_arm = turn(HumanJoint::left_lower_arm);
    turns.hand = turn(HumanJoint::left_hand);
    return turns;
}

std::vector<ArmChain> chains_of(const ArmMotion& motion, ArmSide side) {
    std::vector<ArmChain> chains;
    for (std::size_t t = 0; t * kAgentJoints < motion.turns.size(); ++t)
        chains.push_back(chain_of(turns_at(motion, t, side), side));
    return chains;
}

const std::string& label_at(const ArmMotion& motion, const std::string& name, std::size_t frame) {
    const auto track = std::find_if(motion.labels.begin(), motion.labels.end(),
                                    [&](const LabelTrack& labels) { return labels.name == name; });
    return track->values[static_cast<std::size_t>(track->frames[frame])];
}

ArmMotion perform(const RandomScore& score, const Clock& clock = kClock) {
    return move_arms(score.planned_gestures,
                     {.lexicon = score.lexicon, .speaker = score.speaker, .variants = {}}, clock, 7);
}

ArmMotion perform(const std::vector<PlannedGesture>& planned_gestures, const Clock& clock = kClock) {
    return move_arms(planned_gestures, {.lexicon = test_lexicon(), .speaker = {}, .variants = {}}, clock, 7);
}

TEST(MoveArms, LetsArmsHangAndLiveWhereNothingIsPlanned) {
    const ArmMotion motion = perform(std::vector<PlannedGesture>{});
    EXPECT_TRUE(motion.placed.empty());
    for (const ArmSide side : kArmSides) {
        const auto chains = chains_of(motion, side);
        const Vec3 rest = resting_arm(side, {}).wrist;
        float furthest = 0;
        for (const ArmChain& chain : chains) {
            EXPECT_LT(distance(chain.wrist, rest), 0.0095f);  // the reach of the elbow takes some
            EXPECT_LT(chain.wrist.y, chain.elbow.y - 0.2f);
            EXPECT_GT(signed_distance_to_body(chain.wrist).distance, 0.03);
            furthest = std::max(furthest, distance(chain.wrist, chains[0].wrist));
        }
        EXPECT_GT(furthest, 0.0005f);
        EXPECT_LT(furthest, 0.0052f);  // from one end of the sway to the other
    }
    EXPECT_EQ(label_at(motion, "right phase", 10), "rest");
    EXPECT_EQ(label_at(motion, "gesture", 10), "-");
}

// [degrees] from the first frame on, the first joint of the right middle finger.
std::vector<float> finger_sway_of(const Variants& variants) {
    const ArmMotion motion =
        move_arms({}, {.lexicon = test_lexicon(), .speaker = {}, .variants = variants}, kClock, 7);
    std::vector<float> sway;
    for (std::size_t t = 0; t < kClock.frames; ++t) {
        const auto turn = [&](std::size_t frame) {
            return motion.turns[frame * kAgentJoints + joint_of(HumanJoint::right_middle_1)];
        };
        sway.push_back(glm::degrees(angle_between(turn(0), turn(t))));
    }
    return sway;
}

TEST(MoveArms, LetsFingersSwaySlowlyUnlessTheyAreToBeStill) {
    const std::vector<float> sway = finger_sway_of({.finger_sway = 1.2});
    EXPECT_GT(*std::max_element(sway.begin(), sway.end()), 1.2f);
    EXPECT_LT(*std::max_element(sway.begin(), sway.end()), 4 * 1.2f);
    for (std::size_t t = 1; t < sway.size(); ++t) EXPECT_LT(std::abs(sway[t] - sway[t - 1]), 0.25f) << t;
    EXPECT_THAT(finger_sway_of({.finger_sway = 0}), ::testing::Each(0.0f));
}

TEST(MoveArms, EndsStrokesOnTheirAccentsInLabelsAndInTheHand) {
    const ArmMotion motion =
        perform({planned_gesture(testing::kBeat, 2.51), planned_gesture(testing::kOffer, 7)});
    ASSERT_EQ(motion.placed.size(), 2u);
    for (const PlacedGesture& gesture : motion.placed) {
        const auto chains = chains_of(motion, ArmSide::right);
        const double accent = gesture.strokes.front().end;
        const auto last = static_cast<std::size_t>(std::ceil(accent * 30)) - 1;
        EXPECT_EQ(label_at(motion, "right phase", last), "stroke");
        EXPECT_EQ(label_at(motion, "right phase", last + 1), "post-stroke-hold");
        // The hand comes to rest within a frame of the accent, and not before.
        const auto speed = [&](std::size_t t) { return distance(chains[t].wrist, chains[t + 1].wrist) * 30; };
        EXPECT_LT(speed(last + 1), 0.06f);
        EXPECT_GT(speed(last - 3), 0.3f);
        EXPECT_EQ(label_at(motion, "function", last), "rheme");
    }
    EXPECT_EQ(label_at(motion, "gesture", 75), "beat");
    EXPECT_EQ(label_at(motion, "gesture", 209), "offer");
    EXPECT_EQ(label_at(motion, "left phase", 75), "rest");
    EXPECT_EQ(label_at(motion, "left phase", 209), "stroke");
}

// Of any joint between two frames, over the clip [degrees a second].
double fastest_turn(const ArmMotion& motion, double fps) {
    double fastest = 0;
    for (std::size_t i = kAgentJoints; i < motion.turns.size(); ++i) {
        const float turn = angle_between(motion.turns[i - kAgentJoints], motion.turns[i]);
        fastest = std::max(fastest, double(glm::degrees(turn)) * fps);
    }
    return fastest;
}

// Hands wave at 2 to 4 Hz, by 20 to 40 degrees to either side: 250 to 1000 degrees a second at the most, and fingers
// that close by 76 degrees at 2.3 Hz have 76 * pi * 2.3 = 550.
TEST(MoveArms, WavesGoodbyeAsFastAsPeopleDo) {
    const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    for (const char* wave : {"goodbye_wave", "greet_wave", "farewell"}) {
        const std::size_t gesture = find_gesture(lexicon, wave).value();
        const ArmMotion motion =
            move_arms({planned_gesture(gesture, 3)}, {.lexicon = lexicon, .speaker = {}, .variants = {}},
                      {.frames = 600, .fps = 120}, 7);
        ASSERT_EQ(motion.placed.size(), 1u);
        EXPECT_GT(fastest_turn(motion, 120), 200) << wave;
        EXPECT_LT(fastest_turn(motion, 120), 600) << wave;
    }
}

// Between two key poses that rest on the same, and not on the way there or back.
TEST(MoveArms, LabelsWhatAHandRestsOnWhileItStays) {
    Lexicon lexicon = test_lexicon();
    for (KeyPose& pose : lexicon.gestures[testing::kOffer].poses)
        if (pose.phase != GesturePhase::preparation) pose.right->touches = Touch::trunk;
    const ArmMotion motion = move_arms({planned_gesture(testing::kOffer, 7)},
                                       {.lexicon = lexicon, .speaker = {}, .variants = {}}, kClock, 7);
    EXPECT_EQ(label_at(motion, "right touch", 209), "nothing") << "the stroke";
    EXPECT_EQ(label_at(motion, "right phase", 211), "post-stroke-hold");
    EXPECT_EQ(label_at(motion, "right touch", 211), "trunk");
    EXPECT_EQ(label_at(motion, "left touch", 211), "nothing");
    EXPECT_EQ(label_at(motion, "right touch", 400), "nothing");

    for (const LabelTrack& track : perform({planned_gesture(testing::kOffer, 7)}).labels)
        EXPECT_THAT(track.name, ::testing::Not(::testing::HasSubstr("touch"))) << "nothing is touched";
}

TEST(MoveArms, TurnsOnlyArmsHandsAndFingers) {
    const ArmMotion motion = perform(testing::random_score(3));
    for (const HumanJoint part :
         {HumanJoint::hips, HumanJoint::spine, HumanJoint::upper_chest, HumanJoint::neck, HumanJoint::head,
          HumanJoint::jaw, HumanJoint::left_upper_leg})
        for (std::size_t t = 0; t < kClock.frames; ++t)
            ASSERT_EQ(motion.turns[t * kAgentJoints + joint_of(part)], kNoTurn);
    for (const Quat& turn : motion.turns) ASSERT_NEAR(length(turn), 1, 1e-5);
}

// The extremes over twenty-second scores of gestures anywhere in McNeill's sectors, in any manner.
struct Extremes {
    double nearest_wrist = 1;   // to trunk or head [m]
    double nearest_finger = 1;  // from the last joint of a finger to the body [m]
    double nearest_hands = 1;   // between the palms [m]
    double fastest_change = 0;  // of a wrist's velocity [m/s^2]
    double most_elbow = 0, most_rotation = 0, most_back = 0, most_across = 0;  // [rad]
};

void look_at_pose(Extremes& found, const ArmChain& chain, ArmSide side) {
    const float outward = side == ArmSide::left ? 1 : -1;
    found.nearest_wrist =
        std::min(found.nearest_wrist, signed_distance_to_trunk_and_head(chain.wrist).distance);

    const Vec3 upper = normalize(chain.elbow - chain.shoulder);
    found.most_back = std::max(found.most_back, -double(std::asin(upper.z)));
    found.most_across = std::max(found.most_across, -double(std::asin(outward * upper.x)));
    const Quat carried = turn_between({0, 0, 1}, chain.wrist - chain.shoulder);
    const Vec3 elbow = chain.elbow - chain.shoulder;
    const float swivel =
        std::atan2(dot(elbow, carried * Vec3(outward, 0, 0)), dot(elbow, carried * Vec3(0, -1, 0)));
    const ArmAngles angles =
        solve_arm({.wrist = chain.wrist, .hand = kNoTurn, .swivel = swivel}, side).angles;
    found.most_elbow = std::max(found.most_elbow, double(angles.elbow));
    found.most_rotation = std::max(found.most_rotation, std::abs(double(angles.rotation)));
}

void look_at_fingers(Extremes& found, const ArmMotion& motion, std::size_t frame) {
    std::vector<Transform> local = rest_transforms(agent_skeleton());
    for (std::size_t j = 0; j < kAgentJoints; ++j) local[j].rotation = motion.turns[frame * kAgentJoints + j];
    const auto world = world_from_joints(agent_skeleton(), local);
    for (const ArmSide side : kArmSides)
        for (const HumanJoint last :
             {HumanJoint::left_index_3, HumanJoint::left_middle_3, HumanJoint::left_little_3})
            found.nearest_finger =
                std::min(found.nearest_finger,
                         signed_distance_to_body(origin(world[joint_of(arm_joint(last, side))])).distance);
}

void look_at_motion(Extremes& found, const ArmMotion& motion, double fps) {
    const std::array<std::vector<ArmChain>, 2> arms = {chains_of(motion, ArmSide::left),
                                                       chains_of(motion, ArmSide::right)};
    for (const ArmSide side : kArmSides) {
        const auto& chains = arms[index_of(side)];
        for (const ArmChain& chain : chains) look_at_pose(found, chain, side);
        for (std::size_t t = 2; t < chains.size(); ++t) {
            const Vec3 change = chains[t].wrist - 2.0f * chains[t - 1].wrist + chains[t - 2].wrist;
            found.fastest_change = std::max(found.fastest_change, length(change) * fps * fps);
        }
    }
    for (std::size_t t = 0; t < arms[0].size(); ++t) {
        if (t % 3 == 0) look_at_fingers(found, motion, t);
        const auto palm = [&](std::size_t arm, float outward) {
            return arms[arm][t].wrist + arms[arm][t].hand * Vec3(0.06f * outward, 0, 0);
        };
        found.nearest_hands = std::min(found.nearest_hands, double(distance(palm(0, 1), palm(1, -1))));
    }
}

// At 30 frames a second no wrist changes its velocity by more than 60 m/s^2, which the fastest ways of
// Fitts's law between the ends of the reach need: 1.2 m in 0.45 s at even speed, and back.
TEST(MoveArms, KeepsWithinTheBodyItsLimitsAndAReasonableAcceleration) {
    Extremes found;
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
        look_at_motion(found, perform(testing::random_score(seed)), kClock.fps);
    EXPECT_GT(found.nearest_wrist, 0.02);
    EXPECT_GT(found.nearest_finger, 0);
    EXPECT_GT(found.nearest_hands, 0.025);
    EXPECT_LT(found.fastest_change, 60);
    EXPECT_LT(found.most_elbow, kArmLimits.most_elbow);
    EXPECT_LT(found.most_rotation, kArmLimits.most_rotation);
    EXPECT_LT(found.most_back, kArmLimits.most_back);
    EXPECT_LT(found.most_across, double(kArmLimits.most_across) + 0.05);
}

TEST(MoveArms, IsOneFunctionOfTimeAtAnyRate) {
    const RandomScore score = testing::random_score(5);
    const ArmMotion slow = perform(score, {.frames = 600, .fps = 30});
    const ArmMotion fast = perform(score, {.frames = 1200, .fps = 60});
    for (std::size_t t = 0; t < 600; ++t) {
        for (std::size_t j = 0; j < kAgentJoints; ++j)
            ASSERT_EQ(slow.turns[t * kAgentJoints + j], fast.turns[2 * t * kAgentJoints + j]) << t;
        ASSERT_EQ(label_at(slow, "left phase", t), label_at(fast, "left phase", 2 * t));
    }
}

TEST(MoveArms, IsTheSameForASeedAndSwaysDifferentlyForAnother) {
    const RandomScore score = testing::random_score(9);
    const auto perform_with = [&](std::uint64_t seed) {
        return move_arms(score.planned_gestures,
                         {.lexicon = score.lexicon, .speaker = score.speaker, .variants = {}}, kClock, seed);
    };
    const ArmMotion once = perform_with(1), again = perform_with(1), other = perform_with(2);
    EXPECT_EQ(once.turns, again.turns);
    EXPECT_NE(once.turns, other.turns);
    for (const ArmSide side : kArmSides) {
        const auto a = chains_of(once, side), b = chains_of(other, side);
        for (std::size_t t = 0; t < a.size(); ++t) ASSERT_LT(distance(a[t].wrist, b[t].wrist), 0.02f);
    }
}

TEST(MoveArms, ReportsWhatItDropped) {
    const ArmMotion motion =
        perform({planned_gesture(testing::kBeat, 0.4), planned_gesture(testing::kBeat, 40)});
    EXPECT_TRUE(motion.placed.empty());
    EXPECT_THAT(motion.notes,
                ElementsAre("gesture \"beat\" at 0.40 s dropped: its preparation would begin before 0 s",
                            "gesture \"beat\" at 40.00 s dropped: the motion ends at 20.00 s"));
}

// When a greeting would have to end whose preparation lacks 0.1 s though it is compressed, and how long it takes.
struct EarlyGreeting {
    double end = 0, lead = 0;
};

EarlyGreeting early_greeting() {
    const ArmMotion calm = perform({planned_gesture(testing::kGreet, 10)});
    const PlacedStroke& stroke = calm.placed.at(0).strokes.front();
    const double lead = stroke.start - calm.placed[0].arms[1].begin;
    return {.end = stroke.end - stroke.start + 0.5 * lead - 0.1, .lead = lead};
}

TEST(MoveArms, GreetsALittleLateRatherThanNotAtAll) {
    const EarlyGreeting early = early_greeting();
    const ArmMotion late = perform({planned_gesture(testing::kGreet, early.end)});
    ASSERT_EQ(late.placed.size(), 1u) << ::testing::PrintToString(late.notes);
    const PlacedStroke& stroke = late.placed[0].strokes.front();
    const double wanted = 0.1 + 0.5 * early.lead;
    ASSERT_LT(wanted, Variants{}.latest_at_beginning);
    EXPECT_NEAR(stroke.end, early.end + wanted, 1e-9);
    EXPECT_NEAR(late.placed[0].arms[1].begin, 0, 1e-9);
    EXPECT_THAT(late.notes,
                ElementsAre(format("gesture \"greet\" at {:.2f} s comes {:.2f} s late: its preparation "
                                   "would begin before 0 s",
                                   early.end, wanted)));
}

TEST(MoveArms, DropsAGreetingThatWouldComeTooLateAndAllThatDoInACorpus) {
    for (const auto& [end, variants] :
         {std::pair{0.1, Variants{}}, std::pair{early_greeting().end, kCorpusVariants}}) {
        const ArmMotion none =
            move_arms({planned_gesture(testing::kGreet, end)},
                      {.lexicon = test_lexicon(), .speaker = {}, .variants = variants}, kClock, 7);
        EXPECT_THAT(none.notes,
                    ElementsAre(format("gesture \"greet\" at {:.2f} s dropped: its preparation would "
                                       "begin before 0 s",
                                       end)));
    }
}

}  // namespace
}  // namespace chironomia
