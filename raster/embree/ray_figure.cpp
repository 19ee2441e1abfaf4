#include "raster/embree/ray_figure.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/body/rest.h"

namespace chironomia {
namespace {

// As shadow_caster_of.
Opacity opacity_of(const Surface& surface, const Material& material) {
    if (material.alpha_mode == AlphaMode::blend || (material.unlit && surface.skin < 0))
        return Opacity::camera_only;
    return material.alpha_mode == AlphaMode::mask ? Opacity::masked : Opacity::opaque;
}

// Texture coordinates per metre along a side of the triangle; a triangle without area shows one point.
float log2_uv_per_metre(const std::array<Vec3, 3>& corners, const std::array<Vec2, 3>& uvs) {
    const float area = length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const Vec2 p = uvs[1] - uvs[0], q = uvs[2] - uvs[0];
    const float uv_area = std::abs(p.x * q.y - p.y * q.x);
    return 0.5f * std::log2(std::max(uv_area, 1e-12f) / std::max(area, 1e-12f));
}

template <typename Value>
void append(std::vector<Value>& all, const std::vector<Value>& part, size_t count, const Value& otherwise) {
    if (part.empty()) {
        all.resize(all.size() + count, otherwise);
    } else {
        all.insert(all.end(), part.begin(), part.end());
    }
}

RayMoment moment_of(const PosedMesh& mesh) {
    RayMoment moment;
    for (const PosedSurface& surface : mesh.surfaces) {
        const size_t count = surface.positions.size();
        append(moment.positions, surface.positions, count, Vec3(0));
        append(moment.normals, surface.normals, count, Vec3(0));
        append(moment.tangents, surface.tangents, count, Vec4(0));
    }
    moment.positions.push_back(Vec3(0));
    return moment;
}

}  // namespace

RayFigure::RayFigure(const Avatar& avatar) {
    std::vector<std::uint32_t> first_vertex;
    for (const Surface& surface : avatar.surfaces) {
        first_vertex.push_back(static_cast<std::uint32_t>(uvs.size()));
        append(uvs, surface.uvs, surface.positions.size(), Vec2(0));
        append(colours, surface.colours, surface.positions.size(), Vec4(1));
        materials.push_back(material_for(avatar, surface));
    }
    rest = moment_of(rest_mesh(avatar));
    moments = {rest};

    for (size_t opacity = 0; opacity < kOpacities; ++opacity) {
        first_of[opacity] = static_cast<std::uint32_t>(material_of.size());
        for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
            const Surface& surface = avatar.surfaces[s];
            if (static_cast<size_t>(opacity_of(surface, materials[s].material)) != opacity) continue;
            for (const std::uint32_t vertex : surface.triangles)
                triangles.push_back(first_vertex[s] + vertex);
            material_of.resize(triangles.size() / 3, static_cast<std::uint32_t>(s));
        }
    }
    first_of[kOpacities] = static_cast<std::uint32_t>(material_of.size());

    const std::vector<Vec3>& positions = rest.positions;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const std::uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
        log2_uv_per_metre.push_back(chironomia::log2_uv_per_metre({positions[a], positions[b], positions[c]},
                                                                  {uvs[a], uvs[b], uvs[c]}));
    }
}

const RayTexture* RayFigure::texture_for(const Avatar& avatar, const Texture& use, TextureKind kind) {
    if (use.image < 0) return nullptr;
    auto& texture = textures_[{use.image, use.wrap_u, use.wrap_v, use.smooth, kind}];
    if (!texture) {
        const Image& image = avatar.images[static_cast<size_t>(use.image)];
        texture = std::make_unique<RayTexture>(image, use, kind);
    }
    return texture.get();
}

RayMaterial RayFigure::material_for(const Avatar& avatar, const Surface& surface) {
    RayMaterial made;
    if (surface.material >= 0) made.material = avatar.materials[static_cast<size_t>(surface.material)];
    if (surface.uvs.empty()) return made;
    const Material& material = made.material;
    made.base_colour = texture_for(
        avatar, material.base_colour_texture,
        material.alpha_mode == AlphaMode::opaque ? TextureKind::colour : TextureKind::colour_with_holes);
    if (material.unlit) return made;
    if (!surface.tangents.empty())
        made.normal = texture_for(avatar, material.normal_texture, TextureKind::data);
    made.metallic_roughness = texture_for(avatar, material.metallic_roughness_texture, TextureKind::data);
    made.occlusion = texture_for(avatar, material.occlusion_texture, TextureKind::data);
    made.emissive = texture_for(avatar, material.emissive_texture, TextureKind::colour);
    if (material.anisotropy > 0)
        made.anisotropy = texture_for(avatar, material.anisotropy_texture, TextureKind::data);
    return made;
}

void RayFigure::move_to(std::span<const PosedMesh> exposure) {
    moments.resize(exposure.size());
    for (size_t i = 0; i < exposure.size(); ++i) {
        moments[i] = moment_of(exposure[i]);
        assert(moments[i].normals.size() == uvs.size());
    }
}

Vec2 RayFigure::uv_at(const TrianglePlace& place) const {
    return between_corners(*this, uvs, place);
}

Vec4 RayFigure::base_at(const TrianglePlace& place, float log2_width) const {
    const RayMaterial& material = material_at(place.triangle);
    Vec4 base = material.material.base_colour * between_corners(*this, colours, place);
    if (material.base_colour)
        base *= material.base_colour->at(uv_at(place), log2_uv_width(place.triangle, log2_width));
    return base;
}

bool RayFigure::is_cut_out(const TrianglePlace& place) const {
    const RayMaterial& material = material_at(place.triangle);
    if (material.material.alpha_mode != AlphaMode::mask) return false;
    float alpha = material.material.base_colour.a * between_corners(*this, colours, place).a;
    if (material.base_colour) alpha *= material.base_colour->finest_alpha(uv_at(place));
    return alpha < material.material.alpha_cutoff;
}

}  // namespace chironomia
