#include "synth/learned/styles/mix_stage.h"

#include <gtest/gtest.h>

#include <set>

#include "synth/learned/styles/mix_stage_presets.h"
#include "tests/synth/learned/overfit.h"
#include "tests/synth/learned/styles/reference.h"

namespace chironomia {
namespace {

using namespace testing;
using torch::Tensor;

MixStageSize size_of(const Json& sizes) {
    const auto width = [&](const char* key) { return sizes.at(key).get<std::int64_t>(); };
    return {.speakers = width("speakers"),
            .clusters = width("clusters"),
            .divisor = width("divisor"),
            .pose = width("pose")};
}

MixStageSize tiny_size() {
    return size_of(reference().at("mix_stage").at("sizes"));
}

StageBatch batch_of(const MixStageSize& size) {
    return {.mel = formula("mel", {2, MixStageSize::kFrames, MixStageSize::kBands}),
            .pose = formula("pose", {2, MixStageSize::kFrames, size.pose}),
            .speakers = torch::arange(2),
            .clusters = (torch::arange(MixStageSize::kFrames) % size.clusters).repeat({2, 1})};
}

StageBatch in_floats(StageBatch batch) {
    batch.mel = batch.mel.to(torch::kFloat32);
    batch.pose = batch.pose.to(torch::kFloat32);
    return batch;
}

TEST(MixStage, ComputesWhatTheReferenceDoes) {
    const Json expected = reference().at("mix_stage");
    MixStage model(tiny_size());
    fill(*model);
    const StageBatch batch = batch_of(model->size());
    const Tensor logits = model->style_logits(batch.pose);
    const Tensor content = model->content_of_audio(batch.mel);
    const Tensor style = model->style_of(logits.argmax(1));
    const MixedMotion motion = model->generate(content, style);
    expect_all_near(logits, expected.at("style_logits"), "style_logits");
    expect_all_near(logits.argmax(1).to(torch::kFloat64), expected.at("style_id"), "style_id");
    expect_summary(content, expected.at("content_of_audio"), "content_of_audio");
    expect_summary(motion.pose, expected.at("pose"), "pose");
    expect_summary(motion.clusters.softmax(2), expected.at("cluster_weights"), "cluster_weights");
    expect_summary(model->generate(model->content_of_pose(batch.pose), style).pose,
                   expected.at("pose_with_content_of_pose"), "pose_with_content_of_pose");
    expect_all_near(model->discriminator->forward(batch.pose), expected.at("discriminator_of_real"), "real");
    expect_all_near(model->discriminator->forward(motion.pose), expected.at("discriminator_of_generated"),
                    "generated");
}

TEST(MixStage, LosesWhatTheReferenceDoes) {
    const Json expected = reference().at("mix_stage").at("losses");
    MixStage model(tiny_size());
    fill(*model);
    const StageBatch batch = batch_of(model->size());
    const StageLosses losses = generator_losses(model, batch, StageContent::audio);
    expect_near(losses.pose.item<double>(), expected.at("pose"), "pose");
    expect_near(losses.gan.item<double>(), expected.at("gan"), "gan");
    expect_near(losses.cluster.item<double>(), expected.at("cluster"), "cluster");
    expect_near(losses.id_in.item<double>(), expected.at("id_in"), "id_in");
    expect_near(losses.id_out.item<double>(), expected.at("id_out"), "id_out");
    expect_near(losses.total().item<double>(), expected.at("generator"), "generator");
    expect_near(discriminator_loss(model, batch, StageContent::audio).item<double>(),
                expected.at("discriminator"), "discriminator");
}

// The discriminator's step, then the generator's against what it became, normalised by the batch.
TEST(MixStage, LearnsWhatTheReferenceDoes) {
    const Json expected = reference().at("step").at("mix_stage");
    MixStage model(tiny_size());
    fill(*model);
    model->train();
    Optimiser optimiser({}, *model);
    const StageBatch batch = batch_of(model->size());
    discriminator_loss(model, batch, StageContent::audio).backward();
    expect_gradients(*model, expected.at("discriminator"), true);
    optimiser.step(1e-4);
    optimiser.forget_gradients();
    const Tensor loss = generator_losses(model, batch, StageContent::audio).total();
    expect_near(loss.item<double>(), expected.at("losses").at("generator"), "loss");
    loss.backward();
    expect_gradients(*model, expected.at("generator"), false);
    const auto buffers = model->named_buffers();
    for (const auto& [name, sums] : expected.at("running").items()) {
        expect_near(buffers[name].sum().item<double>(), sums[0], name);
        expect_near(buffers[name].square().sum().item<double>(), sums[1], name);
    }
}

TEST(MixStage, LearnsOneBatchByHeart) {
    torch::manual_seed(1);
    MixStage model(tiny_size());
    const StageBatch batch = in_floats(batch_of(model->size()));
    const double left = loss_left(*model, {.steps = 300, .rate = 1e-2},
                                  [&] { return generator_losses(model, batch, StageContent::audio).pose; });
    EXPECT_LT(left, 0.05);
}

// What teaches the generator does not teach its adversary, and the other way round.
TEST(MixStage, TeachesEitherTheGeneratorOrTheDiscriminator) {
    torch::manual_seed(1);
    MixStage model(tiny_size());
    const StageBatch batch = in_floats(batch_of(model->size()));
    const auto expect_taught = [&](bool discriminator) {
        for (const auto& item : model->named_parameters()) {
            const bool is_other = item.key().starts_with("discriminator.") != discriminator;
            EXPECT_FALSE(is_other && item.value().grad().defined()) << item.key();
            EXPECT_TRUE(item.value().requires_grad()) << item.key();
            item.value().mutable_grad() = Tensor();
        }
    };
    generator_losses(model, batch, StageContent::pose).total().backward();
    EXPECT_TRUE(model->style_encoder->parameters().front().grad().defined());
    expect_taught(false);
    discriminator_loss(model, batch, StageContent::audio).backward();
    EXPECT_TRUE(model->discriminator->parameters().front().grad().defined());
    EXPECT_TRUE(model->is_training());
    expect_taught(true);
}

// The running means of its normalisations are those of steps in which it learned.
TEST(MixStage, LeavesTheGeneratorAloneWhileTheDiscriminatorLearns) {
    torch::manual_seed(1);
    MixStage model(tiny_size());
    const Tensors before = weights_of(*model);
    discriminator_loss(model, in_floats(batch_of(model->size())), StageContent::audio);
    for (const auto& [name, value] : weights_of(*model)) {
        if (name.starts_with("discriminator.")) continue;
        EXPECT_TRUE(value.equal(before.at(name))) << name;
    }
}

TEST(MixStageTraining, GoesFromThePoseToTheSound) {
    const Json choices = mix_stage_choices("small", JsonValue(Json::object(), "options"));
    const MixStageTraining training = mix_stage_training("small", choices);
    EXPECT_EQ(training.pose_share(0), 1);
    EXPECT_EQ(training.pose_share(250), 0.75);
    EXPECT_EQ(training.pose_share(1000), 0);
    EXPECT_EQ(training.pose_share(1900), 0);
    EXPECT_EQ(training.adversary_weight(1900), 1);
    EXPECT_EQ(training.epochs * training.epoch.batches, 4000u);
    const Json rising{{"A62", "rising"}};
    const Json chosen = mix_stage_choices("paper", JsonValue(rising, "options"));
    EXPECT_EQ(mix_stage_training("paper", chosen).adversary_weight(150), 1.5);
    EXPECT_EQ(mix_stage_training("paper", chosen).adversary_weight(900), 2);
}

// Arms at rest, arms at rest somewhere else, and arms that go up and down. The first frame of these, in which nothing
// moves yet, is like no other.
Tensor rest_and_movement() {
    Tensor pose = torch::zeros({3, 64, kStylePose});
    pose[1] += 3;
    pose[2].slice(0, 0, 64, 2) += 1;
    return pose;
}

TEST(PoseClusters, SeparateRestUpAndDown) {
    PoseClusters clusters(5);
    clusters->find(rest_and_movement(), 1);
    const Tensor labels = clusters->labels(rest_and_movement());
    EXPECT_EQ(labels.sizes(), (std::vector<std::int64_t>{3, 64}));
    const Tensor moving = labels[2].slice(0, 1);
    std::set<std::int64_t> found;
    for (const Tensor& same : {labels[0], labels[1], moving.slice(0, 0, 63, 2), moving.slice(0, 1, 63, 2),
                               labels[2].slice(0, 0, 1)}) {
        EXPECT_TRUE((same == same[0]).all().item<bool>());
        found.insert(same[0].item<std::int64_t>());
    }
    EXPECT_EQ(found.size(), 5u);
}

TEST(PoseClusters, AreTheSameForTheSameSeedAndDoNotSeeTheHead) {
    const Tensor pose = torch::randn({4, 64, kStylePose});
    Tensor nodding = pose.clone();
    for (const std::int64_t half : {0, 11}) nodding.slice(2, half + 6, half + 9) += torch::randn({4, 64, 3});
    PoseClusters first(5), second(5);
    first->find(pose, 7);
    second->find(nodding, 7);
    EXPECT_TRUE(first->labels(pose).equal(second->labels(nodding)));
    EXPECT_GT(first->labels(pose).max().item<std::int64_t>(), 1);
}

TEST(PoseClusters, FindWhatThereIs) {
    PoseClusters clusters(4);
    clusters->find(torch::zeros({1, 64, kStylePose}), 1);
    EXPECT_TRUE((clusters->labels(torch::zeros({1, 64, kStylePose})) == 0).all().item<bool>());
}

}  // namespace
}  // namespace chironomia
