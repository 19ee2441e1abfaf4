#include "skinning/face/face_drive.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "core/text.h"
#include "skinning/face/face_map.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/skinning/face/face_figure.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using testing::face_of;
using testing::faced_avatar;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::posed_with;
using testing::test_file;
using testing::weight_of;

constexpr float kDegree = kPi / 180;

TEST(DriveFace, MovesAMorphInProportionToTheIntensity) {
    const Avatar avatar = faced_avatar({"AU12_L", "AU12_R", "AU17"});
    const FaceTrack track = face_of({{"AU12_L", 5}, {"AU12_R", 2}, {"AU17", 1}});
    EXPECT_FLOAT_EQ(weight_of(avatar, track, "AU12_L"), 1);
    EXPECT_FLOAT_EQ(weight_of(avatar, track, "AU12_R"), .4f);
    EXPECT_FLOAT_EQ(weight_of(avatar, face_of({{"AU17", 1}}), "AU17"), .2f);
    EXPECT_EQ(weight_of(avatar, face_of({{"AU12_R", 5}}), "AU12_L"), 0);
}

TEST(DriveFace, AWholeUnitDrivesBothSidesAndSidesTheirMean) {
    const Avatar sided = faced_avatar({"mouthSmileLeft", "mouthSmileRight"});
    for (const char* morph : {"mouthSmileLeft", "mouthSmileRight"})
        EXPECT_FLOAT_EQ(weight_of(sided, face_of({{"AU12", 3}}), morph), .6f);
    const Avatar whole = faced_avatar({"AU12"});
    EXPECT_FLOAT_EQ(weight_of(whole, face_of({{"AU12_L", 5}, {"AU12_R", 1}}), "AU12"), .6f);
}

TEST(DriveFace, MovesTheVertexWhereTheMorphIs) {
    const Avatar avatar = faced_avatar({"AU12"});
    const PosedMesh still = posed_with(avatar, face_of({{"AU12", 0}}));
    const PosedMesh smile = posed_with(avatar, face_of({{"AU12", 2.5f}}));
    EXPECT_NEAR(distance(smile.surfaces[0].positions[0], still.surfaces[0].positions[0]), .5f, 1e-5f);
    EXPECT_EQ(smile.surfaces[0].positions[1], still.surfaces[0].positions[1]);
}

TEST(DriveFace, GainsAreHeldToTheFullIntensityAndCounted) {
    const Avatar avatar = faced_avatar({"AU1", "AU12"});
    const FaceTrack track = face_of({{"AU1", 2}, {"AU12", 4}});
    const FacedPoses faced = drive_face(track, avatar, {rest_pose(avatar)}, {.gains = {{1, 0.5}, {12, 2.0}}});
    EXPECT_THAT(faced.poses[0].morph_weights, ElementsAre(.2f, 1.0f));
    EXPECT_EQ(faced.report.full.at(12), 1u);
    EXPECT_EQ(faced.report.full.count(1), 0u);
}

TEST(DriveFace, AMorphOfSeveralUnitsTakesTheLargest) {
    const Avatar avatar = faced_avatar({"mouthLowerDownLeft", "mouthLowerDownRight"});
    EXPECT_FLOAT_EQ(weight_of(avatar, face_of({{"AU25", 5}}), "mouthLowerDownLeft"), .5f);
    // AU16 is held back to 60 % by AU25, which asks for half.
    EXPECT_FLOAT_EQ(weight_of(avatar, face_of({{"AU25", 5}, {"AU16", 5}}), "mouthLowerDownLeft"), .6f);
}

TEST(DriveFace, AMorphWithAWeightAtRestBeginsThereAndEndsAtOne) {
    Avatar avatar = faced_avatar({"AU12"});
    avatar.rest_morph_weights = {.4f};
    EXPECT_FLOAT_EQ(weight_of(avatar, face_of({{"AU12", 0}}), "AU12"), .4f);
    EXPECT_FLOAT_EQ(weight_of(avatar, face_of({{"AU12", 2.5f}}), "AU12"), .7f);
    EXPECT_FLOAT_EQ(weight_of(avatar, face_of({{"AU12", 5}}), "AU12"), 1);
}

TEST(DriveFace, NoMorphPassesItsRangeWhateverMeets) {
    const Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    FaceTrack track;
    for (const int unit : known_action_units()) {
        track.channels.push_back({.unit = unit});
        track.intensities.push_back(5);
    }
    track.gaze = {{.left = {.5f, -.6f}, .right = {.5f, -.6f}}};
    const FacedPoses faced = drive_face(track, avatar, {rest_pose(avatar)});
    for (const float weight : faced.poses[0].morph_weights) {
        EXPECT_GE(weight, 0);
        EXPECT_LE(weight, 1);
    }
}

TEST(DriveFace, LipsTowardEachOtherCloseTheMouthOrHoldTheJaw) {
    const FaceTrack track = face_of({{"AU26", 3}, {"AU8", 2}});
    const Avatar arkit = faced_avatar({"jawOpen", "mouthClose"}), other = faced_avatar({"AU26"});
    EXPECT_FLOAT_EQ(weight_of(arkit, track, "jawOpen"), .42f);
    EXPECT_FLOAT_EQ(weight_of(arkit, track, "mouthClose"), .28f);
    EXPECT_FLOAT_EQ(weight_of(other, track, "AU26"), .2f);
    EXPECT_EQ(weight_of(other, face_of({{"AU26", 1}, {"AU8", 2}}), "AU26"), 0);
    EXPECT_THAT(shown_by(map_face(other), other, {.unit = 8}), ElementsAre("AU26"));
}

TEST(DriveFace, DoesNothingIfAllIsSwitchedOff) {
    const Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    FaceTrack track = face_of({{"AU12", 5}, {"AU45", 5}});
    track.head = {glm::angleAxis(.5f, Vec3(0, 1, 0))};
    track.gaze = {{.left = {.3f, .1f}, .right = {.3f, .1f}}};
    const Pose rest = rest_pose(avatar);
    const FacedPoses faced =
        drive_face(track, avatar, {rest}, {.units = false, .gaze = false, .head = HeadTurn::keep});
    EXPECT_EQ(faced.poses[0].morph_weights, rest.morph_weights);
    EXPECT_EQ(faced.poses[0].joints, rest.joints);
    EXPECT_THAT(faced.report.channels, IsEmpty());
    EXPECT_EQ(faced.report.head, "kept");
    EXPECT_EQ(faced.report.gaze, "");
}

TEST(DriveFace, WarnsOnceByNameOfWhatAnAvatarCannotShow) {
    FaceTrack track = face_of({{"AU12", 5}, {"AU1", 3}, {"AU45_L", 1}, {"AU9", 0}});
    track.gaze = {{.left = {.1f, 0}, .right = {.1f, 0}}};
    const Avatar bare = faced_avatar({});
    EXPECT_THAT(warnings_of(drive_face(track, bare, {rest_pose(bare)}).report),
                ElementsAre("person.glb: cannot show AU12 lip corner puller, AU1 inner brow raiser, AU45_L "
                            "blink: it has no morphs",
                            "person.glb: cannot turn its eyes: it has neither eye joints nor look morphs"));
    const Avatar odd = faced_avatar({"mouthSmileLeft", "mouthSmileRight", "wink"});
    track.gaze.clear();
    const FaceReport report = drive_face(track, odd, {rest_pose(odd)}).report;
    EXPECT_THAT(warnings_of(report),
                ElementsAre("person.glb: cannot show AU1 inner brow raiser, AU45_L blink: none of its 3 "
                            "morphs is named for it"));
    const Json json = to_json(report);
    EXPECT_EQ(json["shown"]["AU12"], Json({"mouthSmileLeft", "mouthSmileRight"}));
    EXPECT_EQ(json["cannot_show"][0], Json({{"unit", "AU1"}, {"name", "inner brow raiser"}}));
}

TEST(DriveFace, IsTheSameEveryTime) {
    const Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    FaceTrack track = face_of({{"AU12", 3.3f}, {"AU26", 1.7f}, {"AU6_L", 2}});
    track.head = {normalize(Quat(.9f, .1f, .2f, -.1f))};
    track.gaze = {{.left = {.2f, -.3f}, .right = {.25f, -.3f}}};
    const Pose first = drive_face(track, avatar, {rest_pose(avatar)}).poses[0];
    const Pose again = drive_face(track, avatar, {rest_pose(avatar)}).poses[0];
    EXPECT_EQ(first.morph_weights, again.morph_weights);
    EXPECT_EQ(first.joints, again.joints);
}

// Head and gaze on rigs of every kind: turned axes, several neck joints, a joint above all that turns.

Quat turn_since_rest(const Avatar& avatar, const Pose& pose, int joint) {
    const auto j = static_cast<size_t>(joint);
    const Quat rest = rotation_of(world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton))[j]);
    return rotation_of(world_from_joints(avatar.skeleton, pose.joints)[j]) * conjugate(rest);
}

const Quat kHead = glm::angleAxis(25 * kDegree, Vec3(0, 1, 0)) *
                   glm::angleAxis(-14 * kDegree, Vec3(1, 0, 0)) * glm::angleAxis(9 * kDegree, Vec3(0, 0, 1));

class HeadOf : public ::testing::TestWithParam<std::string> {
  protected:
    Avatar avatar() const { return read_avatar(test_file(GetParam())); }
};

TEST_P(HeadOf, TurnsAsTheFaceSaysWhateverTheBodyDoes) {
    const Avatar avatar = this->avatar();
    FaceTrack track;
    track.head = {kHead};
    Pose leaning = rest_pose(avatar);
    auto& hips = leaning.joints[static_cast<size_t>(avatar.humanoid[HumanJoint::hips])];
    hips.rotation = hips.rotation * glm::angleAxis(.3f, Vec3(0, 0, 1));
    for (const Pose& pose : {rest_pose(avatar), leaning}) {
        const Pose faced = drive_face(track, avatar, {pose}).poses[0];
        const int head = map_face(avatar).joints.neck.back();
        EXPECT_LT(angle_between(turn_since_rest(avatar, faced, head), kHead) / kDegree, 0.05f);
    }
}

TEST_P(HeadOf, SharesTheTurnEvenlyAlongTheNeck) {
    const Avatar avatar = this->avatar();
    FaceTrack track;
    track.head = {kHead};
    const Pose faced = drive_face(track, avatar, {rest_pose(avatar)}).poses[0];
    const std::vector<int> neck = map_face(avatar).joints.neck;
    const float whole = angle_between(kNoTurn, kHead);
    for (size_t n = 0; n < neck.size(); ++n) {
        const float expected = whole * static_cast<float>(n + 1) / static_cast<float>(neck.size());
        EXPECT_NEAR(angle_between(turn_since_rest(avatar, faced, neck[n]), kNoTurn) / kDegree,
                    expected / kDegree, 0.1f);
    }
}

TEST_P(HeadOf, AddsToTheBodysTurnWhenAsked) {
    const Avatar avatar = this->avatar();
    FaceTrack track;
    track.head = {glm::angleAxis(20 * kDegree, Vec3(0, 1, 0))};
    const Pose turned = drive_face(track, avatar, {rest_pose(avatar)}).poses[0];
    const Pose twice = drive_face(track, avatar, {turned}, {.head = HeadTurn::add}).poses[0];
    const int head = map_face(avatar).joints.neck.back();
    EXPECT_LT(
        angle_between(turn_since_rest(avatar, twice, head), glm::angleAxis(40 * kDegree, Vec3(0, 1, 0))) /
            kDegree,
        0.05f);
    const Pose kept = drive_face(track, avatar, {turned}, {.head = HeadTurn::keep}).poses[0];
    EXPECT_EQ(kept.joints, turned.joints);
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, HeadOf,
    ::testing::ValuesIn(testing::present(
        {"assets/avatars/neutral.glb", "made/makehuman.glb", "made/mixamo.glb", "made/vrm.vrm",
         "made/numbered.glb", "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
         "../shared/data/avatars/tests/mh_neutral_poseunits.glb",
         "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
         "../shared/data/avatars/tests/mh_neutral_vrm1.vrm", "../shared/data/avatars/tests/CesiumMan.glb"})),
    [](const auto& test) { return testing::test_name_of(test.param); });

// Where an eyeball looks: the turn that brings its vertices from the rest pose to where they are.
Vec3 middle(const PosedSurface& surface, const std::vector<size_t>& vertices) {
    Vec3 sum(0);
    for (const size_t v : vertices) sum += surface.positions[v];
    return sum / static_cast<float>(vertices.size());
}

struct Eyeball {
    size_t surface = 0;
    std::vector<size_t> vertices;
};

// Of the surfaces of the eyes the vertices on one side of the face.
Eyeball eyeball_of(const Avatar& avatar, const PosedMesh& rest, bool left) {
    Eyeball eye;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        if (to_lower(avatar.surfaces[s].name) != "eyes") continue;
        for (size_t v = 0; v < rest.surfaces[s].positions.size(); ++v) {
            if ((rest.surfaces[s].positions[v].x > 0) != left) continue;
            eye.surface = s;
            eye.vertices.push_back(v);
        }
    }
    return eye;
}

// Three directions at right angles, the first from the middle of the eyeball to its foremost vertex.
Mat3 axes_of(const PosedSurface& surface, const Eyeball& eye, size_t pole, size_t side) {
    const Vec3 centre = middle(surface, eye.vertices);
    const Vec3 ahead = normalize(surface.positions[pole] - centre);
    const Vec3 aside = normalize(cross(ahead, surface.positions[side] - centre));
    return {ahead, aside, cross(ahead, aside)};
}

// Where an eyeball that looked ahead at rest looks now.
Vec3 direction_of(const PosedMesh& rest, const PosedMesh& now, const Eyeball& eye) {
    const PosedSurface& before = rest.surfaces[eye.surface];
    size_t pole = eye.vertices[0], side = eye.vertices[0];
    for (const size_t v : eye.vertices) {
        if (before.positions[v].z > before.positions[pole].z) pole = v;
        if (before.positions[v].x > before.positions[side].x) side = v;
    }
    return axes_of(now.surfaces[eye.surface], eye, pole, side) *
           glm::transpose(axes_of(before, eye, pole, side)) * Vec3(0, 0, 1);
}

class GazeOf : public HeadOf {};

TEST_P(GazeOf, PointsBothEyesWithinHalfADegree) {
    const Avatar avatar = this->avatar();
    const PosedMesh rest = skin(avatar, rest_pose(avatar));
    // Joints go as far as eyes do, the shapes of these avatars only so far.
    const bool joints = map_face(avatar).joints.eyes[0] >= 0;
    for (const Vec2& direction : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
        const Vec2 angle = (joints ? 20.0f : 8.0f) * direction;
        FaceTrack track;
        track.gaze = {{.left = angle * kDegree, .right = angle * kDegree}};
        const FacedPoses faced = drive_face(track, avatar, {rest_pose(avatar)});
        EXPECT_EQ(faced.report.gaze_held, 0u);
        const PosedMesh now = skin(avatar, faced.poses[0]);
        for (const bool left : {true, false}) {
            const Vec3 looks = direction_of(rest, now, eyeball_of(avatar, rest, left));
            EXPECT_NEAR(std::atan2(looks.x, looks.z) / kDegree, angle.x, 0.5f);
            EXPECT_NEAR(std::asin(looks.y) / kDegree, angle.y, 0.5f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(TestAvatars, GazeOf,
                         ::testing::ValuesIn(testing::present(
                             {"assets/avatars/neutral.glb", "made/makehuman.glb", "made/mixamo.glb",
                              "made/vrm.vrm", "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
                              "../shared/data/avatars/tests/mh_neutral_poseunits.glb",
                              "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
                              "../shared/data/avatars/tests/mh_neutral_vrm1.vrm"})),
                         [](const auto& test) { return testing::test_name_of(test.param); });

// The joints of VRoid's flat irises lie far behind them: turned like eyeballs, they left the eyes white.
TEST(DriveFace, MovesWhatLiesFarFromItsEyeJointAsFarAsAnIris) {
    Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    const int eye = avatar.humanoid[HumanJoint::left_eye];
    const auto world = [&] {
        return world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton))[static_cast<size_t>(eye)];
    };
    const Mat4 before = world();
    const auto parent = static_cast<size_t>(avatar.skeleton.joints[static_cast<size_t>(eye)].parent);
    const Mat4 world_from_parent =
        world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton))[parent];
    avatar.skeleton.joints[static_cast<size_t>(eye)].rest.translation +=
        Vec3(inverse(world_from_parent) * Vec4(0, 0, -0.1f, 0));
    for (Skin& skin : avatar.skins) {
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            if (skin.joints[j] == eye)
                skin.joint_from_mesh[j] = inverse(world()) * before * skin.joint_from_mesh[j];
        }
    }
    FaceTrack track;
    track.gaze = {{.left = {float(20 * kDegree), 0}, .right = {float(20 * kDegree), 0}}};
    const Pose pose = drive_face(track, avatar, {rest_pose(avatar)}).poses[0];
    // What the joint carries has a radius of 12 to 18 mm, and its middle is 0.1 m in front.
    const float left = angle_between(turn_since_rest(avatar, pose, eye), kNoTurn) / float(kDegree);
    EXPECT_GT(left, 20 * (12 / 5.9f) * 0.012f / 0.1f);
    EXPECT_LT(left, 20 * (12 / 5.9f) * 0.018f / 0.1f);
    const Quat right = turn_since_rest(avatar, pose, avatar.humanoid[HumanJoint::right_eye]);
    EXPECT_NEAR(angle_between(right, kNoTurn) / kDegree, 20, 0.1f);
}

TEST(DriveFace, HoldsEyesAt45DegreesAndSaysSo) {
    const Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    FaceTrack track;
    track.gaze = {{.left = {1.2f, 0}, .right = {.1f, 0}}, {.left = {.1f, 0}, .right = {.1f, 0}}};
    const FacedPoses faced = drive_face(track, avatar, {rest_pose(avatar), rest_pose(avatar)});
    EXPECT_EQ(faced.report.gaze_held, 1u);
    EXPECT_THAT(warnings_of(faced.report)[0],
                HasSubstr("the gaze goes further than its eyes turn in 1 of 2 frames; they stop there"));
    const Quat turn = turn_since_rest(avatar, faced.poses[0], avatar.humanoid[HumanJoint::left_eye]);
    EXPECT_NEAR(angle_between(turn, kNoTurn) / kDegree, 45, 0.1f);
}

TEST(DriveFace, CountsGazeBeyondWhatItsShapesCanShow) {
    const Avatar avatar = read_avatar(test_file("made/mixamo.glb"));
    FaceTrack track;
    track.gaze = {{.left = {.6f, 0}, .right = {.6f, 0}}};
    EXPECT_EQ(drive_face(track, avatar, {rest_pose(avatar)}).report.gaze_held, 1u);
}

TEST(DriveFace, DropsTheJawJointOnlyWithoutAMorphForIt) {
    Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    const int jaw = avatar.humanoid[HumanJoint::jaw];
    ASSERT_GE(jaw, 0);
    const auto drop = [&] {
        const Pose faced = drive_face(face_of({{"AU26", 5}}), avatar, {rest_pose(avatar)}).poses[0];
        return turn_since_rest(avatar, faced, jaw);
    };
    EXPECT_LT(angle_between(drop(), kNoTurn) / kDegree, 0.05f);
    for (std::string& name : avatar.morph_names) name = "morph";
    EXPECT_LT(angle_between(drop(), glm::angleAxis(18 * kDegree, Vec3(1, 0, 0))) / kDegree, 0.05f);
    EXPECT_THAT(shown_by(map_face(avatar), avatar, {.unit = 26}), ElementsAre("joint jaw"));
}

}  // namespace
}  // namespace chironomia
