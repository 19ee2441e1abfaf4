// Baselines for predictions: hold, mean.
#pragma once

#include <string>
#include <vector>

#include "synth/corpus/corpus.h"
#include "synth/predictions.h"

namespace chironomia::study {

// "hold", "mean"
const std::vector<std::string>& baseline_names();

// Throws Error if a baseline cannot be made of a corpus of this kind: means are those of faces.
void check_baseline(const std::string& name, const CorpusIndex& corpus);

// For the same records as `of`:
//   hold   what the person did half a second before
//   mean   always the mean of the corpus's training records
// Throws Error as check_baseline() and reading these do, or if the training records lack a feature.
Predictions baseline(const std::string& name, const Predictions& of, const CorpusIndex& corpus);

}  // namespace chironomia::study
