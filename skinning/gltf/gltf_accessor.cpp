#include "skinning/gltf/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr size_t kMostNumbers = 200'000'000;  // of one file, all accessors together
constexpr size_t kMostZeros = 4'000'000;      // elements of an accessor that has no bytes of its own

size_t component_bytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

size_t component_count(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
        case TINYGLTF_TYPE_MAT2:
            return 4;
        case TINYGLTF_TYPE_MAT3:
            return 9;
        case TINYGLTF_TYPE_MAT4:
            return 16;
        default:
            return 0;
    }
}

template <typename Stored>
Stored load(const std::uint8_t* at) {
    Stored value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

template <typename Number, typename Stored>
Number convert(Stored stored, bool normalized) {
    if constexpr (std::is_same_v<Number, float>) {
        const float value = static_cast<float>(stored);
        if constexpr (std::is_integral_v<Stored>) {
            constexpr float kLargest = static_cast<float>(std::numeric_limits<Stored>::max());
            if (normalized) return std::max(value / kLargest, -1.0f);
        }
        return value;
    } else {
        return static_cast<Number>(stored);
    }
}

// The numbers of `count` elements that begin `stride` bytes apart.
struct Layout {
    const std::uint8_t* first = nullptr;
    size_t stride = 0;
    size_t components = 0;
    bool normalized = false;
};

template <typename Number, typename Stored>
void copy_elements(const Layout& layout, std::span<Number> numbers) {
    for (size_t n = 0, element = 0; n < numbers.size(); ++element) {
        const std::uint8_t* at = layout.first + element * layout.stride;
        for (size_t c = 0; c < layout.components; ++c, ++n)
            numbers[n] = convert<Number>(load<Stored>(at + c * sizeof(Stored)), layout.normalized);
    }
}

template <typename Number>
void copy_elements(int type, const Layout& layout, std::span<Number> numbers) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return copy_elements<Number, std::int8_t>(layout, numbers);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return copy_elements<Number, std::uint8_t>(layout, numbers);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return copy_elements<Number, std::int16_t>(layout, numbers);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return copy_elements<Number, std::uint16_t>(layout, numbers);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return copy_elements<Number, std::uint32_t>(layout, numbers);
        default:
            return copy_elements<Number, float>(layout, numbers);
    }
}

// A place in a buffer view where `count` elements of `bytes` bytes must fit.
struct Extent {
    long long view = -1;
    std::uint64_t offset = 0;
    size_t count = 0;
    size_t bytes = 0;
    size_t component = 1;  // bytes of one component
    bool packed = false;   // ignores the stride of the view
};

struct Region {
    const std::uint8_t* first = nullptr;
    size_t stride = 0;
};

Region find_region(const GltfFile& file, const tinygltf::Model& model, const Extent& extent,
                   const std::string& what) {
    if (extent.view < 0 || extent.view >= static_cast<long long>(model.bufferViews.size())) {
        refuse(file, format("{} is in buffer view {}, there are {}; the file is broken, get it again", what,
                            extent.view, model.bufferViews.size()));
    }
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(extent.view)];
    if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= file.buffers.size()) {
        refuse(file, format("{} is in buffer {}, there are {}; the file is broken, get it again", what,
                            view.buffer, file.buffers.size()));
    }
    const Bytes& buffer = file.buffers[static_cast<size_t>(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
        refuse(file,
               format("{} is in buffer view {}, which ends at byte {} of a buffer of {}; the file is cut off "
                      "or broken, get it again",
                      what, extent.view, view.byteOffset + view.byteLength, buffer.size()));
    }
    const size_t stride = extent.packed || view.byteStride == 0 ? extent.bytes : view.byteStride;
    if (stride < extent.bytes) {
        refuse(file, format("{} has elements of {} bytes, {} apart; the file is broken, get it again", what,
                            extent.bytes, stride));
    }
    if ((view.byteOffset + extent.offset) % extent.component != 0) {
        refuse(
            file,
            format(
                "{} has components of {} bytes and begins at byte {}, which is no multiple; the file is broken, get it again",
                what, extent.component, view.byteOffset + extent.offset));
    }
    const bool fits = extent.count == 0 ||
                      (extent.offset <= view.byteLength && extent.bytes <= view.byteLength - extent.offset &&
                       extent.count - 1 <= (view.byteLength - extent.offset - extent.bytes) / stride);
    if (!fits) {
        refuse(
            file,
            format("{} has {} elements of {} bytes from byte {} on, and buffer view {} has {}; the file is "
                   "cut off or broken, get it again",
                   what, extent.count, extent.bytes, extent.offset, extent.view, view.byteLength));
    }
    return {buffer.data() + view.byteOffset + extent.offset, stride};
}

}  // namespace

struct Accessors::Source {
    const tinygltf::Accessor& accessor;
    size_t component_bytes = 0;
};

Accessors::Source Accessors::source(int index, size_t components, const std::string& what) {
    const size_t elements = count(index, what);
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<size_t>(index)];
    const size_t bytes = component_bytes(accessor.componentType);
    if (bytes == 0 || component_count(accessor.type) != components) {
        refuse(file_,
               format("{} has {} components of type {}, {} are needed; the file is broken, get it again",
                      what, component_count(accessor.type), accessor.componentType, components));
    }
    if (accessor.bufferView < 0 && elements > kMostZeros) {
        refuse(file_,
               format("{} has {} elements and no data, at most {} are read; the file is broken, get it again",
                      what, elements, kMostZeros));
    }
    spend(std::min(elements, kMostNumbers + 1) * components);
    return {accessor, bytes};
}

void Accessors::spend(size_t numbers) {
    spent_ += numbers;
    if (spent_ > kMostNumbers) {
        refuse(file_,
               format("holds more than {} million numbers; use a smaller model", kMostNumbers / 1'000'000));
    }
}

size_t Accessors::count(int index, const std::string& what) const {
    if (index < 0 || static_cast<size_t>(index) >= model_.accessors.size()) {
        refuse(file_, format("{} is accessor {}, there are {}; the file is broken, get it again", what, index,
                             model_.accessors.size()));
    }
    return model_.accessors[static_cast<size_t>(index)].count;
}

size_t Accessors::components(int index, const std::string& what) const {
    count(index, what);
    return component_count(model_.accessors[static_cast<size_t>(index)].type);
}

// The elements that the sparse part of an accessor names are replaced by its values.
template <typename Number>
void Accessors::replace_sparse(const tinygltf::Accessor& accessor, size_t components, const std::string& what,
                               std::span<Number> numbers) {
    const size_t element_bytes = component_bytes(accessor.componentType) * components;
    const auto& sparse = accessor.sparse;
    const size_t changed = sparse.count < 0 ? 0 : static_cast<size_t>(sparse.count);
    const size_t index_bytes = component_bytes(sparse.indices.componentType);
    if (index_bytes == 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        refuse(file_, format("{} has broken sparse indices; get the file again", what));
    const Region at = find_region(file_, model_,
                                  {.view = sparse.indices.bufferView,
                                   .offset = static_cast<std::uint64_t>(sparse.indices.byteOffset),
                                   .count = changed,
                                   .bytes = index_bytes,
                                   .component = index_bytes,
                                   .packed = true},
                                  what);
    const Region from = find_region(file_, model_,
                                    {.view = sparse.values.bufferView,
                                     .offset = static_cast<std::uint64_t>(sparse.values.byteOffset),
                                     .count = changed,
                                     .bytes = element_bytes,
                                     .component = component_bytes(accessor.componentType),
                                     .packed = true},
                                    what);
    spend(changed * (components + 1));
    std::vector<std::uint32_t> where(changed);
    copy_elements<std::uint32_t>(sparse.indices.componentType, {at.first, at.stride, 1, false}, where);
    std::vector<Number> values(changed * components);
    copy_elements<Number>(accessor.componentType, {from.first, from.stride, components, accessor.normalized},
                          values);
    for (size_t i = 0; i < changed; ++i) {
        if (where[i] >= accessor.count) {
            refuse(file_, format("{} replaces element {} of {}; the file is broken, get it again", what,
                                 where[i], accessor.count));
        }
        if (i > 0 && where[i] <= where[i - 1]) {
            refuse(file_,
                   format("{} replaces element {} after element {}, and they are to ascend; the file is "
                          "broken, get it again",
                          what, where[i], where[i - 1]));
        }
        std::copy_n(&values[i * components], components, &numbers[where[i] * components]);
    }
}

template <typename Number>
std::vector<Number> Accessors::read(int index, size_t components, const std::string& what) {
    const auto [accessor, bytes] = source(index, components, what);
    const size_t element_bytes = bytes * components;

    // Without a buffer view the elements are zeros, for a sparse part to fill.
    Layout layout{.first = nullptr, .stride = 0, .components = components, .normalized = accessor.normalized};
    if (accessor.bufferView >= 0) {
        const Region region = find_region(file_, model_,
                                          {.view = accessor.bufferView,
                                           .offset = accessor.byteOffset,
                                           .count = accessor.count,
                                           .bytes = element_bytes,
                                           .component = bytes},
                                          what);
        layout.first = region.first;
        layout.stride = region.stride;
    }
    std::vector<Number> numbers(accessor.count * components);
    if (layout.first) copy_elements<Number>(accessor.componentType, layout, numbers);
    if (!accessor.sparse.isSparse) return numbers;

    replace_sparse<Number>(accessor, components, what, numbers);
    return numbers;
}

std::vector<float> Accessors::floats(int accessor, size_t components, const std::string& what) {
    std::vector<float> numbers = read<float>(accessor, components, what);
    for (size_t n = 0; n < numbers.size(); ++n) {
        if (!std::isfinite(numbers[n])) {
            refuse(file_, format("{} is {} at element {}, a finite number is needed; repair the model", what,
                                 numbers[n], n / components));
        }
    }
    return numbers;
}

std::vector<std::uint32_t> Accessors::integers(int accessor, size_t components, const std::string& what) {
    count(accessor, what);
    const int type = model_.accessors[static_cast<size_t>(accessor)].componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        refuse(
            file_,
            format("{} has components of type {}, unsigned integers are needed; the file is broken, get it "
                   "again",
                   what, type));
    }
    return read<std::uint32_t>(accessor, components, what);
}

}  // namespace chironomia
