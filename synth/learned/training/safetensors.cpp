#include "synth/learned/training/safetensors.h"

#include <bit>
#include <cstring>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "synth/learned/training/safetensors_layout.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little);

torch::ScalarType type_of(const TensorPlace& place) {
    switch (place.type) {
        case TensorType::f16:
            return torch::kFloat16;
        case TensorType::bf16:
            return torch::kBFloat16;
        case TensorType::i64:
            return torch::kInt64;
        default:
            return torch::kFloat32;
    }
}

torch::Tensor tensor_at(const TensorPlace& place) {
    torch::Tensor tensor = torch::empty(place.shape, type_of(place));
    if (!place.bytes.empty()) std::memcpy(tensor.data_ptr(), place.bytes.data(), place.bytes.size());
    return place.type == TensorType::i64 ? tensor : tensor.to(torch::kFloat32);
}

}  // namespace

void write_safetensors(const fs::path& file, const Tensors& tensors) {
    Json header = Json::object();
    std::string payload;
    for (const auto& [name, given] : tensors) {
        const bool is_integer = given.scalar_type() == torch::kInt64;
        const torch::Tensor tensor =
            given.detach().to(is_integer ? torch::kInt64 : torch::kFloat32).contiguous();
        const std::size_t begin = payload.size();
        payload.append(static_cast<const char*>(tensor.data_ptr()), tensor.nbytes());
        header[name] = {{"dtype", is_integer ? "I64" : "F32"},
                        {"shape", tensor.sizes().vec()},
                        {"data_offsets", {begin, payload.size()}}};
    }
    std::string text = header.dump();
    text.resize((text.size() + 7) / 8 * 8, ' ');  // numbers begin at a multiple of their size
    const std::uint64_t length = text.size();
    std::string bytes(sizeof length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    write_text(file, bytes + text + payload);
}

Tensors read_safetensors(const fs::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    Tensors tensors;
    for (const TensorPlace& place : tensor_places(bytes, file)) tensors[place.name] = tensor_at(place);
    return tensors;
}

const torch::Tensor& find_tensor(const Tensors& tensors, const std::string& name, torch::IntArrayRef shape,
                                 const fs::path& file) {
    const auto found = tensors.find(name);
    TensorShapes shapes;
    if (found != tensors.end()) shapes[name] = found->second.sizes().vec();
    check_shape(shapes, name, shape, file);
    return found->second;
}

}  // namespace chironomia
