// The job "encode" of synth/learning.h: words to vectors by BERT.
#pragma once

#include "core/files/json_value.h"

namespace chironomia {

// Throws Error for what is wrong with the job, the weights or the vocabulary.
Json encode_words(const JsonValue& job);

}  // namespace chironomia
