// The jobs of Models 1 and 2, on a small corpus of talks.
#include "synth/learned/faces/face_jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "synth/corpus/corpus.h"
#include "synth/learned/models.h"
#include "synth/predictions.h"
#include "tests/support/support.h"
#include "tests/synth/learned/face_support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using testing::refusal_of;
using testing::small_talk;
using testing::TemporaryFolder;

constexpr Split kSplits[] = {Split::train, Split::train, Split::validation, Split::test, Split::unseen};

// Five talks of 20 words, the last of them by another speaker.
CorpusIndex small_corpus(const fs::path& folder,
                         std::vector<Split> splits = {std::begin(kSplits), std::end(kSplits)}) {
    CorpusIndex index{.folder = folder};
    for (std::size_t i = 0; i < splits.size(); ++i) {
        IpuRecord talk = small_talk(20, i + 1);
        talk.source = "made";
        if (splits[i] == Split::unseen) talk.speaker = "s01";
        write_ipu(folder, talk);
        index.entries.push_back(
            {.id = talk.id, .speaker = talk.speaker, .split = splits[i], .seconds = talk.words.back().end});
    }
    write_corpus_index(index);
    return index;
}

Json ask(const Json& job) {
    return answer(job);
}

Json training(const TemporaryFolder& folder, const std::string& model, const std::string& name) {
    return {{"verb", "train"},
            {"model", model},
            {"preset", "small"},
            {"corpus", (folder / "corpus").string()},
            {"out", (folder / name).string()},
            {"seed", 3},
            {"threads", 1},
            {"quiet", true},
            {"steps", 3}};
}

Json predicting(const TemporaryFolder& folder, const std::string& name, const std::string& split) {
    return {{"verb", "predict"},
            {"checkpoint", (folder / name).string()},
            {"corpus", (folder / "corpus").string()},
            {"split", split},
            {"out", (folder / (name + "_" + split + ".h5")).string()},
            {"threads", 1},
            {"quiet", true}};
}

// Three words, a pause of 0.5 s, two words; 2.5 s in all.
void write_inputs(const fs::path& file, double second_start = 0.3, double f0 = 150) {
    Hdf5Writer writer(file, file.string());
    writer.write_texts("text_encoder", {"hashbert"});
    writer.write_texts("words", {"one", "two", "three", "four", "five"});
    const std::vector<double> times{0, 0.3, second_start, 0.7, 0.7, 1.0, 1.5, 1.9, 1.9, 2.2};
    writer.write_doubles("times", {5, 2}, times);
    writer.write_floats("vectors", {5, kWordVector}, std::vector<float>(5 * kWordVector, 0.1F));
    writer.write_floats("f0", {250}, std::vector<float>(250, static_cast<float>(f0)));
    writer.write_number("seconds", 2.5);
    writer.close();
}

Json animating(const TemporaryFolder& folder, const std::string& name) {
    return {{"verb", "animate"},
            {"checkpoint", (folder / name).string()},
            {"inputs", (folder / "inputs.h5").string()},
            {"out", (folder / (name + "_face.h5")).string()},
            {"threads", 1}};
}

std::vector<double> animated(const TemporaryFolder& folder, const std::string& name,
                             const std::string& array) {
    const auto bytes = read_bytes(folder / (name + "_face.h5"));
    return Hdf5File(bytes, name).read(array).numbers;
}

class FaceJobs : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(BothModels, FaceJobs, ::testing::Values("model1", "model2"));

TEST_P(FaceJobs, LearnFromTalksAndPredictTheFacesOfOthers) {
    const TemporaryFolder folder;
    const CorpusIndex corpus = small_corpus(folder / "corpus");
    const Json trained = ask(training(folder, GetParam(), "m"));
    EXPECT_EQ(trained.at("steps"), 3);
    EXPECT_LT(trained.at("validation_loss"), 1.2 * 9 * std::log(101.0));
    for (const char* split : {"test", "unseen"}) {
        const Json job = predicting(folder, "m", split);
        EXPECT_EQ(ask(job).at("items"), 1);
        const Predictions predictions = read_predictions(job.at("out").get<std::string>());
        EXPECT_EQ(predictions.model, GetParam());
        EXPECT_EQ(predictions.split, split);
        EXPECT_EQ(predictions.fps, 24);
        EXPECT_THAT(predictions.features,
                    ElementsAre("AU1", "AU2", "AU4", "AU5", "AU6", "AU7", "Rx", "Ry", "Rz"));
        EXPECT_THAT(predictions.scale[0], ElementsAre(0, 5));
        EXPECT_THAT(predictions.scale[8], ElementsAre(-1, 1));
        const PredictedItem& item = predictions.items.at(0);
        const IpuRecord record = read_ipu(corpus, corpus.of(*split_named(split)).at(0));
        EXPECT_EQ(item.id, record.id);
        EXPECT_EQ(item.speaker, record.speaker);
        EXPECT_EQ(item.truth, normalised_face(record));
        ASSERT_EQ(item.prediction.size(), item.truth.size());
        for (const float value : item.prediction) EXPECT_NEAR(value * 100, std::round(value * 100), 1e-4);
    }
}

TEST_P(FaceJobs, SayTheSameAgain) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    ask(training(folder, GetParam(), "once"));
    ask(training(folder, GetParam(), "again"));
    EXPECT_EQ(read_text(folder / "once.safetensors"), read_text(folder / "again.safetensors"));
    Json other = training(folder, GetParam(), "other");
    other["seed"] = 4;
    ask(other);
    EXPECT_NE(read_text(folder / "once.safetensors"), read_text(folder / "other.safetensors"));
}

TEST_P(FaceJobs, AnimateSpeechWithoutAStep) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    ask(training(folder, GetParam(), "m"));
    write_inputs(folder / "inputs.h5");
    const Json done = ask(animating(folder, "m"));
    EXPECT_EQ(done.at("frames"), 60);
    EXPECT_EQ(done.at("fps"), 24);
    const std::vector<double> units = animated(folder, "m", "units"), head = animated(folder, "m", "head");
    ASSERT_EQ(units.size(), 60u * 6);
    ASSERT_EQ(head.size(), 60u * 3);
    EXPECT_THAT(units, ::testing::Each(::testing::AllOf(Ge(0), Le(5))));
    EXPECT_THAT(head, ::testing::Each(::testing::AllOf(Ge(-1), Le(1))));
    const auto largest_step = [](const std::vector<double>& values) {
        double most = 0;
        for (std::size_t i = 6; i < values.size(); ++i)
            most = std::max(most, std::abs(values[i] - values[i - 6]));
        return most;
    };
    Json rough = animating(folder, "m");
    rough["options"] = {{"smooth", 0}, {"A39", "argmax"}};
    ask(rough);
    EXPECT_LT(largest_step(units), largest_step(animated(folder, "m", "units")));
}

TEST_P(FaceJobs, DescribeAModel) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    ask(training(folder, GetParam(), "m"));
    const Json asked = ask({{"verb", "describe"}, {"model", GetParam()}, {"preset", "small"}});
    const Json kept = ask({{"verb", "describe"}, {"checkpoint", (folder / "m").string()}});
    EXPECT_EQ(asked.at("parameters"), kept.at("parameters"));
    EXPECT_EQ(kept.at("text_encoder"), "hashbert");
    EXPECT_EQ(kept.at("steps"), 3);
    const Json paper = ask({{"verb", "describe"}, {"model", GetParam()}, {"preset", "paper"}});
    EXPECT_EQ(paper.at("parameters"), GetParam() == std::string("model1") ? 7'249'309 : 3'810'397);
}

TEST(FaceJobs, ReportHowWellAutoencodersRestore) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    const Json trained = ask(training(folder, "model1", "m"));
    for (const char* part : {"speech", "face"}) {
        EXPECT_THAT(trained.at("autoencoders").at(part).at("accuracy").get<double>(),
                    ::testing::AllOf(Ge(0), Le(1)));
        EXPECT_TRUE(fs::exists(folder / ("m-" + std::string(part) + ".safetensors")));
    }
}

TEST(FaceJobs, LearnNineAutoencodersOfFacesIfAsked) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    Json job = training(folder, "model1", "m");
    job["options"] = {{"A35", "nine"}};
    const Json parts = ask(job).at("autoencoders");
    EXPECT_EQ(parts.size(), 10u);
    for (const std::string_view channel : kFaceChannelNames) {
        const std::string part = "face-" + std::string(channel);
        EXPECT_TRUE(parts.contains(part));
        EXPECT_TRUE(fs::exists(folder / ("m-" + part + ".safetensors")));
    }
    const auto numbers = [](const Json& options) -> std::int64_t {
        const Json asked{
            {"verb", "describe"}, {"model", "model1"}, {"preset", "small"}, {"options", options}};
        return ask(asked).at("parameters");
    };
    // Each decoder of the small model: LSTMs of 64 to 32 and of 32 to 64.
    const std::int64_t decoder = 4 * 32 * (64 + 32 + 2) + 4 * 64 * (32 + 64 + 2);
    EXPECT_EQ(numbers({{"A35", "nine"}}), numbers({{"A35", "one"}}) + 8 * decoder);
}

// A45: what is predicted and animated has the same frames, whatever the sequence is of.
TEST(FaceJobs, LearnFromFramesIfAsked) {
    const TemporaryFolder folder;
    const CorpusIndex corpus = small_corpus(folder / "corpus");
    Json job = training(folder, "model2", "m");
    job["options"] = {{"A45", "frames"}};
    ask(job);
    const Json predicted = predicting(folder, "m", "test");
    ask(predicted);
    const Predictions predictions = read_predictions(predicted.at("out").get<std::string>());
    const PredictedItem& item = predictions.items.at(0);
    EXPECT_EQ(item.truth, normalised_face(read_ipu(corpus, corpus.of(Split::test).at(0))));
    EXPECT_EQ(item.prediction.size(), item.truth.size());
    write_inputs(folder / "inputs.h5");
    EXPECT_EQ(ask(animating(folder, "m")).at("frames"), 60);
    EXPECT_EQ(animated(folder, "m", "units").size(), 60u * 6);
}

// Of two voices that stay on one tone, a model that has learned to do without a voice's level says the same.
TEST(FaceJobs, AnimateVoicesOfAnyLevelAlikeIfTheyAreNotPlaced) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    for (const char* share : {"0", "0.5"}) {
        Json job = training(folder, "model2", "m" + std::string(share));
        job["options"] = {{"unplaced", share}};
        ask(job);
        const auto face_of_tone = [&](double f0) {
            write_inputs(folder / "inputs.h5", 0.3, f0);
            ask(animating(folder, "m" + std::string(share)));
            return animated(folder, "m" + std::string(share), "head");
        };
        EXPECT_EQ(face_of_tone(100) == face_of_tone(250), share == std::string("0.5"));
    }
}

TEST(FaceJobs, NameTheAblationInWhatTheyPredict) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    Json job = training(folder, "model2", "m");
    job["options"] = {{"ablation", "text"}, {"A41", "equation"}, {"A38", "units"}};
    ask(job);
    const Json predicted = predicting(folder, "m", "test");
    ask(predicted);
    EXPECT_EQ(read_predictions(predicted.at("out").get<std::string>()).model, "model2-text");
}

TEST_P(FaceJobs, TheBundledOneIsTheSmallOneAsItIsBuiltToday) {
    const fs::path bundled = testing::source_dir() / "assets/models" / GetParam();
    const Json kept = ask({{"verb", "describe"}, {"checkpoint", bundled.string()}});
    const Json fresh = ask({{"verb", "describe"}, {"model", GetParam()}, {"preset", "small"}});
    for (const char* key : {"model", "preset", "options", "parameters"})
        EXPECT_EQ(kept.at(key), fresh.at(key));
}

TEST(FaceJobs, ACheckpointIsWithoutTheOptionsThatItDoesNotName) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus");
    Json job = training(folder, "model2", "m");
    job["options"] = {{"A40", "tokens"}, {"attention", "everywhere"}};
    ask(job);
    Json kept = Json::parse(read_text(folder / "m.json"));
    kept["options"].erase("attention");
    write_text(folder / "m.json", kept.dump());
    const auto described = [&] {
        return ask({{"verb", "describe"}, {"checkpoint", (folder / "m").string()}}).at("options");
    };
    EXPECT_EQ(described().at("attention"), "everywhere");
    kept["options"]["attention"] = "far";
    write_text(folder / "m.json", kept.dump());
    EXPECT_THAT(refusal_of(described), HasSubstr("attention: is \"far\""));
}

TEST(FaceJobs, RefuseWhatTheyCannotLearnFrom) {
    const TemporaryFolder folder;
    small_corpus(folder / "corpus", {Split::train, Split::test});
    EXPECT_THAT(refusal_of([&] { ask(training(folder, "model2", "m")); }),
                HasSubstr("no talks of the split \"validation\""));
    CorpusIndex dyads = read_corpus_index(folder / "corpus");
    dyads.kind = CorpusKind::dyads;
    dyads.folder = folder / "dyads";
    fs::create_directories(dyads.folder);
    for (CorpusEntry& entry : dyads.entries) entry.speaker = entry.id + "+other" + entry.id;
    write_corpus_index(dyads);
    Json job = training(folder, "model2", "m");
    job["corpus"] = (folder / "dyads").string();
    EXPECT_THAT(refusal_of([&] { ask(job); }), HasSubstr("a corpus of dyads, this model learns from talks"));
    job["options"] = {{"A40", "token"}};
    EXPECT_THAT(refusal_of([&] { ask(job); }), HasSubstr("A40: is \"token\""));
    job["options"] = {{"A45", "letters"}};
    EXPECT_THAT(refusal_of([&] { ask(job); }), HasSubstr("A45: is \"letters\""));
    job["options"] = {{"A4", "tokens"}};
    EXPECT_THAT(refusal_of([&] { ask(job); }), HasSubstr("A40"));
    job["options"] = Json::object();
    job["preset"] = "tiny";
    EXPECT_THAT(refusal_of([&] { ask(job); }), HasSubstr("small"));
    job = training(folder, "model1", "m");
    job["options"] = {{"A35", "ten"}};
    EXPECT_THAT(refusal_of([&] { ask(job); }), HasSubstr("A35: is \"ten\""));
}

TEST(FaceJobs, RefuseWhatTheyCannotPredictOrAnimate) {
    const TemporaryFolder folder;
    CorpusIndex corpus = small_corpus(folder / "corpus", {Split::train, Split::validation});
    ask(training(folder, "model2", "m"));
    EXPECT_THAT(refusal_of([&] { ask(predicting(folder, "m", "unseen")); }),
                HasSubstr("no talks of the split \"unseen\""));
    Json with_horizon = predicting(folder, "m", "train");
    with_horizon["options"] = {{"horizon", 0.5}};  // which is of dyads
    EXPECT_THAT(refusal_of([&] { ask(with_horizon); }), HasSubstr("horizon: there is no such key"));
    corpus.text_encoder = "bert-base-uncased";
    write_corpus_index(corpus);
    EXPECT_THAT(refusal_of([&] { ask(predicting(folder, "m", "train")); }),
                HasSubstr("vectors of \"bert-base-uncased\", the model has learned those of \"hashbert\""));
    write_inputs(folder / "inputs.h5", 0.2);
    EXPECT_THAT(refusal_of([&] { ask(animating(folder, "m")); }),
                HasSubstr("word 2 (\"two\") is from 0.2 to 0.7 s, the one before it ends at 0.3 s"));
    write_inputs(folder / "inputs.h5", 0.3, 0);
    EXPECT_THAT(refusal_of([&] { ask(animating(folder, "m")); }), HasSubstr("no word is voiced"));
}

}  // namespace
}  // namespace chironomia
