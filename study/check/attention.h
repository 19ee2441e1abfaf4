// Whether a participant can find the attention checks without watching. For check.cpp alone.
#pragma once

#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia {

// By what `study serve` gives to a participant of each sheet.
Proof check_attention(const StudyRecord& study);

}  // namespace chironomia
