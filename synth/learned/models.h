// The learned models that chironomia_learn knows, and what it can be asked about each: the jobs of
// synth/learning.h.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "core/json_value.h"

namespace chironomia {

// Each function answers a job of that verb, and throws Error for what is wrong with it.
struct LearnedModel {
    using Answer = std::function<Json(const JsonValue& job)>;

    std::string name;  // "amii"
    Answer train;
    Answer predict;
    Answer animate;
    Answer describe;
};

std::span<const LearnedModel> learned_models();

// The model that a job is about, by its "model" or that of its "checkpoint".
// Throws Error if the job has neither, or no model has that name.
const LearnedModel& model_of(const JsonValue& job);

// What chironomia_learn answers. Throws Error for what is wrong with the job.
Json answer(const Json& job);

}  // namespace chironomia
