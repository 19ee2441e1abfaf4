// Faces through the real binary: what is seen, said, baked and remembered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "core/hash.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/study/sounds.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();

// Half a second of a smile and closed eyes at 20 frames a second, the head a little to the left.
fs::path write_face(const fs::path& file, double smile) {
    std::string text = "time,AU12,AU45_L,AU45_R,head_qx,head_qy,head_qz,head_qw\n";
    for (int row = 0; row < 10; ++row)
        text += format("{},{},5,5,0,0.0998334166,0,0.9950041653\n", row / 20.0, smile);
    write_text(file, text);
    return file;
}

std::vector<std::string> render(const fs::path& out, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", "--quiet", "--size", "160x90", "--scene", "head"};
    words.insert(words.end(), {"--out", out.string()});
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::string arkit_avatar() {
    return testing::test_file("made/makehuman.glb").string();
}

TEST(FaceCli, AFaceAloneMovesAStandingAvatar) {
    const TemporaryFolder folder;
    for (const double smile : {0.0, 5.0}) {
        const fs::path face = write_face(folder / format("{}.csv", smile), smile);
        const Outcome outcome = run_chironomia(render(folder / format("{}", smile) / "%d.png",
                                                      {"--face", face.string(), "--avatar", arkit_avatar()}));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }
    // 0.5 s at 30 frames a second.
    EXPECT_TRUE(fs::exists(folder / "5/14.png"));
    EXPECT_FALSE(fs::exists(folder / "5/15.png"));
    EXPECT_NE(sha256_of_file(folder / "0/7.png"), sha256_of_file(folder / "5/7.png"));
}

TEST(FaceCli, TakesTheRateOfAFaceWithoutTimes) {
    const TemporaryFolder folder;
    write_text(folder / "f.csv", "AU12,AU6\n1,0\n2,0\n3,1\n4,1\n");
    std::vector<std::string> words =
        render(folder / "frames/%d.png", {"--face", (folder / "f.csv").string(), "--avatar", arkit_avatar()});
    EXPECT_THAT(run_chironomia(words).err, HasSubstr("set the rate with --motion-fps"));
    words.insert(words.end(), {"--motion-fps", "20"});
    const Outcome outcome = run_chironomia(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder / "frames/5.png")) << "0.2 s at 30 frames a second";
}

TEST(FaceCli, SaysWhatAnAvatarCannotShowAndWhatIsHeld) {
    const TemporaryFolder folder;
    const fs::path face = write_face(folder / "f.csv", 3);
    const Outcome outcome = run_chironomia(
        render(folder / "c.mp4",
               {"--motion", kMotion, "--face", face.string(), "--frames", "0:20", "--avatar",
                testing::test_file("made/numbered.glb").string(), "--report", (folder / "r.json").string()}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("numbered.glb: cannot show AU12 lip corner puller, AU45_L blink, "
                                       "AU45_R blink: it has no morphs\n"));
    EXPECT_THAT(outcome.err, HasSubstr("f.csv: the face lasts 15 frames of "));
    EXPECT_THAT(outcome.err, HasSubstr("; its last values are held\n"));
    const Json report = read_json(folder / "r.json");
    const Json& fitted_face = report["motions"][0]["fit"]["face"];
    EXPECT_EQ(fitted_face["file"], face.string());
    EXPECT_EQ(fitted_face["cannot_show"][0]["unit"], "AU12");
    EXPECT_EQ(fitted_face["head"], "replaced");
    EXPECT_EQ(report["recipe"]["performers"][0]["face"][0], sha256_of_file(face));
}

// A part of a recording: its first row is at 5 s.
TEST(FaceCli, WarnsOfTimesThatBeginLate) {
    const TemporaryFolder folder;
    std::string late = "timestamp,success,AU12_r\n", points = "frame,nose_x,nose_y,nose_z";
    for (const char* name : {"left_shoulder", "right_shoulder", "left_wrist", "right_wrist"})
        for (const char axis : {'x', 'y', 'z'}) points += format(",{}_{}", name, axis);
    points += '\n';
    for (int row = 0; row < 10; ++row) {
        late += format("{:.2f},1,{}\n", 5 + row / 20.0, 0.1 * row);
        points += format("{},0,1.6,0.1,0.2,1.4,0,-0.2,1.4,0,0.3,1,0.1,-0.3,1,0.{}\n", 100 + row, row);
    }
    const fs::path face = folder / "late.csv", body = folder / "points.csv", sound = folder / "s.wav";
    write_text(face, late);
    write_text(body, points);
    write_wav(sound, testing::sine({.seconds = 6}));
    const std::vector<std::string> files = {"--motion", body.string(), "--motion-fps", "20",
                                            "--face",   face.string(), "--audio",      sound.string(),
                                            "--frames", "0:2"};
    const Outcome outcome = run_chironomia(render(folder / "c.mp4", files));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* name : {"late.csv", "points.csv"}) {
        EXPECT_THAT(outcome.err,
                    HasSubstr(format("{}: its times begin at 5 s, which is second 0 of the clip; a sound "
                                     "of the whole recording is cut to it by --audio-cut 5:\n",
                                     (folder / name).string())));
    }
    std::vector<std::string> cut = files;
    cut.insert(cut.end(), {"--audio-cut", "5:"});
    EXPECT_THAT(run_chironomia(render(folder / "c.mp4", cut)).err, Not(HasSubstr("its times begin")));
}

TEST(FaceCli, BakesTheFaceIntoAGlb) {
    const TemporaryFolder folder;
    const fs::path face = write_face(folder / "f.csv", 5);
    const Outcome outcome = run_chironomia({"convert", "--face", face.string(), "--avatar", arkit_avatar(),
                                            "--face-gain", "12=0.5", "--report", (folder / "r.json").string(),
                                            "--out", (folder / "x.glb").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string glb = read_text(folder / "x.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    const Json json = Json::parse(glb.substr(20, length));
    std::size_t weights = 0;
    for (const Json& channel : json["animations"][0]["channels"])
        weights += channel["target"]["path"] == "weights" ? 1 : 0;
    // Skin, lashes, the lids' shadow and their wet line; eyeballs, teeth and tongue have no shape of a smile or a blink.
    EXPECT_EQ(weights, 4u);
    EXPECT_THAT(read_json(folder / "r.json")["face"]["shown"]["AU12"],
                ElementsAre("mouthSmileLeft", "mouthSmileRight"));
}

TEST(FaceCli, JoinsFaceAndBodyInOneMotion) {
    const TemporaryFolder folder;
    const fs::path face = write_face(folder / "f.csv", 5);
    const Outcome joined = run_chironomia(
        {"convert", "--motion", kMotion, "--face", face.string(), "--out", (folder / "both.h5").string()});
    ASSERT_EQ(joined.exit_code, 0) << joined.err;
    const Outcome own = run_chironomia(
        render(folder / "a/%d.png", {"--motion", (folder / "both.h5").string(), "--frames", "3:4"}));
    EXPECT_EQ(own.exit_code, 0) << own.err;
    EXPECT_EQ(own.err, "");
    const Outcome faceless =
        run_chironomia(render(folder / "c/%d.png", {"--motion", (folder / "both.h5").string(), "--avatar",
                                                    "mannequin", "--frames", "3:4"}));
    EXPECT_THAT(faceless.err, HasSubstr("mannequin.glb: cannot show AU12"));
    const Outcome beside = run_chironomia(
        render(folder / "b/%d.png", {"--motion", kMotion, "--face", face.string(), "--frames", "3:4"}));
    EXPECT_EQ(beside.exit_code, 0) << beside.err;
    EXPECT_EQ(read_text(folder / "a/0.png"), read_text(folder / "b/0.png"));
}

TEST(FaceCli, AStudyRefusesAMotionWhoseFaceTheOtherConditionLacks) {
    const TemporaryFolder folder;
    const fs::path face = write_face(folder / "f.csv", 5);
    ASSERT_EQ(run_chironomia({"convert", "--motion", kMotion, "--face", face.string(), "--out",
                              (folder / "both.h5").string()})
                  .exit_code,
              0);
    write_json(
        folder / "plan.json",
        {{"title", "Two ways"},
         {"layout", "pair"},
         {"conditions", {"ours", "baseline"}},
         {"clips", Json::array({{{"id", "c1"}, {"motion", {{"ours", "both.h5"}, {"baseline", kMotion}}}}})}});
    const Outcome built = run_chironomia({"study", "build", (folder / "plan.json").string(), "--seed", "1",
                                          "--quiet", "--out", (folder / "study").string()});
    EXPECT_EQ(built.exit_code, 3);
    EXPECT_EQ(
        built.err,
        "chironomia: clip \"c1\": \"ours\" moves the face and \"baseline\" does not; give every condition a "
        "\"face\", or set the \"face_mode\" to \"neutral\"\n");
    EXPECT_FALSE(fs::exists(folder / "study"));
}

TEST(FaceCli, RefusesWhatIsNoFace) {
    const TemporaryFolder folder;
    const Outcome body = run_chironomia(render(folder / "c.mp4", {"--motion", kMotion, "--face", kMotion}));
    EXPECT_EQ(body.exit_code, 3);
    EXPECT_THAT(body.err, HasSubstr("two-ways.bvh: this motion holds no face; give a file of action units, "
                                    "head turns or gaze"));
    EXPECT_FALSE(fs::exists(folder / "c.mp4"));
    const Outcome none = run_chironomia(render(folder / "c.mp4", {"--face", "/nowhere/f.csv"}));
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_THAT(none.err, HasSubstr("/nowhere/f.csv"));
}

TEST(FaceCli, RefusesOptionsOfAFaceWhereNoneIs) {
    const TemporaryFolder folder;
    const fs::path face = write_face(folder / "f.csv", 5);
    const auto refused = [&](const std::vector<std::string>& words) {
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, 3);
        return outcome.err;
    };
    for (const std::vector<std::string>& given :
         {std::vector<std::string>{"--face-gain", "12=2"}, {"--face-head", "add"}}) {
        const std::string says =
            "chironomia: " + kMotion + ": " + given[0] +
            " was set, but no face comes with the motion; leave it out, or give one with "
            "--face\n";
        std::vector<std::string> words = {"--motion", kMotion, given[0], given[1]};
        EXPECT_EQ(refused(render(folder / "c.mp4", words)), says);
        EXPECT_FALSE(fs::exists(folder / "c.mp4"));
        words.insert(words.begin(), "convert");
        words.insert(words.end(), {"--out", (folder / "c.glb").string()});
        EXPECT_EQ(refused(words), says);
        // One of two people has a face.
        const Outcome both = run_chironomia(render(
            folder / "c.mp4", {"--motion", kMotion, "--motion", kMotion, "--face", face.string(), "--face",
                               face.string(), given[0], given[1], "--scene", "dyad", "--frames", "0:2"}));
        EXPECT_THAT(both.err, Not(HasSubstr("no face comes")));
    }
}

TEST(FaceCli, MakesTheSameBytesForAnyThreads) {
    const TemporaryFolder folder;
    const fs::path face = write_face(folder / "f.csv", 4);
    for (const char* threads : {"1", "3"}) {
        ASSERT_EQ(
            run_chironomia(render(folder / format("{}.mp4", threads), {"--face", face.string(), "--avatar",
                                                                       arkit_avatar(), "--threads", threads}))
                .exit_code,
            0);
    }
    EXPECT_EQ(sha256_of_file(folder / "1.mp4"), sha256_of_file(folder / "3.mp4"));
}

}  // namespace
}  // namespace chironomia::study
