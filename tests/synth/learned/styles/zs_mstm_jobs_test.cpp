// The jobs of ZS-MSTM, on a corpus that the program made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "synth/learned/models.h"
#include "synth/predictions.h"
#include "tests/synth/learned/styles/style_corpus.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ZsMstmJobs : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Styles, ZsMstmJobs, ::testing::Values("zs-mstm-1", "zs-mstm-2"),
                         [](const auto& test) {
                             return std::string(test.param).substr(8) == "1" ? "One" : "Two";
                         });

TEST_P(ZsMstmJobs, GoesOnToTheSameBytes) {
    const TemporaryFolder whole, halves;
    const Json trained = answer(style_training(whole, GetParam(), 4));
    EXPECT_EQ(trained.at("steps"), 4);
    answer(style_training(halves, GetParam(), 2));
    answer(style_training(halves, GetParam(), 4));
    EXPECT_EQ(bytes_of(whole / "model"), bytes_of(halves / "model"));
}

TEST_P(ZsMstmJobs, ShowsIntervalsInTheStylesOfAllSpeakers) {
    const TemporaryFolder folder;
    answer(style_training(folder, GetParam(), 1));
    const Json said = answer({{"verb", "predict"},
                              {"checkpoint", (folder / "model").string()},
                              {"corpus", style_corpus().string()},
                              {"split", "test"},
                              {"out", (folder / "p.h5").string()},
                              {"options", {{"pairs", 1}, {"segments", 2}}},
                              {"quiet", true}});
    const Predictions predictions = read_predictions(folder / "p.h5");
    EXPECT_EQ(said.at("items"), predictions.items.size());
    std::size_t transfers = 0;
    for (const PredictedItem& item : predictions.items) {
        EXPECT_THAT(item.id, HasSubstr(">" + item.style));
        transfers += item.style != item.speaker ? 1 : 0;
    }
    EXPECT_EQ(transfers, 2u);  // each of two speakers as the other
    EXPECT_EQ(predictions.features.front(), "RShoulder x");
}

TEST_P(ZsMstmJobs, MovesInTheStyleOfASpeakerOrOfAnInterval) {
    const TemporaryFolder folder;
    answer(style_training(folder, GetParam(), 1));
    write_inputs(folder / "inputs.h5");
    const CorpusIndex index = read_corpus_index(style_corpus());
    const CorpusEntry unseen = index.of(Split::unseen).front();
    const fs::path interval = style_corpus() / "data" / "processed" / unseen.speaker / (unseen.id + ".h5");
    for (const Json& style : {Json{{"file", interval.string()}},
                              Json{{"corpus", style_corpus().string()}, {"speaker", unseen.speaker}}}) {
        answer({{"verb", "animate"},
                {"checkpoint", (folder / "model").string()},
                {"inputs", (folder / "inputs.h5").string()},
                {"out", (folder / "m.h5").string()},
                {"style", style}});
        const auto bytes = read_bytes(folder / "m.h5");
        const Hdf5File motion(bytes, "m.h5");
        EXPECT_EQ(motion.shape_of("pose/normalize"), (std::vector<std::size_t>{100, 22}));
        EXPECT_EQ(motion.has("face/normalize"), std::string(GetParam()) == "zs-mstm-2");
    }
}

TEST(ZsMstmJobsRefuse, AnotherEncodersVectorsAndStrangers) {
    const TemporaryFolder folder;
    answer(style_training(folder, "zs-mstm-1", 1));
    Json job{{"verb", "animate"},
             {"checkpoint", (folder / "model").string()},
             {"inputs", (folder / "inputs.h5").string()},
             {"out", (folder / "m.h5").string()},
             {"style", {{"corpus", style_corpus().string()}, {"speaker", "nobody"}}}};
    write_inputs(folder / "inputs.h5", {.encoder = "bert-base-uncased"});
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("the model has learned those of \"hashbert\""));
    write_inputs(folder / "inputs.h5");
    EXPECT_THAT(refusal_of([&] { answer(job); }),
                HasSubstr("nobody is called \"nobody\" there; give one of"));
}

TEST(ZsMstmJobsRefuse, WeightsForTheSmallTransformer) {
    const TemporaryFolder folder;
    Json job = style_training(folder, "zs-mstm-1", 1);
    job["ast"] = folder.path().string();
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("too narrow for those weights"));
    job["preset"] = "paper";
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("model.safetensors"));
}

TEST(ZsMstmJobsRefuse, AWarmUpThatTheRateDoesNotHave) {
    const TemporaryFolder folder;
    Json job = style_training(folder, "zs-mstm-2", 1);
    job["preset"] = "paper";
    job["options"]["A56"] = "constant";
    EXPECT_THAT(refusal_of([&] { answer(job); }),
                HasSubstr("goes up and down without a warm-up with the preset \"paper\"; leave "
                          "--rate-after-warm-up out"));
}

TEST(ZsMstmJobsRefuse, CheckpointsOfUnknownChoices) {
    const TemporaryFolder folder;
    answer(style_training(folder, "zs-mstm-1", 1));
    const Json whole = read_json(folder / "model.json");
    const Json job{{"verb", "describe"}, {"checkpoint", (folder / "model").string()}};
    const auto refusal = [&](const char* key, const Json& value) {
        Json other = whole;
        other[key] = value;
        write_json(folder / "model.json", other);
        return refusal_of([&] { answer(job); });
    };
    EXPECT_THAT(refusal("preset", "large"), HasSubstr("model: preset: is \"large\""));
    EXPECT_THAT(refusal("options", {{"A48", "odd"}}), HasSubstr("A48: is \"odd\""));
    EXPECT_THAT(refusal("options", {{"A99", "odd"}}), HasSubstr("A99"));
    Json older = whole;  // than any choice
    older["options"] = Json::object();
    write_json(folder / "model.json", older);
    EXPECT_EQ(answer(job).at("parameters"), 849'558);
}

// What the JSON beside them says is not what they are.
TEST(ZsMstmJobsRefuse, WeightsOfAnotherPreset) {
    const TemporaryFolder folder;
    answer(style_training(folder, "zs-mstm-1", 1));
    const Json job{{"verb", "describe"}, {"checkpoint", (folder / "model").string()}};
    EXPECT_EQ(answer(job).at("parameters"), 849'558);
    EXPECT_EQ(answer(job).at("parameters_without_ast"), 849'558 - 441'216);
    EXPECT_EQ(answer(job).at("discriminator_parameters"), 57'792);
    Json other = read_json(folder / "model.json");
    other["preset"] = "paper";
    write_json(folder / "model.json", other);
    EXPECT_THAT(refusal_of([&] { answer(job); }),
                AllOf(HasSubstr("model: tensor \"content_a"), HasSubstr("the model needs ["),
                      HasSubstr("give a file of the same model and options")));
}

}  // namespace
}  // namespace chironomia
