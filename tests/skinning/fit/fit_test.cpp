#include "skinning/fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <string>

#include "core/hash.h"
#include "skinning/body/body_plan.h"
#include "skinning/body/keypoint_layout.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::avatar_of;
using ::testing::Contains;
using testing::Figure;
using testing::FigureShape;
using ::testing::HasSubstr;
using testing::make_figure;
using testing::refusal_of;

// A figure that walks along +z, nods, swings its arms and bends its knees.
Motion walk(const Figure& figure, size_t frames, double fps) {
    Motion motion;
    motion.source = "walk.bvh";
    motion.fps = fps;
    motion.frames = frames;
    motion.joints = JointTrack{.skeleton = figure.skeleton, .turns = {}, .translations = {}};
    for (size_t t = 0; t < frames; ++t) {
        const float phase = 4 * float(double(t) / fps);
        for (size_t j = 0; j < figure.skeleton.joints.size(); ++j) {
            const Transform& rest = figure.skeleton.joints[j].rest;
            Quat turn = rest.rotation;
            Vec3 place = rest.translation;
            const int joint = int(j);
            if (joint == figure.parts[HumanJoint::hips]) place.z += 0.25f * phase;
            if (joint == figure.parts[HumanJoint::head]) {
                turn = turn * glm::angleAxis(0.2f * std::sin(phase), Vec3(1, 0, 0));
            }
            for (const LimbParts& arm : kArms) {
                if (joint == figure.parts[arm.upper]) {
                    turn = turn * glm::angleAxis(-arm.side * 1.1f, Vec3(0, 0, 1)) *
                           glm::angleAxis(0.4f * std::sin(phase + arm.side), Vec3(0, 1, 0));
                }
                if (joint == figure.parts[arm.lower]) {
                    turn = turn * glm::angleAxis(-arm.side * (0.8f + 0.5f * std::cos(phase)), Vec3(0, 1, 0));
                }
            }
            for (const LimbParts& leg : kLegs) {
                const float swing = 0.3f * std::sin(phase + leg.side);
                if (joint == figure.parts[leg.upper]) turn = turn * glm::angleAxis(-swing, Vec3(1, 0, 0));
                if (joint == figure.parts[leg.lower]) {
                    turn = turn * glm::angleAxis(0.2f + std::abs(swing), Vec3(1, 0, 0));
                }
            }
            motion.joints->turns.push_back(turn);
            motion.joints->translations.push_back(place);
        }
    }
    return motion;
}

std::vector<Vec3> places_of(const Skeleton& skeleton, const std::vector<Transform>& local) {
    std::vector<Vec3> places;
    for (const Mat4& world : world_from_joints(skeleton, local)) places.push_back(origin(world));
    return places;
}

std::vector<Vec3> source_places(const Motion& motion, size_t t) {
    std::vector<Transform> local = rest_transforms(motion.joints->skeleton);
    for (size_t j = 0; j < local.size(); ++j) {
        local[j].rotation = motion.joints->turns[t * local.size() + j];
        local[j].translation = motion.joints->translations[t * local.size() + j];
    }
    return places_of(motion.joints->skeleton, local);
}

struct NamedPoint {
    const char* name;
    HumanJoint part;
};
const std::vector<NamedPoint> kUpperPoints = {
    {"neck", HumanJoint::neck},
    {"left_shoulder", HumanJoint::left_upper_arm},
    {"right_shoulder", HumanJoint::right_upper_arm},
    {"left_elbow", HumanJoint::left_lower_arm},
    {"right_elbow", HumanJoint::right_lower_arm},
    {"left_wrist", HumanJoint::left_hand},
    {"right_wrist", HumanJoint::right_hand},
    {"left_index_1", HumanJoint::left_index_1},
    {"right_index_1", HumanJoint::right_index_1},
    {"left_little_1", HumanJoint::left_little_1},
    {"right_little_1", HumanJoint::right_little_1},
};
const std::vector<NamedPoint> kLowerPoints = {
    {"left_hip", HumanJoint::left_upper_leg},  {"right_hip", HumanJoint::right_upper_leg},
    {"left_knee", HumanJoint::left_lower_leg}, {"right_knee", HumanJoint::right_lower_leg},
    {"left_ankle", HumanJoint::left_foot},     {"right_ankle", HumanJoint::right_foot},
    {"left_toe", HumanJoint::left_toes},       {"right_toe", HumanJoint::right_toes},
};

// What a perfect pose estimator would see of the motion.
Motion keypoints_of(const Motion& motion, const Figure& figure, std::vector<NamedPoint> points) {
    Motion seen;
    seen.source = "walk.json";
    seen.fps = motion.fps;
    seen.frames = motion.frames;
    seen.keypoints = KeypointTrack{};
    for (const NamedPoint& point : points) seen.keypoints->names.emplace_back(point.name);
    for (size_t t = 0; t < motion.frames; ++t) {
        const std::vector<Vec3> places = source_places(motion, t);
        for (const NamedPoint& point : points) {
            seen.keypoints->points.push_back(places[size_t(figure.parts[point.part])]);
            seen.keypoints->confidence.push_back(1);
        }
    }
    return seen;
}

std::vector<NamedPoint> all_points() {
    std::vector<NamedPoint> points = kUpperPoints;
    points.insert(points.end(), kLowerPoints.begin(), kLowerPoints.end());
    return points;
}

Vec3 place(const Avatar& avatar, const Pose& pose, HumanJoint part) {
    return places_of(avatar.skeleton, pose.joints)[size_t(avatar.humanoid[part])];
}

double worst(const std::vector<NamedSpread>& spreads) {
    double largest = 0;
    for (const NamedSpread& named : spreads) largest = std::max(largest, named.spread.max);
    return largest;
}

TEST(FitMotion, GivesRoundedDurationTimesRateFrames) {
    const Figure figure = make_figure({});
    EXPECT_EQ(fit_motion(walk(figure, 839, 120000.0 / 1001), avatar_of(figure), {.fps = 30}).poses.size(),
              210u);
    EXPECT_EQ(fit_motion(walk(figure, 1, 24), avatar_of(figure), {.fps = 30}).poses.size(), 1u);
}

TEST(FitMotion, PutsWristsAnklesAndElbowsWhereTheScaledSourceHasThem) {
    const Figure source = make_figure({.arms_down = 0.7f, .size = 0.8f});
    const Figure target = make_figure({.twist_joints = true, .size = 1.1f});
    const Fit fit = fit_motion(walk(source, 40, 30), avatar_of(target), {.fps = 30});
    EXPECT_EQ(fit.report.source, "joint turns");
    EXPECT_LT(worst(fit.report.direction_deg), 0.1);
    EXPECT_LT(worst(fit.report.distance_mm), 1.0);
    EXPECT_EQ(fit.report.distance_mm.size(), 8u);
}

// The zero pose of such a file is no figure at all: legs and arms lie along the spine. Palms, knees and feet
// must still come out as from an ordinary rest pose.
TEST(FitMotion, MakesAPersonOfBonesThatAllLieAlongOneAxis) {
    const Figure source = make_figure({});
    const testing::LinedUpFigure lined = line_up(source);
    const Motion ordinary = walk(source, 40, 30);
    Motion motion = ordinary;
    motion.joints->skeleton = lined.figure.skeleton;
    const size_t joints = lined.axes.size();
    for (size_t i = 0; i < motion.joints->turns.size(); ++i) {
        const size_t j = i % joints;
        const int parent = source.skeleton.joints[j].parent;
        const Quat before = parent < 0 ? kNoTurn : lined.axes[size_t(parent)];
        motion.joints->turns[i] = conjugate(before) * ordinary.joints->turns[i] * lined.axes[j];
        motion.joints->translations[i] = conjugate(before) * ordinary.joints->translations[i];
    }
    const Avatar avatar = avatar_of(make_figure({.arms_down = 0.7f, .twist_joints = true}));
    const Fit wanted = fit_motion(ordinary, avatar, {.fps = 30});
    const Fit given = fit_motion(motion, avatar, {.fps = 30});
    EXPECT_LT(worst(given.report.direction_deg), 0.1);
    for (size_t t = 0; t < 40; t += 3) {
        for (const HumanJoint part :
             {HumanJoint::head, HumanJoint::left_hand, HumanJoint::left_index_3, HumanJoint::right_little_2,
              HumanJoint::left_toes, HumanJoint::right_foot}) {
            EXPECT_LT(distance(place(avatar, wanted.poses[t], part), place(avatar, given.poses[t], part)),
                      0.045f)
                << name_of(part) << " in frame " << t;
        }
    }
}

TEST(FitMotion, StandsOnTheFloorAndBeginsAtTheOrigin) {
    const Avatar avatar = avatar_of(make_figure({.size = 1.1f}));
    const Fit fit = fit_motion(walk(make_figure({.size = 0.7f}), 60, 30), avatar, {.fps = 30});
    const Vec3 left = place(avatar, fit.poses[0], HumanJoint::left_upper_leg);
    const Vec3 right = place(avatar, fit.poses[0], HumanJoint::right_upper_leg);
    EXPECT_NEAR(left.x + right.x, 0, 1e-4f);
    EXPECT_NEAR(left.z + right.z, 0, 1e-4f);
    float lowest = 9;
    for (const Pose& pose : fit.poses) {
        lowest = std::min({lowest, place(avatar, pose, HumanJoint::left_toes).y,
                           place(avatar, pose, HumanJoint::right_toes).y});
    }
    EXPECT_GT(lowest, -0.02f);
    EXPECT_LT(lowest, 0.06f);
}

TEST(FitMotion, ScalesTravelByTheLengthOfTheLegs) {
    const Figure source = make_figure({.size = 0.5f});
    const Avatar avatar = avatar_of(make_figure({}));
    const Motion motion = walk(source, 31, 30);
    const Fit fit = fit_motion(motion, avatar, {.fps = 30});
    EXPECT_NEAR(fit.report.travel_scale, 2, 1e-3);
    const float way = source_places(motion, 30)[size_t(source.parts[HumanJoint::hips])].z -
                      source_places(motion, 0)[size_t(source.parts[HumanJoint::hips])].z;
    EXPECT_NEAR(
        place(avatar, fit.poses[30], HumanJoint::hips).z - place(avatar, fit.poses[0], HumanJoint::hips).z,
        2 * way, 0.01f);
    EXPECT_NEAR(fit.report.furthest_m, 2 * way, 0.01);
}

// As of toys whose legs are one joint each, far shorter than a person's against the trunk.
TEST(FitMotion, HoldsThePelvisOfAnAvatarWithoutFeetAtItsHeight) {
    Figure toy = make_figure({});
    const auto joint_of = [&](HumanJoint part) -> Joint& {
        return toy.skeleton.joints[size_t(toy.parts[part])];
    };
    for (const LimbParts& leg : kLegs) {
        for (const HumanJoint part : {leg.lower, leg.end}) joint_of(part).rest.translation *= 0.3f;
    }
    joint_of(HumanJoint::hips).rest.translation.y = 0.3f;
    Avatar avatar = avatar_of(toy);
    for (const HumanJoint part :
         {HumanJoint::left_foot, HumanJoint::left_toes, HumanJoint::right_foot, HumanJoint::right_toes}) {
        avatar.humanoid[part] = -1;
    }
    const Fit fit = fit_motion(walk(make_figure({}), 31, 30), avatar, {.fps = 30});
    for (const Pose& pose : fit.poses) EXPECT_NEAR(place(avatar, pose, HumanJoint::hips).y, 0.3f, 0.03f);
}

TEST(FitMotion, HoldsRootAndLegsStillForTheUpperBody) {
    const Figure figure = make_figure({});
    const Avatar avatar = avatar_of(figure);
    const Fit fit = fit_motion(walk(figure, 30, 30), avatar, {.fps = 30, .upper_body = true});
    for (const HumanJoint part : {HumanJoint::hips, HumanJoint::left_foot, HumanJoint::right_lower_leg}) {
        EXPECT_LT(distance(place(avatar, fit.poses[0], part), place(avatar, fit.poses[20], part)), 1e-5f);
    }
    EXPECT_GT(distance(place(avatar, fit.poses[0], HumanJoint::left_hand),
                       place(avatar, fit.poses[20], HumanJoint::left_hand)),
              0.05f);
}

TEST(FitMotion, TakesTheHeadingOfTheHipsAwayFromTheUpperBody) {
    const Figure figure = make_figure({});
    Motion motion = walk(figure, 30, 30);
    for (size_t t = 0; t < 30; ++t) {
        Quat& root = motion.joints->turns[t * figure.skeleton.joints.size()];
        root = glm::angleAxis(0.1f * float(t), Vec3(0, 1, 0)) * root;
    }
    const Avatar avatar = avatar_of(figure);
    const Fit turning = fit_motion(motion, avatar, {.fps = 30, .upper_body = true});
    const Fit straight = fit_motion(walk(figure, 30, 30), avatar, {.fps = 30, .upper_body = true});
    EXPECT_LT(distance(place(avatar, turning.poses[29], HumanJoint::left_hand),
                       place(avatar, straight.poses[29], HumanJoint::left_hand)),
              1e-3f);
    EXPECT_LT(worst(turning.report.direction_deg), 0.1);
}

TEST(FitMotion, CurlsTheFingersThatTheMotionLacks) {
    const Figure source = make_figure({.fingers = false});
    const Figure target = make_figure({});
    const Fit fit = fit_motion(walk(source, 3, 30), avatar_of(target), {.fps = 30});
    EXPECT_THAT(fit.report.held, Contains("left_index_1"));
    const Quat knuckle = fit.poses[0].joints[size_t(target.parts[HumanJoint::left_index_2])].rotation;
    EXPECT_NEAR(angle_between(knuckle, kNoTurn), radians(26.0f), 1e-3f);
}

TEST(FitMotion, CurlsTheFingersThatTheMotionMovesIfHandsAreRelaxed) {
    const Figure figure = make_figure({});
    const auto knuckle_of = [&](bool relaxed) {
        const Fit fit =
            fit_motion(walk(figure, 3, 30), avatar_of(figure), {.fps = 30, .relaxed_hands = relaxed});
        return fit.poses[0].joints[size_t(figure.parts[HumanJoint::left_index_2])].rotation;
    };
    EXPECT_NEAR(angle_between(knuckle_of(true), kNoTurn), radians(26.0f), 1e-3f);
    EXPECT_NEAR(angle_between(knuckle_of(false), kNoTurn), 0, 1e-3f);
}

TEST(FitMotion, FollowsTheKeypointsOfAFigureOfAnotherSize) {
    const Figure source = make_figure({.size = 0.7f});
    const Figure target = make_figure({.arms_down = 0.8f, .elbows_bent = 0.4f, .twist_joints = true});
    const Motion seen = keypoints_of(walk(source, 60, 30), source, all_points());
    const Fit fit = fit_motion(seen, avatar_of(target), {.fps = 30});
    EXPECT_EQ(fit.report.source, "keypoints");
    ASSERT_EQ(fit.report.reached.size(), 4u);
    for (const Reached& limb : fit.report.reached) {
        EXPECT_EQ(limb.unreachable, 0u) << limb.limb;
        EXPECT_LT(limb.end_distance_mm.mean, 1) << limb.limb;
    }
    EXPECT_LT(worst(fit.report.direction_deg), 3);
    EXPECT_TRUE(fit.report.limits.empty());
}

TEST(FitMotion, TurnsTheHandAsTheKnucklesShow) {
    const Figure figure = make_figure({});
    const Motion motion = walk(figure, 20, 30);
    const Avatar avatar = avatar_of(figure);
    const Fit fit = fit_motion(keypoints_of(motion, figure, all_points()), avatar, {.fps = 30});
    for (size_t t = 0; t < 20; ++t) {
        const std::vector<Vec3> wanted = source_places(motion, t);
        const auto across = [&](const std::vector<Vec3>& places) {
            return places[size_t(figure.parts[HumanJoint::left_index_1])] -
                   places[size_t(figure.parts[HumanJoint::left_little_1])];
        };
        EXPECT_LT(angle_between(across(wanted), across(places_of(avatar.skeleton, fit.poses[t].joints))),
                  radians(3.0f));
    }
}

TEST(FitMotion, StandsStillWithoutLegsInTheKeypoints) {
    const Figure figure = make_figure({});
    const Avatar avatar = avatar_of(figure);
    const Motion seen = keypoints_of(walk(figure, 30, 30), figure, kUpperPoints);
    const Fit fit = fit_motion(seen, avatar, {.fps = 30});
    EXPECT_THAT(fit.report.held, Contains("left_lower_leg"));
    EXPECT_LT(distance(place(avatar, fit.poses[0], HumanJoint::hips),
                       place(avatar, fit.poses[29], HumanJoint::hips)),
              1e-5f);
    EXPECT_NEAR(place(avatar, fit.poses[0], HumanJoint::left_foot).y, 0.09f, 0.03f);
}

TEST(FitMotion, HangsAnArmThatTheKeypointsLack) {
    const Figure figure = make_figure({});
    const Avatar avatar = avatar_of(figure);
    Motion seen = keypoints_of(walk(figure, 30, 30), figure,
                               {{"left_shoulder", HumanJoint::left_upper_arm},
                                {"right_shoulder", HumanJoint::right_upper_arm},
                                {"left_elbow", HumanJoint::left_lower_arm},
                                {"left_wrist", HumanJoint::left_hand}});
    const Fit fit = fit_motion(seen, avatar, {.fps = 30});
    const Vec3 shoulder = place(avatar, fit.poses[5], HumanJoint::right_upper_arm);
    EXPECT_LT(place(avatar, fit.poses[5], HumanJoint::right_hand).y, shoulder.y - 0.4f);
    EXPECT_THAT(fit.report.held, Contains("right_upper_arm"));
}

TEST(FitMotion, CountsFramesOutOfReachAndStretchesThere) {
    const Figure figure = make_figure({});
    Motion seen = keypoints_of(walk(figure, 30, 30), figure, all_points());
    const size_t points = seen.keypoints->names.size();
    for (size_t t = 10; t < 14; ++t) {
        seen.keypoints->points[t * points + 5] += Vec3(0.3f, -0.9f, 0.2f);  // the left wrist
    }
    const Fit fit = fit_motion(seen, avatar_of(figure), {.fps = 30});
    EXPECT_EQ(fit.report.reached[0].unreachable, 4u);
    EXPECT_EQ(fit.report.reached[1].unreachable, 0u);
}

// Straightening an elbow passes through the posture that has no plane: nothing may flip there.
TEST(FitMotion, DoesNotFlipTheArmWhenTheElbowStraightens) {
    const Figure figure = make_figure({});
    Motion motion = walk(figure, 60, 30);
    const size_t joints = figure.skeleton.joints.size();
    for (size_t t = 0; t < 60; ++t) {
        motion.joints->turns[t * joints + size_t(figure.parts[HumanJoint::left_lower_arm])] =
            glm::angleAxis(-std::max(0.0f, 0.8f * std::cos(0.15f * float(t))), Vec3(0, 1, 0));
    }
    const Avatar avatar = avatar_of(figure);
    const Fit fit = fit_motion(keypoints_of(motion, figure, all_points()), avatar, {.fps = 30});
    for (size_t t = 1; t < 60; ++t) {
        for (const HumanJoint part : {HumanJoint::left_upper_arm, HumanJoint::left_lower_arm}) {
            const size_t joint = size_t(figure.parts[part]);
            EXPECT_LT(
                angle_between(fit.poses[t - 1].joints[joint].rotation, fit.poses[t].joints[joint].rotation),
                0.35f)
                << name_of(part) << " in frame " << t;
        }
    }
}

std::string fingerprint(const Fit& fit) {
    std::string bytes;
    for (const Pose& pose : fit.poses) {
        for (const Transform& joint : pose.joints) {
            bytes.append(reinterpret_cast<const char*>(&joint), sizeof joint);
        }
    }
    return sha256(bytes + to_json(fit.report).dump());
}

TEST(FitMotion, GivesTheSameBytesAgainAndInEveryLocale) {
    const Figure figure = make_figure({.arms_down = 0.5f});
    const Motion motion = walk(figure, 30, 25);
    const Motion seen = keypoints_of(motion, figure, all_points());
    const std::string turns = fingerprint(fit_motion(motion, avatar_of(figure), {.fps = 30}));
    const std::string points = fingerprint(fit_motion(seen, avatar_of(figure), {.fps = 30}));
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    EXPECT_EQ(fingerprint(fit_motion(motion, avatar_of(figure), {.fps = 30})), turns);
    EXPECT_EQ(fingerprint(fit_motion(seen, avatar_of(figure), {.fps = 30})), points);
    std::setlocale(LC_ALL, "C");
}

TEST(FitMotion, RefusesAMotionWithoutAnything) {
    Motion motion;
    motion.source = "empty.h5";
    motion.fps = 30;
    motion.frames = 1;
    EXPECT_EQ(refusal_of([&] { fit_motion(motion, avatar_of(make_figure({})), {}); }),
              "empty.h5: has neither joint turns nor 3D keypoints; give a motion file that has one of them");
}

TEST(FitMotion, RefusesAFaceWithoutABody) {
    const Motion motion{.source = "face.csv",
                        .fps = 30,
                        .frames = 1,
                        .joints = {},
                        .keypoints = {},
                        .face = FaceTrack{},
                        .notes = {}};
    EXPECT_EQ(refusal_of([&] { fit_motion(motion, avatar_of(make_figure({})), {}); }),
              "face.csv: has a face, but no body; give the motion of a body, and this as its --face");
}

TEST(FitMotion, RefusesASkeletonThatIsNoHumanoid) {
    Motion motion;
    motion.source = "rope.bvh";
    motion.fps = 30;
    motion.frames = 1;
    motion.joints = JointTrack{};
    for (int j = 0; j < 4; ++j) {
        motion.joints->skeleton.joints.push_back(
            {.name = "link" + std::to_string(j), .parent = j - 1, .rest = {.translation = {0, 0.3f, 0}}});
        motion.joints->turns.push_back(kNoTurn);
        motion.joints->translations.emplace_back(0, 0.3f, 0);
    }
    const std::string message = refusal_of([&] { fit_motion(motion, avatar_of(make_figure({})), {}); });
    EXPECT_THAT(message, HasSubstr("rope.bvh: the skeleton is no humanoid: "));
    EXPECT_THAT(message, HasSubstr("; give a motion of a person"));
}

TEST(FitMotion, RefusesKeypointsWithoutShoulders) {
    Motion motion;
    motion.source = "legs.csv";
    motion.fps = 30;
    motion.frames = 1;
    motion.keypoints = KeypointTrack{
        .names = {"left_shoulder", "left_knee"}, .points = {{0, 1, 0}, {0, 0.5f, 0}}, .confidence = {1, 1}};
    EXPECT_EQ(
        refusal_of([&] { fit_motion(motion, avatar_of(make_figure({})), {}); }),
        "legs.csv: of its 2 keypoints none is seen as right_shoulder; both shoulders are needed, rename the "
        "keypoints or give a name map");
}

}  // namespace
}  // namespace chironomia
