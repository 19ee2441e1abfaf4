// Stick figures: what is drawn where, known from the motion alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/body/rest.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "skinning/stick/stick.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/joints.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

// A figure that stands still for `frames` frames, moved by `walk` in each.
Motion standing(size_t frames, const Vec3& walk = Vec3(0)) {
    const testing::Figure figure = testing::make_figure({.arms_down = 0.4f});
    Motion motion{.source = "figure", .fps = 30, .frames = frames};
    JointTrack track{.skeleton = figure.skeleton, .turns = {}, .translations = {}};
    for (size_t t = 0; t < frames; ++t) {
        for (const Joint& joint : figure.skeleton.joints) {
            track.turns.push_back(joint.rest.rotation);
            const Vec3 moved = joint.parent < 0 ? static_cast<float>(t) * walk : Vec3(0);
            track.translations.push_back(joint.rest.translation + moved);
        }
    }
    motion.joints = track;
    return motion;
}

// Named points, in one frame or in many that are alike.
Motion keypoints(const std::vector<std::pair<std::string, Vec3>>& points, size_t frames) {
    Motion motion{.source = "points", .fps = 30, .frames = frames};
    KeypointTrack& track = motion.keypoints.emplace();
    for (const auto& [name, place] : points) track.names.push_back(name);
    for (size_t t = 0; t < frames; ++t) {
        for (const auto& [name, place] : points) {
            track.points.push_back(place);
            track.confidence.push_back(1);
        }
    }
    return motion;
}

const std::vector<std::pair<std::string, Vec3>> kUpperBody = {
    {"left_shoulder", {0.18f, 1.43f, 0}}, {"right_shoulder", {-0.18f, 1.43f, 0}},
    {"left_elbow", {0.25f, 1.15f, 0}},    {"right_elbow", {-0.25f, 1.15f, 0}},
    {"left_wrist", {0.3f, 1.2f, 0.25f}},  {"right_wrist", {-0.3f, 1.2f, 0.25f}},
    {"left_index_1", {0.3f, 1.28f, 0.3f}}};

size_t joint(const StickFigure& figure, const std::string& name) {
    const auto found = testing::find_joint(figure.avatar.skeleton, name);
    EXPECT_TRUE(found) << name;
    return static_cast<size_t>(found.value_or(0));
}

Transform at(const StickFigure& figure, size_t frame, const std::string& name) {
    return figure.fit.poses[frame].joints[joint(figure, name)];
}

bool is_drawn(const StickFigure& figure, size_t frame, const std::string& name) {
    return at(figure, frame, name).scale != Vec3(0);
}

float apart(const Vec3& a, const Vec3& b) {
    return distance(a, b);
}

TEST(StickFigure, JointsAreWhereTheMotionHasThem) {
    const Motion motion = standing(3, {0.1f, 0, 0});
    const StickFigure figure = make_stick_figure(motion, {});
    ASSERT_EQ(figure.fit.poses.size(), 3u);
    const JointTrack& track = *motion.joints;
    std::vector<Transform> local = rest_transforms(track.skeleton);
    const std::vector<Mat4> world = world_from_joints(track.skeleton, local);
    const auto source = [&](const std::string& name) {
        return origin(world[static_cast<size_t>(*testing::find_joint(track.skeleton, name))]);
    };
    for (const char* name : {"head", "left_hand", "right_lower_arm", "left_index_2", "right_foot"}) {
        const Vec3 wanted = source(name) - source("hips");
        const Vec3 given = at(figure, 0, name).translation - at(figure, 0, "hips").translation;
        EXPECT_LT(apart(wanted, given), 1e-5f) << name;
    }
    const Vec3 walked = at(figure, 2, "hips").translation - at(figure, 0, "hips").translation;
    EXPECT_LT(apart(walked, {0.2f, 0, 0}), 1e-5f);
}

TEST(StickFigure, ALineGoesFromItsPointToItsPoint) {
    const StickFigure figure = make_stick_figure(standing(1), {});
    const Transform& line = at(figure, 0, "left_upper_arm to left_lower_arm");
    const Vec3 end = line.translation + line.rotation * (line.scale * Vec3(0, 1, 0));
    EXPECT_LT(apart(line.translation, at(figure, 0, "left_upper_arm").translation), 1e-5f);
    EXPECT_LT(apart(end, at(figure, 0, "left_lower_arm").translation), 1e-5f);
}

TEST(StickFigure, StandsOnTheFloorAndIsFramedAsAPerson) {
    Motion motion = standing(2);
    for (size_t i = 0; i < motion.joints->translations.size(); ++i) {
        const size_t count = motion.joints->skeleton.joints.size();
        if (motion.joints->skeleton.joints[i % count].parent < 0)
            motion.joints->translations[i] += Vec3(3, 7, 2);
    }
    const StickFigure figure = make_stick_figure(motion, {});
    const Bounds rest = bounds_of(rest_mesh(figure.avatar));
    const Bounds posed = bounds_of(skin(figure.avatar, figure.fit.poses[0]));
    EXPECT_NEAR(rest.low.y, posed.low.y, 0.01f);
    EXPECT_NEAR(at(figure, 0, "hips").translation.x, 0, 0.01f);
    EXPECT_NEAR(rest.high.y - rest.low.y, 1.7f, 0.2f);
}

// The same motion with bones that lie along axes of their own: without turns the shoulders lie across the hips, and the
// legs are level.
Motion with_twisted_rest(Motion motion) {
    JointTrack& track = *motion.joints;
    const auto axes = [&](int joint) {
        bool trunk = false;
        for (; joint >= 0; joint = track.skeleton.joints[static_cast<size_t>(joint)].parent)
            trunk = trunk || track.skeleton.joints[static_cast<size_t>(joint)].name == "spine0";
        return glm::angleAxis(kPi / 2, trunk ? Vec3(0, 1, 0) : Vec3(1, 0, 0));
    };
    const JointTrack plain = track;
    for (size_t i = 0; i < plain.turns.size(); ++i) {
        const auto joint = static_cast<int>(i % plain.skeleton.joints.size());
        const int parent = plain.skeleton.joints[static_cast<size_t>(joint)].parent;
        const Quat above = parent < 0 ? kNoTurn : axes(parent);
        track.turns[i] = conjugate(above) * plain.turns[i] * axes(joint);
        track.translations[i] = conjugate(above) * plain.translations[i];
    }
    for (size_t j = 0; j < track.skeleton.joints.size(); ++j)
        track.skeleton.joints[j].rest = {.translation = track.translations[j]};
    return motion;
}

TEST(StickFigure, StandsOnTheFloorWhereNobodyCouldStandAsTheSkeletonIsAtRest) {
    const StickFigure plain = make_stick_figure(standing(2), {});
    const StickFigure twisted = make_stick_figure(with_twisted_rest(standing(2)), {});
    for (const char* name : {"hips", "head", "left_hand", "right_foot"}) {
        EXPECT_LT(apart(at(plain, 0, name).translation, at(twisted, 0, name).translation), 0.01f) << name;
        const auto rest = [&](const StickFigure& figure) {
            return figure.avatar.skeleton.joints[joint(figure, name)].rest.translation;
        };
        EXPECT_LT(std::abs(rest(plain).y - rest(twisted).y), 0.02f) << name;
    }
}

TEST(StickFigure, WhatIsNotSeenIsNotDrawnInExactlyTheseFrames) {
    Motion motion = keypoints(kUpperBody, 8);
    for (const size_t t : {3u, 4u}) motion.keypoints->confidence[t * kUpperBody.size() + 2] = 0.01f;
    const StickFigure figure = make_stick_figure(motion, {});
    for (size_t t = 0; t < 8; ++t) {
        const bool seen = t != 3 && t != 4;
        EXPECT_EQ(is_drawn(figure, t, "left_elbow"), seen) << t;
        EXPECT_EQ(is_drawn(figure, t, "left_shoulder to left_elbow"), seen) << t;
        EXPECT_EQ(is_drawn(figure, t, "left_elbow to left_wrist"), seen) << t;
        EXPECT_TRUE(is_drawn(figure, t, "right_shoulder to right_elbow")) << t;
        EXPECT_FALSE(is_drawn(figure, t, "left_knee")) << "the motion has no legs";
    }
}

TEST(StickFigure, AFingerWithoutItsHandIsNotDrawn) {
    Motion motion = keypoints(kUpperBody, 2);
    motion.keypoints->confidence[kUpperBody.size() + 4] = 0;
    const StickFigure figure = make_stick_figure(motion, {});
    EXPECT_TRUE(is_drawn(figure, 0, "left_index_1"));
    EXPECT_FALSE(is_drawn(figure, 1, "left_index_1"));
}

TEST(StickFigure, WithoutHandsNoFingerIsDrawn) {
    const StickFigure figure = make_stick_figure(standing(1), {.hands = false});
    EXPECT_FALSE(is_drawn(figure, 0, "left_index_1"));
    EXPECT_TRUE(is_drawn(figure, 0, "left_hand"));
}

TEST(StickFigure, WithoutFeetTheShouldersAreWhereAPersonHasThem) {
    std::vector<std::pair<std::string, Vec3>> low = kUpperBody;
    for (auto& [name, place] : low) place.y -= 1;
    const StickFigure figure = make_stick_figure(keypoints(low, 2), {});
    const float rest = figure.avatar.skeleton.joints[joint(figure, "left_shoulder")].rest.translation.y;
    EXPECT_NEAR(at(figure, 1, "left_shoulder").translation.y, rest, 1e-5f);
    EXPECT_GT(rest, 1.2f);
}

TEST(StickFigure, TheUpperBodyAloneIsHeldByItsHips) {
    const StickFigure figure = make_stick_figure(standing(4, {0.3f, 0.1f, 0.2f}), {.upper_body = true});
    EXPECT_LT(apart(at(figure, 0, "head").translation, at(figure, 3, "head").translation), 1e-5f);
    EXPECT_FALSE(is_drawn(figure, 0, "left_lower_leg"));
    EXPECT_TRUE(is_drawn(figure, 0, "left_upper_leg"));
}

// The same body in a picture whose unit is a pixel.
Motion picture(float pixels) {
    Motion motion{.source = "picture", .fps = 30, .frames = 3};
    PictureTrack& track = motion.picture.emplace();
    for (const auto& [name, place] : kUpperBody) track.names.push_back(name);
    for (size_t t = 0; t < 3; ++t) {
        for (const auto& [name, place] : kUpperBody) {
            track.points.emplace_back(400 + pixels * place.x, 900 - pixels * place.y);
            track.confidence.push_back(1);
        }
    }
    return motion;
}

TEST(StickFigure, APictureIsFlatInItsOwnProportionsWhateverItsUnit) {
    for (const float pixels : {100.0f, 700.0f}) {
        const StickFigure figure = make_stick_figure(picture(pixels), {});
        const Vec3 shoulder = at(figure, 1, "left_shoulder").translation;
        const Vec3 elbow = at(figure, 1, "left_elbow").translation;
        const Vec3 other = at(figure, 1, "right_shoulder").translation;
        EXPECT_NEAR((elbow.x - shoulder.x) / (shoulder.x - other.x), 0.07f / 0.36f, 1e-3f);
        EXPECT_NEAR((elbow.y - shoulder.y) / (shoulder.x - other.x), -0.28f / 0.36f, 1e-3f);
        EXPECT_NEAR(shoulder.x + other.x, 0, 1e-3f);
        EXPECT_NEAR(shoulder.x - other.x, 0.36f, 0.1f);
        EXPECT_LT(std::abs(elbow.z), 0.06f);
    }
}

TEST(StickFigure, AFacesOutlineTakesThePlaceOfTheBodysNose) {
    Motion motion = picture(300);
    PictureTrack& track = *motion.picture;
    PictureTrack faced;
    faced.names = track.names;
    faced.names.insert(faced.names.end(), {"nose", "face_7", "face_8"});
    for (size_t t = 0; t < 3; ++t) {
        for (size_t k = 0; k < track.names.size(); ++k) {
            faced.points.push_back(track.points[t * track.names.size() + k]);
            faced.confidence.push_back(1);
        }
        for (const float x : {0.0f, -10.0f, 0.0f}) faced.points.emplace_back(400 + x, 430);
        for (const float sure : {1.0f, t == 1 ? 0.0f : 1.0f, t == 1 ? 0.0f : 1.0f})
            faced.confidence.push_back(sure);
    }
    motion.picture = faced;
    const StickFigure figure = make_stick_figure(motion, {});
    for (size_t t = 0; t < 3; ++t) {
        EXPECT_EQ(is_drawn(figure, t, "nose"), t == 1) << t;
        EXPECT_EQ(is_drawn(figure, t, "face_7 to face_8"), t != 1) << t;
    }
}

TEST(StickFigure, LeftAndRightHaveTheirOwnColours) {
    const StickFigure figure = make_stick_figure(standing(1), {});
    std::vector<std::string> names;
    for (const Surface& surface : figure.avatar.surfaces) names.push_back(surface.name);
    EXPECT_THAT(names, ::testing::ElementsAre("trunk", "left arm", "right arm", "left leg", "right leg",
                                              "left hand", "right hand"));
    for (size_t a = 1; a < 3; ++a) {
        for (size_t b = a + 1; b < 5; ++b) {
            const auto colour = [&](size_t i) {
                return figure.avatar.materials[static_cast<size_t>(figure.avatar.surfaces[i].material)]
                    .base_colour;
            };
            EXPECT_GT(glm::distance(colour(a), colour(b)), 0.15f) << a << " " << b;
        }
    }
}

TEST(StickFigure, AnyMotionIsDrawnOnItsFloor) {
    for (const std::string& name : testing::present(
             {"tests/fixtures/gestures/walk.bvh", "tests/fixtures/gestures/beats.bvh",
              "tests/fixtures/gestures/jacks.bvh", "tests/fixtures/gestures/mediapipe_world33_25fps.json",
              "../shared/data/motion/bvh/ad_zombie.bvh",
              "../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
              "../shared/data/motion/bvh/mh_walk1.bvh",
              "../shared/data/motion/keypoints3d/mediapipe_world33.json"})) {
        const Motion motion = read_motion(testing::test_file(name));
        const StickFigure figure = make_stick_figure(motion, {});
        const Bounds rest = bounds_of(rest_mesh(figure.avatar));
        EXPECT_NEAR(rest.low.y, 0, 0.1f) << name;
        EXPECT_NEAR(rest.high.y, 1.65f, 0.25f) << name;
        const Bounds bounds = bounds_of(skin(figure.avatar, figure.fit.poses.front()));
        EXPECT_GT(bounds.low.y, -0.15f) << name;
        EXPECT_LT(bounds.high.y, 2.5f) << name;
    }
}

TEST(StickFigure, AMotionWithoutABodyIsRefused) {
    const Motion face{.source = "face.csv", .fps = 30, .frames = 1};
    EXPECT_EQ(
        refusal_of([&] { make_stick_figure(face, {}); }),
        "face.csv: has neither joints nor keypoints to draw a stick figure of; give the motion of a body");
}

TEST(StickFigure, KeypointsWithoutAShoulderAreRefused) {
    Motion motion = keypoints({{"left_shoulder", {0, 1, 0}}, {"left_elbow", {0, 0.7f, 0}}}, 2);
    EXPECT_THAT(
        refusal_of([&] { make_stick_figure(motion, {}); }),
        HasSubstr("points: right_shoulder is not seen in any of its 2 frames; both shoulders are needed"));
}

}  // namespace
}  // namespace chironomia
