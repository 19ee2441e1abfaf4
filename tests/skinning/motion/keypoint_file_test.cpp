// Keypoints in every form of file, through the one door: read_motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/points/npy.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::refusal_of;
using testing::test_file;

std::filesystem::path fixture(const std::string& name) {
    return testing::source_dir() / "tests/fixtures/motion" / name;
}

Vec3 place(const Motion& motion, size_t frame, Landmark landmark) {
    return landmarks_of(*motion.keypoints, {frame})[0][static_cast<size_t>(landmark)].value();
}

float confidence(const Motion& motion, size_t frame, Landmark landmark) {
    const auto& names = motion.keypoints->names;
    const auto k = std::find(names.begin(), names.end(), name_of(landmark)) - names.begin();
    return motion.keypoints->confidence.at(frame * names.size() + static_cast<size_t>(k));
}

// The figure of the fixtures: millimetres, z up, facing -y, as the Human3.6M recordings are.
void expect_standing_figure(const Motion& motion) {
    using enum Landmark;
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_DOUBLE_EQ(motion.fps, 50);
    EXPECT_LT(distance(place(motion, 0, head_top), Vec3(0, 1.68f, 0)), 1e-3f);
    EXPECT_LT(distance(place(motion, 0, nose), Vec3(0, 1.5f, 0.08f)), 1e-3f);
    EXPECT_LT(distance(place(motion, 0, left_wrist), Vec3(0.17f, 0.85f, 0.02f)), 1e-3f);
    EXPECT_LT(distance(place(motion, 1, left_wrist), Vec3(0.17f, 0.95f, 0.02f)), 1e-3f);
    EXPECT_LT(distance(place(motion, 1, right_wrist), Vec3(-0.17f, 0.85f, 0.02f)), 1e-3f);
    EXPECT_THAT(motion.notes, Contains(HasSubstr("up axis: z")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("unit: mm")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("facing: -y")));
}

TEST(KeypointFile, ReadsArchivesOfArrays) {
    for (const char* name : {"stored.npz", "deflated.npz", "flat.npz"}) {
        SCOPED_TRACE(name);
        expect_standing_figure(read_motion(fixture(name)));
    }
}

TEST(KeypointFile, FindsHuman36mByTheHipsAndByTheNames) {
    EXPECT_THAT(read_motion(fixture("stored.npz")).notes,
                Contains("keypoints: Human3.6M 17, by the number of points"));
    EXPECT_THAT(read_motion(fixture("deflated.npz")).notes,
                Contains("keypoints: Human3.6M 17, by their names"));
}

// The fixture's points with a confidence each; the root is missing in the first `frames`.
Motion without_root(size_t frames) {
    const auto arrays = parse_npz(read_bytes(fixture("stored.npz")), "stored.npz");
    const auto points = std::find_if(arrays.begin(), arrays.end(),
                                     [](const NumpyArray& array) { return array.name == "keypoints"; });
    std::vector<double> numbers;
    for (size_t i = 0; i < 2 * 17; ++i) {
        const bool missing = i % 17 == 0 && i / 17 < frames;
        for (size_t axis = 0; axis < 3; ++axis)
            numbers.push_back(missing ? 0 : points->numbers[3 * i + axis]);
        numbers.push_back(missing ? 0 : 1);
    }
    const testing::TemporaryFolder folder;
    testing::write_npy(folder / "a.npy", {2, 17, 4}, numbers);
    return read_motion(folder / "a.npy", {.fps = 50});
}

TEST(KeypointFile, KnowsHuman36mThoughARootIsMissing) {
    for (const size_t frames : {1, 2}) {
        EXPECT_THAT(without_root(frames).notes, Contains("keypoints: Human3.6M 17, by the number of points"));
    }
}

// The body of a recording in the order of a layout without its names; points that the recording lacks lie at the hip.
std::filesystem::path without_names(std::string_view layout_name, const testing::TemporaryFolder& folder,
                                    bool reversed = false, bool arms_only = false) {
    const Motion motion = read_motion(test_file("tests/fixtures/gestures/mediapipe_world33_25fps.json"));
    const auto& layouts = keypoint_layouts();
    const auto layout = std::find_if(layouts.begin(), layouts.end(),
                                     [&](const KeypointLayout& each) { return each.name == layout_name; });
    std::vector<double> numbers;
    for (const LandmarkFrame& frame : landmarks_of(*motion.keypoints, {0, 1, 2})) {
        std::vector<Vec3> points;
        for (const LayoutPoint& point : layout->points) {
            const auto& found = frame[size_t(point.ours.value_or(Landmark::left_hip))];
            const bool shown = !arms_only || point.name().find("_shoulder") != std::string::npos;
            points.push_back(shown ? found.value_or(*frame[size_t(Landmark::left_hip)]) : Vec3(NAN));
        }
        if (reversed) std::reverse(points.begin(), points.end());
        for (const Vec3& point : points) numbers.insert(numbers.end(), {point.x, point.y, point.z});
    }
    const std::filesystem::path file = folder / "a.npy";
    testing::write_npy(file, {3, layout->points.size(), 3}, numbers);
    return file;
}

TEST(KeypointFile, KnowsTheOrderOfPointsByTheLengthsOfBones) {
    const testing::TemporaryFolder folder;
    for (const char* layout : {"BODY_25", "Kinect 25", "COCO 17", "MediaPipe 33", "SMPL 22"}) {
        const Motion motion = read_motion(without_names(layout, folder), {.fps = 25});
        EXPECT_THAT(motion.notes, Contains(format("keypoints: {}, by the number of points", layout)));
        EXPECT_GT(place(motion, 0, Landmark::left_shoulder).x, place(motion, 0, Landmark::right_shoulder).x);
    }
}

// Of Human3.6M, where 0 0 0 is a place.
TEST(KeypointFile, KnowsTheOrderThoughLegsAreLeftAtZero) {
    const testing::TemporaryFolder folder;
    NumpyArray points = parse_npy(read_bytes(without_names("Human3.6M 17", folder)), "a.npy");
    for (size_t t = 0; t < 3; ++t) {
        for (const size_t leg : {2, 3, 5, 6}) std::fill_n(&points.numbers[3 * (17 * t + leg)], 3, 0.0);
    }
    testing::write_npy(folder / "a.npy", points.shape, points.numbers);
    EXPECT_THAT(read_motion(folder / "a.npy", {.fps = 25}).notes,
                Contains("keypoints: Human3.6M 17, by the number of points"));
}

TEST(KeypointFile, ZeroIsMissingInBody25) {
    const testing::TemporaryFolder folder;
    NumpyArray points = parse_npy(read_bytes(without_names("BODY_25", folder)), "a.npy");
    std::fill_n(points.numbers.begin() + 3 * 20, 3, 0.0);
    testing::write_npy(folder / "a.npy", points.shape, points.numbers);
    const Motion motion = read_motion(folder / "a.npy", {.fps = 25});
    EXPECT_EQ(confidence(motion, 0, Landmark::left_small_toe), 0);
    EXPECT_EQ(confidence(motion, 0, Landmark::nose), 1);
}

// Columns x1, y1, z1, v1 to v33, as many scripts for MediaPipe write its landmarks in the picture.
TEST(KeypointFile, TakesSharesOfAPictureForWhatTheyAre) {
    const testing::TemporaryFolder folder;
    const NumpyArray body = parse_npy(read_bytes(without_names("MediaPipe 33", folder)), "a.npy");
    std::string table;
    for (size_t k = 1; k <= 33; ++k) table += format("{0}x{1},y{1},z{1},v{1}", k > 1 ? "," : "", k);
    for (size_t i = 0; i < body.numbers.size(); i += 3) {
        const double* x = &body.numbers[i];
        table +=
            format("{}{},{},{},0.9", i % 99 == 0 ? "\n" : ",", 0.5 + 0.2 * x[0], 0.9 - 0.35 * x[1], -x[2]);
    }
    write_text(folder / "shares.csv", table);
    EXPECT_THAT(refusal_of([&] { read_motion(folder / "shares.csv", {.fps = 25}); }),
                HasSubstr("the places look like shares of the width and height of a picture whose size is "
                          "not known; set it with --picture-size"));
    const Motion motion =
        read_motion(folder / "shares.csv", {.fps = 25, .picture = {.size = Vec2(1280, 720)}});
    ASSERT_TRUE(motion.picture);
    EXPECT_NEAR(motion.picture->points[0].x, 1280 * (0.5 + 0.2 * body.numbers[0]), 0.01);
    EXPECT_NEAR(motion.picture->points[0].y, 720 * (0.9 - 0.35 * body.numbers[1]), 0.01);
}

// (T, K, 3) places of joints [m].
std::vector<double> places_of_joints(const JointTrack& track, size_t frames,
                                     const std::vector<HumanJoint>& parts) {
    const HumanoidMap map = find_humanoid(track.skeleton).map;
    const size_t joints = track.skeleton.joints.size();
    std::vector<double> places;
    for (size_t t = 0; t < frames; ++t) {
        std::vector<Transform> local = rest_transforms(track.skeleton);
        for (size_t j = 0; j < joints; ++j)
            local[j] = {.translation = track.translations[t * joints + j],
                        .rotation = track.turns[t * joints + j]};
        const std::vector<Mat4> world = world_from_joints(track.skeleton, local);
        for (const HumanJoint part : parts) {
            const Vec3 place = origin(world.at(static_cast<size_t>(map[part])));
            places.insert(places.end(), {place.x, place.y, place.z});
        }
    }
    return places;
}

using enum HumanJoint;
const std::vector<HumanJoint> kListed = {hips,
                                         spine,
                                         neck,
                                         head,
                                         left_shoulder,
                                         left_upper_arm,
                                         left_lower_arm,
                                         left_hand,
                                         right_shoulder,
                                         right_upper_arm,
                                         right_lower_arm,
                                         right_hand,
                                         left_upper_leg,
                                         left_lower_leg,
                                         left_foot,
                                         right_upper_leg,
                                         right_lower_leg,
                                         right_foot};

TEST(KeypointFile, KnowsJointsByTheNamesOfRigs) {
    const Motion recording = read_motion(test_file("tests/fixtures/gestures/beats.bvh"));
    const std::vector<double> places = places_of_joints(*recording.joints, 3, kListed);
    const std::vector<std::vector<std::string>> tables = {
        {"Hips", "Spine", "Neck", "Head", "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand",
         "RightShoulder", "RightArm", "RightForeArm", "RightHand", "LeftUpLeg", "LeftLeg", "LeftFoot",
         "RightUpLeg", "RightLeg", "RightFoot"},
        {"Pelvis", "L5", "Neck", "Head", "Left Shoulder", "Left Upper Arm", "Left Forearm", "Left Hand",
         "Right Shoulder", "Right Upper Arm", "Right Forearm", "Right Hand", "Left Upper Leg",
         "Left Lower Leg", "Left Foot", "Right Upper Leg", "Right Lower Leg", "Right Foot"},
        {"Hip", "Ab", "Neck", "Head", "LShoulder", "LUArm", "LFArm", "LHand", "RShoulder", "RUArm", "RFArm",
         "RHand", "LThigh", "LShin", "LFoot", "RThigh", "RShin", "RFoot"},
        {"root", "torso_1", "neck_1", "head", "l_shoulder", "l_up_arm", "l_low_arm", "l_hand", "r_shoulder",
         "r_up_arm", "r_low_arm", "r_hand", "l_up_leg", "l_low_leg", "l_foot", "r_up_leg", "r_low_leg",
         "r_foot"}};
    const testing::TemporaryFolder folder;
    for (const auto& names : tables) {
        std::string text;
        for (size_t k = 0; k < names.size(); ++k)
            text += format("{0}{1}_x,{1}_y,{1}_z", k > 0 ? "," : "", names[k]);
        for (size_t i = 0; i < places.size(); ++i)
            text += format("{}{:.5f}", i % (3 * names.size()) == 0 ? "\n" : ",", places[i]);
        write_text(folder / "joints.csv", text);
        const Motion motion = read_motion(folder / "joints.csv", {.fps = 30});
        EXPECT_THAT(motion.notes, Contains("keypoints: joints, by their names")) << names[0];
        const auto bone = [&](const Motion& of, Landmark from, Landmark to) {
            const LandmarkFrame frame =
                of.joints ? landmarks_of(*of.joints, {2})[0] : landmarks_of(*of.keypoints, {2})[0];
            return distance(frame.at(size_t(from)).value(), frame.at(size_t(to)).value());
        };
        for (const auto& [from, to] : {std::pair(Landmark::left_shoulder, Landmark::left_elbow),
                                       std::pair(Landmark::left_elbow, Landmark::left_wrist),
                                       std::pair(Landmark::right_hip, Landmark::right_knee),
                                       std::pair(Landmark::right_wrist, Landmark::left_knee)})
            EXPECT_NEAR(bone(motion, from, to), bone(recording, from, to), 1e-3) << names[0];
    }
}

// A table of joints of kListed with the names of rigs, in this order; `name_of_hips` for the hips.
Motion read_listed(const Motion& recording, const std::vector<HumanJoint>& parts,
                   const std::string& name_of_hips = "Hips") {
    const std::vector<std::string> names = {
        name_of_hips,  "Spine",    "Neck",          "Head",       "LeftShoulder", "LeftArm",
        "LeftForeArm", "LeftHand", "RightShoulder", "RightArm",   "RightForeArm", "RightHand",
        "LeftUpLeg",   "LeftLeg",  "LeftFoot",      "RightUpLeg", "RightLeg",     "RightFoot"};
    std::string text = "time";
    for (const HumanJoint part : parts) {
        const auto k = std::find(kListed.begin(), kListed.end(), part) - kListed.begin();
        text += format(",{0}_x,{0}_y,{0}_z", names.at(size_t(k)));
    }
    const std::vector<double> places = places_of_joints(*recording.joints, 3, parts);
    for (size_t i = 0; i < places.size(); ++i)
        text += (i % (3 * parts.size()) == 0 ? format("\n{:.3f}", double(i / (3 * parts.size())) / 30) : "") +
                format(",{:.5f}", places[i]);
    const testing::TemporaryFolder folder;
    write_text(folder / "joints.csv", text);
    return read_motion(folder / "joints.csv");
}

// Only a point that is called so is the pelvis, wherever it stands; no other takes its place.
TEST(KeypointFile, KnowsJointsOfRigsInAnyOrderAndWithoutHips) {
    const Motion recording = read_motion(test_file("tests/fixtures/gestures/beats.bvh"));
    std::vector<HumanJoint> without_hips(kListed.begin() + 1, kListed.end());
    std::vector<HumanJoint> backwards(kListed.rbegin(), kListed.rend() - 1);  // begins with a foot
    const std::vector<HumanJoint> upper = {
        head, neck, left_upper_arm, right_upper_arm, left_lower_arm, right_lower_arm, left_hand, right_hand};
    const LandmarkFrame shown = landmarks_of(*recording.joints, {2})[0];
    const auto expect_joints = [&](const Motion& motion, const std::vector<HumanJoint>& parts) {
        ASSERT_TRUE(motion.keypoints);
        const LandmarkFrame found = landmarks_of(*motion.keypoints, {2})[0];
        for (const auto& [part, landmark] :
             {std::pair(hips, Landmark::pelvis), std::pair(neck, Landmark::neck),
              std::pair(head, Landmark::head), std::pair(left_upper_arm, Landmark::left_shoulder),
              std::pair(left_hand, Landmark::left_wrist), std::pair(right_lower_arm, Landmark::right_elbow),
              std::pair(right_upper_leg, Landmark::right_hip), std::pair(left_foot, Landmark::left_ankle)}) {
            const bool listed = std::find(parts.begin(), parts.end(), part) != parts.end();
            ASSERT_EQ(found[size_t(landmark)].has_value(), listed) << name_of(landmark);
            if (!listed) continue;
            EXPECT_NEAR(distance(*found[size_t(landmark)], *found[size_t(Landmark::neck)]),
                        distance(*shown[size_t(landmark)], *shown[size_t(Landmark::neck)]), 1e-3)
                << name_of(landmark);
        }
    };
    for (const auto& parts : {without_hips, backwards, upper}) {
        const Motion motion = read_listed(recording, parts);
        EXPECT_THAT(motion.notes, Contains("keypoints: joints, by their names"));
        EXPECT_THAT(motion.notes, Contains(HasSubstr("up axis: y")));
        expect_joints(motion, parts);
    }
    for (const char* name : {"root", "Center", "hip_centre"}) {
        std::vector<HumanJoint> last = without_hips;
        last.push_back(hips);
        expect_joints(read_listed(recording, last, name), last);
    }
}

// Nose, shoulders, elbows and wrists of a recording in other axes, as a table. A skeleton has no nose; it lies 0.12 m
// above and in front of the head joint.
Motion read_upper_body(const std::string& recording, const Mat3& axes, bool has_nose = true) {
    const Motion motion = read_motion(test_file(recording));
    const std::vector<Landmark> points = {Landmark::left_shoulder, Landmark::right_shoulder,
                                          Landmark::left_elbow,    Landmark::right_elbow,
                                          Landmark::left_wrist,    Landmark::right_wrist};
    std::string text = "time";
    if (has_nose) text += ",nose_x,nose_y,nose_z";
    for (const Landmark point : points) text += format(",{0}_x,{0}_y,{0}_z", name_of(point));
    for (size_t t = 0; t < motion.frames; ++t) {
        const LandmarkFrame frame =
            motion.joints ? landmarks_of(*motion.joints, {t})[0] : landmarks_of(*motion.keypoints, {t})[0];
        const auto add = [&](const Vec3& place) {
            const Vec3 turned = axes * place;
            text += format(",{:.5f},{:.5f},{:.5f}", turned.x, turned.y, turned.z);
        };
        text += format("\n{:.4f}", double(t) / motion.fps);
        if (has_nose)
            add(frame[size_t(Landmark::nose)].value_or(frame[size_t(Landmark::head)].value_or(Vec3(0)) +
                                                       Vec3(0, 0.12f, 0.12f)));
        for (const Landmark point : points) add(frame[size_t(point)].value());
    }
    const testing::TemporaryFolder folder;
    write_text(folder / "upper.csv", text);
    return read_motion(folder / "upper.csv");
}

constexpr std::array kRecordings = {"tests/fixtures/gestures/beats.bvh", "tests/fixtures/gestures/wave.bvh",
                                    "tests/fixtures/gestures/walk.bvh", "tests/fixtures/gestures/jacks.bvh",
                                    "tests/fixtures/gestures/mediapipe_world33_25fps.json"};

// The nose lies in front of the shoulders as much as above, and elbows bend either way.
TEST(KeypointFile, StandsAnUpperBodyWithoutHipsUpright) {
    const Mat3 turned(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1));
    const Mat3 z_up(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
    const Mat3 upside_down(Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1));
    for (const char* recording : kRecordings) {
        const Motion plain = read_upper_body(recording, Mat3(1));
        for (const auto& [axis, axes] :
             {std::pair("y", Mat3(1)), std::pair("y", turned), std::pair("z", z_up),
              std::pair("z", Mat3(Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0))),
              std::pair("-y", upside_down)}) {
            SCOPED_TRACE(format("{} {}", recording, axis));
            const Motion read = read_upper_body(recording, axes);
            EXPECT_THAT(read.notes,
                        Contains(AllOf(HasSubstr(format(
                                           "up axis: {} (no hips are seen; from shoulders to head, ", axis)),
                                       HasSubstr("if it is another, set it with --up"))));
            EXPECT_THAT(read.notes, Each(Not(HasSubstr("left-handed"))));
            for (size_t i = 0; i < plain.keypoints->points.size(); ++i)
                ASSERT_LT(distance(read.keypoints->points[i], plain.keypoints->points[i]), 2e-3f) << i;
        }
        EXPECT_GT(place(plain, 0, Landmark::nose).y, place(plain, 0, Landmark::left_shoulder).y);
        EXPECT_GT(place(plain, 0, Landmark::left_shoulder).x, place(plain, 0, Landmark::right_shoulder).x);
        EXPECT_GT(place(plain, 0, Landmark::nose).z, place(plain, 0, Landmark::left_shoulder).z);
    }
}

TEST(KeypointFile, MirrorsAnUpperBodyByItsNoseAndNotByItsElbows) {
    const Mat3 left_handed(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
    for (const char* recording : kRecordings) {
        SCOPED_TRACE(recording);
        const Motion plain = read_upper_body(recording, Mat3(1));
        const Motion mirrored = read_upper_body(recording, left_handed);
        EXPECT_THAT(mirrored.notes, Contains(HasSubstr("axes: left-handed (with left and right as named")));
        for (size_t i = 0; i < plain.keypoints->points.size(); ++i)
            ASSERT_LT(distance(mirrored.keypoints->points[i], plain.keypoints->points[i]), 2e-3f) << i;
        for (const Mat3& axes : {Mat3(1), left_handed}) {
            EXPECT_THAT(read_upper_body(recording, axes, false).notes,
                        AllOf(Each(Not(HasSubstr("axes: left-handed"))),
                              Contains(HasSubstr("handedness: neither nose nor knees nor toes are seen"))));
        }
    }
}

// Its names are those of joints of a skeleton, but its head is the nose.
TEST(KeypointFile, KnowsTheNamesOfAppleVision) {
    const Motion seen = read_motion(test_file("tests/fixtures/gestures/mediapipe_world33_25fps.json"));
    const std::vector<std::pair<std::string, Landmark>> points = {
        {"head_joint", Landmark::nose},
        {"left_ear_joint", Landmark::left_ear},
        {"right_shoulder_1_joint", Landmark::right_shoulder},
        {"left_shoulder_1_joint", Landmark::left_shoulder},
        {"right_forearm_joint", Landmark::right_elbow},
        {"right_hand_joint", Landmark::right_wrist},
        {"left_upLeg_joint", Landmark::left_hip},
        {"right_upLeg_joint", Landmark::right_hip},
        {"left_leg_joint", Landmark::left_knee},
        {"left_foot_joint", Landmark::left_ankle}};
    std::string text = "time";
    for (const auto& point : points) text += format(",{0}_x,{0}_y", point.first);
    const LandmarkFrame frame = landmarks_of(*seen.keypoints, {0})[0];
    for (const char* time : {"0", "0.04"}) {
        text += format("\n{}", time);
        for (const auto& point : points) {
            const Vec3 place = frame[size_t(point.second)].value();
            text += format(",{:.2f},{:.2f}", 640 + 300 * place.x, 600 - 300 * place.y);
        }
    }
    const testing::TemporaryFolder folder;
    write_text(folder / "vision.csv", text);
    const Motion motion = read_motion(folder / "vision.csv");
    EXPECT_THAT(motion.notes, Contains("picture: Apple Vision, by its names"));
    std::vector<std::string> names;
    for (const auto& point : points) names.emplace_back(name_of(point.second));
    EXPECT_EQ(motion.picture->names, names);
}

// LAFAN1 lists legs first, then the trunk; turns and degrees are no places either.
TEST(KeypointFile, RefusesOrdersOfOtherFormatsAndAngles) {
    const Motion recording = read_motion(test_file("tests/fixtures/gestures/beats.bvh"));
    const std::vector<HumanJoint> lafan = {hips,
                                           left_upper_leg,
                                           left_lower_leg,
                                           left_foot,
                                           left_foot,
                                           right_upper_leg,
                                           right_lower_leg,
                                           right_foot,
                                           right_foot,
                                           spine,
                                           spine,
                                           spine,
                                           neck,
                                           head,
                                           left_shoulder,
                                           left_upper_arm,
                                           left_lower_arm,
                                           left_hand,
                                           right_shoulder,
                                           right_upper_arm,
                                           right_lower_arm,
                                           right_hand};
    const testing::TemporaryFolder folder;
    const auto refused = [&](const std::vector<double>& numbers, size_t joints) {
        testing::write_npy(folder / "a.npy", {numbers.size() / 3 / joints, joints, 3}, numbers);
        return refusal_of([&] { read_motion(folder / "a.npy", {.fps = 30}); });
    };
    const char* message =
        "the points have another order, or they are no places; name the points with --names";
    EXPECT_THAT(refused(places_of_joints(*recording.joints, recording.frames, lafan), 22),
                HasSubstr(message));
    std::vector<HumanJoint> unity = lafan;  // 24 points, which might be turns of SMPL
    unity.insert(unity.end(), {left_hand, right_hand});
    EXPECT_THAT(refused(places_of_joints(*recording.joints, recording.frames, unity), 24),
                HasSubstr(message));
    std::vector<double> degrees;
    for (size_t i = 0; i < 100 * 22 * 3; ++i)
        degrees.push_back(50 * std::sin(0.1 * double(i / 66) * (1 + double(i % 66) / 66)));
    EXPECT_THAT(refused(degrees, 22), HasSubstr(message));
}

// Pictures may be in the order of Human3.6M, as programs that lift them read it; third numbers that are all 0 are no
// depth.
TEST(KeypointFile, KnowsHuman36mInAPicture) {
    const testing::TemporaryFolder folder;
    for (const char* layout : {"Human3.6M 17", "COCO 17"}) {
        NumpyArray points = parse_npy(read_bytes(without_names(layout, folder)), "a.npy");
        for (size_t i = 0; i < points.numbers.size(); i += 3) {
            points.numbers[i] = 640 + 300 * points.numbers[i];
            points.numbers[i + 1] = 600 - 300 * points.numbers[i + 1];
            points.numbers[i + 2] = 0;
        }
        testing::write_npy(folder / "a.npy", points.shape, points.numbers);
        const Motion motion = read_motion(folder / "a.npy", {.fps = 25});
        EXPECT_TRUE(motion.picture);
        EXPECT_THAT(motion.notes, Contains(format("picture: {}, by the number of points{}", layout,
                                                  layout[0] == 'H' ? " and by where they lie" : "")));
    }
}

// As a camera in front of a recording sees these joints [px].
std::vector<double> seen_in_picture(const JointTrack& track, size_t frames,
                                    const std::vector<HumanJoint>& parts) {
    std::vector<double> seen;
    const std::vector<double> places = places_of_joints(track, frames, parts);
    for (size_t i = 0; i < places.size(); i += 3)
        seen.insert(seen.end(), {640 + 300 * places[i], 600 - 300 * places[i + 1]});
    return seen;
}

// A Kinect's have no nose and eyes where OpenPose's have; their number is the same.
TEST(KeypointFile, KnowsKinect25InAPicture) {
    const std::vector<HumanJoint> kinect = {hips,
                                            spine,
                                            neck,
                                            head,
                                            left_upper_arm,
                                            left_lower_arm,
                                            left_hand,
                                            left_hand,
                                            right_upper_arm,
                                            right_lower_arm,
                                            right_hand,
                                            right_hand,
                                            left_upper_leg,
                                            left_lower_leg,
                                            left_foot,
                                            left_foot,
                                            right_upper_leg,
                                            right_lower_leg,
                                            right_foot,
                                            right_foot,
                                            neck,
                                            left_hand,
                                            left_hand,
                                            right_hand,
                                            right_hand};
    const testing::TemporaryFolder folder;
    for (const char* recording : {"beats", "walk", "jacks"}) {
        const Motion motion = read_motion(test_file(format("tests/fixtures/gestures/{}.bvh", recording)));
        const auto seen = seen_in_picture(*motion.joints, motion.frames, kinect);
        testing::write_npy(folder / "a.npy", {motion.frames, 25, 2}, seen);
        const Motion picture = read_motion(folder / "a.npy", {.fps = 30});
        EXPECT_THAT(picture.notes,
                    Contains("picture: Kinect 25, by the number of points and by where they lie"));
        EXPECT_EQ(picture.picture->names.at(4), "left_shoulder");
    }
}

TEST(KeypointFile, RefusesOrdersOfOtherFormatsInAPicture) {
    const std::vector<HumanJoint> lafan = {hips,
                                           left_upper_leg,
                                           left_lower_leg,
                                           left_foot,
                                           left_foot,
                                           right_upper_leg,
                                           right_lower_leg,
                                           right_foot,
                                           right_foot,
                                           spine,
                                           spine,
                                           spine,
                                           neck,
                                           head,
                                           left_shoulder,
                                           left_upper_arm,
                                           left_lower_arm,
                                           left_hand,
                                           right_shoulder,
                                           right_upper_arm,
                                           right_lower_arm,
                                           right_hand};
    const testing::TemporaryFolder folder;
    for (const char* recording : {"beats", "walk", "jacks"}) {
        const Motion motion = read_motion(test_file(format("tests/fixtures/gestures/{}.bvh", recording)));
        const auto seen = seen_in_picture(*motion.joints, motion.frames, lafan);
        testing::write_npy(folder / "a.npy", {motion.frames, 22, 2}, seen);
        EXPECT_THAT(
            refusal_of([&] { read_motion(folder / "a.npy", {.fps = 30}); }),
            HasSubstr(
                "22 points without names are by their number those of SMPL 22, but they do not lie as those of a "
                "body in a picture (the nose above the shoulders, these above the hips, eyes near the nose, bones "
                "as long as an adult's): the points have another order, or they are no places; name the points "
                "with --names"));
    }
}

// As YOLO's "xyn" with its confidences.
TEST(KeypointFile, TakesSharesWithConfidencesForAPicture) {
    const testing::TemporaryFolder folder;
    NumpyArray points = parse_npy(read_bytes(without_names("COCO 17", folder)), "a.npy");
    for (size_t i = 0; i < points.numbers.size(); i += 3) {
        points.numbers[i] = 0.5 + 0.2 * points.numbers[i];
        points.numbers[i + 1] = 0.5 - 0.25 * points.numbers[i + 1];
        points.numbers[i + 2] = 0.8;
    }
    testing::write_npy(folder / "a.npy", points.shape, points.numbers);
    EXPECT_THAT(refusal_of([&] { read_motion(folder / "a.npy", {.fps = 25}); }),
                HasSubstr("set it with --picture-size"));
    EXPECT_TRUE(read_motion(folder / "a.npy", {.fps = 25, .picture = {.size = Vec2(1280, 720)}}).picture);
}

// x, y [px or cm] and a third number of the recording in the order of COCO.
NumpyArray with_thirds(const auto& third) {
    const Motion motion = read_motion(test_file("tests/fixtures/gestures/mediapipe_world33_25fps.json"));
    const auto layout = std::find_if(keypoint_layouts().begin(), keypoint_layouts().end(),
                                     [](const KeypointLayout& each) { return each.name == "COCO 17"; });
    NumpyArray points{.name = "", .type = "<f8", .shape = {motion.frames, 17, 3}, .numbers = {}, .texts = {}};
    for (size_t t = 0; t < motion.frames; ++t) {
        const LandmarkFrame frame = landmarks_of(*motion.keypoints, {t})[0];
        for (size_t k = 0; k < 17; ++k) {
            const Vec3 place = frame[size_t(*layout->points[k].ours)].value();
            points.numbers.insert(points.numbers.end(),
                                  {640 + 300.0 * place.x, 600 - 300.0 * place.y, third(t, k, place)});
        }
    }
    return points;
}

double score(size_t t, size_t k, const Vec3& = {}) {
    return 60 + 3 * double(k % 9) + 8 * std::sin(0.3 * double(t) + double(k * k));
}

TEST(KeypointFile, TakesScoresAboveOneForConfidencesOfAPicture) {
    const testing::TemporaryFolder folder;
    const auto read = [&](const auto& third) {
        const NumpyArray points = with_thirds(third);
        testing::write_npy(folder / "a.npy", points.shape, points.numbers);
        return read_motion(folder / "a.npy", {.fps = 25});
    };
    const Motion percent = read(score);
    ASSERT_TRUE(percent.picture);
    EXPECT_THAT(percent.notes, Contains(AllOf(HasSubstr("and are no depth, by which bones would keep"),
                                              HasSubstr("the usual one, counts as 1"))));
    EXPECT_GT(percent.picture->confidence[0], 0.6f);
    EXPECT_LE(percent.picture->confidence[0], 1);

    const Motion flat = read([](size_t t, size_t k, const Vec3&) { return 0.05 * score(t, k); });
    ASSERT_TRUE(flat.picture);
    EXPECT_THAT(flat.notes,
                Contains(AllOf(HasSubstr("confidences"), HasSubstr("while the points spread over"))));

    const Motion logits = read([](size_t t, size_t k, const Vec3&) { return 0.1 * score(t, k) - 7; });
    ASSERT_TRUE(logits.picture);
    EXPECT_THAT(logits.notes, Contains(AllOf(HasSubstr("no depth"), HasSubstr("they are left out"))));
    EXPECT_EQ(logits.picture->confidence[0], 1);
}

// As far above 0 as scores are.
TEST(KeypointFile, TakesDepthForDepth) {
    const testing::TemporaryFolder folder;
    const auto depth = [](size_t, size_t, const Vec3& place) { return 300 + 300.0 * place.z; };
    NumpyArray points = with_thirds(depth);
    testing::write_npy(folder / "a.npy", points.shape, points.numbers);
    EXPECT_TRUE(read_motion(folder / "a.npy", {.fps = 25}).keypoints);

    points.shape[0] = 5;
    points.numbers.resize(5 * 17 * 3);
    testing::write_npy(folder / "a.npy", points.shape, points.numbers);
    EXPECT_THAT(read_motion(folder / "a.npy", {.fps = 25}).notes,
                Contains(HasSubstr("taken for depth, which the motion is too short or too still to show")));
}

// A depth that is off by centimetres, of a body that is seen from its side: its bones spread more with it.
TEST(KeypointFile, RefusesThirdsThatMayBeDepthOrScores) {
    const testing::TemporaryFolder folder;
    NumpyArray points = with_thirds([](size_t t, size_t k, const Vec3& place) {
        return 300 + 300.0 * place.x + 10 * std::sin(2.0 * double(t) + double(k * k));
    });
    const NumpyArray depths =
        with_thirds([](size_t, size_t, const Vec3& place) { return 640 + 300.0 * place.z; });
    for (size_t i = 0; i < points.numbers.size(); i += 3) points.numbers[i] = depths.numbers[i + 2];
    testing::write_npy(folder / "a.npy", points.shape, points.numbers);
    EXPECT_THAT(refusal_of([&] { read_motion(folder / "a.npy", {.fps = 25}); }),
                AllOf(HasSubstr("a.npy: the third numbers of points may be a depth or scores of a detector"),
                      HasSubstr("beside an array \"confidence\"")));
}

TEST(KeypointFile, BringsScoresThatItNamesToShares) {
    const testing::TemporaryFolder folder;
    const NumpyArray points = with_thirds(score);
    std::vector<double> places, scores;
    for (size_t i = 0; i < points.numbers.size(); i += 3) {
        places.insert(places.end(), {points.numbers[i], points.numbers[i + 1]});
        scores.push_back(points.numbers[i + 2]);
    }
    testing::write_npz(folder / "a.npz", {{"keypoints", {points.shape[0], 17, 2}, places},
                                          {"scores", {points.shape[0], 17}, scores}});
    const Motion motion = read_motion(folder / "a.npz", {.fps = 25});
    EXPECT_THAT(motion.notes, Contains(HasSubstr("confidences: scores above 1; ")));
    EXPECT_GT(motion.picture->confidence[0], 0.6f);
}

// Rows of numbered landmarks, columns "landmark_0_x" and "body_nose_x" of FreeMoCap, and MessageToDict of protobuf.
TEST(KeypointFile, KnowsLandmarksOfMediaPipeByTheirNumbers) {
    const testing::TemporaryFolder folder;
    const NumpyArray body = parse_npy(read_bytes(without_names("MediaPipe 33", folder)), "a.npy");
    const auto& layouts = keypoint_layouts();
    const auto& layout = *std::ranges::find(layouts, "MediaPipe 33", &KeypointLayout::name);
    std::string listed = "frame,landmark,x,y,z", wide, freemocap, rows;
    Json frames = Json::array();
    for (size_t i = 0; i < 3 * 33; ++i) {
        const size_t k = i % 33;
        const double* x = &body.numbers[3 * i];
        listed += format("\n{},{},{},{},{}", i / 33, k, x[0], x[1], x[2]);
        if (i < 33) wide += format("{0}landmark_{1}_x,landmark_{1}_y,landmark_{1}_z", k > 0 ? "," : "", k);
        if (i < 33)
            freemocap +=
                format("{0}body_{1}_x,body_{1}_y,body_{1}_z", k > 0 ? "," : "", layout.points[k].theirs);
        rows += format("{}{},{},{}", k > 0 ? "," : "\n", x[0], x[1], x[2]);
        if (k == 0) frames.push_back({{"landmark", Json::array()}});
        frames.back()["landmark"].push_back({{"x", x[0]}, {"y", x[1]}, {"z", x[2]}, {"visibility", 0.9}});
    }
    const Motion expected = read_motion(folder / "a.npy", {.fps = 25});
    for (const std::string& text : {listed, wide + rows, freemocap + rows, frames.dump()}) {
        write_text(folder / "a.txt", text);
        const Motion motion = read_motion(folder / "a.txt", {.fps = 25});
        EXPECT_EQ(motion.keypoints->names, expected.keypoints->names) << text.substr(0, 60);
        EXPECT_LT(distance(place(motion, 2, Landmark::left_wrist), place(expected, 2, Landmark::left_wrist)),
                  1e-4f);
    }
}

// As trackers of several people write it, in space and in a picture.
TEST(KeypointFile, ReadsArraysOfOnePerson) {
    const testing::TemporaryFolder folder;
    const NumpyArray body = parse_npy(read_bytes(without_names("COCO 17", folder)), "a.npy");
    testing::write_npy(folder / "b.npy", {3, 1, 17, 3}, body.numbers);
    EXPECT_EQ(read_motion(folder / "b.npy", {.fps = 25}).keypoints->points,
              read_motion(folder / "a.npy", {.fps = 25}).keypoints->points);
    std::vector<double> pixels;
    for (size_t i = 0; i < body.numbers.size(); i += 3)
        pixels.insert(pixels.end(), {640 + 300 * body.numbers[i], 600 - 300 * body.numbers[i + 1]});
    testing::write_npy(folder / "b.npy", {3, 1, 17, 2}, pixels);
    const Motion motion = read_motion(folder / "b.npy", {.fps = 25});
    EXPECT_EQ(motion.frames, 3u);
    EXPECT_EQ(motion.picture->points.size(), 3u * 17);
    testing::write_npy(folder / "c.npy", {2, 1, 17, 3}, std::vector<double>(2 * 17 * 3, 0.5));
    EXPECT_THAT(
        refusal_of([&] { read_motion(folder / "c.npy", {.fps = 25}); }),
        HasSubstr("array (2, 1, 17, 3) of shares is what MoveNet writes, y before x; save it as (frames, 17, "
                  "3) of x, y and confidence, as a[:, 0][..., [1, 0, 2]] of NumPy is"));
}

// The left wrist of Human3.6M, whose root stays at the origin; another root begins there and goes away slowly.
TEST(KeypointFile, MissesPointsThatJumpToTheOrigin) {
    const testing::TemporaryFolder folder;
    NumpyArray points = parse_npy(read_bytes(without_names("Human3.6M 17", folder)), "a.npy");
    const auto at = [&](size_t t, size_t k) {
        return points.numbers.begin() + std::ptrdiff_t(3 * (17 * t + k));
    };
    for (size_t t = 0; t < 3; ++t) {
        const std::array root = {*at(t, 0), *(at(t, 0) + 1), *(at(t, 0) + 2)};
        for (size_t i = 0; i < 17 * 3; ++i) *(at(t, 0) + std::ptrdiff_t(i)) -= root[i % 3];
    }
    const auto read = [&] {
        testing::write_npy(folder / "a.npy", points.shape, points.numbers);
        return read_motion(folder / "a.npy", {.fps = 25});
    };
    const auto has_zeros = HasSubstr("points at exactly 0 0 0");
    EXPECT_THAT(read().notes, ::testing::Not(Contains(has_zeros)));
    std::fill_n(at(1, 13), 3, 0.0);
    Motion motion = read();
    EXPECT_THAT(motion.notes, Contains("points at exactly 0 0 0: 1, which are missing there"));
    EXPECT_EQ(confidence(motion, 1, Landmark::left_wrist), 0);
    EXPECT_EQ(confidence(motion, 2, Landmark::left_wrist), 1);
    EXPECT_EQ(confidence(motion, 0, Landmark::pelvis), 1);
    for (size_t t = 0; t < 3; ++t) {
        for (size_t k = 0; k < 17; ++k) *at(t, k) += 0.02 * double(t);
    }
    motion = read();
    for (size_t t = 0; t < 3; ++t) EXPECT_EQ(confidence(motion, t, Landmark::pelvis), 1);
}

// A Kinect that sees nobody writes zeros, and its pelvis is no exception.
TEST(KeypointFile, MissesFramesOfZeros) {
    const testing::TemporaryFolder folder;
    for (const char* layout : {"Kinect 25", "Human3.6M 17"}) {
        NumpyArray points = parse_npy(read_bytes(without_names(layout, folder)), "a.npy");
        const size_t row = points.shape[1] * 3;
        std::fill_n(points.numbers.begin() + static_cast<std::ptrdiff_t>(row), row, 0.0);
        testing::write_npy(folder / "a.npy", points.shape, points.numbers);
        const Motion motion = read_motion(folder / "a.npy", {.fps = 25});
        EXPECT_EQ(confidence(motion, 1, Landmark::pelvis), 0) << layout;
        EXPECT_EQ(confidence(motion, 1, Landmark::left_wrist), 0) << layout;
        EXPECT_EQ(confidence(motion, 2, Landmark::left_wrist), 1) << layout;
    }
}

TEST(KeypointFile, RefusesPointsInAnOrderThatIsNoBody) {
    const testing::TemporaryFolder folder;
    const auto file = without_names("MediaPipe 33", folder, true);
    EXPECT_THAT(
        refusal_of([&] { read_motion(file, {.fps = 25}); }),
        AllOf(
            HasSubstr("a.npy: 33 points without names are by their number those of MediaPipe 33, but "),
            HasSubstr(
                " % of their bones are much longer or shorter than those of a body, or change their "
                "lengths: the points have another order, or they are no places; name the points with --names")));
    const auto arms = without_names("COCO 17", folder, false, true);
    EXPECT_THAT(refusal_of([&] { read_motion(arms, {.fps = 25}); }),
                HasSubstr("17 points without names are by their number those of Human3.6M 17 or COCO 17, but "
                          "too few arms, legs, shoulders and hips are seen to know which; name the points"));
}

TEST(KeypointFile, ReadsRowsOfSeventyTwoNumbersAsPlaces) {
    const testing::TemporaryFolder folder;
    const NumpyArray points = parse_npy(read_bytes(without_names("SMPL 24", folder)), "a.npy");
    testing::write_npy(folder / "flat.npy", {3, 72}, points.numbers);
    const Motion motion = read_motion(folder / "flat.npy", {.fps = 25});
    EXPECT_THAT(motion.notes, Contains("keypoints: SMPL 24, by the number of points"));
}

TEST(KeypointFile, TakesConfidenceFromItsOwnArray) {
    const Motion motion = read_motion(fixture("with_confidence.npz"));
    EXPECT_EQ(confidence(motion, 0, Landmark::left_wrist), 0.5f);
    // Point 30 - 17 = 13 of frame 1 is 0; it must not be asked for its place.
    EXPECT_EQ(confidence(motion, 1, Landmark::left_wrist), 0);
    EXPECT_THAT(motion.notes, Contains("missing points: 1 of 34"));
}

struct ArrayFacts {
    std::string file;
    size_t frames = 0;
    float shoulders = 0;  // their distance [m]
};

void PrintTo(const ArrayFacts& facts, std::ostream* out) {
    *out << facts.file;
}

class KeypointArray : public ::testing::TestWithParam<ArrayFacts> {};

TEST_P(KeypointArray, IsReadWithTheJsonBesideIt) {
    using enum Landmark;
    const auto& [file, frames, shoulders] = GetParam();
    const Motion motion = read_motion(test_file(file));
    EXPECT_EQ(motion.frames, frames);
    EXPECT_DOUBLE_EQ(duration(motion), static_cast<double>(frames) / 25);
    EXPECT_THAT(motion.notes, Contains("keypoints: MediaPipe 33, by their names"));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("up axis: -y")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("unit: m ")));
    EXPECT_GT(place(motion, 0, nose).y, place(motion, 0, left_shoulder).y + 0.1f);
    EXPECT_GT(place(motion, 0, left_shoulder).x, place(motion, 0, right_shoulder).x + 0.25f);
    EXPECT_GT(place(motion, 0, nose).z, place(motion, 0, left_ear).z);
    float width = 0;
    for (size_t t = 0; t < motion.frames; ++t)
        width += distance(place(motion, t, left_shoulder), place(motion, t, right_shoulder));
    EXPECT_NEAR(width / static_cast<float>(frames), shoulders, 0.005f);
}

INSTANTIATE_TEST_SUITE_P(MediaPipe, KeypointArray,
                         ::testing::ValuesIn(testing::present<ArrayFacts>(
                             {{"tests/fixtures/gestures/mediapipe_world33_25fps.json", 75, 0.352f},
                              {"tests/fixtures/gestures/mediapipe_world33_25fps.npy", 75, 0.352f},
                              {"../shared/data/motion/keypoints3d/mediapipe_world33.json", 97, 0.329f},
                              {"../shared/data/motion/keypoints3d/mediapipe_world33_xyzc_25fps.npy", 97,
                               0.329f}})));

TEST(KeypointFile, AnArrayAloneNeedsARateByHand) {
    const std::string refusal = refusal_of([] { read_motion(fixture("fortran.npy")); });
    EXPECT_THAT(refusal, HasSubstr("fortran.npy: the file does not give its rate; set it with --motion-fps"));
    const Motion motion = read_motion(fixture("fortran.npy"), {.fps = 50});
    EXPECT_LT(distance(place(motion, 1, Landmark::left_wrist), Vec3(0.17f, 0.95f, 0.02f)), 1e-3f);
}

TEST(KeypointFile, RefusesArraysThatAreAmbiguous) {
    EXPECT_THAT(
        refusal_of([] { read_motion(fixture("two_arrays.npz")); }),
        HasSubstr("2 arrays can be keypoints of shape (T, K, 3) or (T, K, 4), or (T, K, 2) in a picture; the "
                  "arrays are first (2, 17, 3), second (2, 17, 3), fps ()"));
    const testing::TemporaryFolder folder;
    testing::write_npy(folder / "turns6.npy", {2, 330}, std::vector<double>(660));
    EXPECT_THAT(refusal_of([&] { read_motion(folder / "turns6.npy", {.fps = 30}); }),
                HasSubstr("the arrays are array (2, 330); turns of SMPL are read as axes times angles, "
                          "(T, 165), (T, 156), (T, 72) or (T, 66)"));
    const std::map<std::size_t, std::string> features = {
        {263,
         "263 numbers a frame are features of HumanML3D or KIT-ML; save the joints, (T, 22, 3), that its"},
        {251, "save the joints, (T, 21, 3), that its recover_from_ric makes of them"},
        {322, "322 numbers a frame are those of Motion-X; save the first 156, turns as SMPL-H has them"},
        {265,
         "265 numbers a frame are those of TalkSHOW, whose turns of jaw and eyes come first; save "
         "numpy.concatenate([a[:, 9:75], a[:, :9], a[:, 75:165]], 1), turns as SMPL-X has them"}};
    for (const auto& [size, remedy] : features) {
        testing::write_npy(folder / "features.npy", {2, size}, std::vector<double>(2 * size));
        EXPECT_THAT(refusal_of([&] { read_motion(folder / "features.npy", {.fps = 30}); }),
                    HasSubstr(remedy));
    }
    const std::string header = "{'descr': '|O', 'fortran_order': False, 'shape': (), }                    \n";
    write_text(folder / "pickled.npy", std::string("\x93NUMPY\1\0", 8) + static_cast<char>(header.size()) +
                                           '\0' + header + "\x80\x04}.");
    EXPECT_THAT(
        refusal_of([&] { read_motion(folder / "pickled.npy", {.fps = 30}); }),
        HasSubstr("array () was pickled, as NumPy does with dictionaries and lists, in which any program "
                  "could be, so it is not read; save the numbers in it as arrays, by numpy.savez"));
    EXPECT_THAT(
        refusal_of([] { read_motion(fixture("smpl_parts.npz")); }),
        HasSubstr(
            "smpl_parts.npz: these are turns of the SMPL body model, but not in the layout that is read "
            "(body_pose (2, 207), betas (10)); store all of them as \"poses\""));
    EXPECT_THAT(refusal_of([] { read_motion(fixture("wrong_confidence.npz")); }),
                HasSubstr("scores (2, 16) does not fit 2 frames of 17 points"));
    EXPECT_THAT(refusal_of([] { read_motion(fixture("wrong_names.npz")); }),
                HasSubstr("3 names for 17 points"));
    EXPECT_THAT(refusal_of([] { read_motion(fixture("integers.npy"), {.fps = 30}); }),
                HasSubstr("2 points without names; known by their number are MediaPipe 33"));
}

// As scripts/demo.py of TalkSHOW writes it: jaw and eyes, the whole body in the axes of a camera, where y is down, the
// legs of somebody who sits, and the joints above.
TEST(KeypointFile, ReadsTheTurnsOfTalkShow) {
    const testing::TemporaryFolder folder;
    for (const std::size_t width : {165, 265}) {
        std::vector<double> numbers(3 * width);
        for (std::size_t t = 0; t < 3; ++t) {
            double* row = numbers.data() + t * width;
            const auto set = [&](std::size_t column, const Vec3& turn) {
                for (int i = 0; i < 3; ++i) row[column + std::size_t(i)] = turn[i];
            };
            set(0, {0.2f, 0, 0});                        // jaw
            set(9, {3.0747f, -0.0158f, -0.0152f});       // the whole body
            set(12, {-1.1827f, 0.2387f, 0.1515f});       // left hip
            set(15, {-1.2605f, -0.316f, -0.1603f});      // right hip
            set(12 + 3 * 15, {0, 0, -1});                // left shoulder, the arm down
            set(12 + 3 * 16, {0, 0, 1});                 // right shoulder
            set(12 + 3 * 18, {0, float(t) * -0.3f, 0});  // right elbow
            set(75, {0, 0, -0.4f});                      // left index
            for (std::size_t i = 165; i < width; ++i) row[i] = 5;
        }
        testing::write_npy(folder / "talk.npy", {3, width}, numbers);
        const Motion motion = read_motion(folder / "talk.npy", {.fps = 30});
        ASSERT_TRUE(motion.joints);
        EXPECT_THAT(
            motion.notes,
            Contains("TalkSHOW: turns of jaw and eyes come first; its camera sees bodies upside down, "
                     "which are turned over"));
        EXPECT_THAT(motion.notes, Contains(HasSubstr("SMPL-X: turns of 55 joints")));
        EXPECT_THAT(motion.notes, Contains(HasSubstr("hands: their turns go from the model's mean hand")));
        if (width == 265) {
            EXPECT_THAT(motion.notes, Contains(HasSubstr("expressions: left out")));
        }
        const Skeleton& skeleton = motion.joints->skeleton;
        const auto turn = [&](std::size_t frame, std::string_view name) {
            for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
                if (skeleton.joints[j].name == name)
                    return glm::angle(motion.joints->turns[frame * skeleton.joints.size() + j]);
            }
            return -1.0f;
        };
        EXPECT_NEAR(turn(0, "jaw"), 0.2f, 1e-4f);
        EXPECT_NEAR(turn(0, "spine1"), 0, 1e-4f);
        EXPECT_NEAR(turn(0, "left_shoulder"), 1, 1e-4f);
        EXPECT_NEAR(turn(2, "right_elbow"), 0.6f, 1e-4f);
        EXPECT_NEAR(turn(0, "left_index1"), 0.4f, 1e-4f);
        const LandmarkFrame places = landmarks_of(*motion.joints, {0})[0];
        const auto height = [&](Landmark landmark) {
            return places[static_cast<size_t>(landmark)].value().y;
        };
        EXPECT_GT(height(Landmark::left_shoulder), height(Landmark::left_hip) + 0.3f) << "upright";
        EXPECT_THAT(motion.notes, Each(Not(HasSubstr("doubt"))));
        EXPECT_LT(height(Landmark::left_wrist), height(Landmark::left_shoulder) - 0.2f);
    }
}

// Files that the test writes itself.
class KeypointText : public ::testing::Test {
  protected:
    Motion read(const std::string& name, const std::string& text, const MotionHints& hints = {}) {
        write_text(folder_ / name, text);
        return read_motion(folder_ / name, hints);
    }
    std::string refusal(const std::string& name, const std::string& text, const MotionHints& hints = {}) {
        return refusal_of([&] { read(name, text, hints); });
    }
    MotionHints with_map(const std::string& text) {
        write_text(folder_ / "map.json", text);
        MotionHints hints;
        hints.name_map = folder_ / "map.json";
        return hints;
    }

    testing::TemporaryFolder folder_;
};

// A figure of eight points, one frame. {} is a place for what a test adds.
std::string figure(std::string_view left_wrist) {
    return format(R"({{"nose": [0, 1.6, 0.1], "left_ear": [0.07, 1.6, 0], "right_ear": [-0.07, 1.6, 0],
        "left_shoulder": [0.18, 1.4, 0], "right_shoulder": [-0.18, 1.4, 0], "left_hip": [0.1, 0.9, 0],
        "right_hip": [-0.1, 0.9, 0], "left_wrist": {}}})",
                  left_wrist);
}

TEST_F(KeypointText, ReadsOurJson) {
    const Motion motion =
        read("a.json", R"({"fps": 25, "names": ["nose", "left_ear", "right_ear", "left_shoulder",
        "right_shoulder", "left_hip", "right_hip"], "frames": [[[0, 1.6, 0.1], [0.07, 1.6, 0], [-0.07, 1.6, 0],
        [0.18, 1.4, 0, 0.5], null, [0.1, 0.9, 0], [-0.1, 0.9, 0]]]})");
    EXPECT_DOUBLE_EQ(motion.fps, 25);
    EXPECT_LT(distance(place(motion, 0, Landmark::nose), Vec3(0, 1.6f, 0.1f)), 1e-5f);
    EXPECT_EQ(confidence(motion, 0, Landmark::left_shoulder), 0.5f);
    EXPECT_EQ(confidence(motion, 0, Landmark::right_shoulder), 0);
}

TEST_F(KeypointText, ReadsFramesOfNamedPoints) {
    const Motion objects =
        read("a.json", format(R"({{"fps": 25, "frames": [{}, {}]}})", figure("[0.3, 1, 0.1]"),
                              figure(R"({"x": 0.3, "y": 1.1, "z": 0.1, "visibility": 0.25})")));
    EXPECT_EQ(objects.frames, 2u);
    EXPECT_NEAR(place(objects, 1, Landmark::left_wrist).y, 1.1f, 1e-5f);
    EXPECT_EQ(confidence(objects, 1, Landmark::left_wrist), 0.25f);

    const Motion list = read("b.json", R"([{"keypoints": [{"name": "nose", "x": 0, "y": 1.6, "z": 0.1},
        {"name": "LShoulder", "x": 0.18, "y": 1.4, "z": 0}, {"name": "RShoulder", "x": -0.18, "y": 1.4, "z": 0},
        {"name": "MidHip", "x": 0, "y": 0.9, "z": 0}]}])",
                             {.fps = 30});
    EXPECT_EQ(list.keypoints->names,
              (std::vector<std::string>{"nose", "left_shoulder", "right_shoulder", "pelvis"}));
}

TEST_F(KeypointText, TakesTheSizeOfThePicture) {
    const Motion motion =
        read("a.json", R"({"fps": 25, "width": 1280, "height": 720, "frames": [{"nose": [640, 200],
        "neck": [640, 280], "left_hip": [660, 450], "right_hip": [620, 450]}]})");
    EXPECT_EQ(motion.picture->size, Vec2(1280, 720));
}

TEST_F(KeypointText, TakesNumbersForNoNamesOnlyFromTheFirst) {
    for (const char* names : {R"(["", "1", "2"])", R"(["10", "11", "12"])", R"(["2", "3", "4"])"}) {
        const std::string text =
            format(R"({{"fps": 25, "names": {}, "frames": [[[0, 1, 0], [0, 2, 0], [0, 3, 0]]]}})", names);
        EXPECT_THAT(refusal("a.json", text), HasSubstr("0 of the 3 points are known by their names"))
            << names;
    }
    EXPECT_THAT(
        refusal("a.json", R"({"fps": 25, "names": ["p0", "p1"], "frames": [[[0, 1, 0], [0, 2, 0]]]})"),
        HasSubstr("2 points without names"));
}

TEST_F(KeypointText, ReadsLinesOfFrames) {
    const auto line = [](const char* wrist) {
        std::string text = figure(wrist);
        std::erase(text, '\n');
        return text + "\n";
    };
    const Motion motion = read("a.jsonl", line("[0.4, 1, 0.2]") + line("[0.4, 1.1, 0.2]"), {.fps = 25});
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_NEAR(place(motion, 1, Landmark::left_wrist).y, 1.1, 1e-5);
}

TEST_F(KeypointText, APointThatComesLateIsMissingBefore) {
    const Motion motion = read(
        "a.json", format(R"({{"fps": 25, "frames": [{}, {}]}})", figure("null"), figure("[0.3, 1.1, 0.1]")));
    EXPECT_EQ(confidence(motion, 0, Landmark::left_wrist), 0);
    EXPECT_EQ(confidence(motion, 1, Landmark::left_wrist), 1);
}

TEST_F(KeypointText, RefusesJsonOfAnotherForm) {
    EXPECT_THAT(refusal("a.json", R"({"title": "x"})"), HasSubstr("no \"frames\" with a list of frames"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [5]})"), HasSubstr("frame 0: a frame is 5"));
    EXPECT_THAT(refusal("a.json", R"({"fps": "fast", "frames": []})"), HasSubstr("the rate is \"fast\""));
    EXPECT_THAT(refusal("a.json", R"({"names": 5, "frames": []})"), HasSubstr("the names are no list"));
    EXPECT_THAT(refusal("a.json", R"({"names": [5], "frames": []})"),
                HasSubstr("a name is 5; a text is expected"));
    EXPECT_THAT(refusal("a.json", R"({"fps": 30, "frames": []})"), HasSubstr("0 frames of 0 points"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [[[1]]]})"), HasSubstr("frame 0: point 0 has 1 numbers"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [[[1, 2, 3], [1, 2]]]})"),
                HasSubstr("frame 0: point 1 has no z, others have one"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [[[1, 2, "x"]]]})"),
                HasSubstr("point 0 holds \"x\"; a number is"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [[[1, 2, 3]], []]})"),
                HasSubstr("frame 1: 0 points, 1 are expected"));
    EXPECT_THAT(refusal("a.json", R"({"names": ["nose"], "frames": [{"ear": [1, 2, 3]}]})"),
                HasSubstr("the point \"ear\" is none of the names"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [{"nose": {"x": 1}}]})"),
                HasSubstr("x, y and z are expected"));
    EXPECT_THAT(refusal("a.json", R"({"frames": [[{"name": "nose", "x": 1, "y": 1, "z": 1}, {"x": 1}]]})"),
                HasSubstr("has no name"));
    EXPECT_THAT(refusal("a.json", "{\"frames\": [1,]}"), HasSubstr("a.json:1:15: this is no valid JSON"));
    EXPECT_THAT(refusal("a.json", R"({"fps": 25, "names": ["nose"]})"),
                HasSubstr("it has no frames, and describes 0 arrays beside it"));
}

const std::string kWideHeader =
    "time,nose_x,nose_y,nose_z,LShoulder.X,LShoulder.Y,LShoulder.Z,RShoulder x,RShoulder y,RShoulder z,"
    "hips:x,hips:y,hips:z,hips:confidence\n";
const std::string kWideRows =
    "0.00,0,1.6,0.1,0.18,1.4,0,-0.18,1.4,0,0,0.9,0,1\n"
    "0.04,0,1.6,0.1,0.18,1.4,0,-0.18,1.4,0,0,0.9,0,0.5\n"
    "0.08,,,,0.18,1.4,0,-0.18,1.4,0,0,0.9,0,0\n";

TEST_F(KeypointText, ReadsWideTables) {
    const Motion motion = read("a.csv", kWideHeader + kWideRows);
    EXPECT_EQ(motion.frames, 3u);
    EXPECT_DOUBLE_EQ(motion.fps, 25);
    EXPECT_EQ(motion.keypoints->names,
              (std::vector<std::string>{"nose", "left_shoulder", "right_shoulder", "pelvis"}));
    EXPECT_EQ(confidence(motion, 1, Landmark::pelvis), 0.5f);
    EXPECT_EQ(confidence(motion, 2, Landmark::pelvis), 0);
    EXPECT_EQ(confidence(motion, 2, Landmark::nose), 0);
    EXPECT_EQ(confidence(motion, 1, Landmark::nose), 1);

    std::string semicolons = kWideHeader + kWideRows;
    std::replace(semicolons.begin(), semicolons.end(), ',', ';');
    EXPECT_EQ(read("b.csv", "# made by hand\r\n" + semicolons).keypoints->points, motion.keypoints->points);
}

TEST_F(KeypointText, ReadsWideTablesThatNameTheAxisFirst) {
    const std::string header =
        "time,x_nose,y_nose,z_nose,x_LShoulder,y_LShoulder,z_LShoulder,X.RShoulder,Y.RShoulder,Z.RShoulder,"
        "x_hips,y_hips,z_hips,visibility_hips\n";
    const Motion motion = read("a.csv", header + kWideRows);
    EXPECT_EQ(motion.keypoints->points, read("b.csv", kWideHeader + kWideRows).keypoints->points);
    EXPECT_EQ(confidence(motion, 1, Landmark::pelvis), 0.5f);
}

TEST_F(KeypointText, RefusesTimesThatAreNoneOfAMotion) {
    const std::string row = ",0,1.6,0.1,0.18,1.4,0,-0.18,1.4,0,0,0.9,0,1\n";
    EXPECT_THAT(
        refusal("a.csv", kWideHeader + "0" + row + "1e-9" + row),
        HasSubstr("a.csv: it has 1e+09 frames/s; a motion has 1 to 1000; set the rate with --motion-fps"));
    EXPECT_EQ(read("a.csv", kWideHeader + "0" + row + "1e-9" + row, {.fps = 30}).fps, 30);
}

const std::string kLong =
    "frame,name,x,y,z,confidence\n"
    "1,nose,0,1.6,0.1,1\n1,neck,0,1.45,0,1\n1,left_shoulder,0.18,1.4,0,1\n1,right_shoulder,-0.18,1.4,0,0.5\n"
    "2,nose,0,1.6,0.1,1\n2,neck,0,1.45,0,1\n2,right_shoulder,-0.18,1.4,0,1\n";

TEST_F(KeypointText, ReadsLongTables) {
    const Motion motion = read("a.csv", kLong, {.fps = 30});
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_EQ(confidence(motion, 0, Landmark::right_shoulder), 0.5f);
    EXPECT_EQ(confidence(motion, 0, Landmark::left_shoulder), 1);
    EXPECT_EQ(confidence(motion, 1, Landmark::left_shoulder), 0);
}

// As detectors and their users call it.
TEST_F(KeypointText, KnowsHowSureAPointIsByManyNames) {
    for (const char* name : {"confidence", "likelihood", "v", "p", "prob", "presence", "vis"}) {
        std::string table = kLong;
        table.replace(table.find("confidence"), 10, name);
        EXPECT_EQ(confidence(read("a.csv", table, {.fps = 30}), 0, Landmark::right_shoulder), 0.5f) << name;
        table = kWideHeader + kWideRows;
        const std::string old = "hips:confidence";
        ASSERT_NE(table.find(old), table.npos);
        table.replace(table.find(old), old.size(), format("hips:{}", name));
        EXPECT_EQ(confidence(read("b.csv", table), 1, Landmark::pelvis), 0.5f) << name;
    }
    const Motion both =
        read("c.csv",
             "nose_x,nose_y,nose_visibility,nose_presence,neck_x,neck_y,neck_visibility,neck_presence,"
             "left_wrist_x,left_wrist_y,left_wrist_visibility,left_wrist_presence\n"
             "100,100,0.5,0.9,100,150,0.5,0.9,130,200,0.25,1\n",
             {.fps = 30});
    EXPECT_EQ(both.picture->confidence, (std::vector<float>{0.5f, 0.5f, 0.25f}));
    const Motion keys =
        read("e.json", format(R"({{"fps": 25, "frames": [{}]}})",
                              figure(R"({"x": 0.3, "y": 1.1, "z": 0.1, "visible": true, "score": 0.9,
                                                        "visibility": 0.25})")));
    EXPECT_EQ(confidence(keys, 0, Landmark::left_wrist), 0.25f) << "what is visible is no number";
    const Motion beside = read("d.csv",
                               "p_id,nose_x,nose_y,neck_x,neck_y,left_wrist_x,left_wrist_y,body_score\n"
                               "7,100,100,100,150,130,200,0.5\n",
                               {.fps = 30});
    EXPECT_EQ(beside.picture->names.size(), 3u) << "numbers and scores of a person are no points";
}

// A detector that did not find a point writes the corner of the picture, or -1 -1. Around a root the origin is a place.
TEST_F(KeypointText, MissesPointsInTheCornerOfAPicture) {
    const auto frames = [](const std::string& wrist, int x, int y) {
        std::string list;
        for (const std::string& each : {format("[{}, {}]", x + 90, y + 200), wrist, wrist, wrist})
            list += format("{}[[{}, {}], [{}, {}], [{}, {}], {}]", list.empty() ? "" : ", ", x, y, x + 50,
                           y + 80, x - 50, y + 80, each);
        return format(R"({{"fps": 25, "names": ["nose", "left_shoulder", "right_shoulder", "left_wrist"],
            "frames": [{}]}})",
                      list);
    };
    for (const char* corner : {"[0, 0]", "[-1, -1]"}) {
        const Motion motion = read("a.json", frames(corner, 300, 100));
        EXPECT_EQ(motion.picture->confidence[3], 1);
        EXPECT_EQ(motion.picture->confidence[7], 0) << corner;
        EXPECT_THAT(motion.notes, Contains("points at exactly 0 0 or -1 -1: 3, which are missing there"));
    }
    const Motion around = read("b.json", frames("[-1, -1]", 0, -80));
    EXPECT_EQ(around.picture->confidence[0], 1);
    EXPECT_EQ(around.picture->confidence[7], 1);
}

TEST_F(KeypointText, RefusesTablesThatDoNotFit) {
    EXPECT_THAT(refusal("a.csv", "a,b,c\n1,2,3\n"), HasSubstr("no columns NAME_x, NAME_y, NAME_z"));
    EXPECT_THAT(refusal("a.csv", kWideHeader), HasSubstr("no rows follow the header"));
    EXPECT_THAT(refusal("a.csv", kWideHeader + "1,2\n"),
                HasSubstr("a.csv:2: 2 values, the header has 14 columns"));
    EXPECT_THAT(refusal("a.csv", "nose_x,nose_y,neck_x,neck_y,neck_z\n1,2,3,4,5\n"),
                HasSubstr("the point \"nose\" has no column for z"));
    EXPECT_THAT(refusal("a.csv", "nose_x,nose_y,nose_z,nose_x\n1,2,3,4\n"),
                HasSubstr("\"nose_x\" comes twice"));
    EXPECT_THAT(refusal("a.csv", "nose_x,nose_y,nose_z\n1,2,abc\n"),
                HasSubstr("a.csv:2: column \"nose_z\": \"abc\" is no number"));
    EXPECT_THAT(refusal("a.csv", "time,nose_x,nose_y,nose_z\n1,1,2,3\nnan,1,2,3\n3,1,2,3\n"),
                HasSubstr("a.csv:3: "));
    EXPECT_THAT(refusal("a.csv", "time,nose_x,nose_y,nose_z\n1,1,2,3\n1,1,2,3\n"),
                HasSubstr("a.csv:3: the time goes from 1 to 1; it must advance"));
    EXPECT_THAT(refusal("a.csv", "time,nose_x,nose_y,nose_z\n0,1,2,3\n0.04,1,2,3\n90,1,2,3\n90.04,1,2,3\n"),
                HasSubstr("a.csv:2: of 2252 frames only 4 are there; give them as files of their own, each "
                          "without a pause"));
    EXPECT_THAT(refusal("a.csv", "frame,nose_x,nose_y,nose_z\n1,1,2,3\n4,1,2,3\n7,1,2,3\n"),
                HasSubstr("a.csv:3: frame 4, where 2 is expected; more than half of the frames are left out, "
                          "number those that are there one by one and give their rate"));
    EXPECT_THAT(refusal("a.csv", "frame,nose_x,nose_y,nose_z\n1,1,2,3\n1,1,2,3\n"),
                HasSubstr("a.csv:3: the number of the frame goes from 1 to 1; it must advance"));
    EXPECT_THAT(refusal("a.csv", "frame,nose_x,nose_y,nose_z\n1,1,2,3\n1.5,1,2,3\n"),
                HasSubstr("a.csv:3: the number of the frame is 1.5; a whole number is expected"));
    EXPECT_THAT(refusal("a.csv", kLong + "2,nose,0,1.6,0.1,1\n"),
                HasSubstr("a.csv:9: frame 2 has the point \"nose\" twice, first in line 6"));
    EXPECT_THAT(refusal("a.csv", kLong), HasSubstr("the file does not give its rate"));
}

// Rows of two people, one 1 m aside and who comes second.
TEST_F(KeypointText, TakesTheFirstOfSeveralPeople) {
    const std::string wide = "nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n";
    const std::vector<std::pair<const char*, double>> points = {
        {"nose", 1.6}, {"neck", 1.4}, {"pelvis", 0.9}};
    std::string plain = "person," + wide, numbered = "frame,track_id," + wide, timed = "time,id," + wide;
    std::string in_blocks = "Subject," + wide, listed = "frame,id,name,x,y,z\n";
    const auto row = [](int aside) { return format("{0},1.6,0.1,{0},1.4,0,{0},0.9,0\n", aside); };
    for (int t = 0; t < 3; ++t) {
        for (const int person : {7, 8}) {
            plain += format("{},{}", person, row(person - 7));
            numbered += format("{},{},{}", t, person, row(person - 7));
            timed += format("{},{},{}", 0.04 * t, person, row(person - 7));
            in_blocks += format("{},{}", t < 2 ? 1 : 2, row(0));
            for (const auto& [name, y] : points)
                listed += format("{},{},{},{},{},0\n", t, person, name, person - 7, y);
        }
    }
    for (const std::string& text : {plain, numbered, timed, listed}) {
        const Motion motion = read("a.csv", text, {.fps = 25});
        ASSERT_EQ(motion.frames, 3u) << text;
        for (size_t t = 0; t < 3; ++t) EXPECT_NEAR(place(motion, t, Landmark::neck).x, 0, 1e-6) << text;
        const bool is_long = text == listed;
        EXPECT_THAT(
            motion.notes,
            Contains(AllOf(HasSubstr(is_long ? "of 18 rows the 9 with id \"7\"" : "of 6 rows the 3 with "),
                           HasSubstr("\"7\" are taken, as it comes first"))));
    }
    EXPECT_EQ(read("a.csv", in_blocks, {.fps = 25}).frames, 4u);
}

// Numbers of rows, and a tracker that lost somebody and gave another number.
TEST_F(KeypointText, TakesOnePersonForOne) {
    for (const auto& [column, numbers] : {std::pair{"id", std::array{0, 1, 2, 3}}, {"track", {4, 4, 6, 6}}}) {
        std::string text =
            format("{},nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n", column);
        for (const int number : numbers) text += format("{},0,1.6,0.1,0,1.4,0,0,0.9,0\n", number);
        EXPECT_EQ(read("a.csv", text, {.fps = 25}).frames, 4u);
    }
}

// 30 frames a second, written in hundredths.
TEST_F(KeypointText, TakesRoundedTimesForEvenOnes) {
    std::string text = "time,nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n";
    for (const char* time : {"0.00", "0.03", "0.07", "0.10", "0.13", "0.17", "0.20"})
        text += format("{},0,1.6,0.1,0,1.4,0,0,0.9,0\n", time);
    EXPECT_NEAR(read("a.csv", text, {}).fps, 30, 0.01);
}

// A nose that goes aside by 0.1 m/s, so that its place says at which time it was seen.
class UnevenFrames : public KeypointText {
  protected:
    template <typename Value = double>
    static std::string table(const std::string& column, const std::vector<Value>& values,
                             const std::vector<double>& times) {
        std::string text = column + ",nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n";
        for (size_t t = 0; t < values.size(); ++t)
            text += format("{},{},1.6,0.1,0,1.4,0,0,0.9,0\n", values[t], 0.1 * (times[t] - times[0]));
        return text;
    }
    template <typename Value = double>
    static std::string json(const char* key, const std::vector<Value>& values,
                            const std::vector<double>& times) {
        Json frames = Json::array();
        for (size_t t = 0; t < values.size(); ++t)
            frames.push_back({{key, values[t]},
                              {"joints",
                               {{"nose", {0.1 * (times[t] - times[0]), 1.6, 0.1}},
                                {"neck", {0, 1.4, 0}},
                                {"pelvis", {0, 0.9, 0}}}}});
        return frames.dump();
    }
    static double nose_at(const Motion& motion, size_t frame) {
        return 10 * place(motion, frame, Landmark::nose).x;
    }
};

// A camera that was asked for 25 frames a second.
TEST_F(UnevenFrames, LieAtEvenTimesOnTheLineBetweenThoseThatWereSeen) {
    const std::vector<double> times = {10, 10.05, 10.08, 10.12, 10.15, 10.2, 10.24};
    for (const auto& [name, text] :
         {std::pair{"a.csv", table("time", times, times)}, std::pair{"a.json", json("time", times, times)}}) {
        const Motion motion = read(name, text, {});
        EXPECT_DOUBLE_EQ(motion.fps, 25);
        ASSERT_EQ(motion.frames, 7u);
        for (size_t t = 0; t < 7; ++t) EXPECT_NEAR(nose_at(motion, t), 0.04 * static_cast<double>(t), 1e-5);
        EXPECT_THAT(motion.notes,
                    Contains(HasSubstr("times go on by 0.03 to 0.05 s; laid onto even ones of 25 frames/s")));
    }
}

TEST_F(UnevenFrames, MayHaveTimesInSmallerUnits) {
    const std::vector<double> times = {0, 0.055, 0.08, 0.12};
    for (const double unit : {1e3, 1e6, 1e9}) {
        std::vector<double> written;
        for (const double time : times) written.push_back(1.7e6 * unit + time * unit);
        const Motion motion = read("a.json", json("timestamp_ms", written, times), {});
        EXPECT_DOUBLE_EQ(motion.fps, 25);
        ASSERT_EQ(motion.frames, 4u);
        EXPECT_NEAR(nose_at(motion, 1), 0.04, 1e-4);
        EXPECT_THAT(motion.notes, Contains(format("times: 1 = {:g} s, by their usual step", 1 / unit)));
    }
    EXPECT_DOUBLE_EQ(read("a.csv", table("time", {0, 40, 80, 120}, times), {}).fps, 25);
}

TEST_F(UnevenFrames, MayHaveTimesOfAClock) {
    const std::vector<double> times = {0, 0.055, 0.08, 0.12};
    for (const std::string before : {"00:59:", "01:", "2026-05-01 12:30:", "2026-05-01T12:30:"}) {
        std::vector<std::string> written;
        for (const double time : times) written.push_back(before + format("{:06.3f}", 10 + time));
        for (const auto& [name, text] : {std::pair{"a.csv", table("time", written, times)},
                                         std::pair{"a.json", json("timestamp", written, times)}}) {
            const Motion motion = read(name, text, {});
            EXPECT_DOUBLE_EQ(motion.fps, 25) << name << " " << before;
            EXPECT_EQ(motion.frames, 4u);
            EXPECT_NEAR(nose_at(motion, 1), 0.04, 1e-5);
        }
    }
    EXPECT_THAT(refusal("a.csv", table("time", std::vector<std::string>{"0:59", "0.1.2"}, times)),
                HasSubstr("a.csv:3: column \"time\": \"0.1.2\" is no number"));
}

TEST_F(UnevenFrames, MayBeEverySecondOne) {
    const Motion motion = read("a.csv", table("frame", {0, 2, 4}, {0, 2, 4}), {.fps = 25});
    ASSERT_EQ(motion.frames, 5u);
    EXPECT_NEAR(nose_at(motion, 4), 4, 1e-5);
    EXPECT_EQ(confidence(motion, 3, Landmark::nose), 0);
    EXPECT_THAT(motion.notes, Contains("2 of 5 frames are not in the file"));
}

TEST_F(UnevenFrames, HaveNoRateWhereTimesAreNumbersOfFrames) {
    const std::vector<double> numbers = {0, 1, 2, 4};
    for (const auto& [name, text] : {std::pair{"a.csv", table("time", numbers, numbers)},
                                     std::pair{"a.json", json("time", numbers, numbers)}}) {
        EXPECT_THAT(refusal(name, text),
                    HasSubstr("the file does not give its rate; set it with --motion-fps"));
        const Motion motion = read(name, text, {.fps = 25});
        EXPECT_EQ(motion.frames, 5u);
        EXPECT_EQ(confidence(motion, 3, Landmark::nose), 0);
        EXPECT_THAT(motion.notes,
                    Contains("times: whole numbers that go up by one, so they are numbers of frames"));
    }
    const std::vector<double> seconds = {1.7e9, 1.7e9 + 1, 1.7e9 + 2};
    EXPECT_DOUBLE_EQ(read("a.csv", table("timestamp", seconds, seconds), {}).fps, 1);
}

TEST_F(UnevenFrames, MayHaveTimesUnderTheNamesOfTools) {
    const std::vector<double> times = {0, 0.04, 0.08};
    for (const auto& [column, unit] : {std::pair{"time_ms", 1e3},
                                       {"timestamp_usec", 1e6},
                                       {"Time (Seconds)", 1.0},
                                       {"Time [s]", 1.0},
                                       {"timestamp_ms", 1e3},
                                       {"RelativeTime", 1e7}}) {
        std::vector<double> written;
        for (const double time : times) written.push_back(time * unit);
        EXPECT_DOUBLE_EQ(read("a.csv", table(column, written, times), {}).fps, 25) << column;
    }
    EXPECT_DOUBLE_EQ(read("a.json", json("timestamp_us", {0, 40000, 80000}, times), {}).fps, 25);
}

TEST_F(UnevenFrames, SayWhereTheRateByHandContradictsThem) {
    const std::string text = table("time", {0, 0.04, 0.08}, {0, 0.04, 0.08});
    EXPECT_THAT(read("a.csv", text, {.fps = 30}).notes,
                Contains("rate: 30 frames/s, set by hand (in the file: 25)"));
    EXPECT_THAT(read("a.csv", text, {.fps = 25}).notes, Contains("rate: 25 frames/s, set by hand"));
}

// 30 frames a second of a Kinect, since the year 1 and since it was started; microseconds since 1970 stay what they
// are.
TEST_F(UnevenFrames, MayHaveTimesInTicks) {
    for (const double first : {637e15, 0.0}) {
        std::vector<double> ticks;
        for (int t = 0; t < 4; ++t) ticks.push_back(first + std::floor(t * 1e7 / 30));
        const Motion motion = read("a.csv", table("timestamp", ticks, ticks), {});
        EXPECT_NEAR(motion.fps, 30, 0.01);
        EXPECT_THAT(motion.notes, Contains("times: 1 = 1e-07 s, by their usual step"));
    }
    const std::vector<double> slow = {1.6e15, 1.6e15 + 5e5, 1.6e15 + 1e6};
    EXPECT_DOUBLE_EQ(read("a.csv", table("timestamp", slow, slow), {}).fps, 2);
}

TEST_F(UnevenFrames, AreMissingWhereNoneWasSeen) {
    const std::vector<double> times = {0, 0.04, 0.08, 0.25, 0.285, 0.33};
    const std::vector<double> numbers = {4, 5, 6, 10, 11, 12};
    for (const auto& [name, text] :
         {std::pair{"a.csv", table("time", times, times)}, std::pair{"a.json", json("time", times, times)},
          std::pair{"a.csv", table("frame", numbers, times)},
          std::pair{"a.json", json("frame", numbers, times)}}) {
        const Motion motion = read(name, text, {.fps = 25});
        ASSERT_EQ(motion.frames, 9u) << text;
        for (size_t t = 0; t < 9; ++t)
            EXPECT_EQ(confidence(motion, t, Landmark::nose), t > 2 && t < 6 ? 0 : 1) << text << t;
        EXPECT_NEAR(nose_at(motion, 6), 0.25, 1e-5);
        EXPECT_THAT(motion.notes, Contains(HasSubstr("3 of 9 frames are not in the file")));
    }
}

// Frames at 0, 0.04, 0.08 and 0.12 s from those at 0, 0.055, 0.08 and 0.12 s.
TEST_F(UnevenFrames, TakeAPointThatOneOfTwoSawFromTheNearerOne) {
    const auto motion_with = [&](const std::string& first, const std::string& second) {
        const std::string rest = ",0,1.4,0,0,0.9,0\n";
        return read("a.csv",
                    "time,nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n0," + first +
                        rest + "0.055," + second + rest + "0.08,0.03,1.6,0.1" + rest + "0.12,0.04,1.6,0.1" +
                        rest,
                    {});
    };
    const Motion far = motion_with(",,", "0.02,1.6,0.1");
    EXPECT_EQ(confidence(far, 0, Landmark::nose), 0);
    EXPECT_EQ(confidence(far, 1, Landmark::nose), 1);
    EXPECT_NEAR(nose_at(far, 1), 0.2, 1e-5) << "no mean with a place that is none";
    const Motion near = motion_with("0.01,1.6,0.1", ",,");
    EXPECT_EQ(confidence(near, 0, Landmark::nose), 1);
    EXPECT_EQ(confidence(near, 1, Landmark::nose), 0);
    EXPECT_EQ(confidence(near, 1, Landmark::neck), 1);
    EXPECT_NEAR(nose_at(near, 2), 0.3, 1e-5);
}

// 60 frames a second in hundredths: the middle one of the steps would be 0.02 s.
TEST_F(UnevenFrames, HaveTheRateOfTheirMeanStep) {
    const std::vector<double> times = {0, 0.02, 0.03, 0.05, 0.07, 0.08, 0.1};
    EXPECT_DOUBLE_EQ(read("a.csv", table("time", times, times), {}).fps, 60);
}

TEST_F(KeypointText, SaysWhatFilesOfOtherProgramsAre) {
    for (
        const auto& [name, text, message] : std::vector<std::array<std::string, 3>>{
            {"a.csv", "Format Version,1.23,Take Name,a\n",
             "this is a table of OptiTrack Motive, which is not read; export the skeleton as BVH"},
            {"a.tsv", "NO_OF_FRAMES\t3\n",
             "this is a table of Qualisys Track Manager, which is not read; give its points one header row NAME_x,NAME_y,NAME_z"},
            {"a.csv", "Trajectories\n30\n,,S:Hip,,\n",
             "this is a table of Vicon Nexus, which is not read; give its points"},
            {"a.csv", "scorer,DLC,DLC,DLC\nbodyparts,nose,nose,nose\n",
             "this is a table of DeepLabCut, which is not read; give its points one header row NAME_x,NAME_y,"
             "NAME_confidence for each"},
            {"a.trc", "PathFileType\t4\t(X/Y/Z)\ta.trc\n", "this is markers in TRC"},
            {"a.c3d", std::string("\x02\x50", 2), "this is markers in C3D"},
            {"a.mvnx", "<?xml version=\"1.0\"?><mvnx/>", "export BVH from MVN"},
            {"a.amc", ":FULLY-SPECIFIED\n",
             "this is AMC, whose skeleton lies in an ASF, which is not read; convert both to BVH"},
            {"a.asf", ":version 1.10\n", "convert it with its AMC to BVH"},
            {"a.skeleton", "103\n1\n", "save the joints of one body as .npy, (frames, 25, 3)"},
            {"a.xlsx", "PK\x03\x04", "save the sheet with the positions of segments as CSV"},
            {"a.pkl", "\x80\x04",
             "a pickle of Python, in which any program could be, which is not read; save its arrays with numpy.savez"},
            {"a.pt", "PK\x03\x04", "a file of PyTorch, in which any program could be"},
            {"a.pth", "PK\x03\x04", "a file of PyTorch, in which any program could be"}})
        EXPECT_THAT(refusal(name.c_str(), text), HasSubstr(message)) << name;
}

TEST_F(KeypointText, NamesPointsThroughAMap) {
    const std::string text =
        "time,a_x,a_y,a_z,b_x,b_y,b_z,c_x,c_y,c_z,d_x,d_y,d_z\n"
        "0,0,1.6,0.1,0.18,1.4,0,-0.18,1.4,0,9,9,9\n0.04,0,1.6,0.1,0.18,1.4,0,-0.18,1.4,0,9,9,9\n";
    const auto hints = with_map(R"({"a": "nose", "b": "left_shoulder", "c": "right_shoulder", "d": null})");
    const Motion motion = read("a.csv", text, hints);
    EXPECT_EQ(motion.keypoints->names, (std::vector<std::string>{"nose", "left_shoulder", "right_shoulder"}));
    EXPECT_THAT(motion.notes, Contains("points that are not used: d"));
    EXPECT_THAT(refusal("a.csv", text), HasSubstr("0 of the 4 points are known by their names (a, b, c, d)"));
    EXPECT_THAT(refusal("a.csv", text, with_map(R"({"a": "noze"})")),
                HasSubstr("\"a\" is mapped to \"noze\", which is no point; did you mean \"nose\"?"));
    EXPECT_THAT(refusal("a.csv", text, with_map(R"({"a": 5})")),
                HasSubstr("\"a\" is mapped to 5; a name or null"));
    EXPECT_THAT(refusal("a.csv", text, with_map("[]")), HasSubstr("a name map is an object"));
    EXPECT_THAT(refusal("a.csv", text, with_map(R"({"a": "nose", "b": "nose"})")),
                HasSubstr("the points \"a\" and \"b\" both mean nose"));
}

TEST_F(KeypointText, RefusesPlacesAndConfidencesThatMeanNothing) {
    const std::string header =
        "nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z,pelvis_c\n";
    EXPECT_THAT(refusal("a.csv", header + "0,1,0,0,nan,0,0,0,0,1\n", {.fps = 30}),
                HasSubstr("frame 0, point \"neck\": the place (0, nan, 0) is no place"));
    EXPECT_THAT(
        refusal("a.csv", header + "0,1,0,0,1,0,0,0,0,5\n", {.fps = 30}),
        HasSubstr(
            "frame 0, point \"pelvis\": the confidence 5 does not lie between 0 and 1, as most do; set it to "
            "0 where the point is missing, or divide all by their scale"));
    EXPECT_THAT(
        refusal("a.csv", "nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n,,,,,,,,\n",
                {.fps = 30}),
        HasSubstr("every point of every frame is missing"));
    // A place that is no number does not matter where the confidence says that the point is missing.
    const Motion motion = read("a.csv", header + "0,1.6,0,0,1.5,0,nan,nan,nan,0\n", {.fps = 30});
    EXPECT_EQ(confidence(motion, 0, Landmark::pelvis), 0);
    // Nor where the file says nothing about it.
    const Motion lost = read("b.csv",
                             "nose_x,nose_y,nose_z,neck_x,neck_y,neck_z,pelvis_x,pelvis_y,pelvis_z\n"
                             "0,1.6,0,nan,nan,nan,0,1,0\n",
                             {.fps = 30});
    EXPECT_EQ(confidence(lost, 0, Landmark::neck), 0);
    EXPECT_EQ(confidence(lost, 0, Landmark::nose), 1);
}

// OpenPose writes 0 0 0 for a point it did not see.
// The same figure in a left-handed space: x points to its right, all else as before.
TEST_F(KeypointText, MirrorsALeftHandedSpace) {
    const auto csv = [](double sign) {
        std::string rows =
            "time,nose_x,nose_y,nose_z,left_ear_x,left_ear_y,left_ear_z,right_ear_x,right_ear_y,right_ear_z,"
            "left_shoulder_x,left_shoulder_y,left_shoulder_z,right_shoulder_x,right_shoulder_y,"
            "right_shoulder_z,pelvis_x,pelvis_y,pelvis_z\n";
        for (const double time : {0.0, 0.1}) {
            rows += format("{0},{1},1.6,0.12,{2},1.6,0,{3},1.6,0,{4},1.4,0,{5},1.4,0,0,0.9,0\n", time,
                           sign * 0.01, sign * 0.07, sign * -0.07, sign * 0.18, sign * -0.18);
        }
        return rows;
    };
    const Motion right = read("right.csv", csv(1));
    const Motion left = read("left.csv", csv(-1));
    EXPECT_THAT(left.notes, Contains(HasSubstr("axes: left-handed")));
    EXPECT_THAT(right.notes, Not(Contains(HasSubstr("axes: left-handed"))));
    for (size_t i = 0; i < right.keypoints->points.size(); ++i) {
        EXPECT_LT(distance(left.keypoints->points[i], right.keypoints->points[i]), 1e-5f) << i;
    }
}

TEST_F(KeypointText, RefusesWhatIsNoMotion) {
    EXPECT_THAT(refusal("a.txt", "just words\n"), HasSubstr("a.txt: this is no motion that can be read"));
    EXPECT_THAT(
        refusal("a.bvh", "just words\n"),
        HasSubstr("a.bvh: it does not begin with HIERARCHY, as a BVH in UTF-8 does; export it again"));
    EXPECT_THAT(refusal("a.bvh", " \n"), HasSubstr("a.bvh: the file is empty"));
    EXPECT_THAT(refusal_of([&] { read_motion(folder_ / "none.bvh"); }), HasSubstr("none.bvh"));
}

}  // namespace
}  // namespace chironomia
