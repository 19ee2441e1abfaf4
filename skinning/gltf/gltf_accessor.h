// The numbers behind a glTF accessor, of any type and layout, every index checked.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "skinning/gltf/gltf_file.h"

namespace chironomia {

class Accessors {
  public:
    Accessors(const GltfFile& file, const tinygltf::Model& model) : file_(file), model_(model) {}

    // Number of elements. Throws Error if there is no such accessor; `what` says whose it is.
    size_t count(int accessor, const std::string& what) const;
    // Number of components of an element: 3 for VEC3.
    size_t components(int accessor, const std::string& what) const;

    // (count, components), normalised integers as [0, 1] or [-1, 1].
    // Throws Error if the data is not there, has other components, or holds a number that is not finite.
    std::vector<float> floats(int accessor, size_t components, const std::string& what);
    // (count, components). Throws Error if the components are no unsigned integers.
    std::vector<std::uint32_t> integers(int accessor, size_t components, const std::string& what);

    const GltfFile& file() const { return file_; }

  private:
    struct Source;
    Source source(int accessor, size_t components, const std::string& what);
    template <typename Number>
    std::vector<Number> read(int accessor, size_t components, const std::string& what);
    template <typename Number>
    void replace_sparse(const tinygltf::Accessor& accessor, size_t components, const std::string& what,
                        std::span<Number> numbers);
    void spend(size_t numbers);

    const GltfFile& file_;
    const tinygltf::Model& model_;
    size_t spent_ = 0;  // numbers read so far: a small file must not ask for gigabytes
};

}  // namespace chironomia
