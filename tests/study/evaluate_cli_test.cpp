// chironomia evaluate and chironomia train: the real binary, its tables and its refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"
#include "synth/corpus/corpus.h"
#include "tests/study/process.h"
#include "tests/study/sample_predictions.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::sample_dyad;
using testing::sample_faces;
using testing::TemporaryFolder;

class EvaluateVerb : public ::testing::Test {
  protected:
    std::string file(const std::string& name) { return (folder_ / name).string(); }
    Outcome evaluate(std::vector<std::string> more) {
        more.insert(more.begin(), {"evaluate", "--out", file("results"), "--samples", "100"});
        return run_chironomia(more);
    }
    // What a command line that must be refused says.
    std::string refusal(std::vector<std::string> more, int exit_code) {
        const Outcome outcome = evaluate(std::move(more));
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
        EXPECT_FALSE(fs::exists(file("results/evaluation.json")));
        return outcome.err;
    }

    TemporaryFolder folder_;
};

TEST_F(EvaluateVerb, PrintsOursBesideThePublishedNumbers) {
    write_predictions(file("a.h5"), sample_dyad("amii", 5));
    const Outcome made = evaluate({"--predictions", file("a.h5")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, AllOf(HasSubstr("All features together (dyads, test)"), HasSubstr("people"),
                                HasSubstr("MAE published"), HasSubstr("Published: Woo, Fares, Pelachaud"),
                                HasSubstr("Measured on other data: NoXi")));
    for (const char* name :
         {"summary.csv", "features.csv", "pairs.csv", "published/amii.csv", "tables.tex", "evaluation.json"})
        EXPECT_TRUE(fs::exists(folder_ / "results" / name)) << name;
}

TEST_F(EvaluateVerb, PrintsTheSameJsonAsItWrites) {
    write_predictions(file("a.h5"), sample_faces("model2"));
    write_predictions(file("b.h5"), sample_faces("model2"));
    const Outcome made = evaluate({"--predictions", file("a.h5"), file("b.h5"), "--json"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json printed = Json::parse(made.out);
    EXPECT_EQ(printed, read_json(file("results/evaluation.json")));
    EXPECT_EQ(printed["tables"]["summary"][0]["model"], "model2 (a)")
        << "systems of one name are distinguished";
    EXPECT_EQ(printed["tables"]["features"].size(), 4u);
}

// The published numbers are bundled; a broken installation says so.
TEST_F(EvaluateVerb, RefusesDamagedPublishedNumbers) {
    write_predictions(file("a.h5"), sample_faces());
    fs::create_directories(folder_ / "home/study");
    fs::copy(testing::source_dir() / "study/published", folder_ / "home/study/published");
    setenv("CHIRONOMIA_HOME", file("home").c_str(), 1);
    const fs::path table = folder_ / "home/study/published/thesis-faces.json";
    const Json whole = read_json(table);
    const auto refused = [&](const std::string& place, const Json& value) {
        Json broken = whole;
        broken[Json::json_pointer(place)] = value;
        write_json(table, broken);
        return refusal({"--predictions", file("a.h5")}, 3);
    };
    const std::string value = whole["rows"][0]["values"].begin().key();
    EXPECT_THAT(refused("/rows/0/values/" + value, "much"),
                HasSubstr("thesis-faces.json: rows[0].values." + value + ": is \"much\", a number from "));
    EXPECT_THAT(refused("/rows/0/values", 3), HasSubstr("thesis-faces.json: rows[0].values: "));
    EXPECT_THAT(refused("/columns", Json::object({{"mae", 3}})),
                HasSubstr("thesis-faces.json: columns.mae: is 3, a text in quotes is needed"));
    write_text(table, whole.dump().substr(0, 100));
    EXPECT_THAT(refusal({"--predictions", file("a.h5")}, 3), HasSubstr("thesis-faces.json"));
    unsetenv("CHIRONOMIA_HOME");
}

TEST_F(EvaluateVerb, SaysWhatIsWrong) {
    EXPECT_THAT(refusal({"--predictions", file("none.h5")}, 3), HasSubstr("none.h5"));
    write_predictions(file("a.h5"), sample_faces());
    Predictions unseen = sample_faces("model1");
    unseen.split = "unseen";
    write_predictions(file("b.h5"), unseen);
    EXPECT_THAT(refusal({"--predictions", file("a.h5"), file("b.h5")}, 3),
                HasSubstr("they predict talks/test and talks/unseen"));
    EXPECT_THAT(refusal({"--predictions", file("a.h5"), "--against", "hold", "--corpus", file("none")}, 3),
                HasSubstr("none"));
    EXPECT_THAT(
        refusal({"--checkpoint", file("a/m.safetensors"), file("b/m.safetensors"), "--corpus", file("none")},
                3),
        HasSubstr("m.safetensors"));
}

// The record of an item of sample_faces().
IpuRecord recorded_face(const std::string& id) {
    IpuRecord record = testing::sample_ipu(id, "s");
    const std::vector<float> truth = sample_faces().items[0].truth;
    for (std::size_t t = 0; t < record.frames(); ++t) {
        record.units[t * IpuRecord::kUnits] = 5 * truth[2 * t];
        record.head[t * IpuRecord::kAngles] = -0.5f + 2 * truth[2 * t + 1];
    }
    return record;
}

TEST_F(EvaluateVerb, RefusesATruthThatTheCorpusDoesNotHold) {
    CorpusIndex corpus{.folder = folder_ / "talks"};
    for (const char* id : {"s0", "s1", "s2"})
        corpus.entries.push_back({.id = id, .speaker = "s", .split = Split::test, .seconds = 2});
    corpus.entries.push_back({.id = "s4", .speaker = "s", .split = Split::train, .seconds = 2});
    for (const CorpusEntry& entry : corpus.entries) write_ipu(corpus.folder, recorded_face(entry.id));
    write_corpus_index(corpus);
    const std::vector<std::string> call = {"--predictions", file("a.h5"), "--corpus", file("talks")};
    Predictions halved = sample_faces();
    for (float& value : halved.items[1].truth) value /= 2;
    write_predictions(file("a.h5"), halved);
    EXPECT_THAT(refusal(call, 3),
                AllOf(HasSubstr("a.h5: /truth of s1: Rx of frame 0 is 0.2500, and its record in " +
                                file("talks") + " has "),
                      HasSubstr("; give the corpus that was predicted, and what people did in it")));
    Predictions slow = sample_faces();
    slow.fps = 25;
    write_predictions(file("a.h5"), slow);
    EXPECT_THAT(refusal(call, 3), HasSubstr("a.h5: /fps is 25, and the records of " + file("talks") +
                                            " have 24 frames/s; predict at their rate"));
    Predictions longer = sample_faces();
    for (auto* rows : {&longer.items[2].truth, &longer.items[2].prediction})
        rows->insert(rows->end(), {0, 0});
    write_predictions(file("a.h5"), longer);
    EXPECT_THAT(refusal(call, 3), HasSubstr("a.h5: /frames of s2 is 49, and its record in " + file("talks") +
                                            " has 48; give the corpus that was predicted"));
    // Models may leave out frames, such as those between words.
    Predictions shorter = sample_faces();
    for (PredictedItem& item : shorter.items)
        for (auto* rows : {&item.truth, &item.prediction})
            rows->erase(rows->begin() + 20, rows->begin() + 44);
    write_predictions(file("a.h5"), shorter);
    EXPECT_EQ(evaluate(call).exit_code, 0);
}

TEST_F(EvaluateVerb, ComparesPredictionsWithTheRecordsThatTheCorpusHas) {
    CorpusIndex corpus{.folder = folder_ / "talks"};
    for (const char* id : {"s0", "s1", "s2", "s3"})
        corpus.entries.push_back({.id = id, .speaker = "s", .split = Split::test, .seconds = 2});
    corpus.entries.push_back({.id = "s4", .speaker = "s", .split = Split::train, .seconds = 2});
    for (const CorpusEntry& entry : corpus.entries) write_ipu(corpus.folder, recorded_face(entry.id));
    write_corpus_index(corpus);
    write_predictions(file("a.h5"), sample_faces());
    const std::vector<std::string> call = {"--predictions", file("a.h5"), "--corpus", file("talks")};
    EXPECT_THAT(evaluate(call).err, HasSubstr("a.h5: 3 of the 4 records of " + file("talks") +
                                              " in \"test\" are predicted; \"s3\" is the first that is not"));
    fs::remove_all(folder_ / "results");
    EXPECT_THAT(
        refusal({call[0], call[1], call[2], call[3], "--split", "unseen"}, 3),
        HasSubstr("a.h5: /split is \"test\", and --split is \"unseen\"; give the split that was predicted"));
    write_predictions(file("a.h5"), sample_faces("model2", 5));
    EXPECT_THAT(refusal(call, 3),
                HasSubstr("a.h5: /ids: " + file("talks") +
                          " has no record \"s4\" in \"test\"; give the corpus that was predicted"));
}

TEST_F(EvaluateVerb, RefusesModelsOfDifferentOutputsBeforeTheyPredict) {
    const auto bundled = [](const std::string& name) {
        return (testing::source_dir() / "assets/models" / (name + ".safetensors")).string();
    };
    EXPECT_THAT(
        refusal({"--checkpoint", bundled("zs-mstm-1"), bundled("zs-mstm-2"), "--corpus", file("none")}, 3),
        AllOf(HasSubstr("zs-mstm-1.safetensors and "), HasSubstr("zs-mstm-2.safetensors: they predict "),
              HasSubstr("evaluate together models that predict the same")));
}

// How alike two people are is only known where both are.
TEST_F(EvaluateVerb, RefusesAModelWithoutTheOthersPartners) {
    write_predictions(file("a.h5"), sample_dyad("amii", 5));
    Predictions alone = sample_dyad("mine", 5);
    for (PredictedItem& item : alone.items) item.partner.clear();
    write_predictions(file("b.h5"), alone);
    EXPECT_THAT(
        refusal({"--predictions", file("a.h5"), file("b.h5")}, 3),
        HasSubstr("amii and mine: only amii says what the partner of each person did; evaluate models "
                  "together that were asked about the same records"));
}

TEST_F(EvaluateVerb, RefusesPredictionsOfNothing) {
    const fs::path fixtures = testing::source_dir() / "tests/fixtures/learned";
    EXPECT_THAT(refusal({"--predictions", (fixtures / "no_records.h5").string()}, 3),
                HasSubstr("no_records.h5: /ids is empty; at least one record must be predicted"));
    EXPECT_THAT(refusal({"--predictions", (fixtures / "no_features.h5").string()}, 3),
                HasSubstr("no_features.h5: /features is empty; at least one must be predicted"));
}

// Of a rate at which half a second has no frame nothing can be computed.
TEST_F(EvaluateVerb, RefusesARateThatIsNoneOfAMotion) {
    Predictions slow = sample_dyad("amii", 5);
    slow.fps = 0.01;
    write_predictions(file("a.h5"), slow);
    EXPECT_THAT(refusal({"--predictions", file("a.h5")}, 3),
                HasSubstr("a.h5: /fps is 0.01; it must be the rate of a motion, 1 to 1000"));
}

TEST_F(EvaluateVerb, RefusesAWrongCommandLine) {
    EXPECT_THAT(refusal({}, 2), HasSubstr("--checkpoint or --predictions"));
    EXPECT_THAT(refusal({"--checkpoint", "c.safetensors"}, 2), HasSubstr("--corpus"));
    EXPECT_THAT(refusal({"--predictions", "p.h5", "--against", "mean"}, 2),
                HasSubstr("--corpus, for --against"));
    EXPECT_THAT(refusal({"--predictions", "p.h5", "--against", "best", "--corpus", "c"}, 2),
                HasSubstr("best"));
    EXPECT_THAT(refusal({"--predictions", "p.h5", "--lag-summary", "most"}, 2),
                HasSubstr("\"most\" is none of absolute, mean, signed"));
    EXPECT_THAT(refusal({"--predictions", "p.h5", "--split", "all"}, 2), HasSubstr("all"));
}

TEST_F(EvaluateVerb, HelpsWithExamples) {
    for (const char* verb : {"train", "evaluate"}) {
        const Outcome help = run_chironomia({verb, "--help"});
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_THAT(help.out, AllOf(HasSubstr("Examples:"), HasSubstr("--corpus")));
    }
}

TEST(TrainVerb, RefusesAWrongCommandLine) {
    const auto refusal = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"train", "model2", "--corpus", "none", "--out", "m.safetensors"});
        const Outcome outcome = run_chironomia(more);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
        return outcome.err;
    };
    const Outcome hold = run_chironomia({"train", "hold", "--corpus", "none", "--out", "m.safetensors"});
    EXPECT_EQ(hold.exit_code, 2);
    EXPECT_THAT(hold.err, AllOf(HasSubstr("hold not in {amii,"), Not(HasSubstr(",hold,"))));
    EXPECT_THAT(refusal({"--option", "ablate"}), HasSubstr("\"ablate\" is no KEY=VALUE"));
    EXPECT_THAT(refusal({"--batch-of"}), HasSubstr("--batch-of: 1 required words|units missing"));
    EXPECT_THAT(refusal({"--sede", "3"}), HasSubstr("--sede"));
    EXPECT_THAT(refusal({"--epochs", "0"}), HasSubstr("--epochs"));
}

TEST(TrainVerb, SaysWhatTheModelRefuses) {
    const TemporaryFolder folder;
    const auto refusal = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "train");
        more.insert(more.end(),
                    {"--corpus", (folder / "none").string(), "--out", (folder / "m.safetensors").string()});
        const Outcome outcome = run_chironomia(more);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
        return outcome.err;
    };
    EXPECT_THAT(refusal({"amii", "--option", "nosuch=1"}),
                AllOf(HasSubstr("--option nosuch: there is no such key"),
                      HasSubstr("\"encoder-sharing\", \"output-layer\"")));
    EXPECT_THAT(refusal({"amii", "--encoder-sharing", "none"}),
                HasSubstr("--encoder-sharing: is \"none\", which is"));
    EXPECT_THAT(refusal({"amii", "--preset", "huge"}), HasSubstr("--preset: is \"huge\", which is none of"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace chironomia::study
