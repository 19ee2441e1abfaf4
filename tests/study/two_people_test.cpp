// Two people in one clip: how they are drawn, and what the real binary makes of two motions and two voices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "core/hash.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/gl/gl_renderer.h"
#include "raster/images/image_file.h"
#include "scenes/figures.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "study/clip/stage.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

const std::string kLeft = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();
const std::string kRight = (source_dir() / "assets/samples/restrained/simple-idea.bvh").string();
constexpr RenderSize kSize{320, 180};

const Avatar& mannequin() {
    static const Avatar avatar = read_avatar(source_dir() / "assets/avatars/mannequin.glb");
    return avatar;
}

TEST(JoinedFigures, OneAloneIsTheSamePictureAsUnjoined) {
    const Avatar* figure = &mannequin();
    const Transform here;
    const Scene scene = make_scene("upper", mannequin(), kSize);
    const PosedMesh mesh = skin(mannequin(), rest_pose(mannequin()));
    const Avatar joined = join_figures(std::span(&figure, 1), std::span(&here, 1));
    const Frame apart = make_gl_renderer(mannequin(), scene, kSize)->render(mesh);
    const Frame together =
        make_gl_renderer(joined, scene, kSize)->render(join_meshes(std::span(&mesh, 1), std::span(&here, 1)));
    EXPECT_TRUE(apart == together);
}

double mean_green(const Frame& frame, int first_column) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = first_column; x < frame.width; ++x, ++count) {
            sum += frame.rgba[static_cast<std::size_t>(y * frame.width + x) * 4 + 1];
        }
    }
    return sum / count;
}

// Lit from the viewer's left at breast height, the left one takes the light from the right one.
TEST(JoinedFigures, StandInEachOthersLight) {
    const TemporaryFolder folder;
    const auto drawn = [&](double z_of_left) {
        write_text(folder / "scene.json", format(R"({{"camera": {{"eye": [0, 1.2, 6], "target": [0, 1.2, 0]}},
            "places": [{{"x": -0.8, "z": {}, "heading_deg": 0}}, {{"x": 0.8, "z": 0, "heading_deg": 0}}],
            "floor": {{"visible": false}}, "lights": [{{"azimuth_deg": -90, "elevation_deg": 1,
            "colour": "#ffffff", "strength": 2, "shadow": true, "softness_deg": 1, "wrap": 0}}]}})",
                                                 z_of_left));
        const Avatar* figures[] = {&mannequin(), &mannequin()};
        const View view = stage_scene((folder / "scene.json").string(), figures, kSize).views.front();
        std::vector<Transform> places;
        for (const Placement& place : view.scene.places) {
            places.push_back(world_from_figure(measure_figure(mannequin()), place));
        }
        const PosedMesh mesh = skin(mannequin(), rest_pose(mannequin()));
        const PosedMesh meshes[] = {mesh, mesh};
        return make_gl_renderer(join_figures(figures, places), view.scene, kSize)
            ->render(join_meshes(meshes, places));
    };
    const Frame in_line = drawn(0), out_of_line = drawn(-4);
    const int right_body = kSize.width * 5 / 8;
    EXPECT_LT(mean_green(in_line, right_body) + 1, mean_green(out_of_line, right_body));
}

// A person before a blurred face stays sharp, and the blur takes no colour from that person.
TEST(MakeStage, KeepsAnotherPersonSharpBeforeABlurredFace) {
    const TemporaryFolder folder;
    write_text(folder / "scene.json", R"({"camera": {"framing": "head"}, "floor": {"visible": false},
        "places": [{"x": 0, "z": 0, "heading_deg": 0}, {"x": 0.12, "z": 0.6, "heading_deg": 0}]})");
    ClipJob job;
    job.performers = {{.motion = kLeft, .modes = {.face_mode = FaceMode::blur}}, {.motion = kRight}};
    job.scene = folder / "scene.json";
    job.size = {640, 360};
    std::vector<Performance> people;
    for (const Performer& performer : job.performers) people.push_back(perform(performer, job));
    for (Surface& surface : people[1].avatar.surfaces) surface.colours.clear();
    for (Material& material : people[1].avatar.materials)
        material = {.base_colour = {1, 0, 1, 1}, .double_sided = true, .unlit = true};
    const auto picture = [&] {
        const Stage stage = make_stage(people, job);
        return draw(stage, expose_all(stage, people, 0));
    };
    const Frame blurred = picture();
    people[0].blurred.reset();
    const Frame plain = picture();
    const auto is_magenta = [&](std::size_t at) {
        return plain.rgba[at] == 255 && plain.rgba[at + 1] == 0 && plain.rgba[at + 2] == 255;
    };
    int changed = 0, beside = 0;
    for (std::size_t i = 0; i < plain.rgba.size(); i += 4) {
        const std::uint8_t* after = blurred.rgba.data() + i;
        if (std::equal(after, after + 4, plain.rgba.data() + i)) continue;
        EXPECT_FALSE(is_magenta(i)) << "pixel " << i / 4;
        EXPECT_GT(after[1], 0.5f * static_cast<float>(std::min(after[0], after[2]))) << "pixel " << i / 4;
        ++changed;
        beside += is_magenta(i + 8);
    }
    EXPECT_GT(changed, 1000);
    EXPECT_GT(beside, 20) << "the one in front must cover a part of the face";
}

// A small clip of a few frames of two people.
std::vector<std::string> render_two(const fs::path& out, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", "--motion", kLeft,   "--motion",   kRight,
                                      "--size", "320x180",  "--out", out.string(), "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

fs::path write_tone(const fs::path& file, double hertz, double seconds, float amplitude = 0.4f) {
    Audio sound{.rate = 44100, .channels = 1, .samples = {}};
    for (int i = 0; i < static_cast<int>(seconds * sound.rate); ++i) {
        const double angle = 2 * std::numbers::pi * hertz * i / sound.rate;
        sound.samples.push_back(amplitude * static_cast<float>(std::sin(angle)));
    }
    write_wav(file, sound);
    return file;
}

double power_of(const Audio& sound, int channel, double first_s, double last_s) {
    double sum = 0;
    for (auto i = static_cast<std::size_t>(first_s * sound.rate);
         i < static_cast<std::size_t>(last_s * sound.rate); ++i) {
        const double sample =
            sound.samples[i * static_cast<std::size_t>(sound.channels) + static_cast<std::size_t>(channel)];
        sum += sample * sample / ((last_s - first_s) * sound.rate);
    }
    return sum;
}

TEST(TwoPeople, AreSeenAndHeardFromTheirSides) {
    const TemporaryFolder folder;
    const std::string left = write_tone(folder / "left.wav", 300, 2).string();
    const std::string right = write_tone(folder / "right.wav", 500, 1).string();
    for (const std::string scene : {"dyad", "split"}) {
        const fs::path clip = folder / (scene + ".mp4");
        const Outcome outcome =
            run_chironomia(render_two(clip, {"--scene", scene, "--audio", left, "--audio", right, "--frames",
                                             "0:60", "--report", (folder / "r.json").string()}));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.err,
                    HasSubstr("right.wav: the voice lasts 1.000 s of 2.000 s; silence is added"));
        const ClipInfo info = read_clip_info(clip);
        ASSERT_TRUE(info.sound && info.picture);
        EXPECT_EQ(info.sound->channels, 2);
        EXPECT_EQ(info.sound->rate, 48000);
        EXPECT_NEAR(info.sound->duration_s, 2, 0.03);
        EXPECT_NEAR(info.picture->duration_s, 2, 1e-6);
        EXPECT_EQ(info.picture->width, 320);
        // In the second half the left one speaks alone.
        const Audio heard = read_audio(clip);
        const double on_left = power_of(heard, 0, 1.2, 1.9), on_right = power_of(heard, 1, 1.2, 1.9);
        EXPECT_NEAR(on_left + on_right, 0.08, 0.002);
        EXPECT_NEAR(10 * std::log10(on_left / on_right), 11.4, 0.5);
        const Json report = read_json(folder / "r.json");
        ASSERT_EQ(report["motions"].size(), 2u);
        EXPECT_EQ(report["motions"][0]["file"], kLeft);
        EXPECT_EQ(report["motions"][1]["file"], kRight);
        EXPECT_EQ(report["recipe"]["performers"][1]["voice"], sha256_of_file(right));
    }
}

// The bar shows under the one who speaks: the left one during the first second, then the right one.
TEST(TwoPeople, AreMarkedWhileTheySpeak) {
    const TemporaryFolder folder;
    Audio second = read_audio(write_tone(folder / "tone.wav", 500, 1));
    write_wav(folder / "left.wav", second);
    second.samples.insert(second.samples.begin(), static_cast<std::size_t>(second.rate), 0.0f);
    write_wav(folder / "right.wav", second);
    const std::vector<std::string> voices = {"--audio", (folder / "left.wav").string(), "--audio",
                                             (folder / "right.wav").string()};
    for (const std::string scene : {"dyad", "split"}) {
        std::vector<std::string> with = render_two(folder / (scene + "/%d.png"),
                                                   {"--scene", scene, "--cue", "light", "--frames", "20:56"});
        with.insert(with.end(), voices.begin(), voices.end());
        const Outcome outcome = run_chironomia(with);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const Outcome without = run_chironomia(
            render_two(folder / (scene + "-plain/%d.png"), {"--scene", scene, "--frames", "20:56"}));
        ASSERT_EQ(without.exit_code, 0) << without.err;
        for (const int frame : {0, 35}) {
            const Frame marked = read_image(folder / scene / format("{}.png", frame));
            const Frame plain = read_image(folder / (scene + "-plain") / format("{}.png", frame));
            int left = 0, right = 0;
            for (int y = 0; y < marked.height; ++y) {
                for (int x = 0; x < marked.width; ++x) {
                    const auto at = static_cast<std::size_t>(y * marked.width + x) * 4;
                    if (marked.rgba[at] == plain.rgba[at] && marked.rgba[at + 2] == plain.rgba[at + 2])
                        continue;
                    EXPECT_GT(y, marked.height * 9 / 10);
                    ++(x < marked.width / 2 ? left : right);
                }
            }
            EXPECT_EQ(left > 40, frame == 0) << scene << " " << frame;
            EXPECT_EQ(right > 40, frame == 35) << scene << " " << frame;
        }
    }
}

TEST(TwoPeople, AreMadeQuieterTogetherWithANote) {
    const TemporaryFolder folder;
    const std::string loud = write_tone(folder / "loud.wav", 300, 1, 1).string();
    const Outcome outcome = run_chironomia(render_two(
        folder / "a.mp4", {"--scene", "dyad", "--audio", loud, "--audio", loud, "--frames", "0:6"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("together they are too loud by 1.8 dB; both are made quieter by that"));
}

TEST(TwoPeople, ShareOneSoundAsItIs) {
    const TemporaryFolder folder;
    const std::string sound = write_tone(folder / "both.wav", 300, 1).string();
    const Outcome outcome = run_chironomia(
        render_two(folder / "a.mp4", {"--scene", "dyad", "--audio", sound, "--frames", "0:6"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_clip_info(folder / "a.mp4").sound->channels, 1);
}

TEST(TwoPeople, AreTheSameBytesForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    for (const std::string scene : {"dyad", "split"}) {
        std::vector<std::string> hashes;
        for (const std::string threads : {"1", "2", "4"}) {
            const fs::path clip = folder / (scene + threads + ".mp4");
            const Outcome outcome = run_chironomia(
                render_two(clip, {"--scene", scene, "--frames", "30:40", "--threads", threads}));
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            hashes.push_back(sha256_of_file(clip));
        }
        EXPECT_THAT(hashes, ::testing::Each(hashes[0])) << scene;
    }
}

// Two ways to the same pixels: half of a split picture, and the person alone in a picture of that size.
TEST(TwoPeople, OfASplitSceneLookAsAlone) {
    const TemporaryFolder folder;
    const std::vector<std::string> one_frame = {"--frames", "40:41"};
    std::vector<std::string> split = render_two(folder / "both/%d.png", {"--scene", "split"});
    split.insert(split.end(), one_frame.begin(), one_frame.end());
    ASSERT_EQ(run_chironomia(split).exit_code, 0);
    const Frame both = read_image(folder / "both/0.png");
    int left_of_part = 0;
    for (const std::string& motion : {kLeft, kRight}) {
        const fs::path stack = folder / format("alone{}/%d.png", left_of_part);
        const Outcome outcome = run_chironomia({"render", "--motion", motion, "--size", "159x180", "--frames",
                                                "40:41", "--out", stack.string(), "--quiet"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const Frame alone = read_image(stack.parent_path() / "0.png");
        for (int y = 0; y < alone.height; ++y) {
            const auto row = alone.rgba.begin() + y * alone.width * 4;
            const auto part = both.rgba.begin() + (y * both.width + left_of_part) * 4;
            ASSERT_TRUE(std::equal(row, row + alone.width * 4, part)) << motion << " row " << y;
        }
        left_of_part = 161;
    }
    // Between them the gap, white.
    EXPECT_EQ(both.rgba[159 * 4], 255);
    EXPECT_EQ(both.rgba[160 * 4], 255);
}

TEST(TwoPeople, MayHaveTwoAvatarsRatesAndLengths) {
    const TemporaryFolder folder;
    const std::string other = testing::test_file("made/vrm.vrm").string();
    const std::string keypoints = (source_dir() / "assets/samples/keypoints/two-ways.npz").string();
    const fs::path clip = folder / "a.mp4";
    const Outcome outcome = run_chironomia({"render", "--motion", kRight, "--motion", keypoints, "--avatar",
                                            "mannequin", "--avatar", other, "--scene", "dyad", "--size",
                                            "160x90", "--fps", "25", "--out", clip.string(), "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("; its last pose is held"));
}

// A BVH carries its rate, OpenPose does not.
TEST(TwoPeople, ShareARateWhereTheirFilesHaveNone) {
    const TemporaryFolder folder;
    const std::string openpose = testing::test_file("tests/fixtures/gestures/openpose_24fps").string();
    const Outcome outcome =
        run_chironomia({"render", "--motion", kRight, "--motion", openpose, "--motion-fps", "24", "--scene",
                        "dyad", "--avatar", "stick", "--size", "64x36", "--frames", "0:2", "--out",
                        (folder / "a.mp4").string(), "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("openpose_24fps: the motion lasts 105 frames of 287;"));
    EXPECT_THAT(outcome.err,
                HasSubstr("it has 30 frames/s of its own; 24, which is set once for all, is for motions"));
}

TEST(TwoPeople, AreWarnedOfWhoLeavesThePicture) {
    const TemporaryFolder folder;
    const std::string walker = testing::test_file("tests/fixtures/gestures/walk.bvh").string();
    const Outcome outcome =
        run_chironomia({"render", "--motion", kLeft, "--motion", walker, "--scene", "dyad", "--size",
                        "160x90", "--frames", "125:129", "--out", (folder / "a.mp4").string(), "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("walk.bvh: the head is outside the picture in 4 of 4 frames; hold the "
                                       "figure with --in-place or --body upper (of a plan: "));
    EXPECT_THAT(outcome.err, ::testing::Not(HasSubstr("two-ways.bvh: the head is outside")));
}

TEST(TwoPeople, AreRefusedWhereTheirNumberIsWrong) {
    const TemporaryFolder folder;
    const fs::path out = folder / "a.mp4";
    const auto said = [&](const std::vector<std::string>& words, int exit_code) {
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        EXPECT_TRUE(fs::is_empty(folder.path()));
        return outcome.err;
    };
    EXPECT_THAT(said({"render", "--motion", kLeft, "--scene", "dyad", "--out", out.string()}, 3),
                HasSubstr("scene dyad: shows 2 people, but there is 1; give two motions, or choose upper"));
    EXPECT_THAT(said(render_two(out, {}), 3),
                HasSubstr("scene upper: shows 1 people, but there are 2; choose dyad or split for two"));
    EXPECT_THAT(said(render_two(out, {"--scene", "dyad", "--cue", "light"}), 3),
                HasSubstr("speaking cue: needs the voices of two people; give two motions and --audio twice, "
                          "or no cue"));
    EXPECT_THAT(said(render_two(out, {"--scene", "dyad", "--motion", kLeft}), 2),
                HasSubstr("), a clip shows at most 2 people"));
}

}  // namespace
}  // namespace chironomia::study
