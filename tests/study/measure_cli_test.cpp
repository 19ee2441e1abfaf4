// chironomia measure: the real binary on motions whose measures are known by thought.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

// A face whose mouth corners rise by a wave, later by `late` seconds.
Motion smiling(double late, double fps = 25, double seconds = 64) {
    Motion motion{.source = "", .fps = fps, .frames = static_cast<size_t>(seconds * fps), .notes = {}};
    motion.face = FaceTrack{.channels = {{.unit = 12}}, .head = {}, .gaze = {}, .confidence = {}};
    for (size_t t = 0; t < motion.frames; ++t) {
        const double at = static_cast<double>(t) / fps - late;
        motion.face->intensities.push_back(
            static_cast<float>(2 + 2 * std::sin(2 * std::numbers::pi * at / 8)));
    }
    return motion;
}

// Shoulders 0.4 m apart whose right wrist moves sideways, each second by so many widths of the shoulders.
// Of each step to the side `depth` times as much goes towards the camera.
Motion reaching(float speed = 1, float depth = 0) {
    Motion motion{.source = "", .fps = 10, .frames = 20, .notes = {}};
    motion.keypoints = KeypointTrack{
        .names = {"neck", "left_shoulder", "right_shoulder", "right_wrist"}, .points = {}, .confidence = {}};
    for (int t = 0; t < 20; ++t) {
        motion.keypoints->points.insert(motion.keypoints->points.end(),
                                        {{0, 1.4f, 0},
                                         {0.2f, 1.4f, 0},
                                         {-0.2f, 1.4f, 0},
                                         {-0.3f - 0.04f * speed * static_cast<float>(t), 1,
                                          0.04f * speed * depth * static_cast<float>(t)}});
    }
    motion.keypoints->confidence.assign(80, 1);
    return motion;
}

class Measure : public ::testing::Test {
  protected:
    std::string write(const std::string& name, const Motion& motion) {
        write_motion_hdf5(folder_ / name, motion);
        return (folder_ / name).string();
    }
    Json measure(std::vector<std::string> more) {
        more.insert(more.begin(), {"measure", "--json"});
        const Outcome outcome = run_chironomia(more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.exit_code == 0 ? Json::parse(outcome.out) : Json();
    }
    std::string refusal(std::vector<std::string> more, int exit_code) {
        more.insert(more.begin(), "measure");
        const Outcome outcome = run_chironomia(more);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
        return outcome.err;
    }

    TemporaryFolder folder_;
};

TEST_F(Measure, NotesAMotionOfWhichNothingIsKnown) {
    Motion motion = reaching();
    motion.keypoints->names = {"nose", "left_heel", "right_heel", "pelvis"};
    const Outcome outcome = run_chironomia({"measure", write("a.h5", reaching()), write("b.h5", motion)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("b.h5: neither shoulders nor a face are known in it, so nothing was measured"));
}

TEST_F(Measure, KnowsHowFastAWristMovesInWidthsOfTheShoulders) {
    const Json body = measure({write("a.h5", reaching())})[0]["body"][0];
    EXPECT_EQ(body["points"], 3);  // the neck is the origin
    EXPECT_EQ(body["unit"], "shoulders");
    EXPECT_NEAR(body["wrist_velocity"].get<double>(), 1, 1e-3);
    EXPECT_NEAR(body["velocity"].get<double>(), 1.0 / 3, 1e-3);
    EXPECT_NEAR(body["wrist_acceleration"].get<double>(), 0, 1e-2);
}

// The same motion, once with a nose and with a neck above the shoulders.
TEST_F(Measure, TakesThePointsAndTheOriginThatAllMotionsHave) {
    Motion bare = reaching(), more = reaching();
    bare.keypoints->names[0] = "left_eye";
    more.keypoints->names[0] = "neck";
    for (size_t t = 0; t < more.frames; ++t) more.keypoints->points[4 * t] = {0, 1.5f, -0.05f};
    const std::string a = write("a.h5", bare), b = write("b.h5", more);
    const Json both = measure({a, b});
    EXPECT_EQ(both[0]["body"], both[1]["body"]);
    EXPECT_EQ(both[0]["body"][0]["points"], 3);
    EXPECT_THAT(both[0]["notes"][0].get<std::string>(),
                HasSubstr("a.h5: measured over 3 of its 4 points, those that all motions have"));
    EXPECT_EQ(measure({a, "--against", b})[0]["near"][0]["l1"], 0);
}

TEST_F(Measure, ComparesAFaceWithAReferenceAtItsRate) {
    const std::string same = write("a.h5", smiling(0, 50)), reference = write("b.h5", smiling(0));
    const Outcome measured = run_chironomia({"measure", same, "--against", reference});
    EXPECT_EQ(measured.exit_code, 0);
    EXPECT_THAT(measured.err, HasSubstr("50 frames/s, resampled to the 25"));
    EXPECT_THAT(measured.out, AllOf(HasSubstr("Against the reference"), HasSubstr("AU12")));
    const Json near = measure({same, "--against", reference})[0]["near"][0];
    EXPECT_NEAR(near["rmse"].get<double>(), 0, 1e-5);
    EXPECT_NEAR(near["pcc"].get<double>(), 1, 1e-6);
    EXPECT_NEAR(near["ahr"].get<double>(), 100, 1e-9);
    // A quarter of the wave late: no correlation, and an error of 2 (two waves of amplitude 2).
    const Json late = measure({write("c.h5", smiling(2)), "--against", reference})[0]["near"][0];
    EXPECT_NEAR(late["rmse"].get<double>(), 2, 0.01);
    EXPECT_NEAR(late["pcc"].get<double>(), 0, 0.01);
}

// A smile of 1, and half of the frames lost and bridged at 5.
TEST_F(Measure, LeavesOutFramesInWhichAFaceIsLost) {
    Motion half = smiling(0, 25, 10), other = smiling(0, 25, 10);
    half.face->confidence.assign(250, 1);
    half.face->intensities.assign(250, 1);
    other.face->intensities.assign(250, 1);
    for (size_t t = 0; t < 125; ++t) {
        half.face->confidence[t] = 0;
        half.face->intensities[t] = 5;
    }
    const std::string lost = write("a.h5", half), whole = write("b.h5", other);
    const Json found = measure({lost, "--against", whole})[0];
    const Json face = found["face"][0], near = found["near"][0];
    EXPECT_EQ(face["missing"], 0.5);
    EXPECT_EQ(face["mean"], 1);
    EXPECT_EQ(face["sd"], 0);
    EXPECT_EQ(face["per_second"], 0);
    EXPECT_EQ(near["frames"], 125);
    EXPECT_EQ(near["rmse"], 0);
    EXPECT_EQ(measure({whole})[0]["face"][0]["missing"], 0);
    EXPECT_THAT(run_chironomia({"measure", lost}).out, HasSubstr("Missing"));
    EXPECT_THAT(
        measure({lost, "--partner", whole})[0]["notes"].dump(),
        HasSubstr("a.h5: the face is lost in 125 of 250 frames; smiles of both people take lines over these "
                  "gaps"));
    for (size_t t = 0; t < 250; ++t) half.face->confidence[t] = t < 125 ? 1 : 0;
    EXPECT_THAT(
        refusal({lost, "--against", write("c.h5", half)}, 3),
        HasSubstr("there is no frame in which both faces were seen; give recordings that share some"));
}

TEST_F(Measure, ComparesBodies) {
    const std::string file = write("a.h5", reaching());
    const Json near = measure({file, "--against", file})[0]["near"][0];
    EXPECT_EQ(near["feature"], "body");
    EXPECT_EQ(near["minkowski_3"], 0);
    EXPECT_NEAR(near["content"].get<double>(), 100, 1e-6);
    EXPECT_EQ(near["l1"], 0);
    EXPECT_EQ(near["pck_01"], 1);
    EXPECT_NEAR(near["frechet"].get<double>(), 0, 1e-6);
    // Of three points the wrist alone, along one axis of two, is a tenth of a width further away in each frame.
    const Json faster = measure({write("b.h5", reaching(2)), "--against", file})[0]["near"][0];
    EXPECT_NEAR(faster["velocity_l1"].get<double>(), 0.1 / 6, 1e-5);
    EXPECT_NEAR(faster["l1"].get<double>(), 0.95 / 6, 1e-5);
}

// A picture of reaching(): y points down, and there is no depth.
Motion seen(const Motion& motion) {
    Motion flat = motion;
    flat.keypoints.reset();
    flat.picture = PictureTrack{.names = motion.keypoints->names,
                                .points = {},
                                .confidence = motion.keypoints->confidence,
                                .size = {1280, 720}};
    for (const Vec3& point : motion.keypoints->points)
        flat.picture->points.push_back({640 + 200 * point.x, 500 - 200 * point.y});
    return flat;
}

TEST_F(Measure, ComparesAMotionInSpaceWithOneInAPictureFromTheFront) {
    Motion deep = reaching(1, 2);
    for (Vec3& point : deep.keypoints->points)
        if (point.x == 0.2f) point.z = 0.1f;  // the shoulders are turned
    const std::string space = write("a.h5", deep), picture = write("b.h5", seen(deep));
    const Json measured = measure({space, "--against", picture})[0];
    const Json near = measured["near"][0];
    for (const char* distance : {"minkowski_1", "minkowski_2", "minkowski_3", "l1"})
        EXPECT_NEAR(near[distance].get<double>(), 0, 1e-3) << distance;
    EXPECT_NEAR(near["content"].get<double>(), 100, 1e-3);
    EXPECT_THAT(measured["notes"][0].get<std::string>(),
                HasSubstr("one has no depth; compared as seen from the front"));
    const Json both = measure({space, picture});
    EXPECT_EQ(both[0]["notes"].size(), 0u);
    EXPECT_THAT(both[1]["notes"][0].get<std::string>(), HasSubstr("it has no depth, and others here have"));
}

TEST_F(Measure, ComparesTheFramesThatBothHave) {
    Motion holes = reaching();
    for (std::size_t t = 0; t < 10; ++t) holes.keypoints->confidence[4 * t + 3] = 0;
    const Json near = measure({write("a.h5", holes), "--against", write("b.h5", reaching())})[0]["near"][0];
    EXPECT_EQ(near["frames"], 10);
    EXPECT_NEAR(near["frechet"].get<double>(), 0, 1e-6);
}

TEST_F(Measure, FindsHowFarAStyleHasComeFromItsSourceToItsTarget) {
    const std::string slow = write("s.h5", reaching(1)), fast = write("t.h5", reaching(3));
    const Json style =
        measure({write("m.h5", reaching(2.5)), "--against", fast, "--source", slow})[0]["style"];
    ASSERT_EQ(style.size(), 7u);
    EXPECT_EQ(style[3]["metric"], "wrist_velocity");
    EXPECT_NEAR(style[3]["source"].get<double>(), 1, 1e-3);
    EXPECT_NEAR(style[3]["model"].get<double>(), 2.5, 1e-3);
    EXPECT_NEAR(style[3]["dist_avg_model"].get<double>(), 20, 0.1);
    EXPECT_NEAR(style[3]["dist_avg_source"].get<double>(), 80, 0.1);
    // Beside motions of a picture the depth of one in space does not count.
    const std::string deep = write("d.h5", reaching(1, 3));
    const Json flat = measure({fast, "--against", fast, "--source", deep})[0]["style"];
    EXPECT_NEAR(flat[3]["source"].get<double>(), 1, 1e-3);
    EXPECT_NEAR(measure({deep, "--against", deep, "--source", deep})[0]["style"][3]["source"].get<double>(),
                std::sqrt(10), 1e-2);
    const Outcome shown = run_chironomia({"measure", fast, "--against", fast, "--source", slow});
    EXPECT_THAT(shown.out, AllOf(HasSubstr("How near the style comes"), HasSubstr("Dist_avg of source [%]")));
}

// Angles pass through turns, whose rounding is not the same in all frames.
TEST_F(Measure, HasNoCorrelationOfAGazeThatHoldsStill) {
    std::string table =
        "frame,timestamp,confidence,success,gaze_angle_x,gaze_angle_y,pose_Rx,pose_Ry,pose_Rz,AU12_r\n";
    for (int t = 0; t < 100; ++t) {
        table += format("{},{:.2f},0.98,1,0.05,-0.02,{:.3f},{:.3f},0.1,{:.2f}\n", t + 1, t / 25.0,
                        0.1 * std::sin(0.2 * t), 0.2 * std::cos(0.1 * t), 2 + std::sin(0.3 * t));
    }
    const std::string file = (folder_ / "still.csv").string();
    write_text(file, table);
    const Json near = measure({file, "--against", file})[0]["near"];
    ASSERT_EQ(near.size(), 6u);
    for (const Json& row : near) {
        const bool still = row["feature"] == "Rz" || row["feature"].get<std::string>().starts_with("gaze");
        EXPECT_EQ(row["pcc"].is_null(), still) << row.dump();
    }
}

TEST_F(Measure, SaysWhichFeaturesOneOfBothFacesLacks) {
    Motion more = smiling(0);
    more.face->channels.push_back({.unit = 4});
    std::vector<float> intensities;
    for (const float smile : more.face->intensities) intensities.insert(intensities.end(), {smile, 1});
    more.face->intensities = intensities;
    const std::string a = write("a.h5", smiling(0)), b = write("b.h5", more);
    EXPECT_THAT(measure({a, "--against", b})[0]["notes"].dump(),
                HasSubstr(format("{}: has AU4, which {} lacks; not compared", b, a)));
}

// Of three points the wrist alone is further away along one axis of two, by 0.05 widths a frame and unit of speed.
constexpr double kL1 = 0.95 / 6;

TEST_F(Measure, ComparesFoldersByTheNamesOfTheirFiles) {
    for (const char* folder : {"made", "true", "emage", "empty"})
        std::filesystem::create_directory(folder_ / folder);
    write("made/a.h5", reaching(2));
    write("made/b.h5", reaching(3));
    write("emage/res_a.h5", reaching(2));
    write("emage/gt_a.h5", reaching());
    for (const char* name : {"true/a.h5", "true/b.h5", "true/c.h5"}) write(name, reaching());
    write_text(folder_ / "made/readme.txt", "no motion");
    write_text(folder_ / "made/._a.bvh", "what macOS writes beside a file");
    const std::string made = (folder_ / "made").string(), recorded = (folder_ / "true").string();
    const Outcome shown = run_chironomia({"measure", made, "--against", recorded, "--json"});
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_EQ(shown.err, format("{}: lacks 1 of the files of {}, which do not count: c\n", made, recorded));
    const Json all = Json::parse(shown.out);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_NEAR(all[0]["near"][0]["l1"].get<double>(), kL1, 1e-5);
    EXPECT_EQ(all[2]["motion"], made + ": mean of 2");
    EXPECT_NEAR(all[2]["near"][0]["l1"].get<double>(), 1.5 * kL1, 1e-5);
    EXPECT_NEAR(all[2]["body"][0]["wrist_velocity"].get<double>(), 2.5, 1e-3);
    EXPECT_EQ(all[3]["motion"], made + ": all 2 together");
    // The file of EMAGE's folder is compared with the one beside it.
    const std::string emage = (folder_ / "emage").string();
    EXPECT_NEAR(measure({emage, "--against", emage})[0]["near"][0]["l1"].get<double>(), kL1, 1e-5);
    // Two systems have a mean each.
    EXPECT_EQ(measure({made, emage})[4]["motion"], emage + ": mean of 1");
    EXPECT_EQ(refusal({(folder_ / "empty").string()}, 3),
              format("chironomia: {}: holds no motion; give a folder with BVH, keypoints or OpenPose in it\n",
                     (folder_ / "empty").string()));
    write("made/d.h5", reaching());
    EXPECT_THAT(refusal({made, "--against", recorded}, 3),
                HasSubstr(format("made/d.h5: nothing in {} is called d; files belong together by their names",
                                 recorded)));
    write_text(folder_ / "made/d.csv", "time,AU12\n");
    EXPECT_THAT(refusal({made}, 3),
                HasSubstr("made/d.h5: both are called d; keep one of them in the folder"));
}

// In one of two files the smile stands still, and one has a unit that the other lacks.
TEST_F(Measure, SaysWhatTheMeansOfAFolderLeaveOut) {
    for (const char* folder : {"made", "true"}) std::filesystem::create_directory(folder_ / folder);
    Motion still = smiling(0);
    still.face->channels.push_back({.unit = 4});
    still.face->intensities.assign(2 * still.frames, 1);
    write("made/a.h5", smiling(0));
    write("made/b.h5", still);
    for (const char* name : {"true/a.h5", "true/b.h5"}) write(name, smiling(0));
    const std::string made = (folder_ / "made").string();
    const Json mean = measure({made, "--against", (folder_ / "true").string()})[2];
    ASSERT_EQ(mean["near"].size(), 1u);
    EXPECT_NEAR(mean["near"][0]["pcc"].get<double>(), 1, 1e-6);
    EXPECT_EQ(
        mean["notes"],
        Json({made + ": 1 of 2 files have AU4, so it has no mean",
              made + ": the mean of AU12 pcc is that of 1 of 2 files; it is not defined in the others"}));
    EXPECT_THAT(refusal({made, "--audio", made}, 3),
                HasSubstr("made: holds no sound; give a folder with WAV, FLAC, OGG or MP3 in it"));
}

// The places of the wrists differ by a constant, their changes not at all.
TEST_F(Measure, TakesTheFrechetDistanceOfAllPosesOfAFolder) {
    for (const char* folder : {"made", "true"}) std::filesystem::create_directory(folder_ / folder);
    for (const char* name : {"a.h5", "b.h5"}) {
        Motion motion = reaching(), moved = reaching();
        for (size_t t = 0; t < motion.frames; ++t)
            moved.keypoints->points[4 * t + 3].y -= 0.2f;  // half the width of the shoulders
        write(std::string("true/") + name, motion);
        write(std::string("made/") + name, moved);
    }
    const Json all = measure({(folder_ / "made").string(), "--against", (folder_ / "true").string()});
    const Json& together = all[3]["near"][0];
    EXPECT_EQ(together["frames"], 40);
    EXPECT_NEAR(together["frechet"].get<double>(), 0.25, 1e-4);
    EXPECT_NEAR(together["velocity_frechet"].get<double>(), 0, 1e-4);
}

// A wrist that turns back at 0.5, 1.5, ... s, where clicks are heard, or `late` seconds before them.
TEST_F(Measure, FindsBeatsOfAMotionOnThoseOfASound) {
    Motion motion = reaching();
    motion.fps = 60;
    motion.frames = 600;
    motion.keypoints->points.clear();
    for (int t = 0; t < 600; ++t) {
        const auto wave = static_cast<float>(0.1 * std::sin(std::numbers::pi * (t + 0.25) / 60));
        motion.keypoints->points.insert(
            motion.keypoints->points.end(),
            {{0, 1.4f, 0}, {0.2f, 1.4f, 0}, {-0.2f, 1.4f, 0}, {-0.3f, 1 + wave, 0}});
    }
    motion.keypoints->confidence.assign(2400, 1);
    const auto alignment = [&](double late) {
        Audio clicks{.rate = 16000, .channels = 1, .samples = std::vector<float>(160000, 0)};
        for (int n = 0; n < 9; ++n) {
            const auto begin = static_cast<size_t>((n + 0.5 + late) * clicks.rate);
            for (size_t i = 0; i < 160; ++i) clicks.samples[begin + i] = i % 2 ? 0.5f : -0.5f;
        }
        write_wav(folder_ / "clicks.wav", clicks);
        return measure({write("a.h5", motion), "--audio", (folder_ / "clicks.wav").string()})[0]["beats"][0];
    };
    const Json on = alignment(0), off = alignment(0.25);
    EXPECT_EQ(on["beats"], 10);
    EXPECT_EQ(on["onsets"], 9);
    EXPECT_GT(on["alignment"].get<double>(), 0.85);
    EXPECT_LT(off["alignment"].get<double>(), 0.01);
    // A Gaussian of sigma 0.05 s around one onset in a second.
    EXPECT_NEAR(on["chance"].get<double>(), 0.05 * std::sqrt(2 * std::numbers::pi), 0.03);
    EXPECT_THAT(
        run_chironomia({"measure", write("a.h5", motion), "--audio", (folder_ / "clicks.wav").string()}).out,
        HasSubstr("Beat alignment (BC)"));
    const std::string click = (folder_ / "click.wav").string();
    write_wav(click, {.rate = 16000, .channels = 1, .samples = std::vector<float>(320, 0)});
    EXPECT_THAT(
        refusal({write("a.h5", motion), "--audio", click}, 3),
        HasSubstr(
            "click.wav: the sound lasts 0.020 s, its spectrum takes 0.032 s or more; give a longer one"));
    // The wrist, which alone moves, is lost in single frames, far from where it turns back.
    for (const size_t t : {60u, 121u, 182u, 239u, 300u, 422u}) motion.keypoints->confidence[4 * t + 3] = 0;
    const Json lost = alignment(0);
    EXPECT_EQ(lost["beats"], 10);
    EXPECT_NEAR(lost["alignment"].get<double>(), on["alignment"].get<double>(), 1e-3);
}

TEST_F(Measure, SaysThatBeatsNeedShouldersAndASoundAsLong) {
    write_wav(folder_ / "s.wav", {.rate = 16000, .channels = 1, .samples = std::vector<float>(160000, 0)});
    const std::string sound = (folder_ / "s.wav").string();
    EXPECT_THAT(measure({write("f.h5", smiling(0)), "--audio", sound})[0]["notes"].dump(),
                HasSubstr("f.h5: has no shoulders, so its beats were not measured"));
    EXPECT_THAT(measure({write("a.h5", reaching()), "--audio", sound})[0]["notes"].dump(),
                HasSubstr("a.h5: 2.00 s, and its sound 10.00 s; beats are those of the first 2.00 s"));
}

// Times of a table begin at 5 s, those of the reference at 0.
TEST_F(Measure, SaysThatTimesBeginElsewhere) {
    const auto table = [&](const char* name, double begin) {
        std::string text = "timestamp,AU12_r\n";
        for (int t = 0; t < 50; ++t) text += format("{:.2f},{:.2f}\n", begin + t / 25.0, 1 + std::sin(t));
        write_text(folder_ / name, text);
        return (folder_ / name).string();
    };
    const std::string late = table("late.csv", 5), reference = table("reference.csv", 0);
    EXPECT_THAT(measure({late, "--against", reference})[0]["notes"].dump(),
                HasSubstr(format(
                    "{}: its times begin at 5 s, those of {} at 0 s; compared from their first frames on",
                    late, reference)));
}

// `fps` times a second.
Motion waving(double fps) {
    Motion motion = reaching();
    motion.fps = fps;
    motion.frames = static_cast<size_t>(4 * fps);
    const std::vector<Vec3> pose(motion.keypoints->points.begin(), motion.keypoints->points.begin() + 4);
    motion.keypoints->points.clear();
    for (size_t t = 0; t < motion.frames; ++t) {
        motion.keypoints->points.insert(motion.keypoints->points.end(), pose.begin(), pose.end());
        motion.keypoints->points.back().x -=
            static_cast<float>(0.2 * std::sin(3 * static_cast<double>(t) / fps));
    }
    motion.keypoints->confidence.assign(4 * motion.frames, 1);
    return motion;
}

TEST_F(Measure, ComparesMotionsOfDifferentRatesAtTheLowest) {
    const std::string slow = write("slow.h5", waving(15)), fast = write("fast.h5", waving(120));
    const Json both = measure({fast, slow});
    const double jerk = both[1]["body"][0]["wrist_jerk"];
    EXPECT_NEAR(both[0]["body"][0]["wrist_jerk"].get<double>(), jerk, 0.01 * jerk);
    EXPECT_THAT(both[0]["notes"][0].get<std::string>(),
                HasSubstr("fast.h5: 120 frames/s, measured at the 15 of " + slow));
    EXPECT_TRUE(both[1]["notes"].empty());
    // The style of a slower copy is the target's own.
    const Json one = measure({slow, "--against", fast, "--source", write("s.h5", reaching())})[0];
    EXPECT_EQ(one["style"][5]["metric"], "wrist_jerk");
    EXPECT_LT(one["style"][5]["dist_avg_model"].get<double>(), 2);
    EXPECT_THAT(one["notes"].dump(), HasSubstr("measured at the 10 frames/s of "));
}

TEST_F(Measure, FindsHowLateAPartnerFollows) {
    const Json pair =
        measure({write("a.h5", smiling(0)), "--partner", write("u.h5", smiling(1.2))})[0]["pair"][0];
    EXPECT_NEAR(pair["tlcc"].get<double>(), 1, 1e-4);
    EXPECT_NEAR(pair["lag"].get<double>(), 1.2, 1e-6);
    EXPECT_GT(pair["dtw"].get<double>(), 0);
    EXPECT_GT(pair["sync"].get<double>(), 0);
    // The same smiles at twice the rate.
    const Json fast =
        measure({write("a.h5", smiling(0, 50)), "--partner", write("u.h5", smiling(1.2, 50))})[0]["pair"][0];
    for (const char* loop : {"sync", "el"})
        EXPECT_NEAR(fast[loop].get<double>(), pair[loop].get<double>(), 0.05 * pair[loop].get<double>())
            << loop;
    EXPECT_THAT(
        run_chironomia({"measure", (folder_ / "a.h5").string(), "--partner", (folder_ / "u.h5").string()})
            .out,
        HasSubstr("Sync [s/min] (proposed)"));
}

TEST_F(Measure, SaysWhatShortMotionsLeaveOut) {
    const std::string brief = write("a.h5", smiling(0, 25, 5));
    const Outcome measured = run_chironomia({"measure", brief, "--partner", brief});
    EXPECT_EQ(measured.exit_code, 0);
    EXPECT_THAT(measured.err, AllOf(HasSubstr("TLCC: there are no 8 s"), HasSubstr("shorter than 60 s")));
    const Outcome cut = run_chironomia({"measure", brief, "--against", write("b.h5", smiling(0))});
    EXPECT_THAT(cut.err, HasSubstr("compared over the first 5.00 s"));
}

TEST_F(Measure, SaysWhatIsWrong) {
    const std::string body = write("a.h5", reaching()), face = write("b.h5", smiling(0));
    EXPECT_THAT(refusal({body, "--against", face}, 3),
                HasSubstr("they share neither a feature of a face nor a point of a body"));
    EXPECT_THAT(refusal({body, "--partner", face}, 3), HasSubstr("a.h5: it has no AU12"));
    EXPECT_THAT(refusal({body, "--against", body, "--source", face}, 3),
                HasSubstr("b.h5: it has no body with both shoulders, in whose widths styles are compared"));
    EXPECT_THAT(refusal({body, "--source", body}, 2), HasSubstr("--source requires --against"));
    EXPECT_THAT(refusal({"none.bvh"}, 3), HasSubstr("none.bvh"));
    EXPECT_THAT(refusal({}, 2), HasSubstr("--motion is required"));
    EXPECT_THAT(refusal({body, "--motion-fps", "fast"}, 2), HasSubstr("--motion-fps"));
}

}  // namespace
}  // namespace chironomia::study
