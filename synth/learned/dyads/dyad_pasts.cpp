#include "synth/learned/dyads/dyad_pasts.h"

#include <torch/utils.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/progress.h"

namespace chironomia {
namespace {

using torch::Tensor;

int64_t whole(std::size_t number) {
    return static_cast<int64_t>(number);
}

std::uint32_t below(Random& random, std::size_t end) {
    return random.below(static_cast<std::uint32_t>(end));
}

// Every run has at least one more frame after it, which its last window predicts.
std::size_t frames_of_runs(const std::vector<DyadFrames>& dyads, std::size_t most) {
    for (const DyadFrames& dyad : dyads) most = std::min(most, dyad.frames() - kWindowFrames - 1);
    return most;
}

FreeRun some_run(const std::vector<DyadFrames>& dyads, std::size_t frames, Random& random) {
    const std::size_t dyad = below(random, dyads.size());
    return {.dyad = dyad,
            .begin = kWindowFrames + below(random, dyads[dyad].frames() - kWindowFrames - frames)};
}

// The first `count` of `items` in a new order.
template <typename T>
std::vector<T> some_of(std::vector<T> items, std::size_t count, Random& random) {
    random.shuffle(items);
    items.resize(count);
    return items;
}

const DyadFrames::Person& person_of(const std::vector<DyadFrames>& dyads, std::size_t dyad,
                                    std::size_t person) {
    return dyads[dyad].people[person];
}

// Four seconds before each run, and the run; (2 R, 100 + L, ...), first with person `first` of each.
PersonFrames stretches_of(const std::vector<DyadFrames>& dyads, const DyadExamples& examples,
                          std::size_t first) {
    std::vector<Tensor> faces, speeches;
    const int64_t frames = whole(kWindowFrames + examples.frames);
    for (const std::size_t person : {first, 1 - first}) {
        for (const FreeRun& run : examples.runs) {
            const DyadFrames::Person& shown = person_of(dyads, run.dyad, person);
            faces.push_back(shown.face.narrow(0, whole(run.begin - kWindowFrames), frames));
            speeches.push_back(shown.speech.narrow(0, whole(run.begin - kWindowFrames), frames));
        }
    }
    return {.face = torch::stack(faces), .speech = torch::stack(speeches)};
}

PersonFrames window_in(const PersonFrames& stretches, std::size_t begin) {
    return {.face = stretches.face.narrow(1, whole(begin), kWindowFrames),
            .speech = stretches.speech.narrow(1, whole(begin), kWindowFrames)};
}

// (100, 10): the recorded face until the run begins, then the predicted one.
Tensor own_face(const std::vector<DyadFrames>& dyads, const DyadExamples& examples, const PastWindow& past,
                std::size_t person) {
    const std::size_t begin = past.window.begin, run_begin = examples.runs[*past.run].begin;
    const std::size_t known = run_begin - std::min(run_begin, begin);
    const Tensor predicted = examples.faces[whole(person)][whole(*past.run)].narrow(
        0, whole(begin + known - run_begin), whole(kWindowFrames - known));
    const Tensor& recorded = person_of(dyads, past.window.dyad, person).face;
    return torch::cat({recorded.narrow(0, whole(begin), whole(known)), predicted});
}

}  // namespace

DyadExamples plan_examples(const std::vector<DyadFrames>& dyads, const std::vector<DyadWindow>& recorded,
                           const OwnPasts& own, Random random) {
    DyadExamples examples;
    const auto all_recorded = [](const DyadWindow& window) {
        return PastWindow{.window = window, .run = std::nullopt};
    };
    const auto count =
        static_cast<std::size_t>(std::llround(own.share * static_cast<double>(recorded.size())));
    if (count == 0) {
        std::transform(recorded.begin(), recorded.end(), std::back_inserter(examples.windows), all_recorded);
        return examples;
    }
    examples.frames = frames_of_runs(dyads, own.frames);
    assert(examples.frames > 0);
    std::vector<PastWindow> candidates;
    while (candidates.size() < count) {
        const FreeRun run = some_run(dyads, examples.frames, random);
        for (std::size_t k = 1; k <= examples.frames; ++k)
            candidates.push_back({.window = {.dyad = run.dyad, .begin = run.begin + k - kWindowFrames},
                                  .run = examples.runs.size()});
        examples.runs.push_back(run);
    }
    examples.windows = some_of(std::move(candidates), count, random);
    for (const DyadWindow& window : some_of(recorded, recorded.size() - count, random))
        examples.windows.push_back(all_recorded(window));
    return examples;
}

Tensor run_free(const DyadModel& model, const std::vector<DyadFrames>& dyads, const DyadExamples& examples) {
    const torch::NoGradGuard no_gradients;
    const PersonFrames a = stretches_of(dyads, examples, 0), u = stretches_of(dyads, examples, 1);
    const DyadSteps step = model.start_many();
    for (std::size_t k = 0; k < examples.frames; ++k) {
        stop_if_interrupted();
        const Tensor next = step(window_in(a, k), window_in(u, k));
        a.face.select(1, whole(kWindowFrames + k)).copy_(next.clamp(0, 1));
    }
    const Tensor faces = a.face.narrow(1, kWindowFrames, whole(examples.frames)).contiguous();
    return faces.view(examples.shape_of_faces());
}

PastBatch past_batch_of(const std::vector<DyadFrames>& dyads, const DyadExamples& examples,
                        std::span<const PastWindow> windows) {
    std::vector<DyadWindow> plain;
    for (const PastWindow& past : windows) plain.push_back(past.window);
    const WindowBatch recorded = batch_of(dyads, plain);
    std::vector<Tensor> faces;
    for (const std::size_t person : {0, 1})
        for (const PastWindow& past : windows) faces.push_back(own_face(dyads, examples, past, person));
    return {
        .a = {.face = torch::stack(faces), .speech = recorded.people.speech},
        .u = {.face = swapped_halves(recorded.people.face), .speech = swapped_halves(recorded.people.speech)},
        .next = recorded.next};
}

}  // namespace chironomia
