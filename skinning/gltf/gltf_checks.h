// Values that are refused in a glTF file, although it could be read with them: it would be shown wrongly.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/body/avatar.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/gltf/gltf_material.h"

namespace tinygltf {
struct Accessor;
}

namespace chironomia {

// Throws Error for an index, offset or count that is no whole number of at least 0, a transform or a factor that is no
// list of numbers or out of range, and a mode, filter or wrapping that glTF 2.0 does not have.
void check_json(const GltfFile& file);

// Throws Error if an attribute ("POSITION", "WEIGHTS_0") has components of a type that it may not have: section 3.7.2.1
// of the specification of glTF 2.0, and KHR_mesh_quantization where the file uses it.
void check_attribute_type(const GltfFile& file, const tinygltf::Accessor& accessor,
                          std::string_view attribute, const std::string& what);

// Throws Error if the numbers of an accessor lie elsewhere than its "min" and "max" say, as they do when its offset is
// wrong. Of floats alone; by more than 5 % of the longest side (ours: compression moves vertices by less).
void check_bounds(const GltfFile& file, const tinygltf::Accessor& accessor, std::span<const float> numbers,
                  const std::string& what);

// Throws Error if no inverse bind matrix can be so: it is flat, or its last row is not 0 0 0 1.
void check_inverse_bind(const GltfFile& file, const Mat4& matrix, const std::string& what);

// Throws Error for a weight of a vertex below 0 or above 1.
void check_weights(const GltfFile& file, std::span<const float> weights, const std::string& what);

// Throws Error if the material of a surface has a texture that reads a set of coordinates that the surface lacks.
void check_uvs(const GltfFile& file, const Surface& surface, const MaterialSet& materials,
               const std::string& what);

}  // namespace chironomia
