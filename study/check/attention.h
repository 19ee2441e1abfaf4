// Whether a participant can find the attention checks without watching. For check.cpp alone.
#pragma once

#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia::study {

// Uses only what `study serve` sends to a participant, for each sheet.
Proof check_attention(const StudyRecord& study);

}  // namespace chironomia::study
