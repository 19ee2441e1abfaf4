#include "synth/learned/dyads/dyad_jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/text.h"
#include "synth/learned/dyads/amii_options.h"
#include "synth/learned/models.h"
#include "synth/predictions.h"
#include "tests/support/support.h"
#include "tests/synth/learned/sample_dyads.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

// A corpus, and what is learned from it in a few steps.
struct Workshop {
    Workshop() { testing::write_following_dyads(folder / "corpus", 160); }

    Json train_job(const std::string& model) const {
        return {{"verb", "train"},
                {"model", model},
                {"preset", "small"},
                {"corpus", (folder / "corpus").string()},
                {"out", (folder / model).string()},
                {"quiet", true},
                {"epochs", 2},
                {"options", {{"stride", 10}, {"batch", 4}, {"own_past", 0}}}};
    }
    Json predict_job(const std::string& model) const {
        return {{"verb", "predict"},
                {"checkpoint", (folder / model).string()},
                {"corpus", (folder / "corpus").string()},
                {"split", "test"},
                {"out", (folder / "predictions.h5").string()},
                {"quiet", true}};
    }
    Predictions predicted() const { return read_predictions(folder / "predictions.h5"); }

    TemporaryFolder folder;
};

double furthest(const std::vector<float>& a, const std::vector<float>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max<double>(most, std::abs(a[i] - b[i]));
    return most;
}

TEST(DyadJobs, TrainPredictAndDescribeEveryModel) {
    const Workshop workshop;
    for (const std::string model : {"amii", "il-lstm", "sym-il-lstm"}) {
        const Json trained = answer(workshop.train_job(model));
        EXPECT_EQ(trained["checkpoint"], (workshop.folder / (model + ".json")).string());
        EXPECT_EQ(trained["steps"], 6) << model;  // 6 windows, 2 in a batch with both orders, 2 epochs
        EXPECT_EQ(trained["curve"].size(), 2u);

        EXPECT_EQ(answer(workshop.predict_job(model))["items"], 2);
        const Predictions predictions = workshop.predicted();
        EXPECT_EQ(predictions.model, model);
        EXPECT_EQ(predictions.corpus, "corpus");
        EXPECT_EQ(predictions.features.at(9), "AU12");
        EXPECT_NEAR(predictions.scale.at(9)[1], 2, 0.02);
        ASSERT_EQ(predictions.items.size(), 2u);
        EXPECT_EQ(predictions.items[0].id, "d2:0");
        EXPECT_EQ(predictions.items[1].speaker, "q2");
        EXPECT_EQ(predictions.items[0].truth.size(), 600u);  // 60 frames after the first window
        EXPECT_EQ(predictions.items[0].truth, predictions.items[1].partner);
        EXPECT_GT(furthest(predictions.items[0].prediction, predictions.items[0].truth), 0.01);

        const Json described = answer({{"verb", "describe"}, {"checkpoint", trained["checkpoint"]}});
        EXPECT_EQ(described["model"], model);
        EXPECT_EQ(described["options"]["stride"], 10);
        EXPECT_EQ(described["outputs"].size(), 10u);
    }
}

std::string files_of(const fs::path& stem) {
    std::string bytes;
    for (const char* ending : {".json", ".safetensors", ".resume.safetensors", ".svg"})
        bytes += read_text(fs::path(stem) += ending);
    return bytes;
}

// 3 steps an epoch. From the second on, half of the windows follow what the model predicts.
TEST(DyadJobs, LearnFromTheirOwnPastsAsIfTheyHadNeverStopped) {
    const Workshop workshop;
    for (const std::string model : {"amii", "il-lstm", "sym-il-lstm"}) {
        Json job = workshop.train_job(model);
        job["epochs"] = 4;
        const auto trained_as = [&](const char* name, std::optional<int> steps) {
            job["out"] = (workshop.folder / (model + name)).string();
            job.erase("steps");
            if (steps) job["steps"] = *steps;
            return answer(job);
        };
        const Json recorded = trained_as("-recorded", {});
        job["options"].update({{"own_past", 0.5}, {"own_seconds", 0.4}, {"own_from", 1}});
        const Json whole = trained_as("-whole", {});
        EXPECT_EQ(whole["steps"], 12);
        // The first epoch is the same, what it is judged by is not.
        EXPECT_EQ(whole["curve"][0][1], recorded["curve"][0][1]) << model;
        EXPECT_NE(whole["curve"][0][2], recorded["curve"][0][2]) << model;
        EXPECT_NE(whole["curve"][1][1], recorded["curve"][1][1]) << model;
        trained_as("-parts", 5);
        trained_as("-parts", {});
        EXPECT_EQ(files_of(workshop.folder / (model + "-parts")),
                  files_of(workshop.folder / (model + "-whole")))
            << model;
    }
}

TEST(DyadJobs, LearnAsThePaperDoesOrFromTheirOwnPasts) {
    const Json none = Json::object();
    const DyadTraining paper = dyad_training("paper", JsonValue(none, "options"));
    EXPECT_EQ(paper.own_past, 0);
    EXPECT_EQ(paper.batch, 32u);
    EXPECT_EQ(paper.epochs, 300u);
    const DyadTraining small = dyad_training("small", JsonValue(none, "options"));
    EXPECT_EQ(small.own_past, 0.5);
    EXPECT_EQ(small.own_seconds, 60);
    const Json recorded{{"own_past", 0}};
    EXPECT_EQ(dyad_training("small", JsonValue(recorded, "options")).own_past, 0);
}

TEST(DyadJobs, GiveTheSameBytesWithTwoThreadsRunAfterRun) {
    const Workshop workshop;
    for (const std::string model : {"amii", "il-lstm", "sym-il-lstm"}) {
        Json job = workshop.train_job(model);
        job["threads"] = 2;
        job["options"].update({{"own_past", 0.5}, {"own_seconds", 0.4}, {"own_from", 0}});
        std::vector<std::string> found;
        for (const char* name : {"-first", "-second"}) {
            job["out"] = (workshop.folder / (model + name)).string();
            answer(job);
            found.push_back(files_of(workshop.folder / (model + name)));
        }
        EXPECT_EQ(found[0], found[1]) << model;
    }
}

TEST(DyadJobs, CountTheParametersOfWhatIsAskedFor) {
    const auto parameters = [](const char* model, const Json& options) {
        return answer({{"verb", "describe"},
                       {"model", model},
                       {"preset", "paper"},
                       {"options", options}})["parameters"];
    };
    EXPECT_EQ(parameters("amii", Json::object()), 13'908);
    EXPECT_EQ(parameters("amii", {{"A08", "separate"}}), 24'132);
    EXPECT_EQ(parameters("il-lstm", Json::object()), 4 * 64 * (20 + 64 + 2) + 650);
    EXPECT_EQ(parameters("sym-il-lstm", Json::object()), 4 * 64 * (52 + 64 + 2 + 64 + 64 + 2) + 1300);
    EXPECT_EQ(parameters("hold", Json::object()), 0);
}

TEST(DyadJobs, NameAblationsInTheirPredictions) {
    const Workshop workshop;
    Json job = workshop.train_job("amii");
    job["options"]["ablation"] = "noE_dual";
    answer(job);
    answer(workshop.predict_job("amii"));
    EXPECT_EQ(workshop.predicted().model, "amii-noE_dual");
}

// At a horizon of one frame the face is always that of the frame before; without one, that of frame 99.
TEST(DyadJobs, HoldTheLastFace) {
    const Workshop workshop;
    Json job = workshop.predict_job("hold");
    job.erase("checkpoint");
    job["model"] = "hold";
    answer(job);
    const PredictedItem free = workshop.predicted().items[0];
    EXPECT_EQ(std::vector<float>(free.prediction.begin(), free.prediction.begin() + 10),
              std::vector<float>(free.prediction.end() - 10, free.prediction.end()));
    job["options"] = {{"horizon", 0.04}};
    answer(job);
    const PredictedItem near = workshop.predicted().items[0];
    EXPECT_EQ(std::vector<float>(near.prediction.begin() + 10, near.prediction.end()),
              std::vector<float>(near.truth.begin(), near.truth.end() - 10));
}

TEST(DyadJobs, AnimateAnAgentBesideAUser) {
    const Workshop workshop;
    answer(workshop.train_job("amii"));
    const DyadRecord dyad = testing::following_dyad("d", "p", "q", 30, 0);
    const fs::path inputs = workshop.folder / "inputs.h5", out = workshop.folder / "face.h5";
    const Json job{{"verb", "animate"},
                   {"checkpoint", (workshop.folder / "amii").string()},
                   {"inputs", inputs.string()},
                   {"out", out.string()}};
    const auto write_inputs = [&](const std::vector<float>& user_face, std::size_t frames) {
        Hdf5Writer writer(inputs, inputs.string());
        writer.write_floats("speech", {30, 16}, dyad.people[0].speech);
        writer.make_group("user");
        writer.write_floats("user/face", {frames, 10}, user_face);
        writer.write_floats("user/speech", {30, 16}, dyad.people[1].speech);
        writer.close();
    };
    const auto face = [&] {
        const std::vector<std::byte> bytes = read_bytes(out);
        return Hdf5File(bytes, "face.h5").read_numbers("face", {30, 10});
    };
    write_inputs(dyad.people[1].face, 30);
    EXPECT_EQ(answer(job)["frames"], 30);
    const std::vector<double> first = face();
    EXPECT_LE(*std::max_element(first.begin(), first.end()), 2.01);
    EXPECT_GE(*std::min_element(first.begin(), first.end()), -0.01);

    // What the user does in the last two frames reaches the last one alone.
    std::vector<float> other = dyad.people[1].face;
    for (std::size_t i = 28 * 10; i < other.size(); ++i) other[i] = 2 - other[i];
    write_inputs(other, 30);
    answer(job);
    const std::vector<double> second = face();
    EXPECT_EQ(std::vector<double>(first.begin(), first.end() - 10),
              std::vector<double>(second.begin(), second.end() - 10));
    EXPECT_NE(first, second);

    other.resize(200);
    write_inputs(other, 20);
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("user/face"));
    {
        Hdf5Writer writer(inputs, inputs.string());
        writer.write_number("fps", 25);
        writer.close();
    }
    EXPECT_THAT(refusal_of([&] { answer(job); }),
                HasSubstr("inputs.h5: has no array \"speech\", that of the agent; write it"));
}

TEST(DyadJobs, RefuseWhatTheyCannotDo) {
    const Workshop workshop;
    const auto refusal = [](const Json& job) { return refusal_of([&] { answer(job); }); };
    EXPECT_THAT(refusal({{"verb", "teach"}}), HasSubstr("verb"));
    EXPECT_THAT(refusal({{"verb", "train"}, {"model", "amiii"}}), HasSubstr("did you mean \"amii\"?"));
    EXPECT_THAT(
        refusal({{"verb", "train"}, {"model", "hold"}}),
        HasSubstr("hold: this model repeats the last face and has nothing to learn; predict with it"));
    Json job = workshop.train_job("amii");
    job["options"] = {{"A52", "joint"}};
    EXPECT_THAT(refusal(job), HasSubstr("A52: there is no such key"));
    job = workshop.train_job("il-lstm");
    job["options"] = {{"A25", "joint"}};
    EXPECT_THAT(refusal(job), HasSubstr("A25: there is no such key"));
    job = workshop.train_job("amii");
    job["options"] = {{"own_past", 2}};
    EXPECT_THAT(refusal(job), HasSubstr("own_past: is 2, a number from 0 to 1 is needed"));
    job = workshop.train_job("amii");
    job["preset"] = "large";
    EXPECT_THAT(refusal(job), HasSubstr("preset"));
}

TEST(DyadJobs, RefuseCorporaThatTheyCannotLearnFrom) {
    const TemporaryFolder folder;
    const auto refusal = [&](std::size_t frames, bool only_training, CorpusKind kind, double own_past = 0) {
        fs::remove_all(folder / "corpus");
        testing::write_following_dyads(folder / "corpus", frames);
        CorpusIndex index = read_corpus_index(folder / "corpus");
        if (only_training)
            for (CorpusEntry& entry : index.entries) entry.split = Split::train;
        index.kind = kind;
        write_corpus_index(index);
        return refusal_of([&] {
            answer({{"verb", "train"},
                    {"model", "amii"},
                    {"preset", "small"},
                    {"corpus", (folder / "corpus").string()},
                    {"options", {{"own_past", own_past}}},
                    {"out", (folder / "amii").string()}});
        });
    };
    EXPECT_THAT(refusal(100, false, CorpusKind::dyads),
                HasSubstr("the dyad d0 has 100 frames, at least 101 are needed; leave it out"));
    EXPECT_THAT(refusal(101, false, CorpusKind::dyads, 0.5),
                HasSubstr("the dyad d0 has 101 frames, at least 102 are needed; leave it out"));
    EXPECT_THAT(refusal(120, true, CorpusKind::dyads), HasSubstr("no dyad is in the split \"validation\""));
    EXPECT_THAT(refusal(120, false, CorpusKind::talks),
                HasSubstr("a corpus of talks, this model learns from dyads; make or import one of dyads"));
}

TEST(DyadJobs, RefuseCheckpointsThatTheyCannotUse) {
    const Workshop workshop;
    answer(workshop.train_job("amii"));
    const fs::path file = workshop.folder / "amii.json";
    const Json good = read_json(file);
    const auto refusal_with = [&](const char* key, const Json& value) {
        Json json = good;
        json[key] = value;
        write_json(file, json);
        return refusal_of([&] { answer(workshop.predict_job("amii")); });
    };
    EXPECT_THAT(refusal_with("model", "amii2"),
                HasSubstr("holds the model \"amii2\", this program knows amii"));
    EXPECT_THAT(refusal_with("model", "il-lstm"), HasSubstr("there is no such key"));
    Json swapped = good["outputs"];
    std::swap(swapped[0], swapped[1]);
    EXPECT_THAT(refusal_with("outputs", swapped), HasSubstr("its outputs are gaze_angle_y, gaze_angle_x"));
    Json options = good["options"];
    options["A08"] = "separate";
    EXPECT_THAT(refusal_with("options", options), HasSubstr("\" is missing; give a file of the same model"));
    write_json(file, good);
    EXPECT_EQ(answer(workshop.predict_job("amii"))["items"], 2);
}

}  // namespace
}  // namespace chironomia
