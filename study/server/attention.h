// Attention checks: pages whose instruction tells the one right answer.
#pragma once

#include <cstddef>
#include <vector>

#include "core/json.h"
#include "study/study_key.h"
#include "study/study_pages.h"

namespace chironomia {

// An expected value of the key, told as if the videos stood in the order of pages.json, as it must be
// answered when they stand in `order`: what names a side is mirrored, and what has an entry for each video is
// permuted.
Json expected_as_shown(const AskedQuestion& question, const Json& expected,
                       const std::vector<std::size_t>& order);

// Whether an answer, an entry of `answers`, fails: a check with another value than the expected one, or a
// page that was answered faster than the key allows.
bool fails_attention(const StudyPages& study, const StudyKey& key, const Step& step, const Json& entry);

}  // namespace chironomia
