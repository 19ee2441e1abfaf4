// chironomia convert from every kind of motion to every form: the real binary, its files and its refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using ::testing::StartsWith;
using testing::TemporaryFolder;

const std::string kBvh = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();
const std::string kPoints = (source_dir() / "assets/samples/keypoints/two-ways.npz").string();

class Convert : public ::testing::Test {
  protected:
    Outcome convert(const std::string& motion, const std::string& out, std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"convert", "--motion", motion, "--out", (folder_ / out).string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    }
    std::string info(const std::string& file) {
        return run_chironomia({"info", (folder_ / file).string(), "--motion-fps", "25"}).out;
    }

    TemporaryFolder folder_;
};

TEST_F(Convert, NamesFilesOfOpenPoseByTheFolderWithAStrokeBehindItToo) {
    ASSERT_EQ(convert(kBvh, "clip/", {}).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_ / "clip/clip_000000000000_keypoints.json"));
}

TEST_F(Convert, TakesTheMotionWithAndWithoutItsOption) {
    const std::string with = (folder_ / "with.csv").string(), without = (folder_ / "without.csv").string();
    ASSERT_EQ(run_chironomia({"convert", "--motion", kBvh, "--out", with}).exit_code, 0);
    ASSERT_EQ(run_chironomia({"convert", kBvh, "--out", without}).exit_code, 0);
    EXPECT_EQ(read_text(with), read_text(without));
    EXPECT_EQ(run_chironomia({"fit", kBvh, "--avatar", "mannequin"}).out,
              run_chironomia({"fit", "--motion", kBvh, "--avatar", "mannequin"}).out);
    EXPECT_EQ(run_chironomia({"measure", kBvh}).out, run_chironomia({"measure", "--motion", kBvh}).out);
    const auto rendered = [&](std::vector<std::string> motions, const char* name) {
        std::vector<std::string> words = {"render", "--scene", "dyad",     "--avatar", "mannequin",
                                          "--size", "64x36",   "--frames", "0:2"};
        words.insert(words.end(), {"--out", (folder_ / name / "%02d.png").string()});
        words.insert(words.end(), motions.begin(), motions.end());
        EXPECT_EQ(run_chironomia(words).exit_code, 0);
        return read_bytes(folder_ / name / "01.png");
    };
    EXPECT_EQ(rendered({"--motion", kBvh, "--motion", kPoints}, "a"), rendered({kBvh, kPoints}, "b"));
}

TEST_F(Convert, MakesAPictureOfAMotionInSpaceAndLiftsItAgain) {
    const Outcome made = convert(kBvh, "clip", {"--yaw", "20", "--size", "640x480", "--focal", "600"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err,
                HasSubstr("camera: pinhole, 640 x 480 px, focal length 600 px, 4 m away, 20 degrees"));
    EXPECT_TRUE(fs::exists(folder_ / "clip/clip_000000000000_keypoints.json"));
    EXPECT_THAT(info("clip"), HasSubstr("picture       nose, thorax, right_shoulder"));
    const std::string picture = (folder_ / "clip").string();
    for (const char* form : {"a.bvh", "a.glb", "a.h5", "a.csv"}) {
        const Outcome back = convert(picture, form, {"--motion-fps", "25"});
        EXPECT_EQ(back.exit_code, 0) << form << ": " << back.err;
    }
    EXPECT_THAT(info("a.bvh"), HasSubstr("play a part of a humanoid"));
    ASSERT_EQ(convert(picture, "lifted.h5", {"--motion-fps", "25", "--lift"}).exit_code, 0);
    EXPECT_THAT(info("lifted.h5"), HasSubstr("keypoints     pelvis, thorax, nose"));
    EXPECT_THAT(info("lifted.h5"), HasSubstr("lifted from the picture into space"));
}

TEST_F(Convert, FindsTheDistanceOfACameraByItsLens) {
    ASSERT_EQ(convert(kBvh, "clip", {"--distance", "7"}).exit_code, 0);
    const std::string picture = (folder_ / "clip").string(), report = (folder_ / "report.json").string();
    const auto distance = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--motion-fps", "25", "--report", report});
        const Outcome lifted = convert(picture, "a.bvh", more);
        EXPECT_EQ(lifted.exit_code, 0) << lifted.err;
        return read_json(report)["lift"]["camera_distance_m"].get<double>();
    };
    EXPECT_EQ(distance({}), 4);
    EXPECT_NEAR(distance({"--picture-size", "1280x720", "--field-of-view", "53.13"}), 7, 0.7);
    const Outcome unsized = convert(picture, "b.h5", {"--motion-fps", "25", "--field-of-view", "53"});
    EXPECT_EQ(unsized.exit_code, 3);
    EXPECT_THAT(unsized.err, HasSubstr("the size of the picture is not known; set it, too"));
    const Outcome wide = convert(picture, "b.h5", {"--motion-fps", "25", "--field-of-view", "wide"});
    EXPECT_EQ(wide.exit_code, 2);
    EXPECT_THAT(wide.err, HasSubstr("field of view: \"wide\" is not known; use 5 to 160 degrees"));
    EXPECT_FALSE(fs::exists(folder_ / "b.h5"));
}

TEST_F(Convert, SmoothsAMotionInSpaceOnlyIfAsked) {
    ASSERT_EQ(convert(kBvh, "as-it-is.h5").exit_code, 0);
    ASSERT_EQ(convert(kBvh, "smooth.h5", {"--smooth", "4"}).exit_code, 0);
    EXPECT_THAT(info("as-it-is.h5"), Not(HasSubstr("smoothed")));
    EXPECT_THAT(info("smooth.h5"), HasSubstr("smoothed as asked: zero-phase low-pass at 4 Hz"));
    const auto jerk = [&](const char* file) {
        const Outcome measured = run_chironomia({"measure", (folder_ / file).string(), "--json"});
        return Json::parse(measured.out)[0]["body"][0]["jerk"].get<double>();
    };
    EXPECT_LT(jerk("smooth.h5"), 0.9 * jerk("as-it-is.h5"));
    const Outcome refused = convert(kBvh, "never.h5", {"--smooth", "none"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("smoothing: \"none\" is not known; use a cutoff of 0.1 to 100 Hz"));
}

TEST_F(Convert, PassesKeypointsThroughEveryForm) {
    for (const char* form : {"a.bvh", "a.glb", "a.h5", "a.csv", "clip"}) {
        const Outcome made = convert(kPoints, form);
        EXPECT_EQ(made.exit_code, 0) << form << ": " << made.err;
        EXPECT_EQ(made.out, (folder_ / form).string() + "\n");
    }
}

TEST_F(Convert, WritesABareSkeletonAndReadsIt) {
    ASSERT_EQ(convert(kBvh, "a.glb", {"--avatar", "none"}).exit_code, 0);
    EXPECT_THAT(info("a.glb"), HasSubstr("glTF: animation \"motion\", the first of 1"));
    ASSERT_EQ(convert((folder_ / "a.glb").string(), "b.bvh", {"--bvh-names", "mocapnet"}).exit_code, 0);
    EXPECT_EQ(convert(kBvh, "c.glb").exit_code, 0);
    EXPECT_EQ(convert((folder_ / "c.glb").string(), "d.bvh").exit_code, 0);
}

// A file of PATS goes the whole way to pictures.
TEST_F(Convert, IsNotNeededToRenderPats) {
    const Outcome made =
        run_chironomia({"render", "--motion", testing::test_file("made/pats.h5").string(), "--size", "160x90",
                        "--frames", "98:104", "--quiet", "--report", (folder_ / "report.json").string(),
                        "--out", (folder_ / "frames/%03d.png").string()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(fs::exists(folder_ / "frames/005.png"));  // 3.47 s are 104 frames of the clip
    EXPECT_THAT(read_text(folder_ / "report.json"), HasSubstr("PATS: /pose/data, PATS 52"));
}

TEST_F(Convert, DescribesAListOfFrames) {
    write_text(folder_ / "a.json", R"([{"nose": [1, 2], "neck": [1, 3], "left_wrist": [2, 4]}])");
    EXPECT_THAT(info("a.json"), HasSubstr("picture       nose, neck, left_wrist"));
}

TEST_F(Convert, RefusesWhatMakesNoSense) {
    const auto refusal = [&](const std::string& motion, const std::string& out,
                             std::vector<std::string> more) {
        const Outcome outcome = convert(motion, out, std::move(more));
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        EXPECT_FALSE(fs::exists(folder_ / out));
        return outcome.err;
    };
    EXPECT_THAT(refusal(kBvh, "a.fbx", {}),
                HasSubstr("\".fbx\" is no form of motion; choose .bvh, .glb, .h5"));
    EXPECT_THAT(refusal(kBvh, "a.h5", {"--yaw", "3"}),
                HasSubstr("a camera is of use for a folder of OpenPose alone"));
    EXPECT_THAT(refusal(kBvh, "a.h5", {"--bvh-names", "mocapnet"}),
                HasSubstr("--bvh-names is of use for a .bvh alone"));
    EXPECT_THAT(refusal(kBvh, "a.bvh", {"--avatar", "none"}),
                HasSubstr("--avatar none is of use for a .glb"));
    EXPECT_THAT(refusal(kPoints, "a.glb", {"--avatar", "none"}),
                HasSubstr("has no joints; name the avatar that it is put onto with --avatar"));
    EXPECT_THAT(refusal(kBvh, "a.h5", {"--lift"}),
                HasSubstr("has no points of a picture that could be lifted"));
    EXPECT_THAT(refusal(kBvh, "clip", {"--lift"}),
                HasSubstr("OpenPose holds points of a picture as they are"));
    ASSERT_EQ(convert(kBvh, "picture").exit_code, 0);
    EXPECT_THAT(refusal((folder_ / "picture").string(), "again", {"--motion-fps", "25", "--distance", "3"}),
                HasSubstr("its points are in a picture already, so no camera can be chosen"));
}

TEST_F(Convert, RefusesHintsThatTheMotionCannotUse) {
    const std::string names = (folder_ / "names.json").string();
    write_text(names, "{}");
    const std::string no_names =
        kBvh +
        ": names of keypoints were set, but the motion has no keypoints that a map could name; leave "
        "them out\n";
    const std::string not_lifted =
        ": a filter of lifting was set, but the motion is not lifted out of a "
        "picture; leave it out\n";
    for (const char* verb : {"info", "fit"}) {
        EXPECT_EQ(run_chironomia({verb, kBvh, "--names", names}).err, "chironomia: " + no_names);
        EXPECT_EQ(run_chironomia({verb, kPoints, "--lift-filter", "6"}).err,
                  "chironomia: " + kPoints + not_lifted);
    }
    const Outcome converted = convert(kBvh, "a.glb", {"--names", names});
    EXPECT_EQ(converted.exit_code, 3);
    EXPECT_THAT(converted.err, HasSubstr(no_names));
    EXPECT_THAT(convert(kBvh, "a.glb", {"--lift-filter", "off"}).err, HasSubstr(not_lifted));
    // Of two motions one may use what is given once for both.
    ASSERT_EQ(convert(kBvh, "picture").exit_code, 0);
    const Outcome two = run_chironomia({"render",
                                        "--motion",
                                        kBvh,
                                        "--motion",
                                        (folder_ / "picture").string(),
                                        "--motion-fps",
                                        "30",
                                        "--lift-filter",
                                        "6",
                                        "--avatar",
                                        "stick",
                                        "--size",
                                        "64x36",
                                        "--scene",
                                        "dyad",
                                        "--frames",
                                        "0:2",
                                        "--quiet",
                                        "--out",
                                        (folder_ / "two.mp4").string()});
    EXPECT_EQ(two.exit_code, 0) << two.err;
}

TEST_F(Convert, RefusesAFaceWhereNoneCanBe) {
    const std::string face = (folder_ / "face.csv").string();
    write_text(face, "frame,timestamp,confidence,success,AU12_r\n1,0,0.98,1,2\n2,0.04,0.98,1,3\n");
    const Outcome alone = run_chironomia({"convert", "--face", face, "--out", (folder_ / "clip").string()});
    EXPECT_EQ(alone.exit_code, 3);
    EXPECT_THAT(alone.err, HasSubstr("holds a face alone, and OpenPose holds no action units"));
    const Outcome bare = convert(kBvh, "a.glb", {"--avatar", "none", "--face", face});
    EXPECT_EQ(bare.exit_code, 3);
    EXPECT_THAT(bare.err, HasSubstr("a bare skeleton shows no face; name an avatar, or leave --face out"));
}

// A table holds one of them; by --face the file gives its face alone.
TEST_F(Convert, WritesTheFaceOfAFileThatHasABodyToo) {
    const std::string both = (folder_ / "both.h5").string(), face = (folder_ / "face.csv").string();
    ASSERT_EQ(run_chironomia({"synth", "--text", "Hello!", "--out", both}).exit_code, 0);
    const Outcome refused =
        run_chironomia({"convert", "--motion", both, "--out", (folder_ / "both.csv").string()});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err,
                HasSubstr("which keeps both, or give it by --face instead of --motion for its face alone"));
    ASSERT_EQ(run_chironomia({"convert", "--face", both, "--out", face}).exit_code, 0);
    EXPECT_THAT(read_text(face), StartsWith("time,"));
    EXPECT_THAT(read_text(face), HasSubstr("AU12"));
}

}  // namespace
}  // namespace chironomia::study
