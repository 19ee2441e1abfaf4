// The real binary: its exit codes, its messages, and what it leaves behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_info.h"
#include "study/clip/loudness.h"
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

const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();
const std::string kKeypoints = (source_dir() / "assets/samples/keypoints/two-ways.npz").string();
const std::string kSound = (source_dir() / "assets/samples/speech/two-ways.wav").string();

// A small clip of a few frames; options in `more` take the place of the usual ones.
std::vector<std::string> render(const fs::path& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"render"};
    for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
             {"--motion", kMotion}, {"--avatar", "mannequin"}, {"--size", "160x90"}, {"--frames", "0:12"}}) {
        if (std::find(more.begin(), more.end(), option) == more.end())
            words.insert(words.end(), {option, value});
    }
    words.insert(words.end(), {"--out", out.string()});
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// Everything in the folder, hidden files too.
std::vector<std::string> listing(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    return names;
}

TEST(Cli, HelpAndVersionGoToStdout) {
    const Outcome help = run_chironomia({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("render"));
    EXPECT_EQ(help.err, "");
}

TEST(Cli, TheVersionSaysWhatThisMachineHas) {
    const Outcome version = run_chironomia({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out,
                ::testing::MatchesRegex("chironomia [0-9.]+\nOSMesa  .+\nEGL     .+ Mesa [0-9.].*\n"
                                        "Embree  [34]\\.[0-9.]+\nFFmpeg  .+\nTorch   .+\n"
                                        "Built with\n(  [A-Za-z0-9_-]+ [0-9.]+\n)+"));
    EXPECT_THAT(version.out, HasSubstr("\n  HDF5 1."));
    for (const char* library : {"Draco", "FreeType", "libwebp", "meshoptimizer", "tinygltf"})
        EXPECT_THAT(version.out, HasSubstr(format("\n  {} ", library)));
}

// A machine without OSMesa: the loader meets files of its name that are no libraries.
struct NoOsMesa {
    NoOsMesa() {
        for (const char* name : {"libOSMesa.so.8", "libOSMesa.so"}) write_text(folder / name, "");
        setenv("LD_LIBRARY_PATH", folder.path().c_str(), 1);
    }
    ~NoOsMesa() { unsetenv("LD_LIBRARY_PATH"); }
    TemporaryFolder folder;
};

TEST(Cli, EglDrawsTheSameBytesWhereThereIsNoOsMesaAndSaysSo) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_chironomia(render(folder / "any.mp4", {"--quiet", "--renderer", "gl"})).exit_code, 0);
    const NoOsMesa missing;
    const Outcome outcome = run_chironomia(render(folder / "egl.mp4", {"--renderer", "gl"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                StartsWith("this machine has no OSMesa: EGL draws in its place, to the same bytes\n"));
    EXPECT_TRUE(read_bytes(folder / "egl.mp4") == read_bytes(folder / "any.mp4"));
}

TEST(Cli, OsMesaThatIsAskedForMustBeThere) {
    const TemporaryFolder folder;
    const NoOsMesa missing;
    const Outcome outcome = run_chironomia(render(folder / "clip.mp4", {"--gl", "osmesa"}));
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("libOSMesa.so.8: the library is not on this machine ("));
    EXPECT_THAT(outcome.err, HasSubstr("; install the package libosmesa6\n"));
    EXPECT_THAT(run_chironomia({"--version"}).out,
                HasSubstr("\nOSMesa  libOSMesa.so.8: the library is not on this machine ("));
}

TEST(Cli, AWrongCommandLineExitsWithTwo) {
    const Outcome outcome = run_chironomia({"render", "--colour", "red"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
}

TEST(Cli, ShowsControlCharactersOfADamagedFileAsNumbers) {
    const TemporaryFolder folder;
    write_text(folder / "a.bvh", "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 \x1b[31m0 0\n");
    const Outcome outcome = run_chironomia({"info", (folder / "a.bvh").string()});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("\"\\x1b[31m0\" is no number"));
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
}

TEST(Cli, RendersAClipWithSoundAndSaysWhere) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia(render(folder / "clip.mp4", {"--audio", kSound, "--quiet"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, (folder / "clip.mp4").string() + "\n");
    EXPECT_EQ(listing(folder.path()), std::vector<std::string>{"clip.mp4"});
    const Outcome info = run_chironomia({"info", (folder / "clip.mp4").string(), "--json"});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("h264"));
    EXPECT_THAT(info.out, HasSubstr("aac"));
}

TEST(Cli, RendersAPartAsLoudAsAskedFor) {
    const TemporaryFolder folder;
    const fs::path clip = folder / "clip.mp4";
    const Outcome outcome = run_chironomia(render(
        clip, {"--audio", kSound, "--cut", "2:2.5", "--frames", "0:15", "--loudness", "-30", "--quiet"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const ClipInfo info = read_clip_info(clip);
    EXPECT_EQ(info.picture->frames, 15u);
    EXPECT_NEAR(info.sound->duration_s, 0.5, 1e-3);
    EXPECT_NEAR(loudness_of_file(clip)->integrated.value(), -30, 0.5);
    const Outcome beyond = run_chironomia(render(folder / "no.mp4", {"--cut", "2:9.5"}));
    EXPECT_EQ(beyond.exit_code, 3);
    EXPECT_THAT(beyond.err, HasSubstr("2.000 s to 9.500 s is to be shown, but the motion lasts 8.967 s"));
    EXPECT_FALSE(fs::exists(folder / "no.mp4"));
}

TEST(Cli, AClipIsTheSameBytesForOneTwoAndFourThreadsAndBothLibraries) {
    using Ways = std::vector<std::vector<std::string>>;
    const TemporaryFolder folder;
    int clips = 0;
    const auto expect_same = [&](const Ways& ways) {
        std::vector<std::string> hashes;
        for (const std::vector<std::string>& way : ways) {
            const fs::path clip = folder / format("clip{}.mp4", ++clips);
            std::vector<std::string> more = {"--audio", kSound, "--quiet"};
            more.insert(more.end(), way.begin(), way.end());
            const Outcome outcome = run_chironomia(render(clip, more));
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            hashes.push_back(sha256_of_file(clip));
        }
        EXPECT_THAT(hashes, ::testing::Each(hashes[0]));
        return hashes[0];
    };
    const std::string tiles =
        expect_same({{"--threads", "1"}, {"--threads", "2"}, {"--threads", "4"}, {"--threads", "2"}});
    const std::string gl =
        expect_same({{"--gl", "osmesa"}, {"--renderer", "gl", "--threads", "1"}, {"--gl", "egl"}});
    EXPECT_NE(gl, tiles);
}

TEST(Cli, WritesAStackOfFramesThatEqualsItself) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_chironomia(render(folder / "a/%05d.png", {"--quiet"})).exit_code, 0);
    ASSERT_EQ(run_chironomia(render(folder / "b/%05d.png", {"--quiet", "--threads", "1"})).exit_code, 0);
    EXPECT_EQ(listing(folder / "a").size(), 12u);
    const Outcome same = run_chironomia({"compare", (folder / "a").string(), (folder / "b").string()});
    EXPECT_EQ(same.exit_code, 0);
    EXPECT_THAT(same.out, HasSubstr("the same: 12 of 12 frames"));
}

TEST(Cli, RaysGiveTheSameBytesForAnyThreads) {
    const TemporaryFolder folder;
    const auto rays = [&](const char* name, std::vector<std::string> more) {
        more.insert(more.end(), {"--quiet", "--renderer", "rays", "--samples", "4", "--frames", "30:32"});
        const Outcome outcome = run_chironomia(render(folder / name / "%05d.png", more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return sha256_of_file(folder / name / "00000.png") + sha256_of_file(folder / name / "00001.png");
    };
    const std::string two = rays("two", {"--threads", "2"});
    EXPECT_EQ(rays("one", {"--threads", "1"}), two);
    EXPECT_EQ(rays("three", {"--threads", "3"}), two);
    EXPECT_NE(rays("blurred", {"--motion-blur", "1"}), two);
}

// Four frames: what depends on the number of threads need not show in the first.
TEST(Cli, TilesGiveTheSameBytesForAnyThreadsAndNotThoseOfOpenGl) {
    const TemporaryFolder folder;
    const auto frames = [&](const std::string& renderer, const char* threads) {
        const fs::path stack = folder / (renderer + threads);
        const Outcome outcome =
            run_chironomia(render(stack / "%05d.png", {"--quiet", "--renderer", renderer, "--threads",
                                                       threads, "--frames", "30:34"}));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        std::string hashes;
        for (const char* name : {"00000.png", "00001.png", "00002.png", "00003.png"})
            hashes += sha256_of_file(stack / name);
        return hashes;
    };
    const std::string one = frames("tiles", "1");
    for (const char* threads : {"2", "3", "8"}) EXPECT_EQ(frames("tiles", threads), one) << threads;
    const std::string gl = frames("gl", "1");
    EXPECT_NE(gl, one);
    EXPECT_EQ(frames("raster", "1"), gl);
    EXPECT_EQ(frames("auto", "1"), one);
}

TEST(Cli, CompareExitsWithOneAndLeavesPicturesWhenFramesDiffer) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_chironomia(render(folder / "a/%05d.png", {"--quiet"})).exit_code, 0);
    ASSERT_EQ(run_chironomia(render(folder / "b/%05d.png", {"--quiet", "--body", "upper", "--scene", "head"}))
                  .exit_code,
              0);
    const Outcome outcome = run_chironomia({"compare", (folder / "a").string(), (folder / "b").string(),
                                            "--diff", (folder / "diff").string(), "--json"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    const Json result = Json::parse(outcome.out);
    EXPECT_FALSE(result["within_limits"].get<bool>());
    EXPECT_EQ(result["frames"].size(), 12u);
    EXPECT_TRUE(fs::exists(result["difference_images"][0].get<std::string>()));
}

TEST(Cli, ReportsHowWellTheAvatarFollows) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_chironomia(render(folder / "c.mp4", {"--quiet", "--report", (folder / "r.json").string()}))
                  .exit_code,
              0);
    const Json report = read_json(folder / "r.json");
    EXPECT_EQ(report["frames"], 12);
    EXPECT_EQ(report["motions"][0]["file"], kMotion);
    EXPECT_TRUE(report["motions"][0]["fit"].is_object());
    EXPECT_EQ(report["recipe"]["performers"][0]["motion"][0], sha256_of_file(kMotion));
}

TEST(Cli, WarnsWhenTheFigureWalksOutOfThePicture) {
    const TemporaryFolder folder;
    const std::string walker = testing::test_file("tests/fixtures/gestures/walk.bvh").string();
    const auto walk = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"--quiet", "--motion", walker, "--scene", "full"};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(render(folder / "a.mp4", words));
    };
    const Outcome walks = walk({"--frames", "125:137"});
    ASSERT_EQ(walks.exit_code, 0) << walks.err;
    EXPECT_THAT(walks.err, HasSubstr("walk.bvh: the head is outside the picture in 12 of 12 frames; "));
    EXPECT_EQ(walk({"--frames", "0:12"}).err, "") << "it is in the picture while these are shown";
    EXPECT_EQ(walk({"--frames", "125:137", "--body", "upper"}).err, "");
}

TEST(Cli, WarnsOfAFacingThatABodyWhichStandsStillDoesNotShow) {
    const TemporaryFolder folder;
    const std::filesystem::path report = folder / "report.json";
    const auto turned = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"--quiet", "--facing", "20", "--report", report.string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(render(folder / "a.mp4", words));
    };
    const Outcome upper = turned({"--body", "upper"});
    ASSERT_EQ(upper.exit_code, 0) << upper.err;
    EXPECT_THAT(upper.err,
                HasSubstr("a facing of 20 degrees was set, but it stands still and faces the front"));
    EXPECT_THAT(upper.err, HasSubstr("leave the facing out"));
    EXPECT_EQ(read_json(report)["motions"][0]["fit"]["stands_still"], true);
    EXPECT_EQ(turned({}).err, "") << "with its legs it turns";
    EXPECT_EQ(read_json(report)["motions"][0]["fit"]["stands_still"], false);
}

// The walker comes towards the camera: the feet leave the picture by its lower edge long before the head does.
TEST(Cli, WarnsWhenAFootOrAHandLeavesAPictureOfWholePeople) {
    const TemporaryFolder folder;
    const auto shown = [&](const std::string& motion, std::vector<std::string> more) {
        const std::string file = testing::test_file("tests/fixtures/gestures/" + motion).string();
        more.insert(more.end(), {"--quiet", "--motion", file});
        return run_chironomia(render(folder / "a.mp4", more));
    };
    const Outcome near = shown("walk.bvh", {"--scene", "full", "--frames", "40:60"});
    EXPECT_EQ(near.exit_code, 0);
    EXPECT_THAT(near.err,
                HasSubstr("walk.bvh: a foot is outside the picture in 20 of 20 frames; go along with "
                          "--follow, or hold the figure with --in-place or --body upper"));
    EXPECT_EQ(shown("walk.bvh", {"--scene", "full", "--frames", "40:60", "--follow"}).err, "");
    EXPECT_EQ(shown("walk.bvh", {"--scene", "full", "--frames", "40:44"}).err, "")
        << "0.13 s are not noticed";
    EXPECT_THAT(shown("walk.bvh", {"--scene", "upper", "--frames", "40:60"}).err, Not(HasSubstr("foot")))
        << "no feet are expected";

    // At first the arms are spread.
    const auto spread = [&](const char* scene, const char* size) {
        return shown("walk.bvh", {"--scene", scene, "--size", size, "--frames", "0:10"}).err;
    };
    EXPECT_THAT(spread("full", "64x128"),
                HasSubstr("walk.bvh: a hand is outside the picture in 10 of 10 frames; choose a wider scene, "
                          "such as a scene file with"));
    EXPECT_EQ(spread("full", "128x72"), "");
    EXPECT_EQ(spread("head", "128x72"), "") << "hands come and go";
}

TEST(Cli, WarnsWhenAHandLeavesThePicture) {
    const TemporaryFolder folder;
    const auto jump = [&](const std::string& scene, const std::string& frames) {
        return run_chironomia(render(
            folder / "a.mp4", {"--quiet", "--body", "upper", "--scene", scene, "--frames", frames, "--motion",
                               testing::test_file("tests/fixtures/gestures/jacks.bvh").string()}));
    };
    const Outcome cut = jump("upper", "30:60");
    ASSERT_EQ(cut.exit_code, 0) << cut.err;
    EXPECT_THAT(cut.err, HasSubstr("jacks.bvh: a hand leaves the picture by its upper edge or a side in "));
    EXPECT_THAT(cut.err, HasSubstr(" of 30 frames; "));
    EXPECT_THAT(cut.err,
                HasSubstr("choose a wider scene, such as a scene file with {\"camera\": {\"zoom\": 0.9}}"));
    EXPECT_EQ(jump("upper", "30:31").err, "") << "both hands are in the picture";
    write_text(folder / "far.json", R"({"camera": {"zoom": 0.6}})");
    EXPECT_EQ(jump((folder / "far.json").string(), "30:60").err, "");
}

struct Conversion {
    std::string motion;
    const char* ending;
    const char* begins;  // first bytes of the result
};

class Convert : public ::testing::TestWithParam<Conversion> {};

TEST_P(Convert, WritesAFormThatInfoReads) {
    const TemporaryFolder folder;
    const fs::path out = folder / (std::string("motion") + GetParam().ending);
    const Outcome outcome = run_chironomia({"convert", "--motion", GetParam().motion, "--out", out.string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(read_text(out), StartsWith(GetParam().begins));
    EXPECT_EQ(run_chironomia({"info", out.string()}).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, Convert,
    ::testing::Values(Conversion{kMotion, ".bvh", "HIERARCHY"}, Conversion{kMotion, ".glb", "glTF"},
                      Conversion{kMotion, ".h5", "\x89HDF"}, Conversion{kKeypoints, ".csv", "time,"},
                      Conversion{kKeypoints, ".bvh", "HIERARCHY"}, Conversion{kKeypoints, ".h5", "\x89HDF"}),
    [](const auto& form) {
        return std::string(form.param.motion == kMotion ? "turns_to_" : "keypoints_to_") +
               (form.param.ending + 1);
    });

TEST(Cli, ConvertsAFaceThatIsNoBody) {
    const TemporaryFolder folder;
    const std::string table = (folder / "face.csv").string(), out = (folder / "face.h5").string();
    write_text(table, "frame, timestamp, confidence, success, AU12_r\n1, 0, 1, 1, 0\n2, 0.04, 1, 1, 2.5\n");
    EXPECT_EQ(run_chironomia({"convert", "--motion", table, "--out", out}).exit_code, 0);
    EXPECT_THAT(run_chironomia({"info", out}).out, HasSubstr("face, at most AU12 2.5"));
    // An avatar that stands and turns its head as the face does.
    const Outcome stands = run_chironomia({"convert", "--motion", out, "--out", (folder / "a.bvh").string()});
    EXPECT_EQ(stands.exit_code, 0) << stands.err;
    EXPECT_THAT(read_text(folder / "a.bvh"), HasSubstr("Frames: 2\n"));
}

struct Refusal {
    std::vector<std::string> words;
    std::string says;
};

TEST(Cli, RefusesWrongInputWithExitThreeAndLeavesNothing) {
    const TemporaryFolder inputs;
    write_text(inputs / "truncated.bvh", read_text(kMotion).substr(0, 3000));
    write_text(inputs / "plan.json", R"({"title": "x", "layuot": "pair"})");
    const TemporaryFolder folder;
    const std::string out = (folder / "clip.mp4").string();
    const std::vector<Refusal> refusals = {
        {render(out, {"--motion", "/nowhere/m.bvh"}),
         "/nowhere/m.bvh: there is no such file; check the path"},
        {render(out, {"--motion", (inputs / "truncated.bvh").string()}), "truncated.bvh:"},
        {render(out, {"--audio", "/nowhere/a.wav"}), "/nowhere/a.wav"},
        {render(out, {"--avatar", "nobody"}),
         "nobody: is neither a file nor a bundled avatar; the bundled ones are female, female2, male, male2, mannequin, "
         "neutral"},
        {render(out, {"--scene", "moon"}), "moon"},
        {render(out, {"--size", "161x90"}), "161"},
        {render(out, {"--frames", "0:100000"}), "frames 0:100000 were asked for, but the clip has"},
        {render(folder / "clip.avi", {"--size", "161x90"}), "a clip cannot end in \".avi\""},
        {render("/proc/none/clip.mp4"), "/proc/none/clip.mp4: cannot be written"},
        {{"convert", "--motion", kMotion, "--out", (folder / "x.fbx").string()},
         "\".fbx\" is no form of motion; choose .bvh, .glb, .h5, .csv, or a name"},
        {{"info", "/nowhere/x"}, "/nowhere/x"},
        {{"study", "build", (inputs / "plan.json").string(), "--out", (folder / "s").string(), "--seed", "1"},
         "layuot"},
        {{"study", "check", (inputs.path()).string()}, inputs.path().string()},
        {{"compare", "/nowhere/a.png", "/nowhere/b.png"}, "/nowhere/a.png"},
    };
    for (const Refusal& refusal : refusals) {
        const Outcome outcome = run_chironomia(refusal.words);
        EXPECT_EQ(outcome.exit_code, 3) << join(refusal.words, " ") << "\n" << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(refusal.says));
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(fs::is_empty(folder.path())) << join(refusal.words, " ");
    }
}

// A quarter of an hour at one frame a second would be more than a million frames at 1000.
TEST(Cli, RefusesMoreFramesThanFitIntoTheMemory) {
    const TemporaryFolder folder;
    const std::string motion = read_text(kMotion);
    const std::size_t begin = motion.find("Frames:");
    const std::size_t row = motion.find('\n', motion.find("Frame Time:")) + 1;
    std::string slow = motion.substr(0, begin) + "Frames: 1001\nFrame Time: 1\n";
    for (int t = 0; t < 1001; ++t) slow += motion.substr(row, motion.find('\n', row) + 1 - row);
    const fs::path file = folder / "slow.bvh", clip = folder / "clip.mp4";
    write_text(file, slow);
    const std::string says = file.string() +
                             ": its 1001 frames at 1 frames/s last 1001 s, which are 1001000 frames at 1000 "
                             "frames/s, at most 1000000 are possible; choose a lower --fps, or set the "
                             "motion's own rate with --motion-fps if it is wrong";
    for (const char* avatar : {"mannequin", "stick"}) {
        const Outcome outcome =
            run_chironomia(render(clip, {"--motion", file.string(), "--fps", "1000", "--avatar", avatar}));
        EXPECT_EQ(outcome.exit_code, 3) << avatar;
        EXPECT_THAT(outcome.err, HasSubstr(says)) << avatar;
        EXPECT_FALSE(fs::exists(clip)) << avatar;
    }
    const Outcome converted = run_chironomia(
        {"convert", "--motion", file.string(), "--fps", "1000", "--out", (folder / "fast.h5").string()});
    EXPECT_EQ(converted.exit_code, 3);
    EXPECT_THAT(converted.err, HasSubstr(says));
}

TEST(Cli, LeavesNothingWhenTheDiskIsFull) {
    const TemporaryFolder folder;
    const Outcome outcome =
        testing::run_chironomia_with_file_limit(1500, render(folder / "clip.mp4", {"--quiet"}));
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("clip.mp4"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Cli, LeavesNothingUnderAFinalNameAfterInterruptAndKill) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGKILL}) {
        const TemporaryFolder folder;
        const fs::path partial = folder / ".clip.mp4.partial";
        const Outcome outcome = testing::signal_chironomia_at(
            partial, signal,
            {"render", "--motion", kMotion, "--size", "640x360", "--out", (folder / "clip.mp4").string()});
        EXPECT_EQ(outcome.exit_code, signal == SIGKILL ? 128 + SIGKILL : 130) << outcome.err;
        EXPECT_FALSE(fs::exists(folder / "clip.mp4"));
        if (signal != SIGKILL) {
            EXPECT_TRUE(fs::is_empty(folder.path())) << "an interrupt cleans up";
        }
    }
}

// As if this process were a run that began before.
TEST(Cli, WritesWhatAnotherRunBeganToWrite) {
    const TemporaryFolder folder;
    PendingOutput first(folder / "clip.mp4", PendingOutput::Kind::file);
    const Outcome second = run_chironomia(render(folder / "clip.mp4", {"--frames", "0:1", "--quiet"}));
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_THAT(testing::refusal_of([&] { first.commit(); }),
                HasSubstr("clip.mp4: another run began to write it meanwhile"));
    EXPECT_EQ(run_chironomia({"info", (folder / "clip.mp4").string()}).exit_code, 0);
}

TEST(Cli, ReadsMotionsBehindAByteOrderMark) {
    const TemporaryFolder folder;
    const fs::path table = folder / "a.csv", marked = folder / "marked.csv", bvh = folder / "marked.bvh";
    ASSERT_EQ(run_chironomia({"convert", "--motion", kMotion, "--out", table.string()}).exit_code, 0);
    write_text(marked, "\xEF\xBB\xBF" + read_text(table));
    write_text(bvh, "\xEF\xBB\xBF" + read_text(kMotion));
    for (const fs::path& file : {marked, bvh}) {
        const Outcome info = run_chironomia({"info", file.string()});
        EXPECT_EQ(info.exit_code, 0) << info.err;
        EXPECT_THAT(info.out, HasSubstr("269 frames at 30 frames/s"));
    }
}

TEST(Cli, SaysThatASoundIsCutOffAsRenderingDoes) {
    const TemporaryFolder folder;
    const fs::path sound = folder / "a.wav";
    write_text(sound, read_text(source_dir() / "assets/samples/speech/two-ways.wav").substr(0, 100'000));
    const Outcome info = run_chironomia({"info", sound.string()});
    EXPECT_EQ(info.exit_code, 3) << info.out;
    EXPECT_THAT(info.err, HasSubstr("cut off"));
    const Outcome render = run_chironomia(
        {"render", "--motion", kMotion, "--audio", sound.string(), "--out", (folder / "a.mp4").string()});
    EXPECT_EQ(render.err, info.err);
}

constexpr const char* kAccepted =
    "name an avatar (glTF), a motion (BVH, CSV, JSON, NumPy, HDF5, or a folder of OpenPose with "
    "NAME_keypoints.json or of CMU Panoptic with body3DScene_NUMBER.json), words in time "
    "(TextGrid, ELAN, WebVTT, SubRip, JSON, CSV, CTM), a sound, a clip, a picture (PNG, EXR), "
    "a model or a corpus";

void expect_not_described(const fs::path& path, const std::string& what) {
    const Outcome info = run_chironomia({"info", path.string()});
    EXPECT_EQ(info.exit_code, 3) << info.out;
    EXPECT_EQ(info.err, format("chironomia: {}: is {}; {}\n", path.string(), what, kAccepted));
}

TEST(Info, RefusesFoldersThatAreNoMotionAndNoCorpus) {
    const TemporaryFolder folder;
    expect_not_described(folder.path(), "an empty folder");
    for (const char* name : {"b.txt", "a.png", "c.bvh"}) write_text(folder / name, "x");
    expect_not_described(folder.path(),
                         "a folder with a.png, b.txt, c.bvh in it, which is no motion and no corpus");
    for (const char* name : {"d", "e", "f", "g"}) fs::create_directory(folder / name);
    expect_not_described(
        folder.path(),
        "a folder with a.png, b.txt, c.bvh, d, e and 2 more in it, which is no motion and no corpus");
    write_text(folder / "private/key.json", "{}");
    expect_not_described(folder.path(), "the folder of a study, which study check describes");
}

TEST(Info, RefusesFilesOfOtherKinds) {
    const TemporaryFolder folder;
    write_text(folder / "empty.mp4", "");
    expect_not_described(folder / "empty.mp4", "an empty file");
    write_text(folder / "notes.txt", "Call the lab.\n");
    expect_not_described(folder / "notes.txt", "a text, but neither BVH nor CSV, JSON or glTF");
    write_text(folder / "notes.csv", std::string("\xff\xfe"
                                                 "C\0a\0l\0l\0",
                                                 10));
    EXPECT_EQ(run_chironomia({"info", (folder / "notes.csv").string()}).err,
              format("chironomia: {}: it is UTF-16; save it as UTF-8\n", (folder / "notes.csv").string()));
    expect_not_described(source_dir() / "docs/images/page-pair.jpg", "a picture in JPEG, which is not read");
    write_text(folder / "motion.pkl", "\x80\x04\x95 numpy");
    EXPECT_THAT(
        run_chironomia({"info", (folder / "motion.pkl").string()}).err,
        HasSubstr("a pickle of Python, in which any program could be, which is not read; save its arrays"));
}

TEST(Info, DescribesWordsInTime) {
    const TemporaryFolder folder;
    write_text(folder / "a.json",
               "{\"segments\": [{\"words\": [{\"word\": \"two\", \"start\": 0.1, \"end\": 0.3}, "
               "{\"word\": \"ways.\", \"start\": 0.3, \"end\": 0.75}]}]}");
    write_text(folder / "b.json",
               "[{\"word\": \"two\", \"start\": 0.1, \"end\": 0.3}, "
               "{\"word\": \"ways\", \"start\": 0.3, \"end\": 0.75}]");
    write_text(folder / "c.csv", "word,start,end\ntwo,0.1,0.3\nways,0.3,0.75\n");
    write_text(
        folder / "d.json",
        "[{\"alternatives\": [{\"words\": [{\"word\": \"two\", \"start_time\": \"0.1s\", \"end_time\": \"0.3s\"}, "
        "{\"word\": \"ways\", \"start_time\": \"0.3s\", \"end_time\": \"0.75s\"}]}]}]");
    write_text(folder / "e.csv",
               "Begin,End,Label,Type,Speaker\n0.1,0.3,two,words,s\n0.3,0.75,ways,words,s\n");
    write_text(folder / "f.txt",
               "talk\t\t00:00:00.100\t0.1\t00:00:00.300\t0.3\t00:00:00.200\t0.2\ttwo\n"
               "talk\t\t00:00:00.300\t0.3\t00:00:00.750\t0.75\t00:00:00.450\t0.45\tways\n");
    write_text(folder / "g.ctm", "talk 1 0.1 0.2 two\ntalk 1 0.3 0.45 ways\n");
    write_text(folder / "h.tsv", "0.1\t0.3\ttwo\n0.3\t0.75\tways\n");  // as GENEA has them
    write_text(
        folder / "i.json",
        "{\"words\": [{\"word\": \"two\", \"start\": 0.1, \"end\": 0.3}, "
        "{\"word\": \"ways\", \"start\": 0.3, \"end\": 0.75}], "
        "\"segments\": [{\"text\": \"two ways\", \"start\": 0, \"end\": 1}]}");  // as OpenAI's service has them
    write_text(
        folder / "j.json",
        "{\"text\": \" two ways\", \"chunks\": [{\"text\": \" two\", \"timestamp\": [0.1, 0.3]}, "
        "{\"text\": \" ways\", \"timestamp\": [0.3, 0.75]}]}");  // as Hugging Face's pipelines have them
    write_text(
        folder / "k.json",
        "{\"results\": {\"channels\": [{\"alternatives\": [{\"words\": [{\"word\": \"two\", \"start\": 0.1, "
        "\"end\": 0.3}, {\"word\": \"ways\", \"start\": 0.3, \"end\": 0.75}]}]}]}}");  // as Deepgram's
    for (const char* name : {"a.json", "b.json", "c.csv", "d.json", "e.csv", "f.txt", "g.ctm", "h.tsv",
                             "i.json", "j.json", "k.json"}) {
        const Outcome info = run_chironomia({"info", (folder / name).string()});
        EXPECT_EQ(info.out,
                  "words      2, 0 phonemes\n"
                  "first      \"two\", 0.100 to 0.300 s\n"
                  "last       \"ways\", 0.300 to 0.750 s\n")
            << name << info.err;
    }
    write_text(folder / "d.vtt", "WEBVTT\n\n00:00.000 --> 00:01.000\nboth ways\n");
    write_text(folder / "e.srt", "1\n00:00:00,000 --> 00:00:01,000\nboth ways\n");
    const fs::path seeds = source_dir() / "tests/fuzz/seeds/word_times";
    for (const fs::path& file : {seeds / "elan.eaf", seeds / "vosk.json"})
        EXPECT_THAT(run_chironomia({"info", file.string()}).out, HasSubstr("hello")) << file;
    for (const fs::path& file : {folder / "d.vtt", folder / "e.srt"}) {
        const Outcome info = run_chironomia({"info", file.string(), "--json"});
        EXPECT_EQ(Json::parse(info.out)["words"][1]["word"], "ways") << info.err;
    }
    const Outcome grid =
        run_chironomia({"info", (source_dir() / "tests/fixtures/speech/two-ways.TextGrid").string()});
    EXPECT_THAT(grid.out, HasSubstr("first      \"there\", 0.300 to 0.540 s"));
}

TEST(Info, DescribesAPicture) {
    const TemporaryFolder folder;
    for (const std::string ending : {"png", "exr"}) {
        const Outcome drawn =
            run_chironomia(render(folder / ending / ("%d." + ending), {"--frames", "0:1", "--quiet"}));
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        const fs::path file = folder / ending / ("0." + ending);
        const Outcome info = run_chironomia({"info", file.string()});
        EXPECT_EQ(info.exit_code, 0) << info.err;
        EXPECT_EQ(info.out, format("picture    160x90, {} bytes\n", fs::file_size(file)));
        EXPECT_EQ(Json::parse(run_chironomia({"info", file.string(), "--json"}).out),
                  Json({{"picture", {{"size", {160, 90}}, {"bytes", fs::file_size(file)}}}}));
    }
}

TEST(Cli, SaysWhatAFolderOfOpenPoseHolds) {
    const fs::path folder = testing::test_file("tests/fixtures/gestures/openpose_24fps");
    const Outcome info = run_chironomia({"info", folder.string(), "--motion-fps", "24", "--json"});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("\"frames\": 84"));
}

}  // namespace
}  // namespace chironomia::study
