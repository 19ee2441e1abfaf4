// Bodies of Azure Kinect and CMU Panoptic, and folders that are no motion, through the one door: read_motion.
#include "skinning/motion/points/bodies_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

// A person who faces a camera [mm]: x to its right, which is their left, y down, z away from it.
struct SeenJoint {
    const char* azure;
    double x, y, z;
};
constexpr SeenJoint kSpine[] = {{"PELVIS", 0, 0, 2000}, {"NECK", 0, -500, 2000}, {"NOSE", 0, -620, 1880}};
constexpr SeenJoint kSide[] = {{"SHOULDER", 180, -480, 2000}, {"ELBOW", 250, -200, 2000},
                               {"WRIST", 300, 60, 1950},      {"HIP", 100, 0, 2000},
                               {"KNEE", 100, 430, 2000},      {"ANKLE", 100, 850, 2000},
                               {"EYE", 35, -650, 1900},       {"EAR", 75, -630, 1990}};

Json body_of_kinect(int id, double aside = 0) {
    Json places = Json::array();
    for (const SeenJoint& joint : kSpine) places.push_back({joint.x + aside, joint.y, joint.z});
    for (const double side : {1, -1}) {
        for (const SeenJoint& joint : kSide) places.push_back({side * joint.x + aside, joint.y, joint.z});
    }
    return {{"body_id", id}, {"joint_positions", places}};
}

Json file_of_kinect() {
    Json names = Json::array();
    for (const SeenJoint& joint : kSpine) names.push_back(joint.azure);
    for (const char* side : {"_LEFT", "_RIGHT"}) {
        for (const SeenJoint& joint : kSide) names.push_back(std::string(joint.azure) + side);
    }
    Json frames = Json::array();
    for (const int t : {0, 1, 2, 3}) {
        Json bodies = Json::array({body_of_kinect(3, 10 * t)});
        if (t == 1) bodies = Json::array({body_of_kinect(5, 900), bodies[0]});
        if (t == 2) bodies = Json::array();
        frames.push_back({{"bodies", bodies}, {"frame_id", t}, {"timestamp_usec", 50000 + 40000 * t}});
    }
    return {{"joint_names", names}, {"frames", frames}};
}

Vec3 between(const Motion& motion, size_t t, std::string_view from, std::string_view to) {
    const auto& names = motion.keypoints->names;
    const auto at = [&](std::string_view name) {
        const auto k = std::find(names.begin(), names.end(), name) - names.begin();
        return motion.keypoints->points.at(t * names.size() + size_t(k));
    };
    return at(to) - at(from);
}

// Metres, y up, towards +z.
void expect_the_person(const Motion& motion) {
    EXPECT_LT(distance(between(motion, 0, "left_hip", "left_wrist"), Vec3(0.2f, -0.06f, 0.05f)), 1e-4f);
    EXPECT_LT(distance(between(motion, 1, "right_hip", "right_wrist"), Vec3(-0.2f, -0.06f, 0.05f)), 1e-4f);
    EXPECT_LT(distance(between(motion, 0, "pelvis", "nose"), Vec3(0, 0.62f, 0.12f)), 1e-4f);
}

TEST(BodiesJson, ReadsAzureKinect) {
    const testing::TemporaryFolder folder;
    write_json(folder / "a.json", file_of_kinect());
    const Motion motion = read_motion(folder / "a.json");
    EXPECT_EQ(motion.fps, 25);
    ASSERT_EQ(motion.frames, 4u);
    expect_the_person(motion);
    EXPECT_EQ(motion.keypoints->confidence.at(2 * motion.keypoints->names.size()), 0);  // nobody
    EXPECT_THAT(motion.notes, Contains("bodies: 19 joints, 4 frames"));
    EXPECT_THAT(motion.notes,
                Contains("several people: the body 3 is taken, as it comes first; 1 times there is another"));
}

TEST(BodiesJson, TakesTheFirstOfSeveralBodiesWithoutNumbers) {
    const testing::TemporaryFolder folder;
    Json json = file_of_kinect();
    std::swap(json["frames"][1]["bodies"][0], json["frames"][1]["bodies"][1]);
    for (Json& frame : json["frames"])
        for (Json& body : frame["bodies"]) body.erase("body_id");
    write_json(folder / "a.json", json);
    const Motion motion = read_motion(folder / "a.json");
    expect_the_person(motion);
    EXPECT_THAT(motion.notes, Contains("several people: the body at place 0 is taken, as it comes first; 1 "
                                       "times there is another"));
}

TEST(BodiesJson, RefusesBodiesOfAnotherForm) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&](const Json& json) {
        write_json(folder / "a.json", json);
        return refusal_of([&] { read_motion(folder / "a.json"); });
    };
    Json json = file_of_kinect();
    json["frames"][1]["bodies"][1]["joint_positions"].erase(0);
    EXPECT_THAT(refusal(json),
                HasSubstr("a.json: frame 1: a body has no \"joint_positions\" or \"joints19\" of 19 "
                          "joints; get the file again"));
    json["frames"][1]["bodies"][1]["joint_positions"] = 7;
    EXPECT_THAT(refusal(json), HasSubstr("frame 1: a body has no"));
    json.erase("joint_names");
    EXPECT_THAT(refusal(json), HasSubstr("a.json: its bodies have no \"joint_names\"; write it with "
                                         "offline_processor of Azure Kinect"));
}

TEST(BodiesJson, ReadsAFolderOfPanoptic) {
    const testing::TemporaryFolder folder;
    constexpr int kOfKinect[] = {1, 2, 0, 3, 4, 5, 6, 7, 8, 11, 12, 13, 14, 15, 16, 9, 10, 17, 18};
    for (const int t : {0, 1}) {
        const Json places = body_of_kinect(0)["joint_positions"];
        Json row = Json::array();
        for (const int k : kOfKinect) {
            for (const Json& number : places[size_t(k)]) row.push_back(number.get<double>() / 10);
            row.push_back(k == 9 ? -1 : 0.6);
        }
        write_json(
            folder / format("body3DScene_{:08d}.json", 99 + t),
            {{"univTime", 53541.5 + 40 * t}, {"bodies", Json::array({{{"id", 0}, {"joints19", row}}})}});
    }
    ASSERT_TRUE(is_panoptic_folder(folder.path()));
    const Motion motion = read_motion(folder.path());
    EXPECT_NEAR(motion.fps, 25, 1e-6);
    ASSERT_EQ(motion.frames, 2u);
    EXPECT_EQ(motion.companions.size(), 2u);
    expect_the_person(motion);
    EXPECT_FLOAT_EQ(motion.keypoints->confidence[0], 0.6f);
    EXPECT_EQ(motion.keypoints->confidence[15], 0);  // the left eye was not found
}

TEST(BodiesJson, SaysWhichFoldersAreRead) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&] { return refusal_of([&] { read_motion(folder.path()); }); };
    EXPECT_THAT(refusal(),
                HasSubstr("this folder is no motion; folders of OpenPose (NAME_NUMBER_keypoints.json) and of "
                          "CMU Panoptic (body3DScene_NUMBER.json) are read; name a file, or the folder in "
                          "it that has those"));
    write_text(folder / "clip_1.txt", "0 0.5 0.5\n");
    EXPECT_THAT(refusal(),
                HasSubstr("are read; labels of YOLO, a text a picture, are not read: save the points of all "
                          "frames as one .npy, (frames, 17, 3) of x, y in pixels and confidence"));
    write_text(folder / "000001.json", "[]");
    EXPECT_THAT(refusal(),
                HasSubstr("are read; JSON a picture is not read otherwise: write one JSON, a list of "
                          "{\"frame_id\": 0, \"instances\": [{\"keypoints\": [[x, y], ...], "
                          "\"keypoint_scores\": [...]}]} for each picture"));
}

}  // namespace
}  // namespace chironomia
