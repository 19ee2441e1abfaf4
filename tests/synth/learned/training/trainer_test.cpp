#include "synth/learned/training/trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/optim/adam.h>
#include <torch/optim/rmsprop.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/support/support.h"
#include "tests/synth/learned/toy_task.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::toy_description;
using testing::toy_plan;
using testing::ToyTask;

TrainingResult train_toy(ToyTask& toy, const TrainingPlan& plan, const std::filesystem::path& file) {
    return train(toy.task, plan, toy_description(), file);
}

void expect_same(const Tensors& a, const Tensors& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, tensor] : a) EXPECT_TRUE(torch::equal(tensor, b.at(name))) << name;
}

// Ours against torch's own, on the same gradients.
template <typename Theirs>
void expect_same_steps(const OptimiserKind& kind,
                       const std::function<Theirs(std::vector<torch::Tensor>)>& make) {
    ToyTask ours, reference;
    Optimiser optimiser(kind, *ours.model);
    Theirs theirs = make(reference.model->parameters());
    for (int i = 0; i < 20; ++i) {
        for (ToyTask* toy : {&ours, &reference}) {
            toy->dropout = 0;
            toy->model->zero_grad();
            toy->task.loss({0, 1, 2, 3, 4}).backward();
        }
        optimiser.step(0.01);
        theirs.step();
    }
    EXPECT_TRUE(torch::allclose(ours.model->weight, reference.model->weight, 1e-5, 1e-6));
    EXPECT_TRUE(torch::allclose(ours.model->bias, reference.model->bias, 1e-5, 1e-6));
}

TEST(Optimiser, StepsAsTorchsAdamDoes) {
    expect_same_steps<torch::optim::Adam>({}, [](std::vector<torch::Tensor> weights) {
        return torch::optim::Adam(std::move(weights), torch::optim::AdamOptions(0.01));
    });
}

TEST(Optimiser, StepsAsTorchsRmspropDoes) {
    expect_same_steps<torch::optim::RMSprop>(
        {.rule = OptimiserKind::Rule::rmsprop}, [](std::vector<torch::Tensor> weights) {
            return torch::optim::RMSprop(std::move(weights), torch::optim::RMSpropOptions(0.01).alpha(0.9));
        });
}

TEST(Trainer, VisitsEveryExampleOnceInAnEpochInAnOrderOfTheSeed) {
    Random random(5), same(5), other(6);
    const std::vector<Batch> batches = shuffled_batches(10, 4, random);
    ASSERT_EQ(batches.size(), 3u);
    EXPECT_EQ(batches.back().size(), 2u);
    Batch all;
    for (const Batch& batch : batches) all.insert(all.end(), batch.begin(), batch.end());
    EXPECT_FALSE(std::is_sorted(all.begin(), all.end()));
    EXPECT_EQ(shuffled_batches(10, 4, same), batches);
    EXPECT_NE(shuffled_batches(10, 4, other), batches);
    std::sort(all.begin(), all.end());
    Batch expected(10);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(all, expected);
}

TEST(Trainer, LearnsALine) {
    const TemporaryFolder folder;
    ToyTask toy;
    const double before = toy.task.validation_loss();
    TrainingPlan plan = toy_plan();
    plan.epochs = 60;
    const TrainingResult result = train_toy(toy, plan, folder / "toy");
    EXPECT_EQ(result.steps, 180u);
    EXPECT_EQ(result.curve.size(), 60u);
    EXPECT_LT(result.validation_loss, 0.1 * before);
    EXPECT_THAT(read_text(folder / "toy.svg"), HasSubstr("toy small"));
}

TEST(Trainer, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
    const TemporaryFolder folder;
    for (const auto& [name, seed] : {std::pair{"a", 1}, {"b", 1}, {"c", 2}}) {
        ToyTask toy;
        TrainingPlan plan = toy_plan();
        plan.seed = static_cast<std::uint64_t>(seed);
        train_toy(toy, plan, folder / name);
    }
    EXPECT_EQ(read_text(folder / "a.safetensors"), read_text(folder / "b.safetensors"));
    EXPECT_EQ(read_text(folder / "a.json"), read_text(folder / "b.json"));
    EXPECT_NE(read_text(folder / "a.safetensors"), read_text(folder / "c.safetensors"));
}

// 3 batches an epoch: 5 steps end within the second, 9 steps at the end of one.
class TrainerGoesOn : public ::testing::TestWithParam<std::pair<std::size_t, std::size_t>> {};

TEST_P(TrainerGoesOn, AsIfItHadNeverStopped) {
    const auto [first, all] = GetParam();
    for (const auto rule : {OptimiserKind::Rule::adam, OptimiserKind::Rule::rmsprop}) {
        const TemporaryFolder folder;
        TrainingPlan plan = toy_plan();
        plan.optimiser.rule = rule;
        plan.epochs = 10;
        plan.steps = all;
        ToyTask whole;
        const TrainingResult expected = train_toy(whole, plan, folder / "whole");
        ToyTask begun;
        plan.steps = first;
        EXPECT_EQ(train_toy(begun, plan, folder / "parts").steps, first);
        ToyTask ended;
        plan.steps = all;
        const TrainingResult found = train_toy(ended, plan, folder / "parts");
        EXPECT_EQ(found.validation_loss, expected.validation_loss);
        expect_same(weights_of(*ended.model), weights_of(*whole.model));
        for (const char* ending : {".json", ".safetensors", ".resume.safetensors", ".svg"})
            EXPECT_EQ(read_text(folder / (std::string("parts") + ending)),
                      read_text(folder / (std::string("whole") + ending)))
                << ending;
    }
}

INSTANTIATE_TEST_SUITE_P(Steps, TrainerGoesOn,
                         ::testing::Values(std::pair{5, 10}, std::pair{9, 18}, std::pair{1, 2}));

// 3 batches an epoch: the sixth step, which ends it without a word, is the last of the second.
TEST(Trainer, LosesNoStepWhenItIsKilled) {
    const TemporaryFolder folder;
    TrainingPlan plan = toy_plan();
    plan.save_every = 0;
    ToyTask whole, killed, rest;
    train_toy(whole, plan, folder / "whole");
    killed.task.loss = [loss = killed.task.loss, steps = 0](const Batch& batch) mutable {
        if (++steps == 6) throw std::runtime_error("killed");
        return loss(batch);
    };
    EXPECT_THROW(train_toy(killed, plan, folder / "parts"), std::runtime_error);
    EXPECT_EQ(read_json(folder / "parts.json")["step"], 5);
    train_toy(rest, plan, folder / "parts");
    for (const char* ending : {".json", ".safetensors", ".resume.safetensors", ".svg"})
        EXPECT_EQ(read_text(folder / (std::string("parts") + ending)),
                  read_text(folder / (std::string("whole") + ending)))
            << ending;
}

// What is to be learned moves by what the model said when the epoch began.
void chase_itself(ToyTask& toy, std::vector<std::size_t>& made_in) {
    const auto shift = std::make_shared<torch::Tensor>();
    toy.task.make_examples = [&toy, &made_in](std::size_t epoch) {
        made_in.push_back(epoch);
        return Tensors{{"shift", 0.5 * toy.model->forward(toy.x)}};
    };
    toy.task.use_examples = [shift](std::size_t, const Tensors& made) { *shift = made.at("shift"); };
    toy.task.loss = [&toy, shift](const Batch& batch) {
        const torch::Tensor rows = torch::tensor(std::vector<std::int64_t>(batch.begin(), batch.end()));
        return torch::mse_loss(toy.model->forward(toy.x.index_select(0, rows)),
                               (toy.y + *shift).index_select(0, rows));
    };
}

// 3 batches an epoch; 5 steps end within the second.
TEST(Trainer, GoesOnWithTheExamplesThatTheModelMadeForTheEpoch) {
    for (const std::size_t first : {5, 6}) {
        const TemporaryFolder folder;
        TrainingPlan plan = toy_plan();
        ToyTask whole, begun, ended;
        std::vector<std::size_t> in_whole, in_begun, in_ended;
        chase_itself(whole, in_whole);
        chase_itself(begun, in_begun);
        chase_itself(ended, in_ended);
        plan.steps = 8;
        train_toy(whole, plan, folder / "whole");
        EXPECT_EQ(in_whole, (std::vector<std::size_t>{0, 1, 2}));
        plan.steps = first;
        train_toy(begun, plan, folder / "parts");
        EXPECT_EQ(in_begun, (std::vector<std::size_t>{0, 1}));
        plan.steps = 8;
        train_toy(ended, plan, folder / "parts");
        EXPECT_EQ(in_ended, (std::vector<std::size_t>{2}));
        for (const char* ending : {".json", ".safetensors", ".resume.safetensors"})
            EXPECT_EQ(read_text(folder / (std::string("parts") + ending)),
                      read_text(folder / (std::string("whole") + ending)))
                << ending;
    }
}

TEST(Trainer, KeepsTheBestWeightsAndStopsWhenNothingBettersThem) {
    const TemporaryFolder folder;
    ToyTask toy;
    double loss = 5;
    Tensors best;
    toy.task.validation_loss = [&] {
        loss += toy.validations++ < 3 ? -1 : 1;  // 4, 3, 2, 3, 4 ...
        if (loss == 2) best = weights_of(*toy.model);
        return loss;
    };
    TrainingPlan plan = toy_plan();
    plan.epochs = 50;
    plan.patience = 2;
    const TrainingResult result = train_toy(toy, plan, folder / "toy");
    EXPECT_TRUE(result.stopped_early);
    EXPECT_EQ(result.curve.size(), 5u);
    EXPECT_EQ(result.validation_loss, 2);
    expect_same(weights_of(*toy.model), best);
    expect_same(read_checkpoint(folder / "toy", CheckpointParts::weights).weights, best);
}

TEST(Trainer, EndsWhereTheLossIsGoodEnough) {
    ToyTask toy;
    const TemporaryFolder folder;
    double loss = 5;
    toy.task.validation_loss = [&] { return --loss; };
    TrainingPlan plan = toy_plan();
    plan.epochs = 50;
    plan.enough = 2;
    const TrainingResult result = train_toy(toy, plan, folder / "toy");
    EXPECT_TRUE(result.stopped_early);
    EXPECT_EQ(result.curve.size(), 3u);
    EXPECT_EQ(train_toy(toy, plan, folder / "toy").steps, result.steps);
}

TEST(Trainer, ClipsAGradientToTheLengthThatIsAllowed) {
    ToyTask toy;
    toy.scale = 100;
    toy.task.loss({0, 1, 2}).backward();
    Optimiser optimiser({}, *toy.model);
    const double norm = optimiser.gradient_norm();
    ASSERT_GT(norm, 1);
    optimiser.scale_gradients(0.5 / norm);
    EXPECT_NEAR(optimiser.gradient_norm(), 0.5, 1e-6);
    // Plain RMSProp's first step does not depend on the length, but its mean of squares does.
    const TemporaryFolder folder;
    TrainingPlan plan = toy_plan();
    plan.optimiser = {.rule = OptimiserKind::Rule::rmsprop, .alpha = 0};
    plan.steps = 1;
    plan.clip = 0.5;
    ToyTask clipped;
    clipped.scale = 100;
    train_toy(clipped, plan, folder / "toy");
    const Tensors state = read_checkpoint(folder / "toy", CheckpointParts::all).resume;
    const double squares =
        (state.at("optimiser/weight/second").sum() + state.at("optimiser/bias/second").sum()).item<double>();
    EXPECT_NEAR(squares, 0.25, 1e-5);
}

TEST(Trainer, RefusesALossThatIsNoNumber) {
    const TemporaryFolder folder;
    ToyTask toy;
    toy.scale = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(testing::refusal_of([&] { train_toy(toy, toy_plan(), folder / "toy"); }),
                HasSubstr("toy: at step 0 with the learning rate 0.05 the loss is nan and the length of its "
                          "gradient nan; lower the rate or limit the gradient"));
    ToyTask judged;
    judged.task.validation_loss = [] { return std::numeric_limits<double>::infinity(); };
    EXPECT_THAT(testing::refusal_of([&] { train_toy(judged, toy_plan(), folder / "toy"); }),
                HasSubstr("after step 3 the loss of validation is inf; lower the learning rate"));
}

TEST(Trainer, RefusesToGoOnWithAnotherTraining) {
    const TemporaryFolder folder;
    ToyTask toy;
    train_toy(toy, toy_plan(), folder / "toy");
    TrainingPlan plan = toy_plan();
    plan.seed = 2;
    EXPECT_THAT(
        testing::refusal_of([&] { train_toy(toy, plan, folder / "toy"); }),
        HasSubstr("toy.json: holds a training whose seed is 1, asked for is 2; name another file, or remove "
                  "this one to train anew"));
}

TEST(Trainer, LeavesAnotherProgramsFileAlone) {
    const TemporaryFolder folder;
    ToyTask toy;
    for (const char* other : {R"({"kind": "dyads"})", R"({"format": "chironomia corpus"})", "[1]"}) {
        write_text(folder / "toy.json", other);
        EXPECT_THAT(
            testing::refusal_of([&] { train_toy(toy, toy_plan(), folder / "toy"); }),
            HasSubstr("toy.json: it describes no checkpoint, and that of toy.safetensors needs its place; "
                      "name another checkpoint, or move this file"));
        EXPECT_EQ(read_text(folder / "toy.json"), other);
    }
}

TEST(Trainer, RefusesToGoOnOverOtherRecords) {
    const TemporaryFolder folder;
    ToyTask toy;
    TrainingPlan plan = toy_plan();
    train_toy(toy, plan, folder / "toy");
    plan.corpus = "0123456789";
    train_toy(toy, plan, folder / "toy");  // of a version that did not say what was learned
    train_toy(toy, plan, folder / "new");
    plan.corpus = "9876543210";
    EXPECT_THAT(
        testing::refusal_of([&] { train_toy(toy, plan, folder / "new"); }),
        HasSubstr(
            "new.json: holds a training on other records: SHA-256 01234567..., those of this corpus have "
            "98765432...; name another file, or remove this one to train anew"));
}

TEST(Trainer, RefusesToBeShorterThanItWas) {
    const TemporaryFolder folder;
    ToyTask toy;
    TrainingPlan plan = toy_plan();
    plan.epochs = 2;
    train_toy(toy, plan, folder / "toy");
    plan.epochs = 1;
    EXPECT_THAT(testing::refusal_of([&] { train_toy(toy, plan, folder / "toy"); }),
                HasSubstr("toy.json: holds a training of 2 epochs, asked for is one of 1; ask for as many, "
                          "or name another file, or remove this one"));
    plan.epochs = 2;
    plan.steps = 5;
    EXPECT_THAT(testing::refusal_of([&] { train_toy(toy, plan, folder / "toy"); }),
                HasSubstr("toy.json: holds a training of 6 steps, asked for is one of 5; ask"));
}

}  // namespace
}  // namespace chironomia
