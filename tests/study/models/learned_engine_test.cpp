#include "study/models/learned_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::refusal_of;
using testing::run_chironomia;
using testing::TemporaryFolder;

const std::filesystem::path kAny = "any.safetensors";

TEST(LearnedSynthesizer, AsksForWhatItNeeds) {
    EXPECT_THAT(refusal_of([] { LearnedSynthesizer({.model = "amii", .checkpoint = kAny}); }),
                HasSubstr("--engine amii: it adapts to what its partner does; give both --user-face and "
                          "--user-speech"));
    EXPECT_THAT(
        refusal_of([] { LearnedSynthesizer({.model = "model2", .checkpoint = kAny, .user_face = "u.csv"}); }),
        HasSubstr("--engine model2: it knows of no partner; leave out --user-face"));
    const LearnedSynthesizer engine({.model = "model2", .checkpoint = kAny});
    const Speech silent{.audio = {.rate = 16000, .channels = 1, .samples = std::vector<float>(16000)}};
    EXPECT_THAT(refusal_of([&] { engine.synthesize(silent); }),
                HasSubstr("--engine model2: it needs to know what is said and when; give --words"));
}

TEST(LearnedSynthesizer, SaysWhenNoCheckpointIsBundled) {
    EXPECT_THAT(refusal_of([] { LearnedSynthesizer({.model = "model9"}); }),
                HasSubstr("--engine model9: no checkpoint of it is bundled with this program; train one with "
                          "chironomia train model9 and give it with --checkpoint"));
}

TEST(LearnedSynthesizer, RefusesAPartnerWithoutAFace) {
    const TemporaryFolder folder;
    Motion body{.source = "", .fps = 25, .frames = 1, .notes = {}};
    body.keypoints = KeypointTrack{.names = {"neck"}, .points = {{0, 1, 0}}, .confidence = {1}};
    write_motion_hdf5(folder / "u.h5", body);
    const LearnedSynthesizer engine(
        {.model = "amii", .checkpoint = kAny, .user_face = folder / "u.h5", .user_speech = folder / "u.wav"});
    const Speech silent{.audio = {.rate = 16000, .channels = 1, .samples = std::vector<float>(16000)}};
    EXPECT_THAT(refusal_of([&] { engine.synthesize(silent); }),
                HasSubstr("u.h5: it has no face, which --user-face must have"));
}

// One sample is a frame; less is no sound.
TEST(LearnedSynthesizer, TakesAPartnerWhoIsHeardForAMoment) {
    const TemporaryFolder folder;
    write_text(folder / "u.csv",
               "frame,timestamp,confidence,success,pose_Rx,pose_Ry,pose_Rz,AU12_r\n"
               "1,0,1,1,0,0,0,1\n2,0.04,1,1,0,0,0,1\n");
    write_wav(folder / "u.wav", {.rate = 16000, .channels = 1, .samples = {0.5f}});
    const std::vector<std::string> words = {"synth",
                                            "--engine",
                                            "amii",
                                            "--user-face",
                                            (folder / "u.csv").string(),
                                            "--user-speech",
                                            (folder / "u.wav").string(),
                                            "--out",
                                            (folder / "m.h5").string()};
    const Outcome made = run_chironomia(words);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    write_wav(folder / "u.wav", {.rate = 16000, .channels = 1, .samples = {}});
    const Outcome refused = run_chironomia(words);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("u.wav: its sound is empty; record it again"));
}

// Two frames at 10 per second, of the units that are given.
Motion face_of(std::vector<FaceChannel> channels, std::vector<float> intensities) {
    Motion motion{.source = "", .fps = 10, .frames = 2, .notes = {}};
    motion.face = FaceTrack{.channels = std::move(channels),
                            .intensities = std::move(intensities),
                            .head = {},
                            .gaze = {},
                            .confidence = {1, 1}};
    return motion;
}

TEST(Filled, TakesFromTheWholeWhatTheFaceDoesNotSay) {
    const Motion face = face_of({{.unit = 1}}, {3, 4});
    Motion whole = face_of({{.unit = 1, .side = FaceSide::left}, {.unit = 26}}, {5, 1, 5, 2});
    whole.face->head.assign(2, Quat(1, 0, 0, 0));
    const Motion both = filled(face, whole);
    EXPECT_THAT(both.face->channels, ElementsAre(FaceChannel{26}, FaceChannel{1}));
    EXPECT_THAT(both.face->intensities, ElementsAre(1, 3, 2, 4));
    EXPECT_EQ(both.face->head.size(), 2u);
    EXPECT_THAT(both.notes.back(), HasSubstr("by the expressive engine"));
}

class LearnedSynth : public ::testing::Test {
  protected:
    std::string refusal(std::vector<std::string> more, int exit_code) {
        more.insert(more.begin(), {"synth", "--out", (folder_ / "m.h5").string()});
        const Outcome outcome = run_chironomia(more);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "m.h5"));
        return outcome.err;
    }

    TemporaryFolder folder_;
};

TEST_F(LearnedSynth, RefusesOptionsOfAnotherEngine) {
    EXPECT_THAT(refusal({"--engine", "model9", "--text", "a"}, 2), HasSubstr("model9"));
    EXPECT_THAT(refusal({"--engine", "model2", "--text", "a", "--spc", "1"}, 2),
                HasSubstr("is of the expressive engine, not of model2"));
    EXPECT_THAT(refusal({"--engine", "model2", "--text", "a", "--fps", "60"}, 2), HasSubstr("--fps"));
    EXPECT_THAT(refusal({"--text", "a", "--checkpoint", "c"}, 2),
                HasSubstr("needs a learned engine: amii, model1, model2"));
    EXPECT_THAT(refusal({"--text", "a", "--fill"}, 2), HasSubstr("--fill"));
}

TEST_F(LearnedSynth, SaysWhatIsMissing) {
    EXPECT_THAT(refusal({"--engine", "model2", "--text", "Well then.", "--checkpoint",
                         (folder_ / "none.safetensors").string()},
                        3),
                HasSubstr("none"));
    EXPECT_THAT(refusal({"--engine", "amii"}, 3), HasSubstr("give both --user-face and --user-speech"));
    EXPECT_THAT(refusal({"--engine", "amii", "--text", "Well then.", "--checkpoint", "c"}, 3),
                HasSubstr("give both --user-face and --user-speech"));
    write_wav(folder_ / "s.wav", {.rate = 16000, .channels = 1, .samples = std::vector<float>(16000)});
    write_text(folder_ / "w.csv", "word,start,end\nwell,0.2,0.8\n");
    EXPECT_THAT(
        refusal({"--engine", "model2", "--speech", (folder_ / "s.wav").string(), "--words",
                 (folder_ / "w.csv").string()},
                3),
        HasSubstr(
            "chironomia: no word of the speech is voiced, and the model hears its pitch; give a sound in "
            "which somebody speaks"));
}

// What is only described must be as whole as what animates.
TEST(Info, RefusesACheckpointThatWasCutShort) {
    const TemporaryFolder folder;
    for (const std::string model : {"amii", "model1", "model2"}) {
        const auto bundled = testing::source_dir() / "assets/models";
        std::filesystem::copy_file(bundled / (model + ".json"), folder / (model + ".json"));
        const std::filesystem::path weights = folder / (model + ".safetensors");
        std::filesystem::copy_file(bundled / (model + ".safetensors"), weights);
        EXPECT_EQ(run_chironomia({"info", weights.string()}).exit_code, 0) << model;
        std::filesystem::resize_file(weights, std::filesystem::file_size(weights) / 2);
        for (const std::string& file : {weights.string(), (folder / (model + ".json")).string()}) {
            const Outcome outcome = run_chironomia({"info", file});
            EXPECT_EQ(outcome.exit_code, 3) << file;
            EXPECT_EQ(outcome.out, "");
            EXPECT_THAT(outcome.err, HasSubstr(weights.string() + ": these are not the bytes that " + model +
                                               ".json names"));
            EXPECT_THAT(outcome.err, HasSubstr("copy both files again"));
        }
    }
}

}  // namespace
}  // namespace chironomia::study
