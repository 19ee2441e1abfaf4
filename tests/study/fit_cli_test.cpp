// chironomia fit through the real binary, and its page in a real browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/study/browser.h"
#include "tests/study/process.h"
#include "tests/support/joints.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::Browser;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();

// One second of a person whose arms hang down, or are spread; without a rate where `fps` is 0.
void write_person(const fs::path& file, bool spread, int fps = 30) {
    const auto elbow = [&](double side) {
        return spread ? format("[{}, 1.43, 0]", side * 0.45) : format("[{}, 1.15, 0]", side * 0.22);
    };
    const auto wrist = [&](double side) {
        return spread ? format("[{}, 1.43, 0]", side * 0.7) : format("[{}, 0.92, 0.08]", side * 0.24);
    };
    std::string frames;
    for (int t = 0; t < 30; ++t) {
        frames += format(
            "{}[[0.18, 1.43, 0], [-0.18, 1.43, 0], {}, {}, {}, {}, [0.1, 0.93, 0], [-0.1, 0.93, 0], "
            "[0, 1.58, 0.1]]",
            t == 0 ? "" : ", ", elbow(1), elbow(-1), wrist(1), wrist(-1));
    }
    write_text(file, format(R"({{{}"names": ["left_shoulder", "right_shoulder", "left_elbow", "right_elbow",
                               "left_wrist", "right_wrist", "left_hip", "right_hip", "nose"], "frames": [{}]}})",
                            fps > 0 ? format("\"fps\": {}, ", fps) : "", frames));
}

Outcome fit(std::vector<std::string> words) {
    words.insert(words.begin(), {"fit", "--quiet"});
    return run_chironomia(words);
}

TEST(FitCli, AGoodMotionIsFitToShow) {
    const Outcome outcome = fit({kMotion});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "fit to show   two-ways.bvh\n");
    EXPECT_EQ(outcome.err, "");
}

// A person who bows throughout is shown bowing, and fit and render say so.
TEST(FitCli, WarnsOfATrunkThatLeansFar) {
    const TemporaryFolder folder;
    const fs::path file = folder / "bow.json";
    std::string frames;
    for (int t = 0; t < 30; ++t) {
        frames += format(
            "{}[[0.18, 1.1, 0.48], [-0.18, 1.1, 0.48], [0.2, 0.82, 0.48], [-0.2, 0.82, 0.48], [0.2, 0.58, 0.5], "
            "[-0.2, 0.58, 0.5], [0.1, 0.9, 0], [-0.1, 0.9, 0], [0.1, 0.48, 0], [-0.1, 0.48, 0], "
            "[0.1, 0.07, 0], [-0.1, 0.07, 0], [0, 1.05, 0.7]]",
            t == 0 ? "" : ", ");
    }
    write_text(file, format(R"({{"fps": 30, "names": ["left_shoulder", "right_shoulder", "left_elbow",
                               "right_elbow", "left_wrist", "right_wrist", "left_hip", "right_hip", "left_knee",
                               "right_knee", "left_ankle", "right_ankle", "nose"], "frames": [{}]}})",
                            frames));
    const std::string warning =
        "bow.json: y was taken for up, from which the trunk leans by 78 degrees in the median of the frames; if "
        "nobody bows, crawls or lies there, set --up";
    EXPECT_THAT(fit({file.string()}).err, HasSubstr(warning));
    for (const char* avatar : {"neutral", "stick"}) {
        const Outcome render =
            run_chironomia({"render", "--quiet", "--motion", file.string(), "--avatar", avatar, "--size",
                            "64x64", "--frames", "0:1", "--out", (folder / avatar / "%03d.png").string()});
        EXPECT_EQ(render.exit_code, 0) << render.err;
        EXPECT_THAT(render.err, HasSubstr(warning));
    }
}

TEST(FitCli, ATPoseIsNot) {
    const TemporaryFolder folder;
    write_person(folder / "t.json", true);
    const Outcome outcome = fit({(folder / "t.json").string()});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("do not show   t.json\n"));
    EXPECT_THAT(outcome.out, HasSubstr("stands in a T-pose in frames 0 to 29, 100 % of the clip"));
}

// Both forearms lie across, with the hands in the middle of the belly.
void write_person_with_hands_in_the_belly(const fs::path& file) {
    std::string frames;
    for (int t = 0; t < 30; ++t) {
        frames += format(
            "{}[[0.18, 1.43, 0], [-0.18, 1.43, 0], [0.25, 1.16, -0.02], [-0.25, 1.16, -0.02], "
            "[0.02, 1.1, 0.03], [-0.02, 1.1, 0.03], [0.1, 0.93, 0], [-0.1, 0.93, 0], [0, 1.58, 0.1]]",
            t == 0 ? "" : ", ");
    }
    write_text(
        file, format(R"({{"fps": 30, "names": ["left_shoulder", "right_shoulder", "left_elbow", "right_elbow",
                               "left_wrist", "right_wrist", "left_hip", "right_hip", "nose"], "frames": [{}]}})",
                     frames));
}

TEST(FitCli, HandsInTheBellyAreFoundWithDepthAndFrames) {
    const TemporaryFolder folder;
    write_person_with_hands_in_the_belly(folder / "in.json");
    const Outcome outcome = fit({(folder / "in.json").string(), "--json"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    const Json clip = Json::parse(outcome.out)["clips"][0];
    EXPECT_EQ(clip["verdict"]["verdict"], "do not show");
    EXPECT_THAT(clip["verdict"].dump(),
                HasSubstr("left hand of the avatar is in its trunk in frames 0 to 29, up to"));
    EXPECT_EQ(clip["interpenetration"]["touch_mm"].get<double>(), 20);
    std::set<std::string> found;
    for (const Json& one : clip["interpenetration"]["found"]) {
        if (one["in"] != "trunk") continue;
        found.insert(one["part"].get<std::string>());
        EXPECT_GT(one["deepest_mm"].get<double>(), 50);
        EXPECT_EQ(one["frames"], 30);
        EXPECT_EQ(one["spans"], Json::parse("[[0, 29]]"));
    }
    EXPECT_EQ(found, (std::set<std::string>{"left forearm", "left hand", "right forearm", "right hand"}));
    fit({(folder / "in.json").string(), "--report", (folder / "page.html").string()});
    const std::string html = read_text(folder / "page.html");
    EXPECT_THAT(html, HasSubstr("<tr><td>left hand in trunk</td>"));
    EXPECT_THAT(html, HasSubstr("deepest in the body"));
}

TEST(FitCli, SaysThatAHandFlipsInTheSource) {
    const TemporaryFolder folder;
    Motion motion = read_motion(kMotion);
    const Skeleton& skeleton = motion.joints->skeleton;
    const auto hand = static_cast<std::size_t>(*testing::find_joint(skeleton, "RightHand"));
    for (std::size_t t = 60; t < motion.frames; ++t) {
        Quat& turn = motion.joints->turns[t * skeleton.joints.size() + hand];
        turn = turn * glm::angleAxis(2.9f, Vec3(1, 0, 0));
    }
    write_bvh(folder / "flip.bvh", motion);
    const Outcome outcome = fit({(folder / "flip.bvh").string()});
    EXPECT_THAT(outcome.out, HasSubstr("look first    flip.bvh\n"));
    EXPECT_THAT(outcome.out, HasSubstr("right_hand flips by up to 16"));
    EXPECT_THAT(outcome.out, HasSubstr(" degrees from one frame to the next in frame 60, in the source\n"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("of the avatar flips")));
}

// A forearm that turns about itself for one frame: of points that is the avatar's, as points have no turns.
TEST(FitCli, SaysThatAnAvatarPopsThatPointsMove) {
    const TemporaryFolder folder;
    Motion motion = read_motion(kMotion);
    const Skeleton& skeleton = motion.joints->skeleton;
    const auto arm = static_cast<std::size_t>(*testing::find_joint(skeleton, "RightArm"));
    for (std::size_t t = 60; t < motion.frames; ++t) {
        Quat& turn = motion.joints->turns[t * skeleton.joints.size() + arm];
        turn = glm::angleAxis(1.2f, Vec3(0, 1, 0)) * turn;
    }
    write_bvh(folder / "pop.bvh", motion);
    const fs::path picture = folder / "pop";
    ASSERT_EQ(
        run_chironomia({"convert", "--motion", (folder / "pop.bvh").string(), "--out", picture.string()})
            .exit_code,
        0);
    const Outcome outcome = fit(
        {picture.string(), "--lift-filter", "off", "--motion-fps", std::to_string(std::lround(motion.fps))});
    EXPECT_THAT(outcome.out, HasSubstr("right_upper_arm of the avatar turns by up to ")) << outcome.err;
    EXPECT_THAT(outcome.out, Not(HasSubstr("in the source")));
    EXPECT_THAT(fit({kMotion}).out, Not(HasSubstr("of the avatar turns")));
}

TEST(FitCli, SaysThatAWalkerLeavesThePicture) {
    const Outcome outcome = fit({testing::test_file("tests/fixtures/gestures/walk.bvh").string()});
    EXPECT_THAT(outcome.out, HasSubstr("the head leaves the picture of the scene \"full\" in frames "));
    EXPECT_THAT(outcome.out, HasSubstr("; show it with --follow or --in-place\n"));
    EXPECT_THAT(outcome.out, HasSubstr("a foot leaves the picture of the scene \"full\" in frames 38 to 241; "
                                       "show it with --follow or --in-place\n"));
    EXPECT_EQ(outcome.exit_code, 0);
}

// Hands that a lexicon puts where the belly is, and all that the bundled one lays on the body.
TEST(NoInterpenetration, IsTrueOfMotionsOfTheEngine) {
    const TemporaryFolder folder;
    const fs::path lexicon = folder / "lexicon.json";
    write_text(lexicon,
               R"({"gestures": [{"id": "into_belly", "category": "adaptor", "hands": "both", "repeats": false,
        "functions": [], "note": "Both hands where the belly is.", "poses": [
        {"phase": "preparation", "arm": {"wrist": {"x": 0.32, "y": 0, "z": 0.48}, "palm": {"back": 1},
                                         "fingers": {"in": 1}, "shape": "relax"}},
        {"phase": "stroke", "arm": {"wrist": {"x": 0.1, "y": 0.02, "z": 0.22}, "palm": {"back": 1},
                                    "fingers": {"in": 1}, "shape": "relax"}},
        {"phase": "post-stroke-hold"}]}]})");
    for (const std::string gesture :
         {"into_belly", "touch_chin", "hands_together", "hands_on_hips", "arms_crossed", "hand_on_arm"}) {
        const fs::path text = folder / (gesture + ".bml"), motion = folder / (gesture + ".h5");
        write_text(text, format(R"(<bml id="b"><speech id="s"><text>Well, <sync id="a"/>this is what I
            <sync id="e"/>say.</text></speech><gesture id="g" lexeme="{}" stroke="s:a" relax="s:e"/></bml>)",
                                gesture));
        const Outcome made = run_chironomia(
            {"synth", "--bml", text.string(), "--lexicon", lexicon.string(), "--out", motion.string()});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        const Json clip = Json::parse(fit({motion.string(), "--json"}).out)["clips"][0];
        // A millimetre beyond what counts as a touch is how closely the folds of a sleeve are known.
        for (const Json& found : clip["interpenetration"]["found"])
            EXPECT_LT(found["deepest_mm"], 21) << gesture << clip["interpenetration"].dump(1);
    }
}

TEST(NoInterpenetration, MovesHandsOutOfTheBellyAndSaysHowFar) {
    const TemporaryFolder folder;
    write_person_with_hands_in_the_belly(folder / "in.json");
    const auto converted = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"convert",
                                          "--motion",
                                          (folder / "in.json").string(),
                                          "--out",
                                          (folder / "out.bvh").string(),
                                          "--report",
                                          (folder / "r.json").string()};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read_json(folder / "r.json")["interpenetration"];
    };
    const Json before = converted({});
    EXPECT_EQ(before["resolved"], Json());
    EXPECT_GE(before["found"].size(), 4u);
    const Json after = converted({"--no-interpenetration"});
    EXPECT_TRUE(after["found"].empty()) << after.dump(1);
    EXPECT_EQ(after["resolved"]["frames_moved"], 30);
    EXPECT_GT(after["resolved"]["most_wrist_mm"].get<double>(), 50);
    EXPECT_LT(after["resolved"]["most_wrist_mm"].get<double>(), 250);
    const std::string once = read_text(folder / "out.bvh");
    converted({"--no-interpenetration"});
    EXPECT_EQ(read_text(folder / "out.bvh"), once);
}

TEST(NoInterpenetration, LeavesAMotionWithoutContactAsItIs) {
    const TemporaryFolder folder;
    const std::string motion = (source_dir() / "assets/samples/restrained/two-ways.bvh").string();
    const auto converted = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {
            "convert", "--motion", motion, "--avatar", "neutral", "--out", (folder / "out.bvh").string()};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(run_chironomia(words).exit_code, 0);
        return read_text(folder / "out.bvh");
    };
    EXPECT_EQ(converted({"--no-interpenetration"}), converted({}));
}

TEST(NoInterpenetration, IsOfEveryMotionThatIsLiftedFromAPicture) {
    const TemporaryFolder folder;
    write_person_with_hands_in_the_belly(folder / "in.json");
    const std::string picture = (folder / "picture").string();
    ASSERT_EQ(
        run_chironomia({"convert", "--motion", (folder / "in.json").string(), "--out", picture}).exit_code,
        0);
    const Json clip = Json::parse(fit({picture, "--motion-fps", "30", "--json"}).out)["clips"][0];
    EXPECT_EQ(clip["source"], "picture");
    fit({picture, "--motion-fps", "30", "--report", (folder / "page.html").string()});
    EXPECT_THAT(read_text(folder / "page.html"),
                HasSubstr("<dt>arms moved out of the body</dt><dd>in 30 frames, a wrist"));
    EXPECT_FALSE(clip["interpenetration"]["resolved"].is_null());
    EXPECT_TRUE(clip["interpenetration"]["found"].empty()) << clip["interpenetration"].dump(1);
    for (const auto& [joint, error] : clip["joint_error_shoulder_widths"].items())
        EXPECT_LT(error["reprojected"]["median"].get<double>(), 0.25) << joint << ": it is another gesture";
}

TEST(NoInterpenetration, IsOfRenderToo) {
    const TemporaryFolder folder;
    write_person_with_hands_in_the_belly(folder / "in.json");
    const Outcome outcome =
        run_chironomia({"render", "--quiet", "--motion", (folder / "in.json").string(),
                        "--no-interpenetration", "--size", "64x36", "--frames", "0:1", "--out",
                        (folder / "f/%d.png").string(), "--report", (folder / "r.json").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json report = read_json(folder / "r.json");
    EXPECT_TRUE(report["motions"][0]["fit"]["interpenetration"]["found"].empty());
    EXPECT_EQ(report["recipe"]["options"]["no_interpenetration"], true);
}

TEST(NoInterpenetration, NeedsABodyWithAVolume) {
    const TemporaryFolder folder;
    const Outcome skeleton = run_chironomia(
        {"convert", "--motion", kMotion, "--no-interpenetration", "--out", (folder / "a.bvh").string()});
    EXPECT_EQ(skeleton.exit_code, 3);
    EXPECT_THAT(skeleton.err,
                HasSubstr("a.bvh: --no-interpenetration needs the volume of an avatar; name one with "
                          "--avatar, or leave it out"));
    const Outcome stick = run_chironomia({"render", "--quiet", "--motion", kMotion, "--avatar", "stick",
                                          "--no-interpenetration", "--out", (folder / "a.mp4").string()});
    EXPECT_EQ(stick.exit_code, 3);
    EXPECT_THAT(stick.err,
                HasSubstr("two-ways.bvh: a stick figure has no volume that its hands could enter; leave "
                          "--no-interpenetration out, or choose another avatar"));
    // A humanoid of which a foot alone has a surface, and the hands one of a few millimetres.
    testing::GltfBuilder foot = testing::humanoid_file();
    for (Json& node : foot.json["nodes"]) {
        if (node["name"] == "mixamorig:LeftHand" || node["name"] == "mixamorig:RightHand") {
            node["scale"] = {0.01, 0.01, 0.01};
        } else if (node["name"] != "mixamorig:LeftToeBase") {
            node.erase("mesh");
        }
    }
    const fs::path bare = folder / "bare.glb";
    foot.write_glb(bare);
    const Outcome nothing = run_chironomia({"convert", "--motion", kMotion, "--avatar", bare.string(),
                                            "--no-interpenetration", "--out", (folder / "b.glb").string()});
    EXPECT_EQ(nothing.exit_code, 3);
    EXPECT_THAT(nothing.err,
                HasSubstr("bare.glb: has no surface on its trunk and arms, so nothing can be kept out of "
                          "it; choose another avatar, or leave --no-interpenetration out"));
    EXPECT_THAT(
        run_chironomia({"render", "--avatar", "neutral", "--no-interpenetration", "--out", "a.mp4"}).err,
        HasSubstr("--no-interpenetration: needs --motion or --face"));
}

TEST(FitCli, ABrokenClipIsShownAsSuchBesideTheOthers) {
    const TemporaryFolder folder;
    write_person(folder / "in/good.json", false);
    write_person(folder / "in/deep/t.json", true);
    write_text(folder / "in/broken.bvh", "HIERARCHY\nROOT hips\n{\n");
    write_text(folder / "in/face.csv", "time,AU12\n0,1\n0.1,2\n0.2,1\n");
    write_text(folder / "in/readme.txt", "no motion\n");
    const fs::path page = folder / "page.html";
    const Outcome outcome = fit({(folder / "in").string(), "--report", page.string()});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("broken.bvh"));
    EXPECT_THAT(outcome.out, HasSubstr("fit to show   good.json\n"));
    EXPECT_THAT(outcome.out, HasSubstr("do not show   deep/t.json\n"));
    EXPECT_THAT(outcome.out, HasSubstr("do not show   broken.bvh\n"));
    const std::string html = read_text(page);
    EXPECT_THAT(html, HasSubstr("1 of 3 fit to show, do not show: 2, of these 1 could not be read"));
    EXPECT_THAT(html, HasSubstr("Left out, as they hold a face alone: face.csv."));
    EXPECT_THAT(html, Not(HasSubstr("<!--")));
    EXPECT_FALSE(std::regex_search(html, std::regex("(src|href)=\"(?!data:|#)"))) << "it needs no other file";
}

// As systems of a study are kept: a folder for each, with files of the same names.
TEST(FitCli, NamesTheFoldersOfMotionsOfTheSameName) {
    const TemporaryFolder folder;
    write_person(folder / "ours/a.json", false);
    write_person(folder / "ours/b.json", false);
    write_person(folder / "base/a.json", true);
    const fs::path page = folder / "page.html";
    const Outcome outcome =
        fit({(folder / "ours").string(), (folder / "base").string(), "--report", page.string()});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("fit to show   " + (folder / "ours/a.json").string() + "\n"));
    EXPECT_THAT(outcome.out, HasSubstr("fit to show   b.json\n"));
    EXPECT_THAT(outcome.out, HasSubstr("do not show   " + (folder / "base/a.json").string() + "\n"));
    EXPECT_THAT(read_text(page), HasSubstr((folder / "base/a.json").string()));
}

TEST(FitCli, TheJsonHoldsWhatThePageShows) {
    const TemporaryFolder folder;
    const fs::path file = folder / "fit.json";
    EXPECT_EQ(fit({kMotion, "--report", file.string()}).exit_code, 0);
    const Json report = read_json(file);
    EXPECT_EQ(report["fit_to_show"], 1);
    const Json& clip = report["clips"][0];
    EXPECT_EQ(clip["name"], "two-ways.bvh");
    EXPECT_EQ(clip["verdict"]["verdict"], "fit to show");
    EXPECT_TRUE(clip["motion_checks"]["found"]["t_pose"].empty());
    const double share = clip["joint_error_shoulder_widths"]["left_wrist"]["reprojected"]["p95"];
    const double pixels = clip["reprojected_pixels_of_1280x720"]["left_wrist"]["p95"];
    EXPECT_NEAR(pixels, share * report["shoulder_width_pixels_of_1280x720"].get<double>(), 1e-9);
    EXPECT_LT(share, 0.1);
    const Outcome printed = fit({kMotion, "--json"});
    EXPECT_EQ(printed.out, read_text(file));
}

TEST(FitCli, TheReportOfARenderCarriesTheVerdict) {
    const TemporaryFolder folder;
    write_person(folder / "t.json", true);
    const Outcome outcome = run_chironomia(
        {"render", "--quiet", "--motion", (folder / "t.json").string(), "--size", "64x36", "--frames", "0:1",
         "--out", (folder / "f/%d.png").string(), "--report", (folder / "r.json").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_json(folder / "r.json")["motions"][0]["fit"]["verdict"]["verdict"], "do not show");
}

TEST(FitCli, ARateIsForThoseThatDoNotCarryOne) {
    const TemporaryFolder folder;
    write_person(folder / "a/own.json", false, 60);
    write_person(folder / "a/without.json", false, 0);
    const Outcome outcome = fit({(folder / "a").string(), "--motion-fps", "20", "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json report = Json::parse(outcome.out);
    EXPECT_EQ(report["clips"][0]["fps"], 60);
    EXPECT_EQ(report["clips"][1]["fps"], 20);
}

TEST(FitCli, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "empty");
    const Outcome empty = fit({(folder / "empty").string()});
    EXPECT_EQ(empty.exit_code, 3);
    EXPECT_THAT(empty.err,
                HasSubstr("empty: holds no motion; give a folder with BVH, keypoints or OpenPose in it"));
    write_text(folder / "f/face.csv", "time,AU12\n0,1\n0.1,2\n0.2,1\n");
    const Outcome faces = fit({(folder / "f").string()});
    EXPECT_EQ(faces.exit_code, 3);
    EXPECT_THAT(faces.err, HasSubstr("holds faces alone; give the motion of a body"));
    const Outcome table = fit({kMotion, "--report", (folder / "fit.csv").string()});
    EXPECT_EQ(table.exit_code, 3);
    EXPECT_THAT(table.err,
                HasSubstr("fit.csv: a report is a page, .html, or .json; give it one of these endings"));
    EXPECT_FALSE(fs::exists(folder / "fit.csv"));
    EXPECT_EQ(fit({}).exit_code, 2);
    EXPECT_THAT(fit({kMotion, "--avatar", "stick"}).err, HasSubstr("stick: is drawn from a motion"));
}

TEST(FitPage, ShowsStripsChartsAndVerdictsInABrowser) {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    const TemporaryFolder folder;
    write_person(folder / "in/t.json", true);
    fs::copy(kMotion, folder / "in/two-ways.bvh");
    const fs::path page = folder / "page.html";
    EXPECT_EQ(fit({(folder / "in").string(), "--report", page.string()}).exit_code, 1);
    Browser browser(folder / "browser");
    browser.open("file://" + page.string());
    EXPECT_EQ(browser.evaluate("document.querySelector('h1').textContent"),
              "1 of 2 fit to show, do not show: 1");
    EXPECT_EQ(browser.evaluate("Promise.all([...document.images].map((i) => i.decode())).then(() => "
                               "[...document.images].every((i) => i.naturalWidth === 480))"),
              true);
    EXPECT_EQ(browser.evaluate("document.images.length"), 12);
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('#clip1 .errors .chart .course').length"), 12);
    // The lane of the T-pose is filled from the first frame to the last.
    EXPECT_EQ(
        browser.evaluate("(() => { const lane = document.querySelector('#clip0 .lane'), bar = "
                         "document.querySelector('#clip0 rect.t_pose'); return bar.getAttribute('width') - "
                         "lane.getAttribute('width'); })()"),
        0);
    EXPECT_EQ(
        browser.evaluate("[...document.querySelectorAll('h3 .badge')].map((b) => b.textContent).join()"),
        "do not show,fit to show");
    EXPECT_EQ(browser.evaluate("document.documentElement.scrollWidth <= innerWidth"), true)
        << "nothing sticks out";
}

}  // namespace
}  // namespace chironomia::study
