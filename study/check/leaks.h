// Whether a condition can be predicted without a look at the pictures. For check.cpp alone.
#pragma once

#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia {

// By names, sizes, tables of the files, and places in lists and orders.
Proof check_prediction(const StudyRecord& study);

}  // namespace chironomia
