#include "synth/learned/faces/model2.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/utils.h>

#include <array>
#include <limits>

#include "synth/learned/faces/face_presets.h"
#include "tests/synth/learned/face_blocks.h"
#include "tests/synth/learned/face_support.h"
#include "tests/synth/learned/overfit.h"
#include "tests/synth/learned/parameters.h"

namespace chironomia {
namespace {

using testing::batch_of;
using testing::distance;
using testing::FaceBlock;
using testing::frames_before;
using testing::frames_of;
using ::testing::HasSubstr;
using testing::parameters_of;
using testing::small_units;
using torch::Tensor;

constexpr double kParity = 1e-5;
constexpr LayerSize kBlockSize{.groups = 2, .width = 8, .heads = 2, .hidden = 12, .dropout = 0};

Model2Options preset_of(const std::string& preset) {
    const Json nothing = Json::object();
    return model2_options(preset, model2_choices(preset, JsonValue(nothing, "options")));
}

Model2Options small_options() {
    Model2Options options = preset_of("small");
    options.dropout = options.forgotten = options.unplaced = options.unread = 0;
    return options;
}

Model2 model_of(const Model2Options& options, std::uint64_t seed = 1) {
    torch::manual_seed(seed);
    Model2 model(options);
    model->eval();
    return model;
}

// (B, 1, 1, N) of units of 5 and 3 words.
Tensor block_padding() {
    Tensor padding = torch::zeros({2, 1, 1, 5});
    padding[1].slice(2, 3, 5).fill_(-std::numeric_limits<float>::infinity());
    return padding;
}

Tensor block_causal() {
    return torch::full({1, 1, 5, 5}, -std::numeric_limits<float>::infinity()).triu(1);
}

TEST(Model2Layers, EncoderLayersAreThoseOfPyTorchSideBySide) {
    const torch::NoGradGuard no_gradients;
    const FaceBlock block("encoder");
    EncoderLayer layer(kBlockSize);
    block.give_weights(*layer);
    const Tensor y = layer->forward(block.at("x"), block_padding());
    EXPECT_LT(distance(y, block.at("y")), kParity);
}

TEST(Model2Layers, DecoderLayersAreThoseOfPyTorchSideBySide) {
    const torch::NoGradGuard no_gradients;
    const FaceBlock block("decoder");
    DecoderLayer layer(kBlockSize);
    block.give_weights(*layer);
    const Tensor y = layer->forward(block.at("x"), block.at("memory"), block_causal(), block_padding());
    EXPECT_LT(distance(y, block.at("y")), kParity);
}

TEST(Model2Layers, ADecoderLayerGivesTheSameStepByStep) {
    const torch::NoGradGuard no_gradients;
    const FaceBlock block("decoder");
    DecoderLayer layer(kBlockSize);
    block.give_weights(*layer);
    const Attended memory = layer->memory_attention->project(block.at("memory"));
    Attended past;
    for (int64_t i = 0; i < 5; ++i) {
        const Tensor y = layer->step(block.at("x").narrow(2, i, 1), past, torch::zeros({1, 1, 1, 1}),
                                     {memory, block_padding()});
        EXPECT_LT(distance(y, block.at("y").narrow(2, i, 1)), kParity) << "word " << i;
    }
}

TEST(Model2Layers, ConvolutionsStayWithinTheirWord) {
    const torch::NoGradGuard no_gradients;
    const FaceBlock block("convolutions");
    RowConvolutions convolutions(3, 5);
    block.give_weights(*convolutions);
    const Rows rows = make_rows(block.counts());
    const Tensor y = rows.gathered(convolutions->forward(rows.spread(block.at("x")), rows));
    EXPECT_LT(distance(y, block.at("y")), kParity);
}

TEST(Model2, HasAsManyParametersAsItsPresetsSay) {
    EXPECT_EQ(parameters_of(*Model2(preset_of("paper"))), 3'810'397);
    EXPECT_EQ(parameters_of(*Model2(preset_of("m2_2051133"))), 2'051'133);
}

TEST(Model2, AnswersForEveryFrameAndLevel) {
    const torch::NoGradGuard no_gradients;
    for (const char* preset : {"small", "paper", "m2_2051133"}) {
        const Model2Options options = preset_of(preset);
        Model2 model = model_of(options);
        const FaceBatch batch = batch_of(small_units(2, 4), options.levels);
        for (const FaceLogits& logits : {model->forward(batch), model->generate(batch)}) {
            ASSERT_EQ(logits.size(), kFaceChannels);
            for (std::size_t c = 0; c < kFaceChannels; ++c) {
                EXPECT_EQ(logits[c].sizes(),
                          (std::vector<int64_t>{batch.contours.size(1), options.levels[c]}));
                EXPECT_TRUE(torch::isfinite(logits[c]).all().item<bool>());
            }
        }
    }
}

// What is known of a word's face may change what is said of later words, and of no other: neither of the word
// itself, nor of earlier ones, nor of another unit. Speech and text are known of the whole unit beforehand,
// so each of their words may change everything in it.
TEST(Model2, NeverSeesTheFaceOfTheWordItSpeaksOf) {
    const torch::NoGradGuard no_gradients;
    const std::vector<FaceUnit> units = small_units(2, 6);  // of 6 and 7 words
    for (const char* preset : {"small", "paper"}) {
        Model2Options options = preset_of(preset);
        options.forgotten = 0;
        Model2 model = model_of(options);
        FaceBatch batch = batch_of(units);
        const FaceLogits before = model->forward(batch);
        const int64_t first = frames_before(batch, 3), behind = frames_before(batch, 4);
        const int64_t second_unit = frames_before(batch, 6), all = batch.contours.size(1);
        batch.contours.narrow(1, first, behind - first)
            .copy_(100 - batch.contours.narrow(1, first, behind - first));
        const FaceLogits after = model->forward(batch);
        EXPECT_EQ(distance(frames_of(before, 0, behind), frames_of(after, 0, behind)), 0) << preset;
        EXPECT_GT(distance(frames_of(before, behind, second_unit - behind),
                           frames_of(after, behind, second_unit - behind)),
                  1e-4)
            << preset;
        EXPECT_EQ(distance(frames_of(before, second_unit, all - second_unit),
                           frames_of(after, second_unit, all - second_unit)),
                  0)
            << preset;
    }
}

TEST(Model2, EachChannelSeesOnlyItsOwnPastBelowTheFramesDecoder) {
    const torch::NoGradGuard no_gradients;
    Model2Options options = small_options();
    options.with_frames = false;
    Model2 model = model_of(options);
    FaceBatch batch = batch_of(small_units(1, 6));
    const FaceLogits before = model->forward(batch);
    batch.contours[2].copy_(100 - batch.contours[2]);
    const FaceLogits after = model->forward(batch);
    for (std::size_t c = 0; c < kFaceChannels; ++c) {
        EXPECT_EQ(distance(before[c], after[c]) > 1e-4, c == 2) << c;
    }
}

TEST(Model2, HearsAndReadsTheWholeUnit) {
    const torch::NoGradGuard no_gradients;
    Model2 model = model_of(small_options());
    const std::vector<FaceUnit> units = small_units(1, 6);
    const FaceLogits before = model->forward(batch_of(units));
    std::vector<FaceUnit> higher = units, other_word = units;
    for (float& f0 : higher[0].words.back().f0) f0 += 100;
    other_word[0].vectors.back() += 5;
    const int64_t first_word = frames_before(batch_of(units), 1);
    for (const std::vector<FaceUnit>& changed : {higher, other_word}) {
        EXPECT_GT(distance(frames_of(before, 0, first_word),
                           frames_of(model->forward(batch_of(changed)), 0, first_word)),
                  1e-6);
    }
}

TEST(Model2, CompanyInABatchChangesNothing) {
    const torch::NoGradGuard no_gradients;
    const std::vector<FaceUnit> units = small_units(2, 5);  // the first is padded
    for (const char* preset : {"small", "m2_2051133"}) {
        const Model2Options options = preset_of(preset);
        Model2 model = model_of(options);
        const FaceBatch alone = batch_of({units[0]}, options.levels), both = batch_of(units, options.levels);
        const int64_t frames = alone.contours.size(1);
        EXPECT_LT(distance(model->forward(alone), frames_of(model->forward(both), 0, frames)), 1e-5);
        EXPECT_LT(distance(model->generate(alone), frames_of(model->generate(both), 0, frames)), 1e-5);
    }
}

TEST(Model2, GeneratesWhatItWouldSayAfterItsOwnWords) {
    const torch::NoGradGuard no_gradients;
    Model2Options options = small_options();
    options.expected_feedback = false;
    Model2 model = model_of(options);
    FaceBatch batch = batch_of(small_units(2, 6));
    const FaceLogits generated = model->generate(batch);
    std::vector<Tensor> likeliest;
    for (const Tensor& channel : generated) likeliest.push_back(channel.argmax(1));
    EXPECT_GT(distance(generated, model->forward(batch)), 1e-4);
    batch.contours = torch::stack(likeliest);
    EXPECT_LT(distance(generated, model->forward(batch)), 1e-5);
}

TEST(Model2, WordsWithoutFramesOrPitchAreBridged) {
    const torch::NoGradGuard no_gradients;
    std::vector<FaceUnit> units = small_units(1, 5);
    units[0].words[2].f0.clear();
    units[0].words[3].contours.clear();
    units[0].words[3].length = 0;
    Model2 model = model_of(small_options());
    for (const Tensor& channel : model->generate(batch_of(units))) {
        EXPECT_TRUE(torch::isfinite(channel).all().item<bool>());
    }
}

TEST(Model2, OnlyTheSmallPresetDepartsFromTheThesis) {
    const Json nothing = Json::object();
    for (const auto& [preset, expected] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"paper", {"tokens", "everywhere", "plain", "argmax", "0", "0", "0"}},
             {"m2_2051133", {"tokens", "everywhere", "plain", "argmax", "0", "0", "0"}},
             {"small", {"relative", "near", "level", "expected", "1", "0.25", "0.5"}}}) {
        const Json choices = model2_choices(preset, JsonValue(nothing, "options"));
        std::vector<std::string> found;
        for (const char* key : {"A40", "attention", "inputs", "feedback", "forgotten", "unread", "unplaced"})
            found.push_back(choices.at(key).get<std::string>());
        EXPECT_EQ(found, expected) << preset;
    }
}

TEST(Model2, SharesAreGivenAsTextsOrNumbers) {
    const Json given{{"forgotten", 1}, {"unread", 0.25}, {"A40", "rise"}};
    const Json choices = model2_choices("small", JsonValue(given, "options"));
    EXPECT_EQ(choices.at("forgotten"), "1");
    EXPECT_EQ(model2_options("small", choices).forgotten, 1);
    EXPECT_EQ(model2_options("small", choices).unread, 0.25);
    const Json other{{"unread", 0.3}};
    EXPECT_THAT(testing::refusal_of([&] { model2_choices("small", JsonValue(other, "job")); }),
                HasSubstr("unread: is \"0.3\""));
}

// If one level is certain, both kinds of feedback embed it. If two are equally likely, the expected feedback is
// the mean of their embeddings.
TEST(Model2, FeedsTheExpectedLevelBackToTheDecoders) {
    const torch::NoGradGuard no_gradients;
    const FaceBatch batch = batch_of(small_units(1, 4));
    torch::manual_seed(1);
    FaceDecoders decoders(small_options());
    const Tensor zeros = torch::zeros_like(batch.contours);
    FaceLogits certain, divided;
    for (const Tensor& levels : batch.contours.unbind(0)) {
        certain.push_back(200.0 * torch::one_hot(levels, 101));
        divided.push_back(torch::full({levels.size(0), 101}, -200.0));
        divided.back().select(1, 0).fill_(0);
        divided.back().select(1, 40).fill_(0);
    }
    EXPECT_LT(distance(decoders->embed_predicted(batch.frames, certain),
                       decoders->embed(batch.frames, batch.contours)),
              1e-5);
    const Tensor both =
        (decoders->embed(batch.frames, zeros) + decoders->embed(batch.frames, zeros + 40)) / 2;
    EXPECT_LT(distance(decoders->embed_predicted(batch.frames, divided), both), 1e-5);
}

TEST(Model2, ForgetsAndOverlooksInTrainingAlone) {
    const torch::NoGradGuard no_gradients;
    const FaceBatch batch = batch_of(small_units(2, 6));
    FaceBatch another = batch;
    another.contours = 100 - batch.contours;
    Model2Options options = small_options();
    const auto varies_in_training_alone = [&](const Model2Options& asked) {
        Model2 hasty = model_of(asked);
        EXPECT_EQ(distance(hasty->forward(batch), hasty->forward(batch)), 0);
        EXPECT_GT(distance(hasty->forward(batch), hasty->forward(another)), 1e-4);
        hasty->train();
        EXPECT_GT(distance(hasty->forward(batch), hasty->forward(batch)), 1e-4);
    };
    Model2Options forgetful = options, overlooking = options;
    forgetful.forgotten = 0.5;
    varies_in_training_alone(forgetful);
    overlooking.unread = 0.5;
    varies_in_training_alone(overlooking);
    options.forgotten = 1;  // no feedback, in predicting either
    Model2 unaware = model_of(options);
    for (const bool training : {false, true}) {
        unaware->train(training);
        EXPECT_EQ(distance(unaware->forward(batch), unaware->forward(another)), 0);
    }
    unaware->eval();
    EXPECT_EQ(distance(unaware->forward(batch), unaware->generate(batch)), 0);
}

TEST(Model2, DropsTheMeanPitchInTrainingAlone) {
    const torch::NoGradGuard no_gradients;
    const FaceBatch batch = batch_of(small_units(2, 6));
    FaceBatch nowhere = batch;
    nowhere.f0_relative = batch.f0_relative.clone();
    nowhere.f0_relative.narrow(1, 1, 2).zero_();
    Model2Options options = small_options();
    options.unplaced = 1;
    Model2 model = model_of(options);
    EXPECT_GT(distance(model->forward(batch), model->forward(nowhere)), 1e-4);
    model->train();
    EXPECT_EQ(distance(model->forward(batch), model->forward(nowhere)), 0);
}

// The voice of the last word changes what is said of it more than what is said of the first.
TEST(Model2, HearsTheNearWordsMost) {
    const torch::NoGradGuard no_gradients;
    std::vector<FaceUnit> units = small_units(1, 12);
    Model2Options options = small_options();
    options.pitch = Model2Options::Pitch::values;  // of which a word changes no other
    const FaceBatch batch = batch_of(units);
    for (float& f0 : units[0].words.back().f0) f0 += 100;
    const FaceBatch higher = batch_of(units);
    const int64_t behind_first = frames_before(batch, 1), last = frames_before(batch, 11);
    const int64_t all = batch.contours.size(1);
    Model2 model = model_of(options);
    const FaceLogits before = model->forward(batch), after = model->forward(higher);
    EXPECT_GT(distance(frames_of(before, last, all - last), frames_of(after, last, all - last)),
              20 * distance(frames_of(before, 0, behind_first), frames_of(after, 0, behind_first)));
}

TEST(Model2, LevelInputsDoNotDependOnHowLargeTheVectorsAre) {
    const torch::NoGradGuard no_gradients;
    Model2Options options = small_options();
    for (const bool level : {true, false}) {
        options.level_inputs = level;
        Model2 model = model_of(options);
        model->named_parameters()["encoder.text.bias"].zero_();
        FaceBatch batch = batch_of(small_units(1, 5));
        const FaceLogits before = model->forward(batch);
        batch.vectors = 7 * batch.vectors;
        EXPECT_EQ(distance(before, model->forward(batch)) < 1e-3, level);
    }
}

// A40: `relative` holds the mean pitch of the voice, `rise` does not.
TEST(Model2, HearsHowAVoiceRisesButNotWhereItLiesIfAsked) {
    const torch::NoGradGuard no_gradients;
    const std::vector<FaceUnit> units = small_units(1, 5);
    std::vector<FaceUnit> higher = units, flatter = units;
    for (FaceWord& word : higher[0].words)
        for (float& f0 : word.f0) f0 *= 1.5F;
    for (float& f0 : flatter[0].words[0].f0) f0 = 150;
    using Pitch = Model2Options::Pitch;
    for (const Pitch pitch : {Pitch::relative, Pitch::rise}) {
        Model2Options options = small_options();
        options.pitch = pitch;
        Model2 model = model_of(options);
        const FaceLogits said = model->forward(batch_of(units));
        EXPECT_EQ(distance(said, model->forward(batch_of(higher))) < 1e-4, pitch == Pitch::rise);
        EXPECT_GT(distance(said, model->forward(batch_of(flatter))), 1e-3);
    }
}

// A45: the likelihoods of a frame do not change with its own face, those of the next one do.
TEST(Model2, OfFramesSeesTheFramesBeforeAlone) {
    const torch::NoGradGuard no_gradients;
    const std::vector<FaceUnit> units = face_units(testing::small_talk(5, 1), {.by_frames = true});
    Model2 model = model_of(small_options());
    const FaceBatch batch = batch_of(units);
    const int64_t frames = batch.contours.size(1);
    ASSERT_EQ(batch.words(), frames);
    FaceBatch another = batch;
    another.contours = batch.contours.clone();
    another.contours.select(1, 10).fill_(77);
    const FaceLogits before = model->forward(batch), after = model->forward(another);
    EXPECT_EQ(distance(frames_of(before, 0, 11), frames_of(after, 0, 11)), 0);
    EXPECT_GT(distance(frames_of(before, 11, 1), frames_of(after, 11, 1)), 1e-4);
    EXPECT_EQ(model->generate(batch)[8].sizes(), (std::vector<int64_t>{frames, 101}));
}

TEST(Model2, AblationsTakeAwayWhatTheyName) {
    const torch::NoGradGuard no_gradients;
    const std::vector<FaceUnit> units = small_units(1, 5);
    std::vector<FaceUnit> higher = units, reworded = units;
    for (FaceWord& word : higher[0].words) {
        for (float& f0 : word.f0) f0 += 100;
    }
    for (float& number : reworded[0].vectors) number = 1 - number;
    const auto changes = [&](Model2& model, const std::vector<FaceUnit>& other) {
        return distance(model->forward(batch_of(units)), model->forward(batch_of(other))) > 1e-6;
    };
    for (const char* part : {"none", "speech", "text", "A", "D1"}) {
        Model2Options options = small_options();
        ablate(options, part);
        Model2 model = model_of(options);
        EXPECT_EQ(changes(model, higher), part != std::string("speech")) << part;
        EXPECT_EQ(changes(model, reworded), part != std::string("text")) << part;
    }
}

TEST(Model2, EveryReadingOfTheThesisLearns) {
    using Pitch = Model2Options::Pitch;
    const std::array readings{Pitch::values, Pitch::tokens, Pitch::tokens, Pitch::relative};
    for (int reading = 0; reading < 4; ++reading) {
        Model2Options options = small_options();
        options.near = options.level_inputs = reading == 3;
        options.pitch = readings[static_cast<std::size_t>(reading)];
        options.attention_layer = reading != 1;
        options.attended_memory = reading != 2;
        Model2 model = model_of(options);
        const FaceBatch batch = batch_of(small_units(2, 5));
        EXPECT_LT(testing::loss_left(*model, {.steps = 40, .rate = 3e-3},
                                     [&] { return face_loss(model->forward(batch), batch.contours); }),
                  0.8);
        const torch::NoGradGuard no_gradients;
        model->eval();
        EXPECT_TRUE(torch::isfinite(model->generate(batch)[0]).all().item<bool>());
    }
}

TEST(Model2, LearnsOneBatchByHeart) {
    Model2 model = model_of(small_options());
    const FaceBatch batch = batch_of(small_units(3, 6));
    EXPECT_LT(testing::loss_left(*model, {.steps = 400, .rate = 3e-3},
                                 [&] { return face_loss(model->forward(batch), batch.contours); }),
              0.05);
}

TEST(Model2, TheSameSeedTrainsTheSameModel) {
    const FaceBatch batch = batch_of(small_units(2, 5));
    const auto trained = [&](std::uint64_t seed) {
        Model2Options options = small_options();
        options.dropout = 0.1;
        Model2 model = model_of(options, seed);
        testing::loss_left(*model, {.steps = 5},
                           [&] { return face_loss(model->forward(batch), batch.contours); });
        const torch::NoGradGuard no_gradients;
        model->eval();
        return model->forward(batch);
    };
    const FaceLogits once = trained(5);
    EXPECT_EQ(distance(once, trained(5)), 0);
    EXPECT_GT(distance(once, trained(6)), 1e-3);
}

TEST(Model2, ComesBackFromItsWeightsAsItWas) {
    const torch::NoGradGuard no_gradients;
    const testing::TemporaryFolder folder;
    const FaceBatch batch = batch_of(small_units(2, 5));
    Model2 model = model_of(small_options(), 1), other = model_of(small_options(), 2);
    write_safetensors(folder / "weights.safetensors", weights_of(*model));
    EXPECT_GT(distance(model->generate(batch), other->generate(batch)), 1e-3);
    set_weights(*other, read_safetensors(folder / "weights.safetensors"), folder / "weights.safetensors");
    EXPECT_EQ(distance(model->generate(batch), other->generate(batch)), 0);
}

}  // namespace
}  // namespace chironomia
