#include "skinning/degrade/degrade.h"

#include <gmock/gmock.h>

#include <cmath>

#include "skinning/degrade/degradations.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::source_dir;

const Vec3 kUp(0, 1, 0);

// A chest with two arms of two bones each, in a T-pose; the right arm's axes are turned half about.
Skeleton two_arms() {
    const auto joint = [](const char* name, int parent, Vec3 offset, Quat turn = kNoTurn) {
        return Joint{.name = name, .parent = parent, .rest = {.translation = offset, .rotation = turn}};
    };
    const Quat half = glm::angleAxis(kPi, kUp);
    Skeleton skeleton;
    skeleton.joints = {joint("chest", -1, {0, 1, 0}),
                       joint("left_arm", 0, {0.2f, 0, 0}),
                       joint("left_forearm", 1, {0.3f, 0, 0}),
                       joint("left_hand", 2, {0.25f, 0, 0}),
                       joint("right_arm", 0, {-0.2f, 0, 0}, half),
                       joint("right_forearm", 4, {0.3f, 0, 0}),
                       joint("right_hand", 5, {0.25f, 0, 0})};
    return skeleton;
}

Motion rest_motion(std::size_t frames, double fps = 10) {
    Motion motion{.source = "made.bvh",
                  .fps = fps,
                  .frames = frames,
                  .joints = JointTrack{},
                  .keypoints = {},
                  .notes = {}};
    motion.joints->skeleton = two_arms();
    for (std::size_t t = 0; t < frames; ++t) {
        for (const Joint& joint : motion.joints->skeleton.joints) {
            motion.joints->turns.push_back(joint.rest.rotation);
            motion.joints->translations.push_back(joint.rest.translation);
        }
    }
    return motion;
}

// The places of the joints at a frame, in the world.
std::vector<Vec3> places_at(const JointTrack& track, std::size_t frame) {
    std::vector<Transform> local = rest_transforms(track.skeleton);
    for (std::size_t j = 0; j < local.size(); ++j) {
        local[j].rotation = track.turns[frame * local.size() + j];
        local[j].translation = track.translations[frame * local.size() + j];
    }
    std::vector<Vec3> places;
    for (const Mat4& joint : world_from_joints(track.skeleton, local)) places.push_back(origin(joint));
    return places;
}

Quat& turn_of(Motion& motion, std::size_t frame, std::size_t joint) {
    return motion.joints->turns[frame * motion.joints->skeleton.joints.size() + joint];
}

Motion face_motion(const FaceTrack& face, std::size_t frames, double fps = 10) {
    return {.source = "face.csv",
            .fps = fps,
            .frames = frames,
            .joints = {},
            .keypoints = {},
            .face = face,
            .notes = {}};
}

TEST(DegradationNamed, ReadsWhatItWrites) {
    for (const char* text : {"frozen", "mirrored", "delayed:250", "delayed:33.5", "damped:0", "damped:0.5",
                             "jittered:3:1", "jittered:0.5:42"})
        EXPECT_EQ(to_text(degradation_named(text)), text);
    EXPECT_EQ(degradation_named("jittered:3"), degradation_named("jittered:3:1"));
}

TEST(DegradationNamed, RefusesAnythingElse) {
    for (const char* text : {"", "slow", "frozen:1", "delayed", "delayed:0", "delayed:-5", "delayed:60001",
                             "damped:1", "damped:x", "damped:0.5:1", "jittered:0", "jittered:91",
                             "jittered:3:-1", "jittered:3:1:2", "jittered:nan"}) {
        EXPECT_EQ(
            refusal_of([&] { degradation_named(text); }),
            "\"" + std::string(text) +
                "\" is no anchor; write frozen, mirrored, delayed:MS (up to 60000), damped:FACTOR (0 to below "
                "1), or jittered:DEGREES (up to 90) with or without :SEED");
    }
}

// An arm that swings evenly from -1 to 1 is at 0 in the middle: frame 10 of 21.
TEST(Frozen, HoldsTheFrameNearestToTheMean) {
    Motion motion = rest_motion(21);
    for (std::size_t t = 0; t < 21; ++t) {
        turn_of(motion, t, 1) = glm::angleAxis(0.1f * static_cast<float>(t) - 1, Vec3(0, 0, 1));
        motion.joints->translations[t * 7].x = static_cast<float>(t);  // walking is no posture
    }
    const Motion still = degrade(motion, degradation_named("frozen"));
    ASSERT_EQ(still.frames, 21u);
    for (std::size_t t = 0; t < 21; ++t)
        EXPECT_EQ(places_at(*still.joints, t), places_at(*motion.joints, 10));
    EXPECT_THAT(still.notes,
                Contains("frozen in frame 10 (1.000 s), of 21 the one nearest to the mean posture"));
    EXPECT_THAT(still.notes, Contains("anchor: frozen"));
}

TEST(Frozen, PrefersAFrameInWhichAllIsSeen) {
    Motion motion{
        .source = "a", .fps = 10, .frames = 3, .joints = {}, .keypoints = KeypointTrack{}, .notes = {}};
    motion.keypoints->names = {"nose", "left_wrist"};
    motion.keypoints->points = {{0, 0, 0}, {0.4f, 0, 0}, {0, 0, 0}, {0.5f, 0, 0}, {0, 0, 0}, {0.9f, 0, 0}};
    motion.keypoints->confidence = {1, 1, 1, 0, 1, 1};
    const Motion still = degrade(motion, degradation_named("frozen"));
    EXPECT_EQ(still.keypoints->points[1].x, still.keypoints->points[5].x);
    EXPECT_EQ(still.keypoints->confidence, (std::vector<float>{1, 1, 1, 1, 1, 1}));
}

TEST(Frozen, HoldsAFaceOfItsOwn) {
    const Motion still = degrade(face_motion({.channels = {{12, FaceSide::both}},
                                              .intensities = {0, 5, 2.4f},
                                              .head = {},
                                              .gaze = {},
                                              .confidence = {}},
                                             3),
                                 degradation_named("frozen"));
    EXPECT_EQ(still.face->intensities, (std::vector<float>{2.4f, 2.4f, 2.4f}));
    EXPECT_THAT(still.notes,
                Contains("frozen in frame 2 (0.200 s), of 3 the one nearest to the mean of the face"));
}

// The mirror image of every joint stands where its partner stood, whatever the axes of both are.
TEST(Mirrored, PutsEveryJointWhereItsPartnerWas) {
    Motion motion = rest_motion(2);
    turn_of(motion, 0, 0) = normalize(Quat(0.9f, 0.1f, 0.3f, -0.2f));
    turn_of(motion, 0, 1) = normalize(Quat(0.8f, 0.3f, -0.2f, 0.5f));
    turn_of(motion, 0, 2) = normalize(Quat(0.7f, 0.2f, 0.6f, 0.1f));
    turn_of(motion, 0, 4) = normalize(Quat(0.2f, 0.1f, 0.9f, -0.3f));
    motion.joints->translations[0] = {0.5f, 1.2f, 0.3f};
    const Motion other = degrade(motion, degradation_named("mirrored"));
    constexpr std::size_t kPartner[] = {0, 4, 5, 6, 1, 2, 3};
    for (const std::size_t frame : {0, 1}) {
        const auto before = places_at(*motion.joints, frame), after = places_at(*other.joints, frame);
        for (std::size_t j = 0; j < 7; ++j)
            EXPECT_LT(distance(after[j], before[kPartner[j]] * Vec3(-1, 1, 1)), 1e-5f) << frame << " " << j;
    }
    const Motion twice = degrade(other, degradation_named("mirrored"));
    for (std::size_t i = 0; i < motion.joints->turns.size(); ++i)
        EXPECT_LT(angle_between(twice.joints->turns[i], motion.joints->turns[i]), 1e-3f);
}

// The rest pose of the right arm hangs, that of the left is straight out.
TEST(Mirrored, UnderstandsAnAsymmetricRestPose) {
    Motion motion = rest_motion(1);
    motion.joints->skeleton.joints[4].rest.rotation =
        glm::angleAxis(1.2f, Vec3(0, 0, 1)) * motion.joints->skeleton.joints[4].rest.rotation;
    turn_of(motion, 0, 1) = glm::angleAxis(-0.8f, Vec3(0, 0, 1));
    const Motion other = degrade(motion, degradation_named("mirrored"));
    const auto before = places_at(*motion.joints, 0), after = places_at(*other.joints, 0);
    EXPECT_LT(distance(after[6], before[3] * Vec3(-1, 1, 1)), 1e-5f);
    EXPECT_LT(distance(after[3], before[6] * Vec3(-1, 1, 1)), 1e-5f);
}

TEST(Mirrored, SwapsTheNamesOfPoints) {
    Motion motion{
        .source = "a", .fps = 10, .frames = 1, .joints = {}, .keypoints = KeypointTrack{}, .notes = {}};
    motion.keypoints->names = {"nose", "left_wrist", "right_wrist"};
    motion.keypoints->points = {{0.1f, 2, 0}, {1, 1, 3}, {-2, 0, 0}};
    motion.keypoints->confidence = {1, 1, 1};
    motion.picture = PictureTrack{.names = {"nose", "left_elbow", "face_0", "face_36", "face_27"},
                                  .points = {{100, 5}, {130, 50}, {90, 6}, {95, 4}, {1000, 0}},
                                  .confidence = {1, 1, 1, 1, 0}};
    const Motion other = degrade(motion, degradation_named("mirrored"));
    EXPECT_EQ(other.keypoints->names, (std::vector<std::string>{"nose", "right_wrist", "left_wrist"}));
    EXPECT_EQ(other.keypoints->points, (std::vector<Vec3>{{-0.1f, 2, 0}, {-1, 1, 3}, {2, 0, 0}}));
    EXPECT_EQ(other.picture->names,
              (std::vector<std::string>{"nose", "right_elbow", "face_16", "face_45", "face_27"}));
    // About the middle of what is seen, 103.75.
    EXPECT_EQ(other.picture->points[1], Vec2(77.5f, 50));
}

TEST(Mirrored, ChangesTheSidesOfAFace) {
    const Quat nod = glm::angleAxis(0.3f, Vec3(1, 0, 0)), shake = glm::angleAxis(0.4f, kUp);
    const Motion other = degrade(face_motion({.channels = {{12, FaceSide::left}, {1, FaceSide::both}},
                                              .intensities = {3, 1},
                                              .head = {shake * nod},
                                              .gaze = {{.left = {0.1f, 0.2f}, .right = {0.3f, 0.4f}}},
                                              .confidence = {}},
                                             1),
                                 degradation_named("mirrored"));
    EXPECT_EQ(other.face->channels, (std::vector<FaceChannel>{{12, FaceSide::right}, {1, FaceSide::both}}));
    EXPECT_EQ(other.face->intensities, (std::vector<float>{3, 1}));
    EXPECT_LT(angle_between(other.face->head[0], conjugate(shake) * nod), 1e-3f);
    EXPECT_EQ(other.face->gaze[0].left, Vec2(-0.3f, 0.4f));
    EXPECT_EQ(other.face->gaze[0].right, Vec2(-0.1f, 0.2f));
}

// What the left hand rests on is what the right one did; hands that do not arrive rest on nothing.
TEST(Mirrored, ChangesTheHandsThatRestAndDampedOrJitteredOnesDoNotRest) {
    Motion motion = rest_motion(2);
    motion.labels = {{.name = "gesture", .values = {"-"}, .frames = {0, 0}},
                     {.name = "left touch", .values = {"nothing"}, .frames = {0, 0}},
                     {.name = "right touch", .values = {"head"}, .frames = {0, 0}}};
    const auto names = [&](const char* degradation) {
        std::vector<std::string> all;
        for (const LabelTrack& track : degrade(motion, degradation_named(degradation)).labels)
            all.push_back(track.name + "=" + track.values[0]);
        return all;
    };
    EXPECT_THAT(names("mirrored"),
                ::testing::ElementsAre("gesture=-", "right touch=nothing", "left touch=head"));
    EXPECT_THAT(names("damped:0.5"), ::testing::ElementsAre("gesture=-"));
    EXPECT_THAT(names("jittered:3"), ::testing::ElementsAre("gesture=-"));
}

TEST(Delayed, HoldsTheFirstPostureAndComesLate) {
    Motion motion = rest_motion(20);
    for (std::size_t t = 0; t < 20; ++t) motion.joints->translations[t * 7].x = static_cast<float>(t);
    const Motion late = degrade(motion, degradation_named("delayed:500"));
    ASSERT_EQ(late.frames, 20u);
    for (std::size_t t = 0; t < 20; ++t)
        EXPECT_EQ(late.joints->translations[t * 7].x, t < 5 ? 0.0f : static_cast<float>(t - 5)) << t;
    const Motion between = degrade(motion, degradation_named("delayed:250"));
    EXPECT_NEAR(between.joints->translations[7 * 10].x, 7.5f, 1e-5f);
    EXPECT_NEAR(between.joints->translations[7 * 2].x, 0, 1e-5f);
    EXPECT_EQ(refusal_of([&] { degrade(motion, degradation_named("delayed:2000")); }),
              "made.bvh: lasts 2.000 s and would be delayed by 2.000 s; choose a shorter delay");
}

TEST(MeanTurn, IsTheMiddleOfTheShortestWays) {
    const auto about = [](float angle) { return glm::angleAxis(angle, normalize(Vec3(1, 2, -1))); };
    EXPECT_LT(angle_between(mean_turn({about(0.2f), about(1.0f)}), about(0.6f)), 1e-4f);
    EXPECT_LT(angle_between(mean_turn({about(0.2f), -about(0.4f), about(0.9f)}), about(0.5f)), 1e-4f);
    // On both sides of half a turn: the mean is half a turn, not none.
    EXPECT_LT(angle_between(mean_turn({about(3), about(-3)}), about(kPi)), 1e-3f);
}

// A swing from -1 to 1 about 0.2 becomes one from -0.4 to 0.6... by half: its mean stays, its ways are
// halved.
TEST(Damped, HalvesTheWaysFromTheMean) {
    Motion motion = rest_motion(3);
    const float angles[] = {-0.8f, 0.2f, 1.2f};
    for (std::size_t t = 0; t < 3; ++t) {
        turn_of(motion, t, 1) = glm::angleAxis(angles[t], Vec3(0, 0, 1));
        motion.joints->translations[t * 7].z = static_cast<float>(t);
    }
    Motion half = degrade(motion, degradation_named("damped:0.5"));
    for (std::size_t t = 0; t < 3; ++t) {
        EXPECT_LT(angle_between(turn_of(half, t, 1),
                                glm::angleAxis(0.2f + 0.5f * (angles[t] - 0.2f), Vec3(0, 0, 1))),
                  1e-3f);
        EXPECT_NEAR(half.joints->translations[t * 7].z, 1 + 0.5f * (static_cast<float>(t) - 1), 1e-6f);
        EXPECT_LT(angle_between(turn_of(half, t, 4), turn_of(motion, t, 4)), 1e-3f);
    }
    Motion none = degrade(motion, degradation_named("damped:0"));
    for (std::size_t t = 0; t < 3; ++t)
        EXPECT_LT(angle_between(turn_of(none, t, 1), glm::angleAxis(0.2f, Vec3(0, 0, 1))), 1e-3f);
}

// A forearm that swings between up and forward points halfway at a factor of 0, and is as long as before.
TEST(Damped, TurnsTheBonesOfPointsAndKeepsTheirLengths) {
    Motion motion{
        .source = "a", .fps = 10, .frames = 2, .joints = {}, .keypoints = KeypointTrack{}, .notes = {}};
    motion.keypoints->names = {"left_wrist", "left_elbow", "left_thumb_1"};
    motion.keypoints->points = {{0, 2, 0}, {0, 1, 0}, {0, 2.1f, 0}, {0, 1, 1}, {0, 1, 0}, {0, 1, 1.1f}};
    motion.keypoints->confidence.assign(6, 1);
    const auto points = degrade(motion, degradation_named("damped:0")).keypoints->points;
    const float half = std::sqrt(0.5f);
    EXPECT_LT(distance(points[0], Vec3(0, 1 + half, half)), 1e-5f);
    EXPECT_LT(distance(points[3], Vec3(0, 1 + half, half)), 1e-5f);
    EXPECT_LT(distance(points[2], Vec3(0, 1 + 1.1f * half, 1.1f * half)), 1e-5f);
    const auto nearly = degrade(motion, degradation_named("damped:0.5")).keypoints->points;
    EXPECT_LT(distance(nearly[0], Vec3(0, 1 + std::cos(kPi / 8), std::sin(kPi / 8))), 1e-5f);
}

TEST(Damped, DampsAFace) {
    const Motion half = degrade(face_motion({.channels = {{12, FaceSide::both}, {45, FaceSide::both}},
                                             .intensities = {0, 5, 4, 0},
                                             .head = {kNoTurn, glm::angleAxis(0.4f, kUp)},
                                             .gaze = {{{0.2f, 0}, {0, 0}}, {{0, 0}, {0, 0.4f}}},
                                             .confidence = {}},
                                            2),
                                degradation_named("damped:0.5"));
    EXPECT_EQ(half.face->intensities, (std::vector<float>{1, 3.75f, 3, 1.25f}));
    EXPECT_LT(angle_between(half.face->head[0], glm::angleAxis(0.1f, kUp)), 1e-3f);
    EXPECT_LT(distance(half.face->gaze[0].left, Vec2(0.15f, 0)), 1e-6f);
    EXPECT_LT(distance(half.face->gaze[1].right, Vec2(0, 0.3f)), 1e-6f);
}

// How far joint 2 turns from where it was about one of its axes, of each frame [degrees].
std::vector<double> trembling(const Motion& before, const Motion& after, int axis) {
    std::vector<double> angles;
    for (std::size_t t = 0; t < before.frames; ++t) {
        Quat way = conjugate(before.joints->turns[t * 7 + 2]) * after.joints->turns[t * 7 + 2];
        if (way.w < 0) way = -way;
        const Vec3 sine(way.x, way.y, way.z);
        const float share =
            length(sine) > 1e-9f ? 2 * std::asin(std::min(1.0f, length(sine))) / length(sine) : 2;
        angles.push_back(static_cast<double>(sine[axis] * share) * 180 / std::numbers::pi);
    }
    return angles;
}

// The power of a series between two frequencies, as a share of the whole.
double share_of_power(const std::vector<double>& series, double fps, double lowest, double highest) {
    double inside = 0, all = 0;
    for (std::size_t k = 1; k < series.size() / 2; ++k) {
        double real = 0, imaginary = 0;
        for (std::size_t t = 0; t < series.size(); ++t) {
            const double phase = 2 * std::numbers::pi * static_cast<double>(k * t % series.size()) /
                                 static_cast<double>(series.size());
            real += series[t] * std::cos(phase);
            imaginary += series[t] * std::sin(phase);
        }
        const double hertz = static_cast<double>(k) * fps / static_cast<double>(series.size());
        const double power = real * real + imaginary * imaginary;
        all += power;
        if (hertz > lowest && hertz < highest) inside += power;
    }
    return inside / all;
}

TEST(Jittered, TremblesAsStronglyAsAskedBetweenTwoAndEightHertz) {
    const Motion motion = rest_motion(1800, 30);
    const Motion shaken = degrade(motion, degradation_named("jittered:3"));
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double> angles = trembling(motion, shaken, axis);
        double power = 0;
        for (const double angle : angles) power += angle * angle / static_cast<double>(angles.size());
        EXPECT_NEAR(std::sqrt(power), 3, 0.3);
        EXPECT_GT(share_of_power(angles, 30, 1.9, 8.1), 0.98);
    }
    EXPECT_EQ(shaken.joints->turns[0], motion.joints->turns[0]);  // the root stands
}

TEST(Jittered, IsTheSameForTheSameSeedAndAtAnyRate) {
    Motion slow = rest_motion(60, 30), fast = rest_motion(120, 60);
    Motion a = degrade(slow, degradation_named("jittered:3:5")),
           b = degrade(slow, degradation_named("jittered:3:5"));
    EXPECT_EQ(a.joints->turns, b.joints->turns);
    EXPECT_NE(a.joints->turns, degrade(slow, degradation_named("jittered:3:6")).joints->turns);
    Motion c = degrade(fast, degradation_named("jittered:3:5"));
    for (std::size_t t = 0; t < 60; ++t)
        EXPECT_LT(angle_between(turn_of(a, t, 3), turn_of(c, 2 * t, 3)), 1e-3f);
}

TEST(Jittered, TurnsBonesOfPointsWithAllThatTheyCarry) {
    Motion motion{
        .source = "a", .fps = 30, .frames = 300, .joints = {}, .keypoints = KeypointTrack{}, .notes = {}};
    motion.keypoints->names = {"left_shoulder", "left_elbow", "left_wrist"};
    motion.picture = PictureTrack{.names = motion.keypoints->names, .points = {}, .confidence = {}};
    for (int t = 0; t < 300; ++t) {
        motion.keypoints->points.insert(motion.keypoints->points.end(),
                                        {{0, 1, 0}, {0.3f, 1, 0}, {0.6f, 1, 0}});
        motion.picture->points.insert(motion.picture->points.end(), {{100, 100}, {160, 100}, {220, 100}});
    }
    motion.keypoints->confidence.assign(900, 1);
    motion.keypoints->confidence[4] = 0;  // the elbow of the second frame
    motion.picture->confidence.assign(900, 1);
    const Motion shaken = degrade(motion, degradation_named("jittered:5"));
    const auto& points = shaken.keypoints->points;
    double elbow = 0, wrist = 0;
    for (std::size_t t = 0; t < 300; ++t) {
        EXPECT_EQ(points[3 * t], Vec3(0, 1, 0));
        EXPECT_NEAR(distance(shaken.picture->points[3 * t + 2], shaken.picture->points[3 * t + 1]), 60, 1e-2);
        elbow += points[3 * t + 1].y - 1.0;
        if (t == 1) {
            EXPECT_EQ(points[4], Vec3(0.3f, 1, 0));
            EXPECT_NEAR(distance(points[5], points[3]), 0.6f, 1e-4f);
            continue;
        }
        EXPECT_NEAR(distance(points[3 * t + 1], points[3 * t]), 0.3f, 1e-4f);
        EXPECT_NEAR(distance(points[3 * t + 2], points[3 * t + 1]), 0.3f, 1e-4f);
        wrist = std::max<double>(wrist, std::abs(points[3 * t + 2].y - 1));
    }
    EXPECT_NEAR(elbow / 300, 0, 0.005);
    EXPECT_GT(wrist, 0.05);
}

TEST(Jittered, ShakesAFaceWithinItsRange) {
    FaceTrack face{
        .channels = {{12, FaceSide::both}}, .intensities = {}, .head = {}, .gaze = {}, .confidence = {}};
    face.intensities.assign(300, 2.5f);
    face.head.assign(300, kNoTurn);
    face.gaze.resize(300);
    const FaceTrack shaken = *degrade(face_motion(face, 300, 30), degradation_named("jittered:5")).face;
    double units = 0, turns = 0;
    for (std::size_t t = 0; t < 300; ++t) {
        units += std::pow(shaken.intensities[t] - 2.5, 2) / 300;
        turns += std::pow(angle_between(shaken.head[t], kNoTurn), 2) / 300;
        EXPECT_EQ(shaken.gaze[t].left, shaken.gaze[t].right);
    }
    EXPECT_NEAR(std::sqrt(units), 0.5, 0.1);
    EXPECT_NEAR(std::sqrt(turns) * 180 / std::numbers::pi, 5 * std::sqrt(3.0), 1);
}

// The bundled speaker on an avatar: of the mirror image the right hand is where the left hand was.
TEST(Mirrored, IsTheMirrorImageOnAnAvatarToo) {
    const Motion motion = read_motion(source_dir() / "assets/samples/expressive/two-ways.bvh");
    const Avatar avatar = read_avatar(source_dir() / "assets/avatars/mannequin.glb");
    const Fit fit = fit_motion(motion, avatar, {.fps = 30});
    const Fit other = fit_motion(degrade(motion, degradation_named("mirrored")), avatar, {.fps = 30});
    const auto place = [&](const Pose& pose, HumanJoint joint) {
        return origin(world_from_joints(avatar.skeleton,
                                        pose.joints)[static_cast<std::size_t>(avatar.humanoid[joint])]);
    };
    float most = 0;
    for (std::size_t t = 0; t < fit.poses.size(); t += 10) {
        for (const HumanJoint joint : {HumanJoint::left_hand, HumanJoint::right_lower_arm, HumanJoint::head,
                                       HumanJoint::left_index_3, HumanJoint::right_foot}) {
            most = std::max(most, distance(place(fit.poses[t], joint) * Vec3(-1, 1, 1),
                                           place(other.poses[t], mirrored(joint))));
        }
    }
    EXPECT_LT(most, 0.01f);
}

// Lifted out of the picture first: a bone that swings in depth does not become one that is short.
TEST(Damped, LiftsAPictureFirst) {
    const Motion motion = read_motion(testing::test_file("made/pats.h5"));
    const Motion half = degrade(motion, degradation_named("damped:0.5"));
    EXPECT_FALSE(half.picture);
    EXPECT_TRUE(half.keypoints);
    EXPECT_EQ(half.frames, motion.frames);
}

}  // namespace
}  // namespace chironomia
