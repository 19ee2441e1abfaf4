// Where the tensors of a safetensors file lie, without libtorch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

enum class TensorType { f32, f16, bf16, i64 };

struct TensorPlace {
    std::string name;
    TensorType type = TensorType::f32;
    std::vector<std::int64_t> shape;
    std::span<const std::byte> bytes;  // of the file; as many as type and shape say
};

// The tensors of a whole file in the order of their places, which fill it without a gap. `bytes` must outlive them.
// Throws Error as read_safetensors; `file` is for messages.
std::vector<TensorPlace> tensor_places(std::span<const std::byte> bytes, const std::filesystem::path& file);

using TensorShapes = std::map<std::string, std::vector<std::int64_t>>;  // by name

// Of a file's header, without reading its numbers. Throws Error as read_safetensors.
TensorShapes read_tensor_shapes(const std::filesystem::path& file);

// Throws Error with `file` if there is no tensor of that name or its shape is not `shape`.
void check_shape(const TensorShapes& shapes, const std::string& name, std::span<const std::int64_t> shape,
                 const std::filesystem::path& file);

}  // namespace chironomia
