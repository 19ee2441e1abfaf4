// The jobs of Mix-StAGE, on a corpus that the program made.
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
using ::testing::HasSubstr;

const Silence kSound{.bands = 64, .rows = 400, .rate = 100};

// A model that has learned for one step.
const fs::path& trained_once() {
    static const TemporaryFolder folder;
    static const Json trained = answer(style_training(folder, "mix-stage", 1));
    static const fs::path stem = folder / "model";
    return stem;
}

Json prediction(const TemporaryFolder& folder, const std::string& split) {
    return {{"verb", "predict"}, {"checkpoint", trained_once().string()}, {"corpus", style_corpus().string()},
            {"split", split},    {"out", (folder / "p.h5").string()},     {"options", {{"pairs", 1}}},
            {"quiet", true}};
}

Json animation(const TemporaryFolder& folder, const Json& style) {
    return {{"verb", "animate"},
            {"checkpoint", trained_once().string()},
            {"inputs", (folder / "inputs.h5").string()},
            {"out", (folder / "m.h5").string()},
            {"style", style}};
}

std::string learned_speaker() {
    return read_corpus_index(style_corpus()).of(Split::train).front().speaker;
}

std::string unseen_speaker() {
    return read_corpus_index(style_corpus()).of(Split::unseen).front().speaker;
}

TEST(MixStageJobs, GoesOnToTheSameBytes) {
    const TemporaryFolder whole, halves;
    EXPECT_EQ(answer(style_training(whole, "mix-stage", 6)).at("steps"), 6);
    answer(style_training(halves, "mix-stage", 3));
    answer(style_training(halves, "mix-stage", 6));
    EXPECT_EQ(bytes_of(whole / "model"), bytes_of(halves / "model"));
}

TEST(MixStageJobs, ShowsIntervalsInTheStylesOfItsSpeakers) {
    const TemporaryFolder folder;
    const Json said = answer(prediction(folder, "test"));
    const Predictions predictions = read_predictions(folder / "p.h5");
    EXPECT_EQ(said.at("items"), predictions.items.size());
    std::size_t transfers = 0;
    for (const PredictedItem& item : predictions.items) {
        EXPECT_THAT(item.id, HasSubstr(">" + item.style));
        transfers += item.style != item.speaker ? 1 : 0;
    }
    EXPECT_EQ(transfers, 2u);  // each of two speakers as the other
    EXPECT_EQ(predictions.features.size(), 22u);
}

// Its units are those of ZS-MSTM, so that one table holds both.
TEST(MixStageJobs, PredictsOnTheScaleOfTheOtherModels) {
    const TemporaryFolder folder;
    answer(prediction(folder, "test"));
    answer(style_training(folder, "zs-mstm-1", 1));
    Json job = prediction(folder, "test");
    job["checkpoint"] = (folder / "model").string();
    job["out"] = (folder / "zs.h5").string();
    answer(job);
    const Predictions ours = read_predictions(folder / "p.h5"), theirs = read_predictions(folder / "zs.h5");
    EXPECT_EQ(ours.features, theirs.features);
    EXPECT_EQ(ours.scale, theirs.scale);
    EXPECT_EQ(ours.items.front().truth, theirs.items.front().truth);
}

TEST(MixStageJobs, MovesInTheStyleOfASpeakerByName) {
    const TemporaryFolder folder;
    write_inputs(folder / "inputs.h5", kSound);
    answer(animation(folder, {{"speaker", learned_speaker()}}));
    const auto bytes = read_bytes(folder / "m.h5");
    const Hdf5File motion(bytes, "m.h5");
    EXPECT_EQ(motion.shape_of("pose/normalize"), (std::vector<std::size_t>{100, 22}));
    EXPECT_FALSE(motion.has("face/normalize"));
}

TEST(MixStageJobs, MovesAsLongAsASoundWithoutWords) {
    const TemporaryFolder folder;
    Silence sound = kSound;
    sound.words = false;
    write_inputs(folder / "inputs.h5", sound);
    const Json moved = answer(animation(folder, {{"speaker", learned_speaker()}}));
    EXPECT_EQ(moved.at("frames"), 60);  // of 4 s
}

TEST(MixStageJobsRefuse, SpeakersWhomItHasNotLearnedFrom) {
    const TemporaryFolder folder;
    write_inputs(folder / "inputs.h5", kSound);
    EXPECT_THAT(refusal_of([&] {
                    answer(animation(folder, {{"speaker", unseen_speaker()}}));
                }),
                HasSubstr("has not learned from \"" + unseen_speaker() + "\" and knows the styles of "));
    EXPECT_THAT(
        refusal_of([&] {
            answer(animation(folder, {{"file", "interval.h5"}}));
        }),
        HasSubstr("mix-stage knows styles by the names of its speakers alone; give {\"speaker\": NAME}"));
    EXPECT_THAT(refusal_of([&] { answer(prediction(folder, "unseen")); }),
                HasSubstr("are new to every model, and mix-stage knows the styles of " + learned_speaker()));
}

// Of a corpus that has another speaker in the same split.
TEST(MixStageJobsRefuse, ACorpusOfStrangers) {
    const TemporaryFolder folder;
    write_moved_corpus(folder / "corpus", {.from = Split::unseen});
    Json job = prediction(folder, "test");
    job["corpus"] = (folder / "corpus").string();
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("mix-stage has not learned from \""));
}

TEST(MixStageJobsRefuse, ToValidateByWhatItCannotLearn) {
    const TemporaryFolder folder;
    Json job = style_training(folder, "mix-stage", 1);
    write_moved_corpus(folder / "untaught", {.from = Split::train, .speaker = learned_speaker()});
    job["corpus"] = (folder / "untaught").string();
    EXPECT_THAT(
        refusal_of([&] { answer(job); }),
        HasSubstr("\"" + learned_speaker() + "\" is in the split \"validation\" but not in \"train\""));
    write_moved_corpus(folder / "unvalidated", {.from = Split::validation});
    job["corpus"] = (folder / "unvalidated").string();
    EXPECT_THAT(refusal_of([&] { answer(job); }), HasSubstr("no intervals of the split \"validation\""));
}

TEST(MixStageJobsRefuse, ASoundThatIsNone) {
    const TemporaryFolder folder;
    write_inputs(folder / "inputs.h5", {.bands = 64, .rows = 400, .rate = 0});
    EXPECT_THAT(refusal_of([&] {
                    answer(animation(folder, {{"speaker", learned_speaker()}}));
                }),
                HasSubstr("400 rows of /mel at 0 a second and 100 of /text"));
}

TEST(MixStageJobs, DescribesItself) {
    const Json preset = answer(
        {{"verb", "describe"}, {"model", "mix-stage"}, {"preset", "paper"}, {"options", Json::object()}});
    EXPECT_EQ(preset.at("styles"), 16);
    const Json described = answer({{"verb", "describe"}, {"checkpoint", trained_once().string()}});
    EXPECT_EQ(described.at("styles"), 2);
    EXPECT_EQ(described.at("options").at("speakers").at(0), learned_speaker());
    EXPECT_EQ(described.at("text_encoder"), "");
}

}  // namespace
}  // namespace chironomia
