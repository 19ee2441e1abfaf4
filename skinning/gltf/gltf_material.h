// Materials and images of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "core/body/avatar.h"
#include "skinning/gltf/gltf_file.h"

namespace chironomia {

// Where the textures of a material read: one set of texture coordinates and one transform serves them all.
struct UvUse {
    int set = 0;  // TEXCOORD_n
    Vec2 offset{0};
    float rotation = 0;  // [rad], counter-clockwise
    Vec2 scale{1};

    bool operator==(const UvUse&) const = default;
};

struct MaterialSet {
    std::vector<Material> materials;
    std::vector<UvUse> uv_uses;  // (M)
    std::vector<Image> images;   // those that materials use
    std::vector<std::string> notes;
};

// Textures that read from other coordinates than the base colour are left out, with a note.
// Throws Error if an image that a material uses is missing, is no PNG, JPEG or WebP, or is too large.
MaterialSet read_materials(const GltfFile& file, const tinygltf::Model& model);

// 8-bit RGBA of a PNG, JPEG or WebP of any depth. Throws Error if it is none of them, is broken or has a side above
// 8192.
Image decode_image(const GltfFile& file, const EncodedImage& encoded);

}  // namespace chironomia
