// The learned models that chironomia_learn knows, and what it can be asked about each: the jobs of
// synth/learning.h.
#pragma once

#include <span>
#include <string>

#include "core/files/json_value.h"
#include "synth/learned/training/learned_model.h"

namespace chironomia {

std::span<const LearnedModel> learned_models();

// The model that a job is about, by its "model" or that of its "checkpoint".
// Throws Error if the job has neither, or no model has that name.
const LearnedModel& model_of(const JsonValue& job);

// What chironomia_learn answers. Throws Error for what is wrong with the job.
Json answer(const Json& job);

}  // namespace chironomia
