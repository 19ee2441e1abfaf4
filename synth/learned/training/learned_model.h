// One learned model, as the jobs of synth/learning.h ask it.
#pragma once

#include <functional>
#include <string>

#include "core/files/json_value.h"

namespace chironomia {

// Each function answers a job of that verb, and throws Error for what is wrong with it.
struct LearnedModel {
    using Answer = std::function<Json(const JsonValue& job)>;

    std::string name;  // "amii"
    Answer train;
    Answer predict;
    Answer animate;
    Answer describe;
    Answer encode_styles = {};  // of models of style alone
};

}  // namespace chironomia
