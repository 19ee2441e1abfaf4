// AMII's attention with its gradient. torch writes every weight of every head of a batch into memory, several
// times; this keeps those of one query at a time.
#pragma once

#include <torch/types.h>

namespace chironomia {

// What two heads of 8 see: (B, T, 16) queries, already scaled, of keys and values (B, S, 16).
torch::Tensor attended(const torch::Tensor& query, const torch::Tensor& key, const torch::Tensor& value);

}  // namespace chironomia
