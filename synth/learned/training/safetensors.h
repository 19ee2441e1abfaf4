// Tensors by name in a file of the safetensors format: eight bytes of length, a JSON header with each
// tensor's type, shape and place, then the numbers. Nothing in such a file is ever executed.
// Format: the section "Format" of the README of huggingface/safetensors.
#pragma once

#include <torch/types.h>

#include <filesystem>
#include <map>
#include <string>

namespace chironomia {

using Tensors = std::map<std::string, torch::Tensor>;  // by name

// Floats and 64-bit integers; the same tensors give the same bytes. Whole or not at all.
// Throws Error if the file cannot be written.
void write_safetensors(const std::filesystem::path& file, const Tensors& tensors);

// F16 and BF16 become floats; other types than these, F32 and I64 are refused. Memory is used for what the
// file really holds.
// Throws Error with the file and the tensor if the file is truncated or too long, its header is no header,
// two tensors overlap, a tensor lies outside, or its size and its shape disagree.
Tensors read_safetensors(const std::filesystem::path& file);

// The tensor of that name. Throws Error with `file` if there is none or its shape is not `shape`.
const torch::Tensor& find_tensor(const Tensors& tensors, const std::string& name, torch::IntArrayRef shape,
                                 const std::filesystem::path& file);

}  // namespace chironomia
