// Scheduled sampling: windows of dyads in which a person's face is not what was recorded but what the model itself
// predicted, so that it learns to recover from its own errors; the target stays what was recorded. After Bengio,
// Vinyals, Jaitly, Shazeer, "Scheduled Sampling for Sequence Prediction with Recurrent Neural Networks", 2015. We
// differ: whole stretches are predicted, by the model as it is when an epoch begins, as Ross, Gordon, Bagnell, "A
// Reduction of Imitation Learning and Structured Prediction to No-Regret Online Learning", 2011, do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/random.h"
#include "synth/learned/dyads/dyad_frames.h"
#include "synth/learned/dyads/dyad_models.h"

namespace chironomia {

// Frames of a dyad that the model predicts freely, each person in turn beside the other as recorded; all that
// is before is recorded.
struct FreeRun {
    std::size_t dyad = 0;
    std::size_t begin = 0;  // the first frame that is predicted
};

struct PastWindow {
    DyadWindow window;
    std::optional<std::size_t> run;  // whose faces are A's past from its begin on; none: all is recorded
};

// The examples of an epoch of training, or of validation.
struct DyadExamples {
    std::vector<PastWindow> windows;
    std::vector<FreeRun> runs;
    std::size_t frames = 0;  // L, of each run
    torch::Tensor faces;     // of person 0, then of person 1; what `run_free` returns

    std::vector<int64_t> shape_of_faces() const {  // (2, R, L, 10)
        return {2, static_cast<int64_t>(runs.size()), static_cast<int64_t>(frames), DyadPerson::kFace};
    }
};

struct OwnPasts {
    double share = 0;        // of the windows, in [0, 1]
    std::size_t frames = 1;  // most of a run, > 0
};

// As many windows as `recorded` has. The share `own.share` of them follow the frames of free runs, whose first frames
// are drawn by chance; the others are drawn from `recorded`. Each dyad has at least 102 frames if there are runs.
DyadExamples plan_examples(const std::vector<DyadFrames>& dyads, const std::vector<DyadWindow>& recorded,
                           const OwnPasts& own, Random random);

// The faces of all runs in [0, 1], by the weights that the model has now. Throws Interrupted.
torch::Tensor run_free(const DyadModel& model, const std::vector<DyadFrames>& dyads,
                       const DyadExamples& examples);

// Windows in both orders as WindowBatch has them, where U's past is not A's.
struct PastBatch {
    PersonFrames a, u;   // (2 B, 100, ...)
    torch::Tensor next;  // (2 B, 20)
};

// `windows` have runs whose faces are there.
PastBatch past_batch_of(const std::vector<DyadFrames>& dyads, const DyadExamples& examples,
                        std::span<const PastWindow> windows);

}  // namespace chironomia
