// The classifier of styles, and its jobs on a corpus that the program made.
#include "synth/learned/styles/style_classifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/files/json.h"
#include "synth/learned/models.h"
#include "synth/predictions.h"
#include "tests/synth/learned/overfit.h"
#include "tests/synth/learned/styles/reference.h"
#include "tests/synth/learned/styles/style_corpus.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using namespace testing;
using ::testing::HasSubstr;
using torch::Tensor;

TEST(StyleClassifier, ComputesWhatTheReferenceDoes) {
    const Json expected = reference().at("classifier");
    StyleClassifier model(StyleClassifierSize{.inputs = 22, .memory = 8});
    fill(*model);
    const Tensor logits = model->forward(formula("pose", {2, 64, 22}));
    expect_all_near(logits, expected.at("logits"), "logits");
    expect_all_near(speaker_shares(logits).select(1, 1), expected.at("probability"), "probability");
    EXPECT_TRUE(torch::allclose(speaker_shares(logits).sum(1), torch::ones({2}, torch::kFloat64)));
    const Tensor loss = classifier_loss(logits, torch::arange(2));
    expect_near(loss.item<double>(), expected.at("loss"), "loss");
    loss.backward();
    expect_gradients(*model, expected.at("gradients"), false);
}

TEST(StyleClassifier, LearnsOneBatchByHeart) {
    torch::manual_seed(1);
    StyleClassifier model(StyleClassifierSize{.inputs = 4, .memory = 16, .outputs = 3});
    const Tensor motion = torch::randn({6, 20, 4}), speakers = torch::arange(6) % 3;
    const double left = loss_left(*model, {.steps = 150, .rate = 1e-2}, [&] {
        model->eval();  // dropout would hide what it remembers
        return classifier_loss(model->forward(motion), speakers);
    });
    EXPECT_LT(left, 0.05);
}

Json classifier_training(const TemporaryFolder& folder, const Json& options = Json::object()) {
    Json job = style_training(folder, "style-classifier", 1);
    job.erase("steps");
    job["options"] = options;
    return job;
}

std::vector<std::string> learned_speakers() {
    std::set<std::string> names;
    for (const CorpusEntry& entry : read_corpus_index(style_corpus()).of(Split::train))
        names.insert(entry.speaker);
    return {names.begin(), names.end()};
}

std::string unseen_speaker() {
    return read_corpus_index(style_corpus()).of(Split::unseen).front().speaker;
}

Json pair_of(const std::string& source, const std::string& target) {
    return {{"source", source}, {"target", target}};
}

// A classifier of both speakers, as good as it must be.
const fs::path& trained() {
    static const TemporaryFolder folder;
    static const Json answered = answer(classifier_training(folder));
    static const fs::path stem = folder / "model";
    EXPECT_TRUE(answered.at("stopped_early"));
    EXPECT_LE(answered.at("validation_loss"), 0.04);
    return stem;
}

Json judging(const fs::path& checkpoint, const fs::path& predictions) {
    return {{"verb", "predict"}, {"checkpoint", checkpoint.string()}, {"predictions", predictions.string()}};
}

// Clips that Mix-StAGE has just begun to learn.
const Predictions& predictions_of_a_model() {
    static const Predictions predictions = [] {
        const TemporaryFolder folder;
        answer(style_training(folder, "mix-stage", 1));
        answer({{"verb", "predict"},
                {"checkpoint", (folder / "model").string()},
                {"corpus", style_corpus().string()},
                {"split", "test"},
                {"out", (folder / "p.h5").string()},
                {"quiet", true}});
        return read_predictions(folder / "p.h5");
    }();
    return predictions;
}

// As if a model had moved like the one speaker or the other whatever it was asked for.
Predictions moving_like(bool target) {
    Predictions predictions = predictions_of_a_model();
    for (PredictedItem& item : predictions.items) {
        const std::string& wanted = target ? item.style : item.speaker;
        for (const PredictedItem& other : predictions.items)
            if (other.speaker == wanted) item.prediction = other.truth;
        item.truth.resize(item.prediction.size());
    }
    return predictions;
}

// In clips that it has not learned from.
TEST(StyleClassifierJobs, KnowsTheSpeakersOfItsTraining) {
    const Json judged = answer({{"verb", "predict"},
                                {"checkpoint", trained().string()},
                                {"corpus", style_corpus().string()},
                                {"split", "test"}});
    EXPECT_EQ(judged.at("clips"), read_corpus_index(style_corpus()).of(Split::test).size());
    EXPECT_EQ(judged.at("speakers"), Json(learned_speakers()));
    EXPECT_EQ(judged.at("accuracy"), 100);
    const Json& confusion = judged.at("confusion");
    EXPECT_EQ(judged.at("right"), confusion[0][0].get<int>() + confusion[1][1].get<int>());
}

TEST(StyleClassifierJobs, CountsTransfersByWhomTheyLookLike) {
    const TemporaryFolder folder;
    write_predictions(folder / "target.h5", moving_like(true));
    Json job = judging(trained(), folder / "target.h5");
    job["out"] = (folder / "tsa.json").string();
    const Json like_target = answer(job);
    EXPECT_EQ(read_json(folder / "tsa.json"), like_target);
    EXPECT_EQ(like_target.at("tsa"), 100);
    EXPECT_EQ(like_target.at("as_style"), like_target.at("clips"));
    EXPECT_EQ(like_target.at("as_source"), 0);
    write_predictions(folder / "source.h5", moving_like(false));
    const Json like_source = answer(judging(trained(), folder / "source.h5"));
    EXPECT_EQ(like_source.at("tsa"), 0);
    EXPECT_EQ(like_source.at("as_source"), like_source.at("clips"));
    std::size_t transfers = 0;
    for (const PredictedItem& item : predictions_of_a_model().items)
        transfers += item.speaker != item.style ? 1 : 0;
    EXPECT_EQ(like_target.at("clips"), transfers);
}

// The same places on another scale.
TEST(StyleClassifierJobs, JudgesPlacesWhateverTheirScale) {
    const TemporaryFolder folder;
    Predictions halved = predictions_of_a_model();
    for (auto& [low, high] : halved.scale) high = low + 2 * (high - low);
    for (PredictedItem& item : halved.items)
        for (float& value : item.prediction) value /= 2;
    write_predictions(folder / "a.h5", predictions_of_a_model());
    write_predictions(folder / "b.h5", halved);
    EXPECT_EQ(answer(judging(trained(), folder / "a.h5")), answer(judging(trained(), folder / "b.h5")));
}

TEST(StyleClassifierJobs, GoesOnToTheSameBytes) {
    const TemporaryFolder whole, halves;
    Json job = classifier_training(whole, {{"face", "with"}});
    job["steps"] = 4;
    answer(job);
    job["out"] = (halves / "model").string();
    job["steps"] = 2;
    answer(job);
    job["steps"] = 4;
    answer(job);
    EXPECT_EQ(bytes_of(whole / "model"), bytes_of(halves / "model"));
}

TEST(StyleClassifierJobs, SeparatesASpeakerFromOneWhomNoModelHasSeen) {
    const TemporaryFolder folder;
    Json job = classifier_training(folder, pair_of(learned_speakers()[0], unseen_speaker()));
    job["steps"] = 1;
    answer(job);
    const Json judged = answer({{"verb", "predict"},
                                {"checkpoint", (folder / "model").string()},
                                {"corpus", style_corpus().string()},
                                {"split", "unseen"}});
    const std::size_t all = read_corpus_index(style_corpus()).of(Split::unseen).size();
    EXPECT_GE(judged.at("clips"), 1);
    EXPECT_LE(judged.at("clips"), all / 5 + 1);  // the others taught it
    write_predictions(folder / "p.h5", predictions_of_a_model());
    EXPECT_THAT(refusal_of([&] { answer(judging(folder / "model", folder / "p.h5")); }),
                HasSubstr("no clips of " + learned_speakers()[0] + " in the style of " + unseen_speaker()));
}

TEST(StyleClassifierJobs, CountsThoseOfItsPairAlone) {
    const TemporaryFolder folder;
    Json job = classifier_training(folder, pair_of(learned_speakers()[0], learned_speakers()[1]));
    job["steps"] = 1;
    answer(job);
    write_predictions(folder / "p.h5", predictions_of_a_model());
    std::size_t clips = 0;
    for (const PredictedItem& item : predictions_of_a_model().items)
        clips += item.speaker == learned_speakers()[0] && item.style == learned_speakers()[1] ? 1 : 0;
    const Json judged = answer(judging(folder / "model", folder / "p.h5"));
    EXPECT_EQ(judged.at("clips"), clips);
    EXPECT_EQ(judged.at("as_style").get<std::size_t>() + judged.at("as_source").get<std::size_t>(), clips);
}

TEST(StyleClassifierJobs, DescribesOneOfAllSpeakers) {
    const Json described = answer({{"verb", "describe"}, {"model", "style-classifier"}, {"preset", "small"}});
    EXPECT_EQ(described.at("parameters"), 89'153 + 15 * 65);  // 16 outputs
}

std::string refused_options(const Json& options) {
    const TemporaryFolder folder;
    return refusal_of([&] { answer(classifier_training(folder, options)); });
}

TEST(StyleClassifierJobsRefuse, PairsThatAreNone) {
    EXPECT_THAT(refused_options({{"source", "a"}}), HasSubstr("have a source without a target"));
    EXPECT_THAT(refused_options({{"target", "a"}}), HasSubstr("have a target without a source"));
    EXPECT_THAT(refused_options(pair_of("a", "a")), HasSubstr("is \"a\" like the source; give two speakers"));
    Json both = pair_of("a", "b");
    both["speakers"] = "unseen";
    EXPECT_THAT(refused_options(both), HasSubstr("give either"));
    EXPECT_THAT(refused_options(pair_of(learned_speakers()[0], "nobody")),
                HasSubstr("no intervals of \"nobody\" for train, the corpus has " + learned_speakers()[0]));
    EXPECT_THAT(refused_options({{"speakers", "unseen"}}), HasSubstr("1 speakers of the split \"unseen\""));
}

TEST(StyleClassifierJobsRefuse, PredictionsThatItCannotJudge) {
    const TemporaryFolder folder;
    const auto refused = [&](const Predictions& predictions) {
        write_predictions(folder / "p.h5", predictions);
        return refusal_of([&] { answer(judging(trained(), folder / "p.h5")); });
    };
    Predictions without_styles = predictions_of_a_model();
    for (PredictedItem& item : without_styles.items) item.style.clear();
    EXPECT_THAT(refused(without_styles), HasSubstr("its items have no styles"));
    Predictions fast = predictions_of_a_model();
    fast.fps = 25;
    EXPECT_THAT(refused(fast), HasSubstr("has 25 frames a second, the classifier has learned from 15"));
    Predictions strange = predictions_of_a_model();
    for (PredictedItem& item : strange.items) item.style = "nobody";
    EXPECT_THAT(refused(strange), HasSubstr("is in the style of \"nobody\", the classifier knows "));
    Predictions renamed = predictions_of_a_model();
    renamed.features[0] = "elsewhere";
    EXPECT_THAT(refused(renamed), HasSubstr("has no \"RShoulder x\", which the classifier sees"));
    Predictions own = predictions_of_a_model();
    for (PredictedItem& item : own.items) item.style = item.speaker;
    EXPECT_THAT(refused(own), HasSubstr("no clips of one speaker in the style of another"));
}

TEST(StyleClassifierJobsRefuse, SplitsOfStrangersAndAnimation) {
    EXPECT_THAT(refusal_of([] {
                    answer({{"verb", "predict"},
                            {"checkpoint", trained().string()},
                            {"corpus", style_corpus().string()},
                            {"split", "unseen"}});
                }),
                HasSubstr("no intervals of the split \"unseen\" of " + learned_speakers()[0]));
    EXPECT_THAT(refusal_of([] {
                    answer({{"verb", "animate"}, {"checkpoint", trained().string()}});
                }),
                HasSubstr("judges motion and makes none"));
}

}  // namespace
}  // namespace chironomia
