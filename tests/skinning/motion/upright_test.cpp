#include "skinning/motion/upright.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files/files.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/body/up_doubt.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

// A figure in a T-pose that raises its left arm, in metres, +y up, facing +z.
Motion figure() {
    Motion motion{
        .source = "made", .fps = 2, .frames = 3, .joints = JointTrack{}, .keypoints = {}, .notes = {}};
    motion.joints->skeleton.joints = {{"Hips", -1, {.translation = {0, 0.9f, 0}}},
                                      {"Spine", 0, {.translation = {0, 0.2f, 0}}},
                                      {"Neck", 1, {.translation = {0, 0.35f, 0}}},
                                      {"Head", 2, {.translation = {0, 0.1f, 0}}},
                                      {"LeftArm", 1, {.translation = {0.17f, 0.28f, 0}}},
                                      {"LeftForeArm", 4, {.translation = {0.28f, 0, 0}}},
                                      {"LeftHand", 5, {.translation = {0.25f, 0, 0}}},
                                      {"RightArm", 1, {.translation = {-0.17f, 0.28f, 0}}},
                                      {"RightForeArm", 7, {.translation = {-0.28f, 0, 0}}},
                                      {"RightHand", 8, {.translation = {-0.25f, 0, 0}}},
                                      {"LeftUpLeg", 0, {.translation = {0.09f, -0.05f, 0}}},
                                      {"LeftLeg", 10, {.translation = {0, -0.41f, 0}}},
                                      {"LeftFoot", 11, {.translation = {0, -0.41f, 0}}},
                                      {"RightUpLeg", 0, {.translation = {-0.09f, -0.05f, 0}}},
                                      {"RightLeg", 13, {.translation = {0, -0.41f, 0}}},
                                      {"RightFoot", 14, {.translation = {0, -0.41f, 0}}}};
    for (int t = 0; t < 3; ++t) {
        for (const Joint& joint : motion.joints->skeleton.joints) {
            const bool raised = joint.name == "LeftArm";
            motion.joints->turns.push_back(raised ? glm::angleAxis(0.5f * float(t), Vec3(0, 0, 1)) : kNoTurn);
            motion.joints->translations.push_back(joint.rest.translation);
        }
    }
    return motion;
}

// The same figure in other axes and another unit; the rest pose is turned by `rest` instead.
Motion figure_in(const Quat& rest, const Quat& turn, float scale) {
    Motion motion = figure();
    auto& joints = motion.joints->skeleton.joints;
    const size_t count = joints.size();
    for (Joint& joint : joints) joint.rest.translation *= scale;
    joints[0].rest = {.translation = rest * joints[0].rest.translation, .rotation = rest};
    for (size_t i = 0; i < motion.joints->turns.size(); ++i) {
        motion.joints->translations[i] *= scale;
        if (i % count != 0) continue;
        motion.joints->translations[i] = turn * motion.joints->translations[i];
        motion.joints->turns[i] = turn * motion.joints->turns[i];
    }
    return motion;
}

void expect_same_places(const LandmarkFrame& a, const LandmarkFrame& b) {
    for (size_t l = 0; l < a.size(); ++l) {
        ASSERT_EQ(a[l].has_value(), b[l].has_value());
        if (!a[l]) continue;
        EXPECT_LT(distance(*a[l], *b[l]), 1e-4f) << name_of(static_cast<Landmark>(l));
    }
}

void expect_figure(const Motion& motion) {
    const Motion expected = figure();
    for (size_t t = 0; t < 3; ++t) {
        expect_same_places(landmarks_of(*motion.joints, {t})[0], landmarks_of(*expected.joints, {t})[0]);
    }
    expect_same_places(rest_landmarks(motion.joints->skeleton), rest_landmarks(expected.joints->skeleton));
}

// Whatever the axes and the unit of the file, the figure stands in the same place.
TEST(UprightMotion, UndoesEveryFrameOfReference) {
    for (const Vec3 up :
         {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)}) {
        for (const float yaw : {0.0f, 0.3f, kPi / 2, 2.5f, -kPi / 2}) {
            for (const float scale : {1.0f, 100.0f, 1000.0f, 10.0f, 1 / 0.0254f}) {
                const Quat turn = turn_between(Vec3(0, 1, 0), up) * glm::angleAxis(yaw, Vec3(0, 1, 0));
                SCOPED_TRACE(::testing::Message() << up.x << up.y << up.z << " " << yaw << " " << scale);
                expect_figure(stand_upright(figure_in(turn, turn, scale), {}));
                expect_figure(stand_upright(figure_in(kNoTurn, turn, scale), {}));
                if (HasFailure()) return;
            }
        }
    }
}

// On the back in the beginning, then on both feet.
TEST(UprightMotion, LetsAPersonGetUp) {
    Motion motion = figure();
    motion.fps = 1;
    for (const size_t t : {0, 1})
        motion.joints->turns[t * motion.joints->skeleton.joints.size()] =
            glm::angleAxis(-kPi / 2, Vec3(1, 0, 0));
    const Motion after = stand_upright(motion, {});
    EXPECT_THAT(after.notes,
                Contains(HasSubstr("up axis: y, as in the rest pose; the body stands along it in ")));
    expect_same_places(landmarks_of(*after.joints, {2})[0], landmarks_of(*figure().joints, {2})[0]);
}

// The figure with its hips turned about x by `deg`, and its spine back by so much if it bows from the hips.
Motion leaning(float deg, bool bows) {
    Motion motion = figure();
    const size_t count = motion.joints->skeleton.joints.size();
    const Quat lean = glm::angleAxis(radians(deg), Vec3(1, 0, 0));
    for (size_t t = 0; t < motion.frames; ++t) {
        motion.joints->turns[t * count + (bows ? 1 : 0)] = lean;
        motion.joints->translations[t * count].x += 0.05f;  // not where the rest pose is
    }
    return motion;
}

Motion points_of(const Motion& joints) {
    Motion motion{.source = "made", .fps = joints.fps, .frames = joints.frames, .keypoints = KeypointTrack{}};
    std::vector<size_t> frames;
    for (size_t t = 0; t < joints.frames; ++t) frames.push_back(t);
    const auto places = landmarks_of(*joints.joints, frames);
    for (size_t l = 0; l < places[0].size(); ++l)
        if (places[0][l]) motion.keypoints->names.emplace_back(name_of(static_cast<Landmark>(l)));
    for (const LandmarkFrame& frame : places) {
        for (const auto& place : frame)
            if (place) motion.keypoints->points.push_back(*place);
    }
    motion.keypoints->confidence.assign(motion.keypoints->points.size(), 1);
    return motion;
}

bool stands_along_y(const Motion& motion) {
    return std::ranges::any_of(motion.notes,
                               [](const std::string& note) { return note.starts_with("up axis: y"); });
}

// A bow, and a body that lies on its front or its back in the air all the time, keep y as their up axis, with and
// without a rest pose, and a note says what to look at.
TEST(UprightMotion, LetsAPersonBowAndLie) {
    for (const auto& [deg, bows] :
         {std::pair(75.0f, true), {90.0f, false}, {-90.0f, false}, {60.0f, false}}) {
        SCOPED_TRACE(::testing::Message() << deg << " " << bows);
        for (const Motion& motion : {leaning(deg, bows), points_of(leaning(deg, bows))}) {
            const Motion after = stand_upright(motion, {});
            EXPECT_TRUE(stands_along_y(after)) << ::testing::PrintToString(after.notes);
            ASSERT_TRUE(doubt_of_up_axis(after));
            EXPECT_THAT(
                *doubt_of_up_axis(after),
                AllOf(HasSubstr("y was taken for up, from which the trunk leans by "),
                      HasSubstr(" degrees in the median of the frames; if nobody bows, crawls or lies "
                                "there, set --up")));
        }
    }
}

// What stands on a floor at 0 along z stands there, whatever its rest pose says, and so do points whose hips are the
// origin.
TEST(UprightMotion, LetsTheFloorDecide) {
    const Quat z_up = turn_between(Vec3(0, 1, 0), Vec3(0, 0, 1));
    const Motion joints = stand_upright(figure_in(kNoTurn, z_up, 1), {});
    EXPECT_FALSE(stands_along_y(joints));
    EXPECT_EQ(doubt_of_up_axis(joints), std::nullopt);
    Motion sunk = figure_in(kNoTurn, z_up, 1);
    for (size_t t = 0; t < sunk.frames; ++t)
        sunk.joints->translations[t * sunk.joints->skeleton.joints.size()] -= Vec3(0, 3, 3);
    EXPECT_EQ(doubt_of_up_axis(stand_upright(sunk, {})),
              "z was taken for up, but the rest pose stands along y; if somebody lies there, set --up y");
    const Motion by_format = stand_upright(sunk, {}, {.up = UpAxis::y});
    EXPECT_THAT(by_format.notes,
                Contains("up axis: y, as the format of the file has it; the body leaves it in doubt"));
    EXPECT_FALSE(stands_along_y(stand_upright(figure_in(kNoTurn, z_up, 1), {}, {.up = UpAxis::y})));
    Motion points = points_of(figure_in(z_up, z_up, 1));
    EXPECT_FALSE(stands_along_y(stand_upright(points, {})));
    EXPECT_EQ(doubt_of_up_axis(stand_upright(points, {})), std::nullopt);
    for (Vec3& place : points.keypoints->points) place -= Vec3(0, 0, 0.85f);
    EXPECT_FALSE(stands_along_y(stand_upright(points, {})));
}

// On the back for two thirds of the time, then on both feet.
TEST(UprightMotion, LetsPointsGetUp) {
    Motion motion = leaning(0, false);
    motion.fps = 1;
    for (const size_t t : {0, 1})
        motion.joints->turns[t * motion.joints->skeleton.joints.size()] =
            glm::angleAxis(-kPi / 2, Vec3(1, 0, 0));
    EXPECT_TRUE(stands_along_y(stand_upright(points_of(motion), {})));
}

TEST(UprightMotion, KeepsTheTurnsOfAllJointsButTheRoot) {
    const Motion before = figure_in(kNoTurn, glm::angleAxis(1.0f, normalize(Vec3(0, 1, 0))), 100);
    const Motion after = stand_upright(before, {});
    for (size_t i = 0; i < before.joints->turns.size(); ++i) {
        if (i % before.joints->skeleton.joints.size() == 0) continue;
        EXPECT_EQ(after.joints->turns[i], before.joints->turns[i]);
    }
}

// Common units are taken as they are: a tall figure stays tall. Only odd sizes are fitted, and a note says
// so.
TEST(UprightMotion, ScalesFreelyOnlyWhereNoCommonUnitFits) {
    const Motion tall = stand_upright(figure_in(kNoTurn, kNoTurn, 115), {});
    EXPECT_THAT(tall.notes, Contains(HasSubstr("unit: cm")));
    EXPECT_NEAR(tall.joints->translations[0].y, 0.9f * 1.15f, 1e-4f);
    const Motion odd = stand_upright(figure_in(kNoTurn, kNoTurn, 23), {});
    EXPECT_THAT(odd.notes, Contains(HasSubstr("chosen so that the body is 1.7 m tall")));
}

TEST(UprightMotion, LeavesAMotionThatDoesNotShowItsAxesAndSaysSo) {
    Motion motion{
        .source = "made", .fps = 30, .frames = 1, .joints = JointTrack{}, .keypoints = {}, .notes = {}};
    motion.joints->skeleton.joints = {{"a", -1, {}}, {"b", 0, {.translation = {0, 1, 0}}}};
    motion.joints->turns = {kNoTurn, kNoTurn};
    motion.joints->translations = {{0, 0, 0}, {0, 1, 0}};
    const Motion result = stand_upright(motion, {});
    EXPECT_EQ(result.joints->translations, motion.joints->translations);
    EXPECT_THAT(result.notes,
                Contains("up axis: y is taken, hips and head do not show it; set it with --up"));
    EXPECT_THAT(result.notes, Contains(HasSubstr("facing: left as it is")));
    EXPECT_THAT(result.notes, Contains(HasSubstr("unit: metres are taken")));
}

TEST(StandUpright, RefusesAUnitThatMakesGiantsOrDwarfs) {
    const auto refusal = [](float scale, double unit) {
        return testing::refusal_of(
            [&] { stand_upright(figure_in(kNoTurn, kNoTurn, scale), {.unit = unit}); });
    };
    EXPECT_THAT(refusal(100, 1), HasSubstr("made: a unit of 1 m was set, which makes the body 1"));
    EXPECT_THAT(refusal(100, 1), HasSubstr("m tall; people are 0.3 to 4 m tall, set cm (1."));
    EXPECT_THAT(refusal(1, 0.01), HasSubstr("set m (1."));
    EXPECT_THAT(refusal(1e-5f, 1), HasSubstr("leave it out to have it found"));
}

}  // namespace
}  // namespace chironomia
