// How a rasterizer lights a figure: which surfaces can carry light and shadow at their vertices, and the shadows
// of each frame. The same for every rasterizer, so that they draw the same picture.
#pragma once

#include <compare>
#include <optional>
#include <span>
#include <vector>

#include "core/body/avatar.h"
#include "core/render/frame.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/rectangle.h"
#include "raster/studio/soft_shadow.h"

namespace chironomia {

inline constexpr int kMostLights = 8;
inline constexpr int kShadowMapSide = 768;  // [texels]

// Throws Error if a side is not in 1..8192.
void require_drawable(RenderSize size);

// Where light and shadow are worked out.
enum class Lighting { vertices, vertices_but_shadow, pixels_by_vertex_shadow, pixels };

// What a surface needs beyond the plain material; a feature that is off costs nothing.
struct SurfaceFeatures {
    int lights = 0;
    bool per_vertex = false;    // light is worked out at the vertices; for fine meshes without metal
    bool pixel_shadow = false;  // shadow and tone are worked out at the pixels even so
    bool shadow = false;        // of the first light
    bool base_colour_map = false;
    bool normal_map = false;
    bool metallic_roughness_map = false;
    bool occlusion_map = false;
    bool emissive_map = false;
    bool vertex_colour = false;
    bool coated = false;
    bool anisotropic = false;
    bool anisotropy_map = false;
    bool scattering = false;
    bool unlit = false;
    bool cut_out = false;  // alpha mask
    bool translucent = false;
    bool double_sided = false;

    bool textured() const {
        return base_colour_map || normal_map || metallic_roughness_map || occlusion_map || emissive_map ||
               anisotropy_map;
    }
    // Without anything that varies between vertices their colour can be finished there.
    bool finished() const {
        return per_vertex && !pixel_shadow && !textured() && !vertex_colour && !translucent && !cut_out;
    }
    // Lit at the vertices for both of its sides.
    bool lit_on_both_sides() const { return cut_out && double_sided; }

    auto operator<=>(const SurfaceFeatures&) const = default;
};

struct LitSurface {
    Material material;
    Lighting lighting = Lighting::pixels;
    float coarseness = 0;  // mean edge [m]
    SurfaceFeatures features;
    std::vector<float> ambient_occlusion;  // (V) of ambient_occlusion_of
};

// The values that a pixel needs to look for the shadow on it.
struct PixelShadow {
    Mat4 map_from_world{1};
    float extent = 1;  // side of the map [m]
    float range = 1;   // depth of the map [m]
    float offset = 0;  // along the normal [m]
    float bias = 0;    // in depth
    float least = 0;   // radius of the sharpest edge [m]
    float wide = 0;    // radius from which shadows are smooth enough to be known at the vertices [m]
};

class FigureLight {
  public:
    // Throws Error if the size is not in 1..8192, or the scene asks for more than 8 lights or 1 shadow.
    // What is worked out for each frame is shared by `threads` (0: all cores), and the same for any number.
    FigureLight(const Avatar& avatar, const Scene& scene, RenderSize size, int threads);

    const Scene& scene() const { return scene_; }  // the light with the shadow comes first
    RenderSize size() const { return size_; }
    const std::vector<LitSurface>& surfaces() const { return surfaces_; }    // as Avatar::surfaces
    const std::vector<size_t>& outer_first() const { return outer_first_; }  // indices of them
    Vec3 ahead() const { return normalize(scene_.camera.target - scene_.camera.eye); }

    bool has_shadow() const { return !scene_.lights.empty() && scene_.lights.front().casts_shadow; }
    // Where vertices are too far apart to find shadows, every pixel searches for them.
    VertexShadow shadow_at_pixels() const;
    // (V), or empty where `shadow_at_pixels` holds for each vertex. Of `vertices` alone, if they are given.
    std::vector<VertexShadow> shadow_at_vertices(
        const LitSurface& surface, const PosedSurface& posed, const DepthMap& depth,
        std::optional<std::span<const std::uint32_t>> vertices = {}) const;
    PixelShadow pixel_shadow_of(const LitSurface& surface, const DepthMap& depth) const;

    // The depth map of the key light, if it casts a shadow; the floor of `frame` is darkened by it. With
    // `whole_frame` every pixel of the floor is looked at: the same bytes, slower.
    std::optional<DepthMap> cast_shadow(const PosedMesh& mesh, Frame& frame, bool whole_frame = false) const;
    // The pixels that the figure may touch.
    Rectangle area_of(const PosedMesh& mesh) const;

  private:
    float body() const;  // 1 for a figure of 1.7 m
    // Its spread is the tangent of the key light's angle; its radii grow with the figure.
    Penumbra penumbra_on(const LitSurface& surface) const;
    LitSurface lit(const Avatar& avatar, const Surface& surface, const PosedSurface& rest,
                   std::vector<float> ambient_occlusion) const;

    Scene scene_;
    RenderSize size_;
    int threads_ = 1;
    ShadowCaster caster_;
    float extent_ = 2.5f;  // of the shadow map [m]
    std::vector<LitSurface> surfaces_;
    std::vector<size_t> outer_first_;
};

}  // namespace chironomia
