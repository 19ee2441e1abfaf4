// A posed avatar as rays meet it: all surfaces in one list of triangles, at one or several moments, with what
// they are made of.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "core/body/avatar.h"
#include "raster/embree/ray_texture.h"

namespace chironomia {

// Which rays triangles stop; those of one kind follow each other in RayFigure::triangles.
enum class Opacity {
    opaque,       // camera rays and shadow rays
    masked,       // both where the alpha of a texture does not cut the surface out
    camera_only,  // blended, or unlit without a skin: seen, but casts no shadow
    count
};
inline constexpr size_t kOpacities = static_cast<size_t>(Opacity::count);

struct RayMaterial {
    Material material;
    // Null: none.
    const RayTexture* base_colour = nullptr;
    const RayTexture* normal = nullptr;
    const RayTexture* metallic_roughness = nullptr;
    const RayTexture* occlusion = nullptr;
    const RayTexture* emissive = nullptr;
    const RayTexture* anisotropy = nullptr;
};

// Where a ray meets a triangle: corner weights are 1 - u - v, u, v.
struct TrianglePlace {
    std::uint32_t triangle = 0;
    float u = 0;
    float v = 0;
};

// The vertices of all surfaces, one after the other.
struct RayMoment {
    std::vector<Vec3> positions;  // (V + 1) [m]; Embree reads past the last one
    std::vector<Vec3> normals;    // (V)
    std::vector<Vec4> tangents;   // (V), zero where a surface has none
};

struct RayFigure {
    explicit RayFigure(const Avatar& avatar);

    // `exposure` holds the surfaces of the avatar at even distances in time.
    void move_to(std::span<const PosedMesh> exposure);

    const RayMaterial& material_at(std::uint32_t triangle) const { return materials[material_of[triangle]]; }
    Vec2 uv_at(const TrianglePlace& place) const;
    // Base colour with texture and vertex colours; `width` of the patch that is seen [m].
    Vec4 base_at(const TrianglePlace& place, float log2_width) const;
    // By the finest texels: the samples of a pixel together find the share of it that is there.
    bool is_cut_out(const TrianglePlace& place) const;
    // The binary logarithm of the width of a patch in texture coordinates, from that in metres.
    float log2_uv_width(std::uint32_t triangle, float log2_width) const {
        return log2_width + log2_uv_per_metre[triangle];
    }

    std::vector<std::uint32_t> triangles;                  // (F, 3)
    std::array<std::uint32_t, kOpacities + 1> first_of{};  // by Opacity: its first triangle
    std::vector<std::uint32_t> material_of;                // (F)
    std::vector<float> log2_uv_per_metre;  // (F) how large the texture is drawn, in the rest shape
    std::vector<RayMaterial> materials;    // one per surface
    std::vector<Vec2> uvs;                 // (V), zero where a surface has none
    std::vector<Vec4> colours;             // (V), white where a surface has none
    RayMoment rest;                        // the avatar as it stands in its file
    std::vector<RayMoment> moments;        // of the exposure

  private:
    using TextureKey = std::tuple<int, Wrap, Wrap, bool, TextureKind>;

    const RayTexture* texture_for(const Avatar& avatar, const Texture& use, TextureKind kind);
    RayMaterial material_for(const Avatar& avatar, const Surface& surface);

    std::map<TextureKey, std::unique_ptr<RayTexture>> textures_;
};

// The mean of a value at the corners of a triangle, weighted for a place on it.
template <typename Value>
Value between_corners(const RayFigure& figure, const std::vector<Value>& values, const TrianglePlace& place) {
    const std::uint32_t* corner = figure.triangles.data() + 3 * static_cast<size_t>(place.triangle);
    return (1 - place.u - place.v) * values[corner[0]] + place.u * values[corner[1]] +
           place.v * values[corner[2]];
}

}  // namespace chironomia
