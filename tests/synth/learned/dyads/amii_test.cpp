#include "synth/learned/dyads/amii.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <tuple>

#include "core/random.h"
#include "synth/learned/dyads/dyad_frames.h"
#include "synth/learned/dyads/dyad_models.h"
#include "synth/learned/training/trainer.h"
#include "tests/support/support.h"
#include "tests/synth/learned/parameters.h"
#include "tests/synth/learned/sample_dyads.h"

namespace chironomia {
namespace {

using testing::parameters_of;

using torch::Tensor;

// Every reading, and every ablation of the first.
std::vector<AmiiParts> all_parts() {
    return {{},
            {.ablation = "noE_m"},
            {.ablation = "noE_dual"},
            {.ablation = "noE_inter"},
            {.shared = false},
            {.joint = false},
            {.tanh = false},
            {.residual = true},
            {.sequence = false},
            {.ablation = "noE_inter", .joint = false}};
}

std::string named(const AmiiParts& parts) {
    return to_json(parts).dump();
}

Amii make(const AmiiParts& parts) {
    torch::manual_seed(11);
    return Amii(parts);
}

std::int64_t count(const AmiiParts& parts) {
    return parameters_of(*Amii(parts));
}

PersonFrames some_frames(std::int64_t batch) {
    return {.face = torch::rand({batch, 100, 10}), .speech = torch::rand({batch, 100, 16})};
}

CorpusStatistics statistics_for_waves() {
    CorpusStatistics statistics{.kind = CorpusKind::dyads};
    statistics.scales["face"].assign(10, {.zero = 0, .one = 2, .is_clamped = true});
    statistics.scales["speech"].assign(16, {.zero = 0, .one = 1, .is_clamped = true});
    return statistics;
}

PersonTrack random_track(std::size_t frames, Random& random) {
    PersonTrack track;
    for (std::size_t i = 0; i < 10 * frames; ++i) track.face.push_back(static_cast<float>(random.uniform()));
    for (std::size_t i = 0; i < 16 * frames; ++i)
        track.speech.push_back(static_cast<float>(random.uniform()));
    return track;
}

// Encoders of 3,808 and 3,712, two crossings of 2,704, a generator of 980.
TEST(Amii, HasTheParametersThatItsDescriptionCounts) {
    EXPECT_EQ(count({}), 13'908);
    EXPECT_EQ(count({.shared = false}), 24'132);
    EXPECT_EQ(count({.ablation = "noE_m"}), 13'908 - 2 * 2'176);
    EXPECT_EQ(count({.ablation = "noE_dual"}), 13'908 - 2 * 1'088);
    EXPECT_EQ(count({.ablation = "noE_inter"}), 13'908 - 2'704 - 320);
    EXPECT_EQ(count({.joint = false}), 13'908 - 980 + 660 + 210);
    const Amii model{AmiiParts{}};
    EXPECT_EQ(parameters_of(*model->intra->speech), 3'808);
    EXPECT_EQ(parameters_of(*model->intra->face), 3'712);
    EXPECT_EQ(parameters_of(*model->intra->dual), 2'704);
    EXPECT_EQ(parameters_of(*model->inter), 2'704);
    EXPECT_EQ(parameters_of(*model->generator), 980);
}

TEST(Amii, GivesTwoFacesForEveryWindow) {
    for (const AmiiParts& parts : all_parts()) {
        Amii model = make(parts);
        const PersonFrames a = some_frames(2), u = some_frames(2);
        EXPECT_EQ(model->forward(a, u).sizes(), torch::IntArrayRef({2, 20})) << named(parts);
        const std::int64_t states = parts.sequence ? 100 : 1;
        EXPECT_EQ(model->intra->forward(a).sizes(), torch::IntArrayRef({2, states, 16})) << named(parts);
    }
}

TEST(Amii, SeesBothOrdersOfADyadAsTwoDyads) {
    const torch::NoGradGuard no_gradients;
    for (const AmiiParts& parts : all_parts()) {
        Amii model = make(parts);
        const PersonFrames a = some_frames(3), u = some_frames(3);
        const Tensor both = model->both_orders(
            {.face = torch::cat({a.face, u.face}), .speech = torch::cat({a.speech, u.speech})});
        const Tensor apart = torch::cat({model->forward(a, u), model->forward(u, a)});
        EXPECT_TRUE(torch::allclose(both, apart, 1e-5, 1e-6)) << named(parts);
    }
}

TEST(Amii, LetsTheLossReachEveryWeight) {
    for (const AmiiParts& parts : all_parts()) {
        Amii model = make(parts);
        model->forward(some_frames(2), some_frames(2)).square().sum().backward();
        for (const auto& weight : model->named_parameters()) {
            // One key is attended to whole, whatever it and the query are.
            if (!parts.sequence && weight.key().find("dual") != std::string::npos) continue;
            if (!parts.sequence && weight.key().find("inter") != std::string::npos) continue;
            ASSERT_TRUE(weight.value().grad().defined()) << named(parts) << weight.key();
            // Adding the same to all scores changes nothing: a key's bias has no gradient.
            if (weight.key().find("key.bias") != std::string::npos) continue;
            EXPECT_GT(weight.value().grad().abs().max().item<float>(), 0) << named(parts) << weight.key();
        }
    }
}

// What U does from frame 110 on reaches A's face of frame 111, and not before.
TEST(Amii, KnowsNothingOfTheUserThatHasNotHappened) {
    Random random(5);
    const DyadTrack dyad{.a = random_track(115, random), .u = random_track(115, random)};
    DyadTrack other = dyad;
    for (std::size_t i = 110 * 10; i < other.u.face.size(); ++i) other.u.face[i] = 1 - other.u.face[i];
    for (std::size_t i = 110 * 16; i < other.u.speech.size(); ++i) other.u.speech[i] = 1 - other.u.speech[i];
    const Json none = Json::object();
    const DyadStep step = make_dyad_model("amii", "paper", JsonValue(none, "options"), 11).start();
    const std::vector<float> before = roll_out(step, dyad, 100, 0);
    const std::vector<float> after = roll_out(step, other, 100, 0);
    for (std::size_t i = 0; i < 11 * 10; ++i) ASSERT_EQ(before[i], after[i]) << "frame " << 100 + i / 10;
    float change = 0;
    for (std::size_t i = 11 * 10; i < 12 * 10; ++i) change = std::max(change, std::abs(before[i] - after[i]));
    EXPECT_GT(change, 0);
}

TEST(Amii, LearnsOneBatchByHeart) {
    use_threads(1);
    const DyadFeatures features = dyad_features(statistics_for_waves());
    const DyadRecord record = testing::following_dyad("d", "p", "q", 220, 0);
    DyadFrames dyad{.id = "d"};
    for (const std::size_t p : {0, 1})
        dyad.people[p] = {.participant = record.people[p].participant,
                          .face = normalised(record.people[p].face, features.face),
                          .speech = normalised(record.people[p].speech, features.speech)};
    const WindowBatch batch = batch_of({dyad}, windows_over({dyad}, 15));
    Amii model = make({});
    Optimiser optimiser({}, *model);
    double first = 0, last = 0;
    constexpr int kSteps = 250;
    for (int step = 0; step < kSteps; ++step) {
        optimiser.forget_gradients();
        const Tensor loss = torch::mse_loss(model->both_orders(batch.people), batch.next);
        loss.backward();
        // Ever smaller steps: at the full rate the last one may be a jump.
        optimiser.step(1e-2 * (1 - double(step) / kSteps));
        last = loss.item<double>();
        if (step == 0) first = last;
    }
    EXPECT_LT(last, 0.05 * first);
}

TEST(Amii, AttendsAndRemembersAsPyTorchDoes) {
    const Tensors known =
        read_safetensors(testing::source_dir() / "tests/fixtures/learned/parity.safetensors");
    const auto part = [&](const std::string& prefix) {
        Tensors found;
        for (const auto& [name, tensor] : known)
            if (name.starts_with(prefix)) found[name.substr(prefix.size())] = tensor;
        return found;
    };
    Tensors attention = part("attention/");
    const Tensor from = attention.at("from"), to = attention.at("to"), result = attention.at("result");
    for (const char* name : {"from", "to", "result"}) attention.erase(name);
    AmiiAttention ours;
    set_weights(*ours, attention, "parity");
    EXPECT_TRUE(torch::allclose(ours->forward(from, to), result, 1e-5, 1e-5));

    ModalityEncoder encoder(16, AmiiParts{});
    for (const auto& weight : encoder->memory->named_parameters())
        weight.value().data().copy_(known.at("lstm/" + weight.key()));
    const Tensor x = known.at("lstm/x").clone().set_requires_grad(true);
    const Tensor states = std::get<0>(encoder->memory->forward(x));
    EXPECT_TRUE(torch::allclose(states, known.at("lstm/states"), 1e-5, 1e-5));
    (states * known.at("lstm/weight")).sum().backward();
    EXPECT_TRUE(torch::allclose(x.grad(), known.at("lstm/gradient/x"), 1e-5, 1e-5));
    for (const auto& weight : encoder->memory->named_parameters())
        EXPECT_TRUE(
            torch::allclose(weight.value().grad(), known.at("lstm/gradient/" + weight.key()), 1e-5, 1e-5))
            << weight.key();
}

TEST(DyadFrames, CutsWindowsAndWhatFollowsThem) {
    const DyadFeatures features = dyad_features(statistics_for_waves());
    DyadFrames dyad{.id = "d"};
    for (const std::size_t p : {0, 1}) {
        std::vector<float> rows(104 * 10), words(104 * 16);
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<float>(i / 10 + 200 * p) / 200;
        dyad.people[p] = {.face = normalised(rows, features.face),
                          .speech = normalised(words, features.speech)};
    }
    const auto windows = windows_over({dyad}, 2);
    ASSERT_EQ(windows.size(), 2u);
    EXPECT_EQ(windows[1].begin, 2u);
    const WindowBatch batch = batch_of({dyad}, windows);
    // People 0 twice, then people 1 twice; 200 frames are worth 0.5, person 1 is half a unit above.
    EXPECT_NEAR(batch.people.face[1][0][0].item<float>(), 2.0 / 400, 1e-6);
    EXPECT_NEAR(batch.people.face[3][99][4].item<float>(), 0.5 + 101.0 / 400, 1e-6);
    EXPECT_NEAR(batch.next[0][0].item<float>(), 100.0 / 400, 1e-6);
    EXPECT_NEAR(batch.next[0][10].item<float>(), 0.5 + 100.0 / 400, 1e-6);
    EXPECT_NEAR(batch.next[3][0].item<float>(), 0.5 + 102.0 / 400, 1e-6);
    EXPECT_NEAR(batch.next[3][10].item<float>(), 102.0 / 400, 1e-6);
}

TEST(DyadFrames, HoldsWhatIsOutsideAndGivesBackWhatIsInside) {
    const std::vector<Feature> features{{.name = "a", .low = -1, .high = 1},
                                        {.name = "b", .low = 0, .high = 5}};
    const Tensor scaled = normalised({-3, 2.5, 0, 9}, features);
    EXPECT_TRUE(torch::equal(scaled, torch::tensor({{0.0f, 0.5f}, {0.5f, 1.0f}})));
    EXPECT_EQ(denormalised(scaled, features), (std::vector<float>{-1, 2.5, 0, 5}));
}

TEST(Rollout, FeedsBackWhatItPredictedUntilItStartsAnew) {
    const PersonTrack track{.face = std::vector<float>(60, 0.25f), .speech = std::vector<float>(96, 0)};
    DyadTrack dyad{.a = track, .u = track};
    const DyadStep adds = [](const DyadPast& past, bool restarted) {
        FaceFrame face = hold_face(past, restarted);
        for (float& value : face) value += 0.125f;
        return face;
    };
    const auto first_column = [](const std::vector<float>& rows) {
        std::vector<float> column;
        for (std::size_t i = 0; i < rows.size(); i += 10) column.push_back(rows[i]);
        return column;
    };
    EXPECT_EQ(first_column(roll_out(adds, dyad, 2, 0)), (std::vector<float>{0.375, 0.5, 0.625, 0.75}));
    EXPECT_EQ(first_column(roll_out(adds, dyad, 2, 2)), (std::vector<float>{0.375, 0.5, 0.375, 0.5}));
    EXPECT_EQ(first_column(roll_out(hold_face, dyad, 2, 0)), (std::vector<float>(4, 0.25f)));
    for (float& value : dyad.a.face) value = 0.9f;
    EXPECT_EQ(first_column(roll_out(adds, dyad, 2, 0)), (std::vector<float>(4, 1.0f)));
}

}  // namespace
}  // namespace chironomia
