// Builds a study again from its plan and compares both. For check.cpp alone.
#pragma once

#include <optional>

#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia::study {

// Open without `again`. Throws Error if the plan or an input of it is wrong.
Proof check_built_again(const StudyRecord& study, const std::optional<StudySource>& again);

}  // namespace chironomia::study
