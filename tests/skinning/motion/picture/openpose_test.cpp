#include "skinning/motion/picture/openpose.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;
using ::testing::StartsWith;
using testing::TemporaryFolder;

// A body of which only the nose and the neck are seen, `x` pixels from the left.
Json person(double x, double confidence = 0.8, std::size_t points = 25) {
    std::vector<double> numbers(3 * points, 0);
    numbers[0] = x;
    numbers[1] = 50;
    numbers[2] = confidence;
    numbers[3] = x + 1;
    numbers[4] = 80;
    numbers[5] = confidence;
    return {{"pose_keypoints_2d", numbers}, {"hand_left_keypoints_2d", Json::array()}};
}

void write_frame(const fs::path& folder, int number, const std::vector<Json>& people) {
    write_text(folder / format("clip_{:012}_keypoints.json", number), Json({{"people", people}}).dump());
}

float x_of(const Motion& motion, std::size_t t, const std::string& name) {
    const PictureTrack& track = *motion.picture;
    const auto k = std::size_t(std::find(track.names.begin(), track.names.end(), name) - track.names.begin());
    return track.points[t * track.names.size() + k].x;
}

TEST(ReadOpenPose, TakesThePointsOfOnePerson) {
    const TemporaryFolder folder;
    write_frame(folder.path(), 7, {person(100)});
    write_frame(folder.path(), 8, {person(104)});
    const Motion motion = read_openpose(folder.path(), 25);
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_EQ(motion.fps, 25);
    EXPECT_EQ(x_of(motion, 1, "nose"), 104);
    EXPECT_EQ(x_of(motion, 1, "thorax"), 105);
    EXPECT_THAT(motion.picture->names, Contains("face_69"));
    EXPECT_THAT(motion.picture->names, Contains("right_little_4"));
    EXPECT_EQ(motion.companions.size(), 2u);
}

// "._clip_000000000007_keypoints.json", of macOS on a disk of another system.
TEST(ReadOpenPose, PassesOverFilesOfTheFileSystem) {
    const TemporaryFolder folder;
    write_frame(folder.path(), 7, {person(100)});
    write_text(folder / "._clip_000000000007_keypoints.json", "of macOS");
    EXPECT_EQ(read_openpose(folder.path(), 25).companions.size(), 1u);
    fs::remove(folder / "clip_000000000007_keypoints.json");
    EXPECT_FALSE(is_openpose_folder(folder.path()));
}

TEST(ReadOpenPose, FollowsThePersonItBeganWith) {
    const TemporaryFolder folder;
    write_frame(folder.path(), 0, {person(100, 0.5), person(300, 0.9)});
    write_frame(folder.path(), 1, {person(302, 0.4), person(101, 0.9)});
    write_frame(folder.path(), 2, {person(102, 0.9), person(304, 0.4)});
    const Motion motion = read_openpose(folder.path(), 25);
    EXPECT_EQ(x_of(motion, 1, "nose"), 302);
    EXPECT_EQ(x_of(motion, 2, "nose"), 304);
    EXPECT_THAT(motion.notes, Contains(StartsWith("several people in 3 frames")));
}

TEST(ReadOpenPose, LeavesAFrameWithoutFileEmptyAndSaysSo) {
    const TemporaryFolder folder;
    for (const int number : {0, 1, 3}) write_frame(folder.path(), number, {person(100)});
    const Motion motion = read_openpose(folder.path(), 25);
    EXPECT_EQ(motion.frames, 4u);
    EXPECT_EQ(motion.picture->confidence[2 * motion.picture->names.size()], 0);
    EXPECT_THAT(motion.notes, Contains("1 frames have no file"));
}

TEST(ReadOpenPose, SaysThatItsNumbersBeginLate) {
    const TemporaryFolder folder;
    write_frame(folder.path(), 15, {person(100)});
    const Motion motion = read_openpose(folder.path(), 25);
    EXPECT_EQ(motion.first_time, 0.6);
    EXPECT_THAT(motion.notes, Contains("time: the first frame is at 0.6 s, which is second 0 here"));
}

TEST(ReadOpenPose, KnowsCoco) {
    const TemporaryFolder folder;
    write_frame(folder.path(), 0, {person(100, 0.8, 18)});
    EXPECT_THAT(read_openpose(folder.path(), 25).notes, Contains(StartsWith("OpenPose: COCO-18")));
}

TEST(ReadOpenPose, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    const auto refusal = [&] { return refusal_of([&] { read_openpose(folder.path(), 25); }); };
    write_frame(folder.path(), 0, {person(100)});
    EXPECT_THAT(
        refusal_of([&] { read_motion(folder.path()); }),
        HasSubstr("OpenPose does not write the frame rate; give that of the video with --motion-fps"));
    write_frame(folder.path(), 90, {person(100)});
    EXPECT_THAT(refusal(), HasSubstr("holds 2 of the frames 0 to 90; more than half of them are missing"));
    fs::remove(folder / "clip_000000000090_keypoints.json");

    const fs::path second = folder / "clip_000000000001_keypoints.json";
    write_text(second, R"({"people": [{"pose_keypoints_2d": [1, 2]}]})");
    EXPECT_THAT(refusal(),
                HasSubstr("clip_000000000001_keypoints.json: pose_keypoints_2d has 2 numbers, 75 are"));
    write_text(second, R"({"people": [{"pose_key)");
    EXPECT_THAT(refusal(), HasSubstr("clip_000000000001_keypoints.json"));
    write_text(second, "[]");
    EXPECT_THAT(refusal(), HasSubstr("has no list \"people\""));
    Json broken = person(100);
    broken["pose_keypoints_2d"][4] = nullptr;
    write_frame(folder.path(), 1, {broken});
    EXPECT_THAT(refusal(),
                HasSubstr("pose_keypoints_2d: number 4 is null; a place or a confidence is expected"));
    write_frame(folder.path(), 1, {person(100, 1.5)});
    EXPECT_THAT(refusal(), HasSubstr("the confidence of point 0 is 1.5; it lies between 0 and 1"));
    fs::remove(second);

    write_text(folder / "other_000000000000_keypoints.json", R"({"people": []})");
    EXPECT_THAT(refusal(), HasSubstr("has the same frame number as"));
    fs::remove(folder / "other_000000000000_keypoints.json");
    write_text(folder / "clip_keypoints.json", R"({"people": []})");
    EXPECT_THAT(refusal(), HasSubstr("its name has no frame number"));
}

TEST(ReadOpenPose, RefusesOtherBodiesAndEmptyPictures) {
    const TemporaryFolder body, nobody;
    write_frame(body.path(), 0, {person(100, 0.8, 15)});
    EXPECT_THAT(refusal_of([&] { read_openpose(body.path(), 25); }),
                HasSubstr("pose_keypoints_2d has 15 points; 25 (BODY_25) or 18 (COCO) are known"));
    write_frame(nobody.path(), 0, {});
    EXPECT_THAT(refusal_of([&] { read_openpose(nobody.path(), 25); }),
                HasSubstr("nobody is seen in any of its 1 frames"));
}

}  // namespace
}  // namespace chironomia
