// The jobs of ZS-MSTM, on a corpus that the program made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "synth/corpus/make/make_corpus.h"
#include "synth/learned/models.h"
#include "synth/learned/styles/style_points.h"
#include "synth/predictions.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

// Two speakers to learn from and one more.
const fs::path& corpus() {
    static const TemporaryFolder folder;
    static const CorpusIndex made = make_corpus({.kind = CorpusKind::intervals,
                                                 .size = CorpusSize::ci,
                                                 .folder = folder / "corpus",
                                                 .speakers = speaker_choice_of("2+1"),
                                                 .quiet = true});
    return made.folder;
}

Json training(const TemporaryFolder& folder, const std::string& model, int steps) {
    return {{"verb", "train"},
            {"model", model},
            {"preset", "small"},
            {"corpus", corpus().string()},
            {"out", (folder / "model").string()},
            {"seed", 3},
            {"threads", 1},
            {"quiet", true},
            {"steps", steps}};
}

// The weights and how they learned.
std::string bytes_of(const fs::path& stem) {
    return read_text(fs::path(stem) += ".safetensors");
}

class ZsMstmJobs : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Styles, ZsMstmJobs, ::testing::Values("zs-mstm-1", "zs-mstm-2"),
                         [](const auto& test) {
                             return std::string(test.param).substr(8) == "1" ? "One" : "Two";
                         });

TEST_P(ZsMstmJobs, GoesOnToTheSameBytes) {
    const TemporaryFolder whole, halves;
    const Json trained = answer(training(whole, GetParam(), 4));
    EXPECT_EQ(trained.at("steps"), 4);
    answer(training(halves, GetParam(), 2));
    answer(training(halves, GetParam(), 4));
    EXPECT_EQ(bytes_of(whole / "model"), bytes_of(halves / "model"));
}

TEST_P(ZsMstmJobs, ShowsIntervalsInTheStylesOfAllSpeakers) {
    const TemporaryFolder folder;
    answer(training(folder, GetParam(), 1));
    const Json said = answer({{"verb", "predict"},
                              {"checkpoint", (folder / "model").string()},
                              {"corpus", corpus().string()},
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

// Speech of 100 frames: nobody says anything.
void write_inputs(const fs::path& file, const std::string& encoder = "hashbert") {
    Hdf5Writer writer(file, file.string());
    writer.write_texts("text_encoder", {encoder});
    writer.write_floats("text", {100, kStyleText}, std::vector<float>(100 * kStyleText));
    writer.write_floats("mel", {580, kStyleMel}, std::vector<float>(580 * kStyleMel, -10));
    writer.write_number("mel_rate", 86.13);
    writer.close();
}

TEST_P(ZsMstmJobs, MovesInTheStyleOfASpeakerOrOfAnInterval) {
    const TemporaryFolder folder;
    answer(training(folder, GetParam(), 1));
    write_inputs(folder / "inputs.h5");
    const CorpusIndex index = read_corpus_index(corpus());
    const CorpusEntry unseen = index.of(Split::unseen).front();
    const fs::path interval = corpus() / "data" / "processed" / unseen.speaker / (unseen.id + ".h5");
    for (const Json& style : {Json{{"file", interval.string()}},
                              Json{{"corpus", corpus().string()}, {"speaker", unseen.speaker}}}) {
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
    answer(training(folder, "zs-mstm-1", 1));
    Json job{{"verb", "animate"},
             {"checkpoint", (folder / "model").string()},
             {"inputs", (folder / "inputs.h5").string()},
             {"out", (folder / "m.h5").string()},
             {"style", {{"corpus", corpus().string()}, {"speaker", "nobody"}}}};
    write_inputs(folder / "inputs.h5", "bert-base-uncased");
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("the model has learned those of \"hashbert\""));
    write_inputs(folder / "inputs.h5");
    EXPECT_THAT(refusal_of([&] { answer(job); }),
                HasSubstr("nobody is called \"nobody\" there; give one of"));
}

TEST(ZsMstmJobsRefuse, WeightsForTheSmallTransformer) {
    const TemporaryFolder folder;
    Json job = training(folder, "zs-mstm-1", 1);
    job["ast"] = folder.path().string();
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("too narrow for those weights"));
    job["preset"] = "paper";
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("model.safetensors"));
}

TEST(ZsMstmJobs, DescribesPresets) {
    const Json described = answer(
        {{"verb", "describe"}, {"model", "zs-mstm-2"}, {"preset", "paper"}, {"options", Json::object()}});
    EXPECT_EQ(described.at("parameters"), 7'793'076);
    EXPECT_EQ(described.at("discriminator_parameters"), 535'526);
}

}  // namespace
}  // namespace chironomia
