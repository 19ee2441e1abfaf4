// The learned models from a corpus to a motion: the real binary, few steps of the smallest presets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "synth/corpus/corpus.h"
#include "tests/study/process.h"
#include "tests/study/recordings.h"
#include "tests/support/motion_hdf5.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

constexpr const char* kText = "Well, there are two ways, and one of them is really big.";

class Learning : public ::testing::Test {
  protected:
    std::string file(const std::string& name) { return (folder_ / name).string(); }

    // Runs a command that must succeed; what it says on stdout.
    std::string must(const std::vector<std::string>& words) {
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        said_ = outcome.err;
        return outcome.out;
    }
    void train(const std::string& model, const std::string& corpus, const std::string& out) {
        EXPECT_THAT(must({"train", model, "--corpus", file(corpus), "--preset", "small", "--steps", "2",
                          "--epochs", "1", "--quiet", "--out", file(out)}),
                    HasSubstr(" steps, loss "));
    }
    Json evaluate(const std::string& checkpoint, const std::string& corpus) {
        return Json::parse(
            must({"evaluate", "--checkpoint", file(checkpoint), "--corpus", file(corpus), "--against",
                  "hold,mean", "--samples", "100", "--quiet", "--out", file("results"), "--json"}));
    }

    TemporaryFolder folder_;
    std::string said_;  // by the last command on stderr
};

// Dyads of six seconds: AMII looks back for four.
void write_dyads(const fs::path& folder, float most = 30) {
    constexpr std::size_t kFrames = 150;
    CorpusIndex index =
        testing::sample_index(folder, CorpusKind::dyads,
                              {{.id = "d_1", .speaker = "a+b", .split = Split::train, .seconds = 6},
                               {.id = "d_2", .speaker = "c+d", .split = Split::validation, .seconds = 6},
                               {.id = "d_3", .speaker = "e+f", .split = Split::test, .seconds = 6}});
    double phase = 0;
    for (const CorpusEntry& entry : index.entries) {
        DyadRecord record =
            testing::sample_dyad(entry.id, entry.speaker.substr(0, 1), entry.speaker.substr(2), phase += 0.7);
        for (DyadPerson& person : record.people) {
            person.face = testing::wave(kFrames * DyadPerson::kFace, 0, 1.5, phase);
            person.speech = testing::wave(kFrames * DyadPerson::kSpeech, -3, most, phase += 0.3);
        }
        write_dyad(folder, record);
    }
    write_corpus_index(index);
}

// Half of the windows follow what the model predicts, which a checkpoint must keep as well.
TEST_F(Learning, LeavesAWholeCheckpointWhenASignalEndsIt) {
    write_dyads(folder_ / "dyads");
    const auto command = [&](const std::string& out, std::vector<std::string> rest) {
        std::vector<std::string> words{
            "train",    "amii",    "--corpus", file("dyads"),  "--preset", "small",   "--option", "stride=2",
            "--option", "batch=8", "--option", "own_past=0.5", "--epochs", "1000000", "--out",    file(out)};
        words.insert(words.end(), rest.begin(), rest.end());
        return words;
    };
    for (const auto& [name, signal] : {std::pair{"terminated", SIGTERM}, {"interrupted", SIGINT}}) {
        testing::RunningChironomia running(command(name, {}));
        ASSERT_THAT(running.wait_for_err("training: "), HasSubstr("training: "));
        const Outcome outcome = running.end(signal);
        EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("chironomia: interrupted; the same command goes on from here\n"));
        const int step = read_json(folder_ / (std::string(name) + ".json"))["step"];
        EXPECT_GT(step, 0);
        const std::string steps = std::to_string(step + 9), whole = std::string(name) + "-whole";
        must(command(name, {"--steps", steps}));
        must(command(whole, {"--steps", steps}));
        for (const char* ending : {".json", ".safetensors", ".resume.safetensors", ".svg"})
            EXPECT_EQ(read_text(folder_ / (name + std::string(ending))),
                      read_text(folder_ / (whole + ending)))
                << name << ending << " after " << step << " steps";
    }
}

TEST_F(Learning, RefusesToGoOnOverAnotherCorpusOfTheSameSize) {
    write_dyads(folder_ / "dyads");
    write_dyads(folder_ / "others", 60);
    const auto command = [&](const char* corpus, const char* steps) {
        return std::vector<std::string>{"train",   "amii", "--corpus", file(corpus), "--preset",   "small",
                                        "--steps", steps,  "--quiet",  "--out",      file("model")};
    };
    must(command("dyads", "1"));
    const Outcome outcome = run_chironomia(command("others", "2"));
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("model.json: holds a training on another corpus, in which "));
    EXPECT_THAT(outcome.err, HasSubstr("; name another file, or remove this one to train anew"));
    must(command("dyads", "2"));
}

// The ranges are the same: what one of them said comes in another order.
TEST_F(Learning, RefusesToGoOnOverACorrectedCorpus) {
    write_dyads(folder_ / "dyads");
    const std::vector<std::string> command = {"train",    "amii",  "--corpus",   file("dyads"),
                                              "--preset", "small", "--steps",    "1",
                                              "--quiet",  "--out", file("model")};
    must(command);
    const CorpusIndex corpus = read_corpus_index(folder_ / "dyads");
    const auto change = [&](Split split) {
        DyadRecord record = read_dyad(corpus, corpus.of(split).at(0));
        std::ranges::rotate(record.people[0].speech, record.people[0].speech.begin() + DyadPerson::kSpeech);
        write_dyad(corpus.folder, record);
    };
    change(Split::test);
    must(command);  // nothing is learned from it
    change(Split::train);
    const Outcome outcome = run_chironomia(command);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("model.json: holds a training on other records: SHA-256 "));
}

TEST_F(Learning, SaysThatAModelMayBeJudgedOnWhatItHasLearned) {
    write_dyads(folder_ / "dyads");
    train("amii", "dyads", "model.safetensors");
    evaluate("model.safetensors", "dyads");
    EXPECT_THAT(said_, Not(HasSubstr("learned")));
    CorpusIndex corpus = read_corpus_index(folder_ / "dyads");
    std::swap(corpus.entries[0].split, corpus.entries[2].split);  // as another seed would
    write_corpus_index(corpus);
    evaluate("model.safetensors", "dyads");
    EXPECT_THAT(said_,
                HasSubstr("model.safetensors: it has learned from other records than those in \"train\" and "
                          "\"validation\" of "));
}

// libtorch, OpenBLAS and oneDNN would take the instructions of a processor of 2008, as they are told here.
TEST_F(Learning, ComputesTheSameBytesOnOtherProcessors) {
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no other instructions";
    write_dyads(folder_ / "dyads");
    testing::sample_talks(folder_ / "talks");
    must({"corpus", "make", "--kind", "intervals", "--size", "ci", "--speakers", "2+1", "--quiet", "--out",
          file("people")});
    const auto train_all = [&](const std::string& name) {
        train("amii", "dyads", name + "-amii.safetensors");
        train("model2", "talks", name + "-model2.safetensors");
        must({"train", "zs-mstm-1", "--corpus", file("people"), "--preset", "small", "--steps", "3",
              "--quiet", "--out", file(name + "-zs-mstm-1.safetensors")});
    };
    train_all("new");
    const std::pair<const char*, const char*> old[] = {
        {"OPENBLAS_CORETYPE", "Nehalem"}, {"ATEN_CPU_CAPABILITY", "default"}, {"DNNL_MAX_CPU_ISA", "SSE41"}};
    for (const auto& [name, value] : old) setenv(name, value, 1);
    train_all("old");
    for (const auto& [name, value] : old) unsetenv(name);
    for (const char* ending : {"-amii.safetensors", "-model2.safetensors", "-zs-mstm-1.safetensors"})
        EXPECT_EQ(read_text(folder_ / (std::string("new") + ending)),
                  read_text(folder_ / (std::string("old") + ending)))
            << ending;
#endif
}

TEST_F(Learning, GoesFromTalksToAFace) {
    testing::sample_talks(folder_ / "talks");
    train("model2", "talks", "m.safetensors");
    const Json found = evaluate("m.safetensors", "talks");
    std::vector<std::string> systems;
    for (const Json& row : found["tables"]["summary"]) systems.push_back(row["model"]);
    EXPECT_THAT(systems, ElementsAre("model2", "hold", "mean"));
    EXPECT_EQ(found["tables"]["features"][0]["rmse_published"], 0.193);
    for (const char* out : {"a.h5", "b.h5"})
        must({"synth", "--engine", "model2", "--checkpoint", file("m.safetensors"), "--text", kText, "--out",
              file(out), "--speech-out", file("s.wav")});
    EXPECT_EQ(read_bytes(file("a.h5")), read_bytes(file("b.h5")));
    const Motion motion = testing::read_motion_hdf5(file("a.h5"));
    EXPECT_NEAR(duration(motion), read_audio(file("s.wav")).duration(), 1 / motion.fps);
    ASSERT_TRUE(motion.face && !motion.joints);
    EXPECT_EQ(motion.face->channels.size(), 6u);
    EXPECT_EQ(motion.face->head.size(), motion.frames);
    must({"synth", "--engine", "model2", "--checkpoint", file("m.safetensors"), "--text", kText, "--fill",
          "--out", file("c.h5")});
    const Motion filled = testing::read_motion_hdf5(file("c.h5"));
    EXPECT_EQ(filled.frames, motion.frames);
    EXPECT_TRUE(filled.joints.has_value());
    EXPECT_THAT(filled.face->channels, AllOf(Contains(FaceChannel{26}), Contains(FaceChannel{1})));
}

// Brows that live, and do not jump from one frame to the next.
TEST_F(Learning, SpeaksWithTheModelsThatAreBundled) {
    for (const char* model : {"model1", "model2"}) {
        must({"synth", "--engine", model, "--text", kText, "--quiet", "--out", file("m.h5")});
        const Motion motion = testing::read_motion_hdf5(file("m.h5"));
        const FaceTrack& face = *motion.face;
        const std::size_t channels = face.channels.size();
        ASSERT_EQ(face.channels[0], FaceChannel{1});
        float least = 5, most = 0, step = 0;
        for (std::size_t t = 0; t < motion.frames; ++t) {
            const float brow = face.intensities[t * channels];
            least = std::min(least, brow);
            most = std::max(most, brow);
            if (t > 0) step = std::max(step, std::abs(brow - face.intensities[(t - 1) * channels]));
        }
        EXPECT_GT(most - least, 0.3F) << model;
        EXPECT_LT(step, 1) << model;
    }
}

TEST_F(Learning, GoesFromDyadsToSomebodyWhoListens) {
    write_dyads(folder_ / "dyads");
    train("amii", "dyads", "m.safetensors");
    for (const char* part : {"m.safetensors", "m.json"})
        EXPECT_THAT(must({"info", file(part)}), AllOf(HasSubstr("amii, preset small, 13908 numbers"),
                                                      HasSubstr("encoder-sharing shared")));
    EXPECT_EQ(must({"info", file("dyads")}), must({"corpus", "info", file("dyads")}));
    const Json found = evaluate("m.safetensors", "dyads");
    EXPECT_EQ(found["tables"]["pairs"][0]["model"], "people");
    EXPECT_EQ(found["tables"]["pairs"].size(), 4u);
    // The partner is somebody of the expressive engine, with a face that is recorded for longer.
    must({"synth", "--text", kText, "--out", file("u.h5"), "--speech-out", file("u.wav")});
    Audio brief = read_audio(file("u.wav"));
    brief.samples.resize(brief.samples.size() / 2);
    write_wav(file("u2.wav"), brief);
    must({"synth", "--engine", "amii", "--checkpoint", file("m.safetensors"), "--user-face", file("u.h5"),
          "--user-speech", file("u2.wav"), "--out", file("a.h5")});
    EXPECT_THAT(said_, HasSubstr("unequal lengths, cut to"));
    must({"synth", "--engine", "amii", "--user-face", file("u.h5"), "--speech", file("u2.wav"),
          "--user-speech", file("u2.wav"), "--out", file("d.h5")});
    EXPECT_THAT(said_, HasSubstr("u2.wav: it is --speech and --user-speech, so both people say the same"));
    must({"synth", "--text", kText, "--partner-deg", "45", "--out", file("aside.h5")});
    must({"synth", "--engine", "amii", "--user-face", file("aside.h5"), "--user-speech", file("u2.wav"),
          "--out", file("c.h5")});
    EXPECT_THAT(said_, HasSubstr("aside.h5: Ry lies outside what the model has learned"));
    const Motion motion = testing::read_motion_hdf5(file("a.h5"));
    EXPECT_EQ(motion.fps, 25);
    EXPECT_NEAR(duration(motion), brief.duration(), 1 / motion.fps);
    EXPECT_EQ(motion.face->gaze.size(), motion.frames);
    EXPECT_THAT(motion.face->channels, Contains(FaceChannel{12}));
    // A table that lacks its first rows and a unit that the model looks at.
    testing::write_openface(file("late.csv"), {.without = "AU06", .first_row = 15});
    testing::write_voice(file("late.wav"));
    must({"synth", "--engine", "amii", "--checkpoint", file("m.safetensors"), "--user-face", file("late.csv"),
          "--user-speech", file("late.wav"), "--out", file("b.h5")});
    EXPECT_THAT(said_,
                HasSubstr("late.csv: its times begin at 0.5 s, which is second 0 here; --user-speech must"));
    EXPECT_THAT(said_, HasSubstr("late.csv: no AU6; it is held at 0"));
}

TEST_F(Learning, RefusesWeightsWithoutADescription) {
    write_text(file("foreign.safetensors"), std::string("\2\0\0\0\0\0\0\0{}", 10));
    const Outcome outcome = run_chironomia({"info", file("foreign.safetensors")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err,
                HasSubstr("foreign.safetensors: has no foreign.json beside it, by which train describes "
                          "each of its models; it is not one of them, or give back its file"));
}

TEST_F(Learning, RefusesACheckpointOfAnotherModel) {
    write_dyads(folder_ / "dyads");
    train("il-lstm", "dyads", "m.safetensors");
    must({"synth", "--text", "Well then.", "--out", file("u.h5"), "--speech-out", file("u.wav")});
    const Outcome other =
        run_chironomia({"synth", "--engine", "amii", "--checkpoint", file("m.safetensors"), "--user-face",
                        file("u.h5"), "--user-speech", file("u.wav"), "--out", file("a.h5")});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_THAT(other.err, HasSubstr("it holds il-lstm, but --engine is amii; give a checkpoint of that"));
    EXPECT_FALSE(fs::exists(file("a.h5")));
}

}  // namespace
}  // namespace chironomia::study
