#include "skinning/fit/retarget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

#include "skinning/body/body_plan.h"
#include "skinning/body/posture.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/joints.h"

namespace chironomia {
namespace {

using testing::Figure;
using testing::FigureShape;
using testing::make_figure;

constexpr float kDegree = kPi / 180;

// Every joint turned a little about a slowly changing axis, starting from the rest pose.
JointTrack wriggle(const Figure& figure, size_t frames) {
    JointTrack track{.skeleton = figure.skeleton, .turns = {}, .translations = {}};
    for (size_t t = 0; t < frames; ++t) {
        for (size_t j = 0; j < figure.skeleton.joints.size(); ++j) {
            const float phase = 0.7f * float(j) + 0.3f * float(t);
            const Vec3 axis =
                normalize(Vec3(std::sin(phase), std::cos(1.3f * phase), std::sin(2.1f * phase)));
            const Transform& rest = figure.skeleton.joints[j].rest;
            track.turns.push_back(rest.rotation * glm::angleAxis(0.04f * float(t), axis));
            track.translations.push_back(rest.translation);
        }
    }
    return track;
}

std::vector<Mat4> world_of(const JointTrack& track, size_t t) {
    std::vector<Transform> local = rest_transforms(track.skeleton);
    for (size_t j = 0; j < local.size(); ++j) {
        local[j].rotation = track.turns[t * local.size() + j];
        local[j].translation = track.translations[t * local.size() + j];
    }
    return world_from_joints(track.skeleton, local);
}

Vec3 bone_of(const std::vector<Mat4>& world, const HumanoidMap& parts, HumanJoint part) {
    return origin(world[size_t(parts[*tip_of(part)])]) - origin(world[size_t(parts[part])]);
}

std::vector<Mat4> posed_by(const Figure& figure, const Posture& posture) {
    const PostureRig rig = posture_rig(figure.skeleton, figure.parts);
    return world_from_joints(figure.skeleton, pose_skeleton(rig, posture, {}).joints);
}

const std::vector<HumanJoint> kBones = {HumanJoint::left_upper_arm, HumanJoint::right_upper_arm,
                                        HumanJoint::left_lower_arm, HumanJoint::right_lower_arm,
                                        HumanJoint::left_upper_leg, HumanJoint::right_upper_leg,
                                        HumanJoint::left_lower_leg, HumanJoint::right_lower_leg};

struct Pair {
    const char* name;
    FigureShape source;
    FigureShape target;
};

void PrintTo(const Pair& pair, std::ostream* out) {
    *out << pair.name;
}

class RetargetBetween : public ::testing::TestWithParam<Pair> {};

// The figures lie differently in the world, so the source's directions are turned upright first.
TEST_P(RetargetBetween, PointsEveryBoneWhereTheSourceDoes) {
    const Figure source = make_figure(GetParam().source);
    const Figure target = make_figure(GetParam().target);
    const JointTrack track = wriggle(source, 12);
    const BodyMotion motion = retarget(track, 12, source.parts);
    for (size_t t = 0; t < 12; ++t) {
        const std::vector<Mat4> wanted = world_of(track, t);
        const std::vector<Mat4> given = posed_by(target, motion.postures[t]);
        for (const HumanJoint part : kBones) {
            const float error =
                angle_between(bone_of(wanted, source.parts, part), bone_of(given, target.parts, part));
            EXPECT_LT(error, 0.1f * kDegree) << name_of(part) << " in frame " << t;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    RestPoses, RetargetBetween,
    ::testing::Values(Pair{"TToT", {}, {}}, Pair{"TToA", {}, {.arms_down = 0.8f}},
                      Pair{"AToT", {.arms_down = 0.8f}, {}},
                      Pair{"TToBentA", {}, {.arms_down = 0.8f, .elbows_bent = 0.6f}},
                      Pair{"HangingToT", {.arms_down = 1.4f}, {}},
                      Pair{"ForwardToT", {.arms_forward = 1.5f}, {}},
                      Pair{"TurnedAxes", {.turned_axes = true}, {.arms_down = 0.5f, .turned_axes = true}},
                      Pair{"FewToManyJoints",
                           {.spine_joints = 1, .clavicles = false},
                           {.spine_joints = 5, .twist_joints = true}},
                      Pair{"ManyToFewJoints",
                           {.spine_joints = 5, .twist_joints = true},
                           {.spine_joints = 1, .clavicles = false, .fingers = false}},
                      Pair{"SmallToLarge", {.size = 0.01f}, {.size = 2}}),
    [](const ::testing::TestParamInfo<Pair>& info) { return std::string(info.param.name); });

TEST(Retarget, GivesTheSameFigureItsOwnTurnsBack) {
    const Figure figure = make_figure({.arms_down = 0.6f, .elbows_bent = 0.3f, .turned_axes = true});
    const JointTrack track = wriggle(figure, 6);
    const BodyMotion motion = retarget(track, 6, figure.parts);
    for (size_t t = 0; t < 6; ++t) {
        const std::vector<Mat4> wanted = world_of(track, t);
        const std::vector<Mat4> given = posed_by(figure, motion.postures[t]);
        for (const HumanJoint part : {HumanJoint::hips, HumanJoint::spine, HumanJoint::upper_chest,
                                      HumanJoint::head, HumanJoint::left_upper_arm, HumanJoint::left_hand,
                                      HumanJoint::right_index_2, HumanJoint::left_foot}) {
            const size_t joint = size_t(figure.parts[part]);
            EXPECT_LT(angle_between(rotation_of(wanted[joint]), rotation_of(given[joint])), 0.2f * kDegree)
                << name_of(part) << " in frame " << t;
        }
    }
}

TEST(Retarget, StandsAFigureUpThatLiesInItsRestPose) {
    const Figure lying = make_figure({.lying = true});
    JointTrack track{.skeleton = lying.skeleton, .turns = {}, .translations = {}};
    for (const Joint& joint : lying.skeleton.joints) {
        track.turns.push_back(joint.rest.rotation);
        track.translations.push_back(joint.rest.translation);
    }
    track.turns[0] = glm::angleAxis(kPi / 2, Vec3(1, 0, 0));  // the root stands it up
    const BodyMotion motion = retarget(track, 1, lying.parts);
    EXPECT_LT(angle_between(motion.postures[0].hips, kNoTurn), 0.1f * kDegree);
    EXPECT_LT(angle_between(motion.postures[0].neck.back(), kNoTurn), 0.1f * kDegree);
    EXPECT_LT(angle_between(*motion.postures[0][HumanJoint::left_hand], kNoTurn), 0.1f * kDegree);
}

bool hangs_from(const Skeleton& skeleton, int joint, int above) {
    while (joint > above) joint = skeleton.joints[size_t(joint)].parent;
    return joint == above;
}

// The same person in the same motion, with a skeleton whose joints have other axes: the axes of each joint are turned
// by `axes_of`.
JointTrack with_axes(const Figure& figure, const JointTrack& track, size_t frames,
                     const std::function<Quat(int)>& axes_of) {
    JointTrack turned{.skeleton = figure.skeleton, .turns = {}, .translations = {}};
    const size_t joints = figure.skeleton.joints.size();
    const auto axes = [&](int joint) { return joint < 0 ? kNoTurn : axes_of(joint); };
    for (size_t i = 0; i < frames * joints; ++i) {
        const int joint = int(i % joints), parent = figure.skeleton.joints[size_t(joint)].parent;
        turned.turns.push_back(conjugate(axes(parent)) * track.turns[i] * axes(joint));
        turned.translations.push_back(conjugate(axes(parent)) * track.translations[i]);
    }
    for (size_t j = 0; j < joints; ++j)
        turned.skeleton.joints[j].rest = {.translation = turned.translations[j]};
    return turned;
}

// The spine and all above has its own axes a quarter turn aside: with no joint turned, the shoulders lie
// across the hips. `head`: how its axes lie against those of the neck.
JointTrack with_twisted_rest(const Figure& figure, const JointTrack& track, size_t frames, const Quat& head) {
    const Quat aside = glm::angleAxis(kPi / 2, normalize(Vec3(0.1f, 1, 0.2f)));
    return with_axes(figure, track, frames, [&](int joint) {
        if (hangs_from(figure.skeleton, joint, figure.parts[HumanJoint::head])) return aside * head;
        return hangs_from(figure.skeleton, joint, figure.parts[HumanJoint::spine]) ? aside : kNoTurn;
    });
}

class RetargetTwisted : public ::testing::TestWithParam<float> {};

TEST_P(RetargetTwisted, FindsInTheMotionWhereTheTrunkFaces) {
    constexpr size_t kFrames = 60;
    const Figure figure = make_figure({.elbows_bent = 0.8f});
    JointTrack track{.skeleton = figure.skeleton, .turns = {}, .translations = {}};
    for (size_t t = 0; t < kFrames; ++t) {
        const float sway = 0.3f * std::sin(0.3f * float(t));
        for (size_t j = 0; j < figure.skeleton.joints.size(); ++j) {
            const Joint& joint = figure.skeleton.joints[j];
            const bool sways =
                int(j) == figure.parts[HumanJoint::chest] || int(j) == figure.parts[HumanJoint::head];
            track.turns.push_back(sways ? glm::angleAxis(sway, Vec3(0, 1, 0)) : joint.rest.rotation);
            track.translations.push_back(joint.rest.translation);
        }
    }
    const BodyMotion wanted = retarget(track, kFrames, figure.parts);
    const BodyMotion found =
        retarget(with_twisted_rest(figure, track, kFrames, glm::angleAxis(GetParam(), Vec3(0, 0, 1))),
                 kFrames, figure.parts);
    EXPECT_FALSE(wanted.rest_is_twisted);
    EXPECT_TRUE(found.rest_is_twisted);
    for (size_t t = 0; t < kFrames; ++t) {
        const Posture &here = found.postures[t], &there = wanted.postures[t];
        EXPECT_LT(angle_between(here.hips, there.hips), 2 * kDegree) << t;
        EXPECT_LT(angle_between(here.spine.back(), there.spine.back()), 2 * kDegree) << t;
        EXPECT_LT(angle_between(here.neck.back(), there.neck.back()), 2 * kDegree) << t;
        for (const HumanJoint part :
             {HumanJoint::left_shoulder, HumanJoint::right_shoulder, HumanJoint::left_upper_arm,
              HumanJoint::right_lower_arm, HumanJoint::left_hand, HumanJoint::right_hand,
              HumanJoint::left_upper_leg, HumanJoint::right_foot})
            EXPECT_LT(angle_between(*here[part], *there[part]), 4 * kDegree) << name_of(part) << " " << t;
    }
}

// Elbows and knees of straight limbs do not show their roll.
TEST(Retarget, FindsTheRollOfStraightLimbsByFeetAndTrunk) {
    const Figure figure = make_figure({});
    JointTrack track{.skeleton = figure.skeleton, .turns = {}, .translations = {}};
    const float toed_out = 0.4f;
    for (size_t j = 0; j < figure.skeleton.joints.size(); ++j) {
        const Joint& joint = figure.skeleton.joints[j];
        Quat turn = joint.rest.rotation;
        for (const LimbParts& arm : kArms) {
            if (int(j) == figure.parts[arm.upper])
                turn = glm::angleAxis(-1.3f * arm.side, Vec3(0, 0, 1)) * turn;
        }
        for (const LimbParts& leg : kLegs) {
            if (int(j) == figure.parts[leg.upper])
                turn = glm::angleAxis(toed_out * leg.side, Vec3(0, 1, 0)) * turn;
        }
        track.turns.push_back(turn);
        track.translations.push_back(joint.rest.translation);
    }
    const Quat above = glm::angleAxis(2.0f, normalize(Vec3(0.1f, 1, 0.2f))),
               below = glm::angleAxis(2.0f, normalize(Vec3(0.9f, 0.3f, 0.5f)));
    const JointTrack aside = with_axes(figure, track, 1, [&](int joint) {
        if (hangs_from(figure.skeleton, joint, figure.parts[HumanJoint::spine])) return above;
        for (const LimbParts& leg : kLegs) {
            if (hangs_from(figure.skeleton, joint, figure.parts[leg.upper])) return below;
        }
        return kNoTurn;
    });
    const Posture wanted = retarget(track, 1, figure.parts).postures[0],
                  found = retarget(aside, 1, figure.parts).postures[0];
    for (const HumanJoint part : {HumanJoint::left_upper_arm, HumanJoint::right_lower_arm,
                                  HumanJoint::left_upper_leg, HumanJoint::right_lower_leg})
        EXPECT_LT(angle_between(*found[part], *wanted[part]), 3 * kDegree) << name_of(part);
}

INSTANTIATE_TEST_SUITE_P(HeadAgainstNeck, RetargetTwisted, ::testing::Values(0.0f, 2.0f));

// Between the arms and the head, whatever the joint is called, bends the neck and leaves the shoulders alone.
TEST(Retarget, KeepsTheShouldersOutOfABendBelowTheNeck) {
    const Figure source = make_figure({.low_neck = true});
    JointTrack track = wriggle(source, 1);
    track.turns[size_t(*testing::find_joint(source.skeleton, "low_neck"))] =
        glm::angleAxis(0.5f, Vec3(1, 0, 0));
    const BodyMotion motion = retarget(track, 1, source.parts);
    EXPECT_LT(angle_between(motion.postures[0].spine.back(), kNoTurn), 1e-3f);
    EXPECT_LT(angle_between(motion.postures[0].neck.back(), glm::angleAxis(0.5f, Vec3(1, 0, 0))), 1e-3f);
    const Figure target = make_figure({});
    const std::vector<Mat4> world = posed_by(target, motion.postures[0]);
    const size_t chest = size_t(target.parts[HumanJoint::upper_chest]);
    EXPECT_LT(angle_between(rotation_of(world[chest]), kNoTurn), 1e-3f);
}

// The T-pose of a figure at rest with hanging arms: palms that faced the thighs face down.
TEST(RestPose, BringsEveryRestPoseToPalmsDownAndThumbsForward) {
    for (const FigureShape& shape : {FigureShape{.arms_down = 1.4f}, FigureShape{.arms_forward = 1.5f},
                                     FigureShape{.arms_down = 0.7f, .elbows_bent = 0.7f}}) {
        const Figure figure = make_figure(shape);
        const RestPose rest = measure_rest(figure.skeleton, figure.parts, true);
        const size_t index = size_t(figure.parts[HumanJoint::left_index_1]);
        const size_t little = size_t(figure.parts[HumanJoint::left_little_1]);
        const Vec3 across =
            rest.tpose_of_rest[index_of(HumanJoint::left_hand)] * (rest.places[index] - rest.places[little]);
        EXPECT_LT(angle_between(across, Vec3(0, 0, 1)), 0.1f * kDegree);
    }
}

// Some writers of files put the end of a hand a millimetre away from the wrist, anywhere.
TEST(RestPose, TakesNoDirectionFromAnEndThatOnlyMarksTheEnd) {
    Figure figure = make_figure({.fingers = false});
    const auto turn_of = [&] {
        return measure_rest(figure.skeleton, figure.parts, true)
            .tpose_of_rest[index_of(HumanJoint::left_hand)];
    };
    const Quat without = turn_of();
    figure.skeleton.joints.push_back({.name = "end",
                                      .parent = figure.parts[HumanJoint::left_hand],
                                      .rest = {.translation = {0, 0.001f, 0}}});
    EXPECT_LT(angle_between(turn_of(), without), 1e-6f);
    figure.skeleton.joints.back().rest.translation = {0.06f, 0.06f, 0};
    EXPECT_NEAR(angle_between(turn_of(), without), 45 * kDegree, 1e-4f);
}

TEST(ForearmTwist, SharesTheTwistOfTheHandBetweenElbowAndWrist) {
    const Figure figure = make_figure({});
    const PostureRig rig = posture_rig(figure.skeleton, figure.parts);
    Posture posture{.pelvis = {0, 0.9f, 0}};
    const Quat supine = glm::angleAxis(1.2f, Vec3(1, 0, 0));
    posture[HumanJoint::left_upper_arm] = kNoTurn;
    posture[HumanJoint::left_lower_arm] = kNoTurn;
    posture[HumanJoint::left_hand] = supine;
    const PosedSkeleton posed = pose_skeleton(rig, posture, {});
    EXPECT_NEAR(posed.forearm_twists[0], 1.2f, 1e-5f);
    const Quat forearm = posed.turns[size_t(figure.parts[HumanJoint::left_lower_arm])];
    EXPECT_LT(angle_between(forearm, glm::angleAxis(0.6f, Vec3(1, 0, 0))), 1e-3f);
    EXPECT_LT(angle_between(posed.turns[size_t(figure.parts[HumanJoint::left_hand])], supine), 1e-3f);
}

TEST(ForearmTwist, GoesOnTurningPastHalfATurnWithoutAFlip) {
    const Figure figure = make_figure({});
    const PostureRig rig = posture_rig(figure.skeleton, figure.parts);
    std::array<float, 2> twists{};
    for (float angle = 0; angle < 4; angle += 0.1f) {
        Posture posture;
        posture[HumanJoint::left_upper_arm] = kNoTurn;
        posture[HumanJoint::left_lower_arm] = kNoTurn;
        posture[HumanJoint::left_hand] = glm::angleAxis(angle, Vec3(1, 0, 0));
        twists = pose_skeleton(rig, posture, twists).forearm_twists;
        ASSERT_NEAR(twists[0], angle, 1e-4f);
    }
}

TEST(TurnAlong, BendsEvenlyFromTheFirstToTheLast) {
    const auto about_x = [](float angle) { return glm::angleAxis(angle, Vec3(1, 0, 0)); };
    const std::vector<Quat> chain = {about_x(0.2f), about_x(0.8f)};
    EXPECT_LT(angle_between(turn_along(kNoTurn, chain, 0.25f), about_x(0.1f)), 1e-3f);
    EXPECT_LT(angle_between(turn_along(kNoTurn, chain, 0.5f), about_x(0.2f)), 1e-3f);
    EXPECT_LT(angle_between(turn_along(kNoTurn, chain, 0.75f), about_x(0.5f)), 1e-3f);
    EXPECT_LT(angle_between(turn_along(kNoTurn, chain, 1), about_x(0.8f)), 1e-3f);
}

}  // namespace
}  // namespace chironomia
