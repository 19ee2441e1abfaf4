#include "raster/tiles/tile_figure.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "raster/studio/draw_order.h"
#include "raster/studio/share_work.h"
#include "raster/tiles/tile_kernels.h"

namespace chironomia {
namespace {

// That one thread takes.
constexpr size_t kTrianglesAtOnce = 1024;
constexpr size_t kVerticesAtOnce = 512;

TileLights lights_of(const Scene& scene) {
    TileLights lights{.eye = scene.camera.eye, .sky = scene.sky, .ground = scene.ground};
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        lights.lights[i] = {.towards = light.towards,
                            .radiance = light.radiance,
                            .wrap = light.wrap,
                            .size = std::sin(light.angle)};
    }
    return lights;
}

void require_places(const PosedSurface& posed, size_t surface) {
    for (size_t i = 0; i < posed.positions.size(); ++i) {
        const Vec3& place = posed.positions[i];
        if (std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z)) continue;
        throw Error(
            format("surface {}: vertex {} lies at ({}, {}, {}), but a picture needs finite places; "
                   "look for what poses the figure",
                   surface, i, place.x, place.y, place.z));
    }
}

// A piece of a surface that one thread sets up.
struct Stretch {
    std::uint32_t surface = 0;
    const std::vector<std::uint32_t>* corners = nullptr;
    size_t first = 0, last = 0;  // indices of corners
};

void add_stretches(std::uint32_t surface, const std::vector<std::uint32_t>& corners,
                   std::vector<Stretch>& stretches) {
    const size_t count = corners.size() / 3 * 3;
    for (size_t first = 0; first < count; first += 3 * kTrianglesAtOnce)
        stretches.push_back({surface, &corners, first, std::min(count, first + 3 * kTrianglesAtOnce)});
}

}  // namespace

TileFigure::TileFigure(const Avatar& avatar, const FigureLight& light, const TileCamera& camera,
                       TileTextures& textures)
    : light_(light), camera_(camera), lights_(lights_of(light.scene())) {
    for (size_t i = 0; i < avatar.surfaces.size(); ++i) {
        const Surface& surface = avatar.surfaces[i];
        const LitSurface& lit = light.surfaces()[i];
        const Material& material = lit.material;
        const SurfaceFeatures& features = lit.features;
        const size_t count = surface.positions.size();
        const std::vector<Vec3> room(features.per_vertex ? count : 0);
        const std::vector<Vec3> more_room(
            features.pixel_shadow || features.lit_on_both_sides() ? room : std::vector<Vec3>{});
        parts_.push_back(
            {.corners = surface.triangles,
             .uvs = surface.uvs,
             .colours = surface.colours,
             .sample_orders = features.cut_out ? sample_orders(surface) : std::vector<std::uint8_t>{},
             .shadows = std::vector<VertexShadow>(count, light.shadow_at_pixels()),
             .diffuse = room,
             .specular = room,
             .more_diffuse = more_room,
             .more_specular = more_room,
             .vertices = std::vector<TileVertex>(count)});
        const auto image = [&](bool wanted, const Texture& texture, ImageUse use, float cutoff = 0) {
            return wanted ? textures.add(avatar.images, texture, use, cutoff) : TileImage{};
        };
        frame_.push_back(
            {.lit = &lit,
             .ambient_occlusion = lit.ambient_occlusion.data(),
             .base_colour = image(features.base_colour_map, material.base_colour_texture,
                                  use_of_base_colour(material), cutoff_in_texture(material)),
             .normal = image(features.normal_map, material.normal_texture, ImageUse::data),
             .metallic_roughness =
                 image(features.metallic_roughness_map, material.metallic_roughness_texture, ImageUse::data),
             .occlusion = image(features.occlusion_map, material.occlusion_texture, ImageUse::data),
             .emissive = image(features.emissive_map, material.emissive_texture, ImageUse::colour),
             .anisotropy = image(features.anisotropy_map, material.anisotropy_texture, ImageUse::data)});
    }
}

void TileFigure::pose(const PosedMesh& mesh, const DepthMap* depth, int threads) {
    for (size_t i = 0; i < parts_.size(); ++i) require_places(mesh.surfaces[i], i);
    lights_.depth = depth ? depth->depth.data() : nullptr;
    lights_.side = depth ? depth->side : 0;
    for (size_t i = 0; i < parts_.size(); ++i) place_part(i, mesh.surfaces[i], threads);
    triangles_ = set_up_triangles(mesh, threads);
    find_seen_vertices();
    for (size_t i = 0; i < parts_.size(); ++i) light_part(i, mesh.surfaces[i], depth, threads);
}

void TileFigure::place_part(size_t index, const PosedSurface& posed, int threads) {
    Part& part = parts_[index];
    share_stretches(posed.positions.size(), kVerticesAtOnce, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i)
            part.vertices[i] = make_tile_vertex(camera_, posed.positions[i]);
    });
}

void TileFigure::find_seen_vertices() {
    std::vector<std::vector<bool>> seen;
    for (const Part& part : parts_) seen.emplace_back(part.vertices.size());
    for (const TileTriangle& triangle : triangles_) {
        for (const std::uint32_t corner : triangle.corners) seen[triangle.surface][corner] = true;
    }
    for (size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].seen.clear();
        for (std::uint32_t v = 0; v < seen[i].size(); ++v)
            if (seen[i][v]) parts_[i].seen.push_back(v);
    }
}

void TileFigure::light_part(size_t index, const PosedSurface& posed, const DepthMap* depth, int threads) {
    Part& part = parts_[index];
    const LitSurface& lit = light_.surfaces()[index];
    TileSurface& surface = frame_[index];
    if (depth) {
        auto shadows = light_.shadow_at_vertices(lit, posed, *depth, part.seen);
        if (!shadows.empty()) part.shadows = std::move(shadows);
        surface.pixel_shadow = light_.pixel_shadow_of(lit, *depth);
    }
    surface.positions = posed.positions.data();
    surface.normals = posed.normals.data();
    surface.tangents = posed.tangents.data();
    surface.uvs = part.uvs.data();
    surface.colours = part.colours.empty() ? nullptr : part.colours.data();
    surface.shadows = part.shadows.data();
    surface.sample_orders = part.sample_orders.data();
    surface.diffuse = part.diffuse.data();
    surface.specular = part.specular.data();
    surface.more_diffuse = part.more_diffuse.data();
    surface.more_specular = part.more_specular.data();
    if (!lit.features.per_vertex) return;
    const std::span<const std::uint32_t> seen = part.seen;
    share_stretches(seen.size(), kVerticesAtOnce, threads, [&](size_t first, size_t last) {
        light_vertices(surface, lights_, seen.subspan(first, last - first));
    });
}

std::vector<TileTriangle> TileFigure::set_up_triangles(const PosedMesh& mesh, int threads) const {
    std::vector<size_t> solid, cut_out, translucent;
    for (const size_t i : light_.outer_first()) {
        const SurfaceFeatures& features = light_.surfaces()[i].features;
        if (mesh.surfaces[i].positions.empty()) continue;
        (features.translucent ? translucent : features.cut_out ? cut_out : solid).push_back(i);
    }
    std::vector<Stretch> stretches;
    for (const auto* kind : {&solid, &cut_out}) {
        for (const size_t i : *kind)
            add_stretches(static_cast<std::uint32_t>(i), parts_[i].corners, stretches);
    }
    std::vector<std::vector<std::uint32_t>> sorted(parts_.size());
    for (const size_t i : furthest_first(translucent, mesh, light_.ahead())) {
        sorted[i] = triangles_from_behind(parts_[i].corners, mesh.surfaces[i], light_.ahead());
        add_stretches(static_cast<std::uint32_t>(i), sorted[i], stretches);
    }
    std::vector<std::vector<TileTriangle>> pieces(stretches.size());
    share_work(static_cast<int>(stretches.size()), threads, [&](int n) {
        const Stretch& stretch = stretches[static_cast<size_t>(n)];
        const Part& part = parts_[stretch.surface];
        const bool double_sided = light_.surfaces()[stretch.surface].material.double_sided;
        for (size_t i = stretch.first; i < stretch.last; i += 3) {
            const auto& corners = *stretch.corners;
            set_up_triangle(camera_, part.vertices,
                            {.corners = {corners[i], corners[i + 1], corners[i + 2]},
                             .surface = stretch.surface,
                             .double_sided = double_sided},
                            pieces[static_cast<size_t>(n)]);
        }
    });
    std::vector<TileTriangle> all;
    for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
    return all;
}

}  // namespace chironomia
