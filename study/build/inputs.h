// The files a study is made from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/plan/plan.h"

namespace chironomia::study {

struct InputFile {
    std::string path;  // as in the plan; of a bundled file its path in the source tree
    std::string sha256;
    std::uint64_t bytes = 0;
};

// Every file that the plan names, once each, in the order of the plan.
// Throws Error if one cannot be read.
std::vector<InputFile> list_inputs(const Plan& plan);

}  // namespace chironomia::study
