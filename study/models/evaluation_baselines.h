// Baselines for predictions: hold, mean.
#pragma once

#include <string>
#include <vector>

#include "synth/corpus/corpus.h"
#include "synth/predictions.h"

namespace chironomia::study {

// "hold", "mean"
const std::vector<std::string>& baseline_names();

// For the same records as `of`:
//   hold   what the person did half a second before
//   mean   always the mean of the corpus's training records
// Throws Error as reading these does, or if the corpus is none of talks or dyads.
Predictions baseline(const std::string& name, const Predictions& of, const CorpusIndex& corpus);

}  // namespace chironomia::study
