// The fields that jobs of all learned models have alike; see synth/learning.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/json_value.h"
#include "synth/corpus/corpus.h"
#include "synth/learned/training/trainer.h"
#include "synth/predictions.h"

namespace chironomia {

// How a computation runs: the job's "seed", "threads" and "quiet", 1, 1 and false where it has none. Sets the
// threads.
struct JobRun {
    std::uint64_t seed = 1;
    int threads = 1;
    bool quiet = false;
};
JobRun begin_job(const JsonValue& job);

// The job's "options"; an empty object if it has none.
JsonValue job_options(const JsonValue& job);

// The job's "corpus". Throws Error with its folder if it is of another kind.
CorpusIndex job_corpus(const JsonValue& job, CorpusKind kind);

// The job's "split".
Split job_split(const JsonValue& job);

// What a training's plan takes from its job: how it runs, what it learns from, and "steps", "epochs" and "save_every"
// where the job has them.
void apply_job(const JsonValue& job, const JobRun& run, TrainingPlan& plan);

// What "train" answers.
Json training_answer(const std::filesystem::path& checkpoint, const TrainingResult& result);

// What "describe" answers of a checkpoint but how many numbers it has.
Json checkpoint_answer(const Checkpoint& checkpoint);

// As what a model's predictions are shown: "model2", and without a part "model2-text".
std::string shown_name(const Checkpoint& checkpoint);

// Those that `predict` writes, still without features and items.
Predictions empty_predictions(const std::string& model, const CorpusIndex& corpus, Split split);

// Numbers that training changes, by their tensor: of the job's "checkpoint" as its file holds them, or else of the
// model. Throws Error if the file is not the model's.
using ParameterCounts = std::map<std::string, std::int64_t>;
ParameterCounts count_parameters(const torch::nn::Module& model, const JsonValue& job);
// Of all tensors whose names begin so.
std::int64_t sum_of(const ParameterCounts& counts, std::string_view beginning = "");

}  // namespace chironomia
