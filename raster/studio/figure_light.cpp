#include "raster/studio/figure_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/render/camera.h"
#include "core/text.h"
#include "raster/studio/ambient_occlusion.h"
#include "raster/studio/draw_order.h"
#include "raster/studio/floor_shadow.h"

namespace chironomia {
namespace {

// Mean edges of meshes, up to which (or from which) vertices can carry light and shadow. All numbers down to
// ShadowExtent are ours; these thresholds are by eye.
struct MeshLimits {
    static constexpr float kLightAndShadow = 0.035f;  // up to it vertices can carry light and shadow [m]
    static constexpr float kLight = 0.06f;            // up to it vertices can carry the light alone [m]
    static constexpr float kClothShadow = 0.022f;     // from it shadows on clothes are wrong at vertices [m]
    static constexpr float kShadowSearch = 0.018f;    // up to it vertices show where shadows may lie [m]
    static constexpr float kPixels = 9;               // up to it vertices are as good as pixels [px]
};

// Materials that vertices can carry.
struct PlainMaterial {
    static constexpr float kMostMetallic = 0.01f;   // below it
    static constexpr float kLeastRoughness = 0.4f;  // from it
    static constexpr float kMostCoat = 0.9f;        // below it
};

// Radii of penumbras, for a figure of 1.7 m [m].
struct PenumbraRadii {
    static constexpr float kSharpest = 0.004f;
    static constexpr float kSoftest = 0.08f;
    static constexpr float kAtPixels = 0.006f;    // where no vertex has a better radius
    static constexpr float kAtVertices = 0.016f;  // from it the vertices of a fine mesh show the shadow
    static constexpr float kOverMeanEdge = 1.2f;  // least radius at vertices, over the mean edge
};

// Boxes around head and hands, for a figure of 1.7 m [m].
struct DelicateBoxes {
    static constexpr float kReach = 0.16f;                         // from the middle to a side
    static constexpr float kHeadUp = 0.09f, kHeadForward = 0.02f;  // of the middle, from the joint
    static constexpr float kHandOut = 0.06f, kHandUp = -0.05f;     // of the middle, from the joint
};

// The shadow map.
struct ShadowExtent {
    static constexpr float kOverFigure = 1.3f;  // over height or width of the figure: arms may reach up
    static constexpr float kLeast = 0.1f;       // [m]
    static constexpr float kOfAdult = 2.2f;     // of a figure of 1.7 m [m]
};

// The mean length of an edge, larger triangles counting for more [m].
float coarseness_of(const Surface& surface, const PosedSurface& rest) {
    float length_sum = 0, area_sum = 0;
    for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        const Vec3 a = rest.positions[surface.triangles[i]];
        const Vec3 b = rest.positions[surface.triangles[i + 1]] - a;
        const Vec3 c = rest.positions[surface.triangles[i + 2]] - a;
        const float area = length(cross(b, c));
        length_sum += area * (length(b) + length(c) + length(c - b)) / 3;
        area_sum += area;
    }
    return area_sum > 0 ? length_sum / area_sum : 0;
}

// Light at the vertices is enough for matt surfaces without metal whose triangles are small. Clothes and hair are
// judged in metres, skin in pixels, because it is seen from near. Light at the vertices costs a software rasteriser a
// fraction of light at the pixels.
Lighting lighting_of(const Material& material, float coarseness, float pixels_per_metre) {
    const bool plain = !material.unlit && material.metallic < PlainMaterial::kMostMetallic &&
                       material.roughness >= PlainMaterial::kLeastRoughness &&
                       material.coat < PlainMaterial::kMostCoat && material.normal_texture.image < 0 &&
                       material.metallic_roughness_texture.image < 0 &&
                       material.occlusion_texture.image < 0 && material.anisotropy_texture.image < 0;
    const bool fine = coarseness < MeshLimits::kShadowSearch;
    const bool delicate = material.alpha_mode == AlphaMode::opaque && material.scatter != Vec3(0);
    const bool fine_in_picture = !fine || !delicate || coarseness * pixels_per_metre < MeshLimits::kPixels;
    const bool even = material.alpha_mode == AlphaMode::opaque && material.scatter == Vec3(0);
    if (plain && even && coarseness >= MeshLimits::kClothShadow && coarseness < MeshLimits::kLight)
        return Lighting::vertices_but_shadow;
    if (plain && coarseness < MeshLimits::kLightAndShadow && fine_in_picture) return Lighting::vertices;
    return fine ? Lighting::pixels_by_vertex_shadow : Lighting::pixels;
}

// At the figure.
float pixels_per_metre(const Camera& camera, RenderSize size) {
    const float height = 2 * distance(camera.eye, camera.target) * std::tan(camera.fov_y / 2);
    return static_cast<float>(size.height) / height;
}

// Boxes around the head and the hands in the rest pose, for a figure of `body` times 1.7 m.
std::vector<Bounds> delicate_parts(const Avatar& avatar, float body) {
    using Box = DelicateBoxes;
    const std::vector<Mat4> world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    std::vector<Bounds> parts;
    const auto add = [&](const HumanoidMap& figure, HumanJoint joint, const Vec3& away, float reach) {
        if (!figure.has(joint)) return;
        const Vec3 middle = origin(world[static_cast<size_t>(figure[joint])]) + body * away;
        parts.push_back({.low = middle - body * reach, .high = middle + body * reach});
    };
    std::vector<HumanoidMap> figures = {avatar.humanoid};
    figures.insert(figures.end(), avatar.more_humanoids.begin(), avatar.more_humanoids.end());
    for (const HumanoidMap& figure : figures) {
        add(figure, HumanJoint::head, {0, Box::kHeadUp, Box::kHeadForward}, Box::kReach);
        add(figure, HumanJoint::left_hand, {Box::kHandOut, Box::kHandUp, 0}, Box::kReach);
        add(figure, HumanJoint::right_hand, {-Box::kHandOut, Box::kHandUp, 0}, Box::kReach);
    }
    return parts;
}

// The scene as the renderer uses it: the light with the shadow first.
Scene checked(Scene scene, RenderSize size) {
    require_drawable(size);
    if (scene.lights.size() > kMostLights) {
        throw Error(format("scene: {} lights, at most {} can be drawn; remove some", scene.lights.size(),
                           kMostLights));
    }
    const auto casts = [](const Light& light) { return light.casts_shadow; };
    const auto casters = std::count_if(scene.lights.begin(), scene.lights.end(), casts);
    if (casters > 1) {
        throw Error(
            format("scene: {} lights cast shadows, at most 1 can be drawn; let the key light alone cast one",
                   casters));
    }
    std::stable_partition(scene.lights.begin(), scene.lights.end(), casts);
    return scene;
}

}  // namespace

void require_drawable(RenderSize size) {
    if (size.width >= 1 && size.height >= 1 && size.width <= 8192 && size.height <= 8192) return;
    throw Error(format("picture size: {} x {} pixels, each side must be 1 to 8192", size.width, size.height));
}

FigureLight::FigureLight(const Avatar& avatar, const Scene& scene, RenderSize size, int threads)
    : scene_(checked(scene, size)), size_(size), threads_(threads), caster_(shadow_caster_of(avatar)) {
    const PosedMesh rest = rest_mesh(avatar);
    const Bounds bounds = bounds_of(rest);
    // Room for arms that reach up, so that the grid keeps its scale.
    extent_ =
        ShadowExtent::kOverFigure * std::max(bounds.high.y - bounds.low.y, bounds.high.x - bounds.low.x);
    extent_ = std::max(extent_, ShadowExtent::kLeast);
    auto ambient_occlusion = ambient_occlusion_of(rest, caster_, delicate_parts(avatar, body()));
    outer_first_ = chironomia::outer_first(ambient_occlusion);
    for (size_t i = 0; i < avatar.surfaces.size(); ++i)
        surfaces_.push_back(
            lit(avatar, avatar.surfaces[i], rest.surfaces[i], std::move(ambient_occlusion[i])));
}

float FigureLight::body() const {
    return extent_ / ShadowExtent::kOfAdult;
}

LitSurface FigureLight::lit(const Avatar& avatar, const Surface& surface, const PosedSurface& rest,
                            std::vector<float> ambient_occlusion) const {
    const Material material =
        surface.material >= 0 ? avatar.materials[static_cast<size_t>(surface.material)] : Material{};
    const float coarseness = coarseness_of(surface, rest);
    const Lighting lighting = lighting_of(material, coarseness, pixels_per_metre(scene_.camera, size_));
    const auto has = [&](const Texture& texture) { return !surface.uvs.empty() && texture.image >= 0; };
    const bool is_lit = !material.unlit;
    const bool anisotropic = material.anisotropy > 0 && !surface.tangents.empty() && is_lit;
    return {.material = material,
            .lighting = lighting,
            .coarseness = coarseness,
            .features = {.lights = is_lit ? static_cast<int>(scene_.lights.size()) : 0,
                         .per_vertex =
                             lighting == Lighting::vertices || lighting == Lighting::vertices_but_shadow,
                         .pixel_shadow = lighting == Lighting::vertices_but_shadow,
                         .shadow = is_lit && has_shadow(),
                         .base_colour_map = has(material.base_colour_texture),
                         .normal_map = has(material.normal_texture) && !surface.tangents.empty() && is_lit,
                         .metallic_roughness_map = has(material.metallic_roughness_texture) && is_lit,
                         .occlusion_map = has(material.occlusion_texture) && is_lit,
                         .emissive_map = has(material.emissive_texture) && is_lit,
                         .vertex_colour = !surface.colours.empty(),
                         .coated = material.coat > 0 && is_lit,
                         .anisotropic = anisotropic,
                         .anisotropy_map = has(material.anisotropy_texture) && anisotropic,
                         .scattering = material.scatter != Vec3(0) && is_lit,
                         .unlit = material.unlit,
                         .cut_out = material.alpha_mode == AlphaMode::mask,
                         .translucent = material.alpha_mode == AlphaMode::blend,
                         .double_sided = material.double_sided && is_lit},
            .ambient_occlusion = std::move(ambient_occlusion)};
}

// Vertices cannot show an edge that is sharper than they are dense.
Penumbra FigureLight::penumbra_on(const LitSurface& surface) const {
    const float least = PenumbraRadii::kSharpest * body();
    const float dense =
        surface.lighting == Lighting::vertices ? PenumbraRadii::kOverMeanEdge * surface.coarseness : 0;
    const bool between = surface.lighting == Lighting::vertices_but_shadow;
    return {.spread = std::tan(scene_.lights.front().angle),
            .least = std::max(least, dense),
            .most = (between ? PenumbraRadii::kAtVertices : PenumbraRadii::kSoftest) * body(),
            .around = between ? surface.coarseness : 0};
}

VertexShadow FigureLight::shadow_at_pixels() const {
    return {.visible = 1, .radius = PenumbraRadii::kAtPixels * body()};
}

std::vector<VertexShadow> FigureLight::shadow_at_vertices(
    const LitSurface& surface, const PosedSurface& posed, const DepthMap& depth,
    std::optional<std::span<const std::uint32_t>> vertices) const {
    if (surface.lighting == Lighting::pixels || surface.material.unlit) return {};
    const bool strands = surface.material.alpha_mode == AlphaMode::mask && surface.material.double_sided;
    return soft_shadow_of(posed, depth, penumbra_on(surface),
                          {.double_sided = strands, .threads = threads_, .vertices = vertices});
}

PixelShadow FigureLight::pixel_shadow_of(const LitSurface& surface, const DepthMap& depth) const {
    // Where the shadow alone is worked out at the pixels, no radius is above kAtVertices (penumbra_on).
    // With twice that as the limit the pixels never mix in the shadow of the vertices.
    const float limit = surface.lighting == Lighting::vertices_but_shadow ? 2.0f : 1.0f;
    return {.map_from_world = map_from_world(depth),
            .extent = depth.texel * static_cast<float>(depth.side),
            .range = depth.range,
            .offset = depth.off_surface(),
            .bias = 1.0f * depth.texel / depth.range,
            .least = penumbra_on(surface).least,
            .wide = limit * PenumbraRadii::kAtVertices * body()};
}

std::optional<DepthMap> FigureLight::cast_shadow(const PosedMesh& mesh, Frame& frame,
                                                 bool whole_frame) const {
    if (!has_shadow()) return std::nullopt;
    const Light& key = scene_.lights.front();
    DepthMap depth = draw_depth_map(
        mesh, caster_, {.towards = key.towards, .extent = extent_, .side = kShadowMapSide}, threads_);
    shade_floor(frame, scene_, {.mesh = mesh, .caster = caster_, .seen_by_key = depth},
                {.extent = extent_, .whole_frame = whole_frame, .threads = threads_});
    return depth;
}

// The pixels that the figure may touch.
Rectangle FigureLight::area_of(const PosedMesh& mesh) const {
    const Rectangle whole{0, 0, size_.width, size_.height};
    const Mat4 clip = clip_from_world(scene_.camera, size_);
    Vec2 low(2), high(-2);
    for (const PosedSurface& surface : mesh.surfaces) {
        for (const Vec3& position : surface.positions) {
            const Vec4 seen = clip * Vec4(position, 1);
            if (seen.w < scene_.camera.near) return whole;
            const Vec2 place(seen.x / seen.w, -seen.y / seen.w);
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    }
    const Vec2 size(static_cast<float>(size_.width), static_cast<float>(size_.height));
    const Vec2 first = glm::clamp(glm::floor((low * 0.5f + 0.5f) * size) - 1.0f, Vec2(0), size);
    const Vec2 last = glm::clamp(glm::ceil((high * 0.5f + 0.5f) * size) + 1.0f, Vec2(0), size);
    return {static_cast<int>(first.x), static_cast<int>(first.y),
            std::max(0, static_cast<int>(last.x - first.x)), std::max(0, static_cast<int>(last.y - first.y))};
}

}  // namespace chironomia
