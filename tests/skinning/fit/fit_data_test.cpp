// Real motion on real avatars: the bones of the avatar against those of the BVH file, whose forward
// kinematics are written here a second time, in double precision and straight from the text of the format.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/files/files.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using glm::dmat3;
using glm::dvec3;
using testing::test_file;

struct PlainJoint {
    std::string name;
    int parent = -1;
    dvec3 offset{0};
    std::vector<std::string> channels;
};

struct PlainBvh {
    std::vector<PlainJoint> joints;
    std::vector<std::vector<double>> frames;
};

PlainBvh read_plainly(const fs::path& file) {
    std::istringstream in(read_text(file));
    PlainBvh bvh;
    std::vector<int> open;
    std::string word;
    while (in >> word && word != "MOTION") {
        if (word == "ROOT" || word == "JOINT" || word == "End") {
            PlainJoint joint;
            in >> joint.name;
            joint.parent = open.empty() ? -1 : open.back();
            bvh.joints.push_back(joint);
        } else if (word == "{") {
            open.push_back(int(bvh.joints.size()) - 1);
        } else if (word == "}") {
            open.pop_back();
        } else if (word == "OFFSET") {
            dvec3& offset = bvh.joints.back().offset;
            in >> offset.x >> offset.y >> offset.z;
        } else if (word == "CHANNELS") {
            size_t count = 0;
            in >> count;
            bvh.joints.back().channels.resize(count);
            for (std::string& channel : bvh.joints.back().channels) in >> channel;
        }
    }
    size_t frames = 0;
    size_t columns = 0;
    for (const PlainJoint& joint : bvh.joints) columns += joint.channels.size();
    in >> word >> frames >> word >> word >> word;
    bvh.frames.assign(frames, std::vector<double>(columns));
    for (auto& frame : bvh.frames) {
        for (double& value : frame) in >> value;
    }
    return bvh;
}

dmat3 about(char axis, double degrees) {
    const double c = std::cos(degrees * 3.14159265358979323846 / 180);
    const double s = std::sin(degrees * 3.14159265358979323846 / 180);
    if (axis == 'X') return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
    if (axis == 'Y') return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

// `adds_moves`: position channels below the root count from OFFSET, as one exporter writes them.
std::vector<dvec3> places_of(const PlainBvh& bvh, size_t frame, bool adds_moves) {
    std::vector<dmat3> turns;
    std::vector<dvec3> places;
    size_t column = 0;
    for (const PlainJoint& joint : bvh.joints) {
        dmat3 turn(1);
        dvec3 move = joint.offset;
        for (const std::string& channel : joint.channels) {
            const double value = bvh.frames[frame][column++];
            if (channel.ends_with("rotation")) {
                turn = turn * about(channel[0], value);
            } else {
                double& place = move[channel[0] - 'X'];
                place = adds_moves && joint.parent >= 0 ? place + value : value;
            }
        }
        const bool root = joint.parent < 0;
        places.push_back(root ? move : places[size_t(joint.parent)] + turns[size_t(joint.parent)] * move);
        turns.push_back(root ? turn : turns[size_t(joint.parent)] * turn);
    }
    return places;
}

// The joints that begin and end a bone, in the avatar and in the file.
struct Bone {
    HumanJoint begin;
    HumanJoint end;
    std::string source_begin;
    std::string source_end;
};

struct Clip {
    std::string file;
    bool z_up;
    // Left upper arm, forearm, hand, thigh, shin, foot; `left` in a name stands for the side.
    std::array<const char*, 6> joints;
    std::array<const char*, 2> sides;
    bool adds_moves = false;
    float lean = 20;  // of the head above the hips in the first frame, at most [degrees]
};

const std::vector<Clip> kClips = testing::present<Clip>({
    {"tests/fixtures/gestures/wave.bvh",
     true,
     {"*Arm", "*ForeArm", "*Hand", "*UpLeg", "*Leg", "*Foot"},
     {"Left", "Right"}},
    {"tests/fixtures/gestures/jacks.bvh",
     false,
     {"*Shoulder", "*Elbow", "*Wrist", "*Hip", "*Knee", "*Ankle"},
     {"Left", "Right"}},
    {"tests/fixtures/gestures/beats.bvh",
     false,
     {"b_*_arm", "b_*_forearm", "b_*_wrist", "b_*_upleg", "b_*_leg", "b_*_foot"},
     {"l", "r"}},
    {"tests/fixtures/gestures/walk.bvh",
     true,
     {"UpArm_*", "LoArm_*", "Hand_*", "UpLeg_*", "LoLeg_*", "Foot_*"},
     {"L", "R"}},
    {"tests/fixtures/gestures/t_pose.bvh",
     true,
     {"upperarm01.*", "lowerarm01.*", "wrist.*", "upperleg01.*", "lowerleg01.*", "foot.*"},
     {"L", "R"},
     true},
    {"../shared/data/motion/bvh/ad_wave_hello.bvh",
     true,
     {"*Arm", "*ForeArm", "*Hand", "*UpLeg", "*Leg", "*Foot"},
     {"Left", "Right"}},
    {"../shared/data/motion/bvh/ad_zombie.bvh",
     true,
     {"*Arm", "*ForeArm", "*Hand", "*UpLeg", "*Leg", "*Foot"},
     {"Left", "Right"}},
    {"../shared/data/motion/bvh/ad_jumping_jacks.bvh",
     false,
     {"*Shoulder", "*Elbow", "*Wrist", "*Hip", "*Knee", "*Ankle"},
     {"Left", "Right"}},
    {"../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
     false,
     {"b_*_arm", "b_*_forearm", "b_*_wrist", "b_*_upleg", "b_*_leg", "b_*_foot"},
     {"l", "r"}},
    {"../shared/data/motion/bvh/mh_tpose.bvh",
     true,
     {"upperarm01.*", "lowerarm01.*", "wrist.*", "upperleg01.*", "lowerleg01.*", "foot.*"},
     {"L", "R"},
     true},
    {"../shared/data/motion/bvh/mh_walk1.bvh",
     true,
     {"UpArm_*", "LoArm_*", "Hand_*", "UpLeg_*", "LoLeg_*", "Foot_*"},
     {"L", "R"},
     false,
     21},
});

std::string on_side(std::string name, const char* side) {
    const size_t star = name.find('*');
    return name.replace(star, 1, side);
}

std::vector<Bone> bones_of(const Clip& clip) {
    constexpr std::array kLeft = {HumanJoint::left_upper_arm, HumanJoint::left_lower_arm,
                                  HumanJoint::left_hand,      HumanJoint::left_upper_leg,
                                  HumanJoint::left_lower_leg, HumanJoint::left_foot};
    std::vector<Bone> bones;
    for (const size_t side : {0, 1}) {
        for (const size_t i : {0, 1, 3, 4}) {
            const auto part = [&](size_t k) { return side == 0 ? kLeft[k] : mirrored(kLeft[k]); };
            bones.push_back({part(i), part(i + 1), on_side(clip.joints[i], clip.sides[side]),
                             on_side(clip.joints[i + 1], clip.sides[side])});
        }
    }
    return bones;
}

size_t joint_named(const PlainBvh& bvh, const std::string& name) {
    for (size_t j = 0; j < bvh.joints.size(); ++j) {
        if (bvh.joints[j].name == name) return j;
    }
    ADD_FAILURE() << "no joint " << name;
    return 0;
}

// Direction of every bone in every frame, +y up.
std::vector<dvec3> directions_of(const PlainBvh& bvh, const Clip& clip) {
    std::vector<dvec3> directions;
    for (size_t t = 0; t < bvh.frames.size(); ++t) {
        const std::vector<dvec3> places = places_of(bvh, t, clip.adds_moves);
        for (const Bone& bone : bones_of(clip)) {
            const dvec3 d =
                places[joint_named(bvh, bone.source_end)] - places[joint_named(bvh, bone.source_begin)];
            directions.push_back(glm::normalize(clip.z_up ? dvec3(d.x, d.z, -d.y) : d));
        }
    }
    return directions;
}

std::vector<dvec3> directions_of(const Avatar& avatar, const Fit& fit, const Clip& clip) {
    std::vector<dvec3> directions;
    for (const Pose& pose : fit.poses) {
        const std::vector<Mat4> world = world_from_joints(avatar.skeleton, pose.joints);
        for (const Bone& bone : bones_of(clip)) {
            directions.push_back(glm::normalize(dvec3(origin(world[size_t(avatar.humanoid[bone.end])]) -
                                                      origin(world[size_t(avatar.humanoid[bone.begin])]))));
        }
    }
    return directions;
}

// The reader turns a motion about the vertical until it faces +z; the one angle that explains the whole clip
// best.
double heading_between(const std::vector<dvec3>& from, const std::vector<dvec3>& to) {
    double along = 0;
    double across = 0;
    for (size_t i = 0; i < from.size(); ++i) {
        along += from[i].x * to[i].x + from[i].z * to[i].z;
        across += from[i].z * to[i].x - from[i].x * to[i].z;
    }
    return std::atan2(across, along);
}

const std::vector<std::string> kAvatars = testing::present(
    {"assets/avatars/mannequin.glb", "assets/avatars/neutral.glb", "made/makehuman.glb", "made/mixamo.glb",
     "made/vrm.vrm", "made/numbered.glb", "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
     "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
     "../shared/data/avatars/tests/mh_neutral_vrm1.vrm",
     "../shared/data/avatars/tests/mh_neutral_poseunits.glb", "../shared/data/avatars/tests/CesiumMan.glb"});

const std::vector<std::string> kKeypoints =
    testing::present({"tests/fixtures/gestures/mediapipe_world33_25fps.npy",
                      "../shared/data/motion/keypoints3d/mediapipe_world33_xyzc_25fps.npy"});

class RealMotion : public ::testing::TestWithParam<std::string> {};

TEST_P(RealMotion, KeepsTheBoneDirectionsOfEveryBvh) {
    const Avatar avatar = read_avatar(test_file(GetParam()));
    for (const Clip& clip : kClips) {
        const fs::path file = test_file(clip.file);
        const Motion motion = read_motion(file);
        const Fit fit = fit_motion(motion, avatar, {.fps = motion.fps});
        const std::vector<dvec3> wanted = directions_of(read_plainly(file), clip);
        const std::vector<dvec3> given = directions_of(avatar, fit, clip);
        ASSERT_EQ(wanted.size(), given.size()) << clip.file;
        const double heading = heading_between(wanted, given) * 180 / 3.14159265358979323846;
        double sum = 0;
        double worst = 0;
        for (size_t i = 0; i < wanted.size(); ++i) {
            const dvec3 turned = about('Y', heading) * wanted[i];
            const double error = std::acos(std::clamp(glm::dot(turned, given[i]), -1.0, 1.0)) * 57.29578;
            sum += error;
            worst = std::max(worst, error);
        }
        ASSERT_TRUE(std::isfinite(sum)) << clip.file;
        EXPECT_LT(sum / double(wanted.size()), 2) << clip.file << " on " << GetParam();
        EXPECT_LT(worst, 8) << clip.file << " on " << GetParam();
    }
}

// Right way up, facing the camera at the start, standing on the floor.
TEST_P(RealMotion, StandsUprightFacingTheCamera) {
    const Avatar avatar = read_avatar(test_file(GetParam()));
    for (const Clip& clip : kClips) {
        const Motion motion = read_motion(test_file(clip.file));
        const Fit fit = fit_motion(motion, avatar, {.fps = 30});
        const std::vector<Mat4> world = world_from_joints(avatar.skeleton, fit.poses[0].joints);
        const auto place = [&](HumanJoint part) { return origin(world[size_t(avatar.humanoid[part])]); };
        const Vec3 left = place(HumanJoint::left_upper_arm) - place(HumanJoint::right_upper_arm);
        const Vec3 hips = place(HumanJoint::hips);
        EXPECT_LT(angle_between(left, Vec3(1, 0, 0)), radians(35.0f)) << clip.file;
        EXPECT_LT(angle_between(place(HumanJoint::head) - hips, Vec3(0, 1, 0)), radians(clip.lean))
            << clip.file;
        EXPECT_LT(std::hypot(hips.x, hips.z), 0.15f) << clip.file;
        const float lowest = std::min(place(HumanJoint::left_foot).y, place(HumanJoint::right_foot).y);
        EXPECT_GT(lowest, 0) << clip.file;
        EXPECT_LT(lowest, 0.2f) << clip.file;
    }
}

// No joint of the avatar turns further from frame to frame than the source's quickest joint does, threefold.
TEST_P(RealMotion, DoesNotJump) {
    const Avatar avatar = read_avatar(test_file(GetParam()));
    for (const Clip& clip : kClips) {
        const Motion motion = read_motion(test_file(clip.file));
        const size_t joints = motion.joints->skeleton.joints.size();
        float quickest = radians(2.0f);
        for (size_t i = joints; i < motion.joints->turns.size(); ++i) {
            quickest =
                std::max(quickest, angle_between(motion.joints->turns[i - joints], motion.joints->turns[i]));
        }
        const Fit fit = fit_motion(motion, avatar, {.fps = motion.fps});
        for (size_t t = 1; t < fit.poses.size(); ++t) {
            for (size_t j = 0; j < avatar.skeleton.joints.size(); ++j) {
                ASSERT_LT(angle_between(fit.poses[t - 1].joints[j].rotation, fit.poses[t].joints[j].rotation),
                          3 * quickest)
                    << clip.file << " frame " << t << " " << avatar.skeleton.joints[j].name;
            }
        }
    }
}

TEST_P(RealMotion, BringsTheWristsToTheKeypoints) {
    const Avatar avatar = read_avatar(test_file(GetParam()));
    for (const std::string& file : kKeypoints) {
        const Motion motion = read_motion(test_file(file));
        const Fit fit = fit_motion(motion, avatar, {.fps = 30});
        ASSERT_GE(fit.report.reached.size(), 2u);  // arms, and legs where they are seen
        for (const Reached& arm : fit.report.reached) {
            EXPECT_LT(arm.end_distance_mm.mean, 5) << arm.limb;
            EXPECT_LT(arm.unreachable, 12u) << arm.limb;
        }
        for (size_t t = 1; t < fit.poses.size(); ++t) {
            for (size_t j = 0; j < avatar.skeleton.joints.size(); ++j) {
                ASSERT_LT(angle_between(fit.poses[t - 1].joints[j].rotation, fit.poses[t].joints[j].rotation),
                          radians(45.0f))
                    << file << " frame " << t << " " << avatar.skeleton.joints[j].name;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Avatars, RealMotion, ::testing::ValuesIn(kAvatars),
                         [](const ::testing::TestParamInfo<std::string>& info) {
                             return testing::test_name_of(info.param);
                         });

TEST(FitMotion, HasAsManyFramesAsItsSecondsAsk) {
    const Avatar avatar = read_avatar(test_file("assets/avatars/mannequin.glb"));
    const Motion wave = read_motion(test_file("tests/fixtures/gestures/wave.bvh"));
    EXPECT_EQ(fit_motion(wave, avatar, {.fps = 30}).poses.size(), 90u);  // 360 at 119.88 a second
    const Motion points = read_motion(test_file("tests/fixtures/gestures/mediapipe_world33_25fps.npy"));
    EXPECT_EQ(fit_motion(points, avatar, {.fps = 30}).poses.size(), 90u);  // 75 at 25 a second
}

}  // namespace
}  // namespace chironomia
