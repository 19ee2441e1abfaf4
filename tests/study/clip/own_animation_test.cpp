// Files that play an animation of their own: what is shown when, where, and through the real binary.
#include "study/clip/own_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "core/hash.h"
#include "core/render/camera.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "study/clip/stage.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/study/process.h"
#include "tests/study/sounds.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::add_animation;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::Keys;
using testing::Outcome;
using testing::refusal_of;
using testing::run_chironomia;
using testing::TemporaryFolder;

const Keys kSlide{.times = {0, 2}, .values = {0, 0, 0, 4, 0, 0}};  // 2 m a second along x
const Keys kRise{.times = {0, 1}, .values = {0, 0, 0, 0, 3, 0}};

// The triangle (0,0,0) (1,0,0) (0,1,0) that slides, or rises.
GltfBuilder sliding_file() {
    GltfBuilder file = testing::triangle_file();
    add_animation(file, kSlide, "slide");
    add_animation(file, kRise, "rise");
    return file;
}

ClipJob job_of(const fs::path& avatar, const std::string& animation = "") {
    ClipJob job;
    job.performers[0].avatar = avatar;
    job.performers[0].hints.animation = animation;
    job.scene = "object";
    job.size = {160, 120};
    job.out = "clip.mp4";
    job.quiet = true;
    return job;
}

Performance play(const ClipJob& job) {
    return perform(job.performers[0], job);
}

Performance play(const GltfBuilder& file, const std::string& animation = "") {
    const TemporaryFolder folder;
    file.write_glb(folder / "x.glb");
    return play(job_of(folder / "x.glb", animation));
}

TEST(PlayOwnAnimation, LastsAsLongAsTheAnimation) {
    const TemporaryFolder folder;
    sliding_file().write_glb(folder / "x.glb");
    ClipJob job = job_of(folder / "x.glb");
    EXPECT_EQ(play(job).fit.poses.size(), 61u) << "the last key is a frame, too";
    job.fps = {12, 1};
    const Performance slow = play(job);
    ASSERT_EQ(slow.fit.poses.size(), 25u);
    EXPECT_FLOAT_EQ(slow.fit.poses[6].joints[0].translation.x, 1) << "half a second of 2 m a second";
    EXPECT_FLOAT_EQ(slow.boxes[6].low.x, 1);
    EXPECT_FLOAT_EQ(slow.boxes[6].high.x, 2);
    EXPECT_FLOAT_EQ(around(slow.boxes).high.x, 1 + 4);
    EXPECT_EQ(slow.boxes[6].high.y, 1);
}

TEST(PlayOwnAnimation, ChoosesByNameOrNumber) {
    const GltfBuilder file = sliding_file();
    for (const char* asked : {"rise", "1"}) {
        const Performance rising = play(file, asked);
        EXPECT_EQ(rising.fit.poses.size(), 31u) << asked;
        EXPECT_THAT(rising.notes, ::testing::ElementsAre("animation \"rise\", one of 2, 1.000 s"));
    }
    EXPECT_EQ(play(file, "0").fit.poses.size(), 61u);
    // A name goes before a number.
    GltfBuilder named = sliding_file();
    named.json["animations"][1]["name"] = "0";
    EXPECT_EQ(play(named, "0").fit.poses.size(), 31u);
}

TEST(PlayOwnAnimation, RefusesAnAnimationThatIsNotThere) {
    GltfBuilder file = sliding_file();
    file.json["animations"][1].erase("name");
    const auto refusal = [&](const std::string& asked) { return refusal_of([&] { play(file, asked); }); };
    EXPECT_THAT(refusal("Walk"),
                HasSubstr("x.glb: has no animation \"Walk\"; choose one of 0 \"slide\", 1 without a name"));
    EXPECT_THAT(refusal("2"), HasSubstr("has no animation \"2\"; choose one of"));
    EXPECT_THAT(refusal("-1"), HasSubstr("has no animation \"-1\"; choose one of"));
    EXPECT_THAT(refusal_of([&] { play(testing::triangle_file(), "0"); }),
                HasSubstr("x.glb: has no animation \"0\"; it has none at all, leave --animation out"));
}

TEST(PlayOwnAnimation, ShowsAFileWithoutAnyForASecondOrInOnePicture) {
    const TemporaryFolder folder;
    testing::triangle_file().write_glb(folder / "x.glb");
    ClipJob job = job_of(folder / "x.glb");
    EXPECT_EQ(play(job).fit.poses.size(), 30u);
    job.out = "clip.webm";
    job.fps = {25, 1};
    EXPECT_EQ(play(job).fit.poses.size(), 25u);
    job.out = "frames/%05d.png";
    EXPECT_EQ(play(job).fit.poses.size(), 1u);
    EXPECT_EQ(play(job).notes, std::vector<std::string>{"no animation; shown still"});
}

TEST(PlayOwnAnimation, RefusesWhatCannotBeShown) {
    GltfBuilder endless = testing::triangle_file();
    add_animation(endless, {.times = {0, 1e7f}});
    EXPECT_THAT(
        refusal_of([&] { play(endless); }),
        HasSubstr("x.glb: animation \"move\" lasts 10000000.000 s, which is 300000001 frames; of its 1 "
                  "nodes and morphs at most 20000000 frames can be shown; shorten it, or choose a lower "
                  "--fps"));
    GltfBuilder far = testing::triangle_file();
    add_animation(far, {.times = {0, 1}, .values = {2e9f, 0, 0, 2e9f, 0, 0}});
    EXPECT_THAT(refusal_of([&] { play(far); }),
                HasSubstr("x.glb: \"Triangle\" has a vertex at 2000000000, 0, 0 m in frame 0, at most "
                          "1000000000 m from the origin can be shown; repair the model"));
    GltfBuilder point = testing::triangle_file();
    point.json["nodes"][0]["scale"] = {0, 0, 0};
    EXPECT_THAT(
        refusal_of([&] { play(point); }),
        HasSubstr("x.glb: is 0 m large in every frame, at least 1e-12 m can be shown; repair the model"));
    GltfBuilder infinite = testing::triangle_file();
    infinite.json["nodes"][0]["scale"] = {3e38, 3e38, 3e38};
    infinite.json["nodes"].push_back({{"children", {0}}, {"scale", {1e10, 1e10, 1e10}}});
    infinite.json["scenes"][0]["nodes"] = {1};
    EXPECT_THAT(refusal_of([&] { play(infinite); }), HasSubstr("m in frame 0, at most 1000000000 m"));
}

// How far out in the picture the farthest vertex is in any frame; 1 is the edge.
float farthest_out(const Stage& stage, const Performance& performance) {
    const View& view = stage.views.at(0).view;
    const Vec2 half = Vec2(static_cast<float>(view.size.width), static_cast<float>(view.size.height)) * 0.5f;
    float farthest = 0;
    for (std::size_t frame = 0; frame < performance.fit.poses.size(); ++frame) {
        for (const Exposure& exposure : expose_all(stage, std::span(&performance, 1), frame)) {
            for (const Vec3& point : exposure.at(0).surfaces.at(0).positions) {
                const Vec2 pixel = pixel_of(view.scene.camera, view.size, point) / half - 1.0f;
                farthest = std::max({farthest, std::abs(pixel.x), std::abs(pixel.y)});
            }
        }
    }
    return farthest;
}

TEST(MakeStage, KeepsAllThatEverMovesInThePicture) {
    const TemporaryFolder folder;
    GltfBuilder file = sliding_file();
    file.write_glb(folder / "x.glb");
    for (const char* animation : {"slide", "rise"}) {
        for (const RenderSize size : {RenderSize{160, 120}, RenderSize{90, 160}}) {
            ClipJob job = job_of(folder / "x.glb", animation);
            job.size = size;
            const Performance performance = play(job);
            const Stage stage = make_stage(std::span(&performance, 1), job);
            EXPECT_LT(farthest_out(stage, performance), 0.95f);
            EXPECT_GT(farthest_out(stage, performance), 0.7f);
            EXPECT_EQ(frames_outside(stage, std::span(&performance, 1), 0).figure, 0u);
        }
    }
}

// The first picture of the file with everything `scale` times as large.
Frame picture_at_scale(double scale) {
    const TemporaryFolder folder;
    GltfBuilder file = testing::triangle_file();
    file.json["nodes"].push_back({{"children", {0}}, {"scale", {scale, scale, scale}}});
    file.json["scenes"][0]["nodes"] = {1};
    file.write_glb(folder / "x.glb");
    const ClipJob job = job_of(folder / "x.glb");
    const Performance performance = play(job);
    const Stage stage = make_stage(std::span(&performance, 1), job);
    return draw(stage, expose_all(stage, std::span(&performance, 1), 0));
}

TEST(MakeStage, DrawsAThingOfAnySizeAlike) {
    const Frame usual = picture_at_scale(1);
    for (const double scale : {1e-11, 1e-4, 1e5}) {
        const Frame other = picture_at_scale(scale);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < usual.rgba.size(); ++i)
            differ += std::abs(usual.rgba[i] - other.rgba[i]) > 3;
        EXPECT_LT(differ, usual.rgba.size() / 1000) << scale;
    }
}

TEST(MakeStage, PutsTheCameraOfASceneFileWhereItSaysInTheFilesOwnMetres) {
    const TemporaryFolder folder;
    sliding_file().write_glb(folder / "x.glb");
    const fs::path scene = folder / "scene.json";
    write_text(scene, R"({"camera": {"eye": [0, 1, 8], "target": [0, 1, 0]}})");
    ClipJob job = job_of(folder / "x.glb");
    job.scene = scene;
    const Performance performance = play(job);
    const Stage stage = make_stage(std::span(&performance, 1), job);
    const Scene expected = make_scene(scene.string(), performance.avatar, job.size);
    const View& view = stage.views.at(0).view;
    const Vec3 corner = expose_all(stage, std::span(&performance, 1), 30)[0][0].surfaces[0].positions[2];
    const Vec2 pixel = pixel_of(view.scene.camera, view.size, corner);
    EXPECT_LT(glm::distance(pixel, pixel_of(expected.camera, job.size, {2, 1, 0})), 0.01f);
    // By trigonometry: at 8 m, half the picture is 8 tan(11 degrees) high and 4/3 of that wide.
    EXPECT_NEAR(pixel.x, 80 + 80 * 2 / (8 * std::tan(radians(11.0f)) * 4 / 3), 0.05);
    // Its middle leaves the picture on the right when it has slid 2.07 - 0.5 m, after 0.79 s.
    EXPECT_EQ(frames_outside(stage, std::span(&performance, 1), 0).figure, 37u);
    // Where its last pose is held it stays outside.
    const std::size_t all = performance.fit.poses.size();
    const FramesOutside held =
        frames_outside(stage, std::span(&performance, 1), 0, {.first = all, .last = all + 5});
    EXPECT_EQ(held.figure, 5u);
    EXPECT_EQ(held.of, 5u);
}

std::vector<std::string> render(const fs::path& avatar, const fs::path& out,
                                const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"render",  "--avatar", avatar.string(), "--size",
                                      "160x120", "--quiet",  "--out",         out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(OwnAnimationCli, PlaysAFileThatIsNoHumanoid) {
    const TemporaryFolder folder;
    sliding_file().write_gltf(folder / "x.gltf");
    const Outcome outcome = run_chironomia(
        render(folder / "x.gltf", folder / "clip.mp4", {"--report", (folder / "report.json").string()}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const Json info = Json::parse(run_chironomia({"info", (folder / "clip.mp4").string(), "--json"}).out);
    EXPECT_EQ(info.at("picture").at("frames"), 61);
    EXPECT_NEAR(info.at("picture").at("duration_s"), 61 / 30.0, 1e-3);
    const Json report = read_json(folder / "report.json");
    EXPECT_EQ(report.at("frames"), 61);
    EXPECT_EQ(report.at("motions")[0].at("detected")[0], "animation \"slide\", one of 2, 2.000 s");
    EXPECT_TRUE(report.at("motions")[0].at("fit").is_null());
    EXPECT_EQ(report.at("recipe").at("performers")[0].at("animation"), "");
}

// What was baked from a motion lasts as long as the motion, with its own rate and with another.
TEST(OwnAnimationCli, ABakedMotionLastsAsLongAsTheMotion) {
    const TemporaryFolder folder;
    const std::string motion = testing::test_file("tests/fixtures/gestures/beats.bvh").string();
    const fs::path baked = folder / "baked.glb", clip = folder / "clip.mp4";
    ASSERT_EQ(run_chironomia({"convert", motion, "--avatar", "mannequin", "--out", baked.string()}).exit_code,
              0);
    const auto frames = [&](const std::vector<std::string>& words) {
        EXPECT_EQ(run_chironomia(words).exit_code, 0);
        return Json::parse(run_chironomia({"info", clip.string(), "--json"}).out)["picture"]["frames"];
    };
    for (const char* fps : {"30", "25"}) {
        EXPECT_EQ(frames(render(baked, clip, {"--fps", fps})),
                  frames(render("mannequin", clip, {"--motion", motion, "--fps", fps})))
            << fps;
    }
}

TEST(OwnAnimationCli, HoldsItsLastPoseUntilTheSoundEnds) {
    const TemporaryFolder folder;
    sliding_file().write_glb(folder / "x.glb");
    write_wav(folder / "s.wav", testing::sine({.seconds = 3}));
    const Outcome outcome = run_chironomia(
        render(folder / "x.glb", folder / "clip.mp4", {"--audio", (folder / "s.wav").string()}));
    EXPECT_EQ(outcome.err,
              "the motion lasts 2.033 s and the sound 3.000 s; the last pose is held for 0.967 s\n");
}

TEST(OwnAnimationCli, GivesTheSameBytesForAnyThreadsAndBothLibraries) {
    const TemporaryFolder folder;
    sliding_file().write_glb(folder / "x.glb");
    const auto hash = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--frames", "20:22"});
        const fs::path frames = folder / "frames";
        fs::remove_all(frames);
        const Outcome outcome = run_chironomia(render(folder / "x.glb", frames / "%05d.png", more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return sha256_of_file(frames / "00000.png") + sha256_of_file(frames / "00001.png");
    };
    const std::string usual = hash({"--threads", "1"});
    EXPECT_EQ(hash({"--threads", "3"}), usual);
    EXPECT_EQ(hash({"--gl", "egl"}), hash({"--gl", "osmesa"}));
    EXPECT_NE(hash({"--animation", "rise"}), usual);
    const std::string rays = hash({"--renderer", "rays", "--samples", "4", "--threads", "1"});
    EXPECT_EQ(hash({"--renderer", "rays", "--samples", "4", "--threads", "3"}), rays);
    EXPECT_NE(hash({"--renderer", "rays", "--samples", "4", "--motion-blur", "1"}), rays);
}

TEST(OwnAnimationCli, RefusesAnAnimationThatIsNotThereWithExitThree) {
    const TemporaryFolder folder;
    sliding_file().write_glb(folder / "x.glb");
    const Outcome outcome =
        run_chironomia(render(folder / "x.glb", folder / "clip.mp4", {"--animation", "walk"}));
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.err, "chironomia: " + (folder / "x.glb").string() +
                               ": has no animation \"walk\"; choose one of 0 \"slide\", 1 \"rise\"\n");
    EXPECT_FALSE(fs::exists(folder / "clip.mp4"));
}

TEST(OwnAnimationCli, WarnsOfAModelThatLeavesTheScene) {
    const TemporaryFolder folder;
    sliding_file().write_glb(folder / "x.glb");
    write_text(folder / "scene.json", R"({"camera": {"eye": [0, 1, 8], "target": [0, 1, 0]}})");
    const Outcome outcome = run_chironomia(
        render(folder / "x.glb", folder / "clip.mp4", {"--scene", (folder / "scene.json").string()}));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, (folder / "x.glb").string() +
                               ": the middle of the model is outside the picture in 37 of 61 frames; let "
                               "--scene object follow its size, or choose a wider scene\n");
}

TEST(OwnAnimationCli, ShowsABundledAvatarStill) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_chironomia(render("mannequin", folder / "frames/%05d.png", {"--scene", "head"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "a part of it fills the picture";
    EXPECT_TRUE(fs::exists(folder / "frames/00000.png"));
    EXPECT_FALSE(fs::exists(folder / "frames/00001.png"));
}

}  // namespace
}  // namespace chironomia::study
