// Which participants are excluded, and why.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/analysis/dataset.h"

namespace chironomia::study::analysis {

enum class Strictness { strict, lenient };

const char* to_text(Strictness strictness);

// For each rater the reason why the answers do not count; empty: they count. The strict rule excludes raters with at
// least "failed_checks" (of the key) failed checks, and raters who did not finish. The lenient rule excludes raters
// with at least "lenient_failed_checks". A page of which a pass (one of its repetitions) was answered faster than
// "fastest_seconds" is a failed check too. A page counts once, however many of its passes failed. Both rules exclude
// raters who answered nothing.
std::vector<std::string> reasons_to_exclude(const Dataset& data, Strictness strictness);

// The data without the preferences, scores and choices of raters who have a reason. All rows and raters stay, so that
// the indices of raters stay valid.
Dataset without_excluded(const Dataset& data, const std::vector<std::string>& reasons);

}  // namespace chironomia::study::analysis
