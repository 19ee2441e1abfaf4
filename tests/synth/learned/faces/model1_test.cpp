#include "synth/learned/faces/model1.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/nn/functional/loss.h>
#include <torch/utils.h>

#include "tests/synth/learned/face_blocks.h"
#include "tests/synth/learned/face_support.h"
#include "tests/synth/learned/overfit.h"
#include "tests/synth/learned/parameters.h"

namespace chironomia {
namespace {

using testing::batch_of;
using testing::distance;
using ::testing::ElementsAre;
using testing::FaceBlock;
using testing::frames_of;
using testing::parameters_of;
using testing::small_talk;
using testing::small_units;
using torch::Tensor;

const Model1Options kSmall{.hidden = 32, .shared_trunk = true};

Model1 model_of(const Model1Options& options, std::uint64_t seed = 1) {
    torch::manual_seed(seed);
    Model1 model(options);
    model->eval();
    return model;
}

std::vector<int64_t> numbers_of(const Tensor& tensor) {
    return {tensor.data_ptr<int64_t>(), tensor.data_ptr<int64_t>() + tensor.size(0)};
}

TEST(PackSeries, PutsTheLongestFirstAndGoesStepByStep) {
    const Packed packed = pack_series(std::vector<int64_t>{1, 0, 3, 2});  // elements 0 | | 1 2 3 | 4 5
    EXPECT_THAT(numbers_of(packed.series), ElementsAre(2, 3, 0));
    EXPECT_THAT(numbers_of(packed.counts), ElementsAre(3, 2, 1));
    EXPECT_THAT(numbers_of(packed.order), ElementsAre(1, 4, 0, 2, 5, 3));
    EXPECT_THAT(numbers_of(packed.back), ElementsAre(2, 0, 3, 5, 1, 4));
}

TEST(Model1Layers, BidirectionalLstmsAreThoseOfPyTorchOnEachSeriesAlone) {
    const torch::NoGradGuard no_gradients;
    const FaceBlock block("recurrent");
    RecurrentEncoder encoder(RecurrentEncoderImpl::Size{.in = 3, .hidden = 4, .slope = 0.05});
    block.give_weights(*encoder);
    const Packed packed = pack_series(block.counts());
    EXPECT_LT(distance(encoder->forward(block.at("x"), packed), block.at("y")), 1e-5);
    EXPECT_LT(distance(encoder->last(block.at("x"), packed), block.at("last")), 1e-5);
}

TEST(Model1, HasAsManyParametersAsTheThesis) {
    EXPECT_EQ(parameters_of(*ContourAutoencoder(Model1Options())), 1'089'001);
    EXPECT_EQ(parameters_of(*Model1(Model1Options())), 7'249'309);
}

TEST(Model1, AnswersForEveryFrameAndLevel) {
    const torch::NoGradGuard no_gradients;
    for (const bool per_direction : {true, false}) {
        for (const bool shared_trunk : {true, false}) {
            Model1 model =
                model_of({.hidden = 8, .per_direction = per_direction, .shared_trunk = shared_trunk});
            const FaceBatch batch = batch_of(small_units(2, 4));
            const FaceLogits logits = model->forward(batch);
            ASSERT_EQ(logits.size(), kFaceChannels);
            for (const Tensor& channel : logits) {
                EXPECT_EQ(channel.sizes(), (std::vector<int64_t>{batch.contours.size(1), 101}));
            }
        }
    }
}

TEST(Model1, CompanyInABatchChangesNothing) {
    const torch::NoGradGuard no_gradients;
    const std::vector<FaceUnit> units = small_units(2, 5);
    Model1 model = model_of(kSmall);
    const FaceBatch alone = batch_of({units[0]});
    const FaceLogits both = model->forward(batch_of(units));
    EXPECT_LT(distance(model->forward(alone), frames_of(both, 0, alone.contours.size(1))), 1e-5);
}

TEST(Model1, WordsWithoutFramesOrPitchAreBridged) {
    const torch::NoGradGuard no_gradients;
    std::vector<FaceUnit> units = small_units(1, 5);
    units[0].words[2].f0.clear();
    units[0].words[3].contours.clear();
    units[0].words[3].length = 0;
    for (const Tensor& channel : model_of(kSmall)->forward(batch_of(units))) {
        EXPECT_TRUE(torch::isfinite(channel).all().item<bool>());
    }
}

// Of nine auto-encoders each decoder takes its own, of one all take the same.
TEST(Model1, BeginsWithWhatTheAutoencodersLearned) {
    const ContourAutoencoder speech(kSmall);
    for (const std::size_t count : {1u, 9u}) {
        std::vector<ContourAutoencoder> faces;
        for (std::size_t i = 0; i < count; ++i) faces.emplace_back(kSmall);
        Model1 model = model_of({.hidden = 32});
        model->take_over(speech, faces);
        const auto ours = model->named_parameters();
        for (const auto& weight : speech->encoder->named_parameters())
            EXPECT_TRUE(ours["pitch." + weight.key()].equal(weight.value())) << weight.key();
        for (const auto& weight : faces.front()->decoder->named_parameters())
            EXPECT_TRUE(ours["decoders.0." + weight.key()].equal(weight.value())) << weight.key();
        for (const auto& weight : faces.back()->decoder->named_parameters())
            EXPECT_TRUE(ours["decoders.8." + weight.key()].equal(weight.value())) << weight.key();
    }
}

TEST(ContourAutoencoder, LearnsABatchByHeart) {
    torch::manual_seed(1);
    ContourAutoencoder autoencoder(kSmall);
    const FaceBatch batch = batch_of(small_units(1, 6));
    const Packed packed = pack_series(batch.frames.counts);
    const double left = testing::loss_left(*autoencoder, {.steps = 200, .rate = 3e-3}, [&] {
        return torch::nn::functional::mse_loss(autoencoder->forward(batch.normalised[0], packed),
                                               batch.normalised[0]);
    });
    EXPECT_LT(left, 0.05);
}

// Trains with RMSprop, as the thesis does. Adam scales the steps of all weights alike, saturates the states of the
// six stacked LSTMs before they distinguish words, and stays at 13 % of the loss. Words have few samples and frames,
// because each is a step of six LSTMs.
TEST(Model1, LearnsOneBatchByHeart) {
    std::vector<FaceUnit> units = face_units(small_talk(3, 1), {.most_frames = 3});
    for (FaceWord& word : units[0].words) word.f0 = resampled_rows(word.f0, 1, 3);
    Model1 model = model_of(kSmall);
    const FaceBatch batch = batch_of(units);
    const testing::Learning by_rmsprop{
        .steps = 280, .rate = 2e-3, .rule = {.rule = OptimiserKind::Rule::rmsprop}};
    EXPECT_LT(testing::loss_left(*model, by_rmsprop,
                                 [&] { return face_loss(model->forward(batch), batch.contours); }),
              0.05);
}

TEST(Model1, TheSameSeedTrainsTheSameModel) {
    const FaceBatch batch = batch_of(small_units(2, 5));
    const auto trained = [&](std::uint64_t seed) {
        Model1 model = model_of(kSmall, seed);
        testing::loss_left(*model, {.steps = 3},
                           [&] { return face_loss(model->forward(batch), batch.contours); });
        const torch::NoGradGuard no_gradients;
        return model->forward(batch);
    };
    const FaceLogits once = trained(5);
    EXPECT_EQ(distance(once, trained(5)), 0);
    EXPECT_GT(distance(once, trained(6)), 1e-4);
}

TEST(Model1, ComesBackFromItsWeightsAsItWas) {
    const torch::NoGradGuard no_gradients;
    const testing::TemporaryFolder folder;
    const FaceBatch batch = batch_of(small_units(2, 5));
    Model1 model = model_of(kSmall, 1), other = model_of(kSmall, 2);
    EXPECT_GT(distance(model->forward(batch), other->forward(batch)), 1e-4);
    write_safetensors(folder / "weights.safetensors", weights_of(*model));
    set_weights(*other, read_safetensors(folder / "weights.safetensors"), folder / "weights.safetensors");
    EXPECT_EQ(distance(model->forward(batch), other->forward(batch)), 0);
}

}  // namespace
}  // namespace chironomia
