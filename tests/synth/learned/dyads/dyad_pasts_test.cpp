#include "synth/learned/dyads/dyad_pasts.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <algorithm>
#include <set>

#include "synth/learned/dyads/dyad_loss.h"
#include "synth/learned/training/trainer.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using torch::Tensor;

// Dyads of noise, each frame of its own.
std::vector<DyadFrames> some_dyads(std::initializer_list<std::int64_t> frames) {
    torch::manual_seed(7);
    std::vector<DyadFrames> dyads;
    for (const std::int64_t count : frames) {
        DyadFrames dyad{.id = "d" + std::to_string(dyads.size())};
        for (DyadFrames::Person& person : dyad.people)
            person = {
                .participant = "p", .face = torch::rand({count, 10}), .speech = torch::rand({count, 16})};
        dyads.push_back(dyad);
    }
    return dyads;
}

DyadModel model_named(const std::string& name) {
    static const Json none = Json::object();
    return make_dyad_model(name, "small", JsonValue(none, "options"), 3);
}

std::set<std::pair<std::size_t, std::size_t>> places_of(const std::vector<DyadWindow>& windows) {
    std::set<std::pair<std::size_t, std::size_t>> places;
    for (const DyadWindow& window : windows) places.insert({window.dyad, window.begin});
    return places;
}

PersonTrack track_of(const DyadFrames::Person& person) {
    const auto numbers = [](const Tensor& rows) {
        return std::vector<float>(rows.data_ptr<float>(), rows.data_ptr<float>() + rows.numel());
    };
    return {.face = numbers(person.face), .speech = numbers(person.speech)};
}

TEST(DyadPasts, TakeAsManyWindowsFromRunsAsAreAskedFor) {
    const auto dyads = some_dyads({160, 200});
    const auto recorded = windows_over(dyads, 2);  // 30 and 50
    const DyadExamples examples = plan_examples(dyads, recorded, {.share = 0.75, .frames = 25}, Random(4));
    ASSERT_EQ(examples.windows.size(), 80u);
    EXPECT_EQ(examples.runs.size(), 3u);  // of 25 frames, for 60 windows
    EXPECT_EQ(examples.frames, 25u);
    std::vector<DyadWindow> rest;
    std::size_t own = 0;
    for (const PastWindow& past : examples.windows) {
        if (!past.run) {
            rest.push_back(past.window);
            continue;
        }
        ++own;
        const FreeRun& run = examples.runs.at(*past.run);
        const std::size_t next = past.window.begin + 100;
        EXPECT_EQ(past.window.dyad, run.dyad);
        EXPECT_GT(next, run.begin);
        EXPECT_LE(next, run.begin + 25);
        EXPECT_LT(next, dyads[run.dyad].frames());
    }
    EXPECT_EQ(own, 60u);
    const auto all = places_of(recorded), others = places_of(rest);
    EXPECT_EQ(others.size(), 20u);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), others.begin(), others.end()));
}

TEST(DyadPasts, AreTheSameForTheSameChance) {
    const auto dyads = some_dyads({160});
    const auto recorded = windows_over(dyads, 2);
    const auto begins = [&](std::uint64_t seed) {
        std::vector<std::size_t> found;
        for (const PastWindow& past :
             plan_examples(dyads, recorded, {.share = 0.5, .frames = 9}, Random(seed)).windows)
            found.push_back(past.window.begin);
        return found;
    };
    EXPECT_EQ(begins(1), begins(1));
    EXPECT_NE(begins(1), begins(2));
}

TEST(DyadPasts, LeaveAllAsItWasRecordedWithoutAShare) {
    const auto dyads = some_dyads({160});
    const auto recorded = windows_over(dyads, 3);
    const DyadExamples examples = plan_examples(dyads, recorded, {.share = 0, .frames = 9}, Random(1));
    ASSERT_EQ(examples.windows.size(), recorded.size());
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        EXPECT_EQ(examples.windows[i].window.begin, recorded[i].begin);
        EXPECT_FALSE(examples.windows[i].run);
    }
    EXPECT_TRUE(examples.runs.empty());
}

// 102 frames have one run of one frame, after which one frame is to be predicted.
TEST(DyadPasts, FitRunsIntoTheShortestDyad) {
    const auto dyads = some_dyads({102});
    const DyadExamples examples =
        plan_examples(dyads, windows_over(dyads, 1), {.share = 1, .frames = 200}, Random(1));
    EXPECT_EQ(examples.frames, 1u);
    for (const FreeRun& run : examples.runs) EXPECT_EQ(run.begin, 100u);
    for (const PastWindow& past : examples.windows) EXPECT_EQ(past.window.begin, 1u);
}

// Many runs at once as `roll_out` predicts each of them.
TEST(DyadPasts, RunAsModelsRunFreely) {
    use_threads(1);
    const auto dyads = some_dyads({140, 150});
    DyadExamples examples{
        .runs = {{.dyad = 0, .begin = 100}, {.dyad = 1, .begin = 120}, {.dyad = 1, .begin = 107}},
        .frames = 20};
    for (const std::string name : {"amii", "il-lstm", "sym-il-lstm"}) {
        const DyadModel model = model_named(name);
        examples.faces = run_free(model, dyads, examples);
        ASSERT_EQ(examples.faces.sizes(), torch::IntArrayRef({2, 3, 20, 10}));
        for (const std::int64_t person : {0, 1}) {
            for (std::size_t i = 0; i < examples.runs.size(); ++i) {
                const FreeRun& run = examples.runs[i];
                const auto& people = dyads[run.dyad].people;
                const std::vector<float> alone =
                    roll_out(model.start(),
                             {track_of(people[static_cast<std::size_t>(person)]),
                              track_of(people[static_cast<std::size_t>(1 - person)])},
                             run.begin, 0);
                const Tensor expected =
                    torch::tensor(std::vector<float>(alone.begin(), alone.begin() + 200)).view({20, 10});
                EXPECT_TRUE(torch::allclose(examples.faces[person][static_cast<std::int64_t>(i)], expected,
                                            1e-5, 1e-5))
                    << name << " run " << i;
            }
        }
    }
}

// What a person does from the begin of a run on changes the partner's face, but not that of the person.
TEST(DyadPasts, KnowNothingOfTheFaceThatTheyReplace) {
    use_threads(1);
    auto dyads = some_dyads({140});
    const DyadExamples examples{.runs = {{.dyad = 0, .begin = 110}}, .frames = 20};
    const DyadModel model = model_named("amii");
    const Tensor before = run_free(model, dyads, examples);
    Tensor& face = dyads[0].people[0].face;
    face = torch::cat({face.narrow(0, 0, 115), 1 - face.narrow(0, 115, 25)});
    const Tensor after = run_free(model, dyads, examples);
    EXPECT_TRUE(torch::equal(before[0], after[0]));
    // Frame 115 is the first that is another, and reaches frame 116, the seventh of the run.
    EXPECT_TRUE(torch::equal(before[1][0].narrow(0, 0, 6), after[1][0].narrow(0, 0, 6)));
    EXPECT_FALSE(torch::equal(before[1][0][6], after[1][0][6]));
}

// Recorded faces are the frame's number in thousandths, predicted ones two units higher.
TEST(DyadPasts, ShowAWhatWasPredictedAndUWhatWasRecorded) {
    DyadFrames dyad{.id = "d"};
    for (DyadFrames::Person& person : dyad.people) {
        const Tensor frames = torch::arange(400, torch::kFloat).view({400, 1}) / 1000;
        person = {.participant = "p", .face = frames.expand({400, 10}), .speech = frames.expand({400, 16})};
    }
    DyadExamples examples{.runs = {{.dyad = 0, .begin = 150}}, .frames = 200};
    const Tensor own = 2 + torch::arange(150, 350, torch::kFloat).view({200, 1}) / 1000;
    examples.faces = own.expand({2, 1, 200, 10});
    const std::vector<PastWindow> windows{{.window = {.dyad = 0, .begin = 60}, .run = 0},
                                          {.window = {.dyad = 0, .begin = 180}, .run = 0}};
    const PastBatch batch = past_batch_of({dyad}, examples, windows);
    const auto at = [](const Tensor& rows, std::int64_t window, std::int64_t frame) {
        return rows[window][frame][3].item<float>();
    };
    for (const std::int64_t order : {0, 2}) {
        EXPECT_FLOAT_EQ(at(batch.a.face, order, 89), 0.149f);
        EXPECT_FLOAT_EQ(at(batch.a.face, order, 90), 2.150f);
        EXPECT_FLOAT_EQ(at(batch.a.face, order, 99), 2.159f);
        EXPECT_FLOAT_EQ(at(batch.a.face, order + 1, 0), 2.180f);
        EXPECT_FLOAT_EQ(at(batch.a.face, order + 1, 99), 2.279f);
        EXPECT_FLOAT_EQ(at(batch.u.face, order, 99), 0.159f);
        EXPECT_FLOAT_EQ(at(batch.a.speech, order, 99), 0.159f);
        EXPECT_FLOAT_EQ(batch.next[order][0].item<float>(), 0.160f);
        EXPECT_FLOAT_EQ(batch.next[order + 1][19].item<float>(), 0.280f);
    }
}

TEST(DyadPasts, WeighWindowsOfBothKindsByTheirNumber) {
    use_threads(1);
    const torch::NoGradGuard no_gradients;
    const auto dyads = some_dyads({160});
    for (const std::string name : {"amii", "il-lstm"}) {
        const DyadModel model = model_named(name);
        DyadExamples examples =
            plan_examples(dyads, windows_over(dyads, 10), {.share = 0.5, .frames = 9}, Random(1));
        examples.faces = run_free(model, dyads, examples);
        ASSERT_EQ(examples.windows.size(), 6u);
        double sum = 0;
        for (const PastWindow& past : examples.windows)
            sum += loss_of(model, dyads, examples, std::span(&past, 1)).item<double>();
        EXPECT_NEAR(mean_loss(model, dyads, examples), sum / 6, 1e-6) << name;
    }
}

}  // namespace
}  // namespace chironomia
