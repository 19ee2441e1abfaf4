#include "tests/raster/shapes.h"

#include <cmath>

namespace chironomia::testing {

Avatar avatar_of(std::vector<Surface> surfaces, const Material& material) {
    Avatar avatar;
    avatar.source = "shapes";
    avatar.skeleton.joints.push_back({.name = "root"});
    avatar.materials.push_back(material);
    avatar.surfaces = std::move(surfaces);
    for (Surface& surface : avatar.surfaces) {
        surface.joint = 0;
        surface.material = 0;
    }
    return avatar;
}

Surface quad(const Quad& shape) {
    Surface surface;
    surface.name = "quad";
    for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
        const Vec2 place = shape.low + corner * (shape.high - shape.low);
        surface.positions.emplace_back(place, shape.z);
        surface.normals.emplace_back(0, 0, 1);
        surface.uvs.emplace_back(corner.x, 1 - corner.y);
    }
    surface.triangles = {0, 1, 2, 0, 2, 3};
    return surface;
}

Avatar half_covered_cards(int count) {
    Surface cards;
    for (int i = 0; i < count; ++i) {
        const Surface card = quad({.z = -0.1f * static_cast<float>(i)});
        for (const std::uint32_t corner : card.triangles)
            cards.triangles.push_back(static_cast<std::uint32_t>(cards.positions.size()) + corner);
        cards.positions.insert(cards.positions.end(), card.positions.begin(), card.positions.end());
        cards.normals.insert(cards.normals.end(), card.normals.begin(), card.normals.end());
    }
    return avatar_of(
        {cards},
        {.base_colour = {1, 1, 1, 0.5f}, .alpha_mode = AlphaMode::mask, .alpha_cutoff = 0.5f, .unlit = true});
}

Surface capsule(const Capsule& shape) {
    const Vec3 axis = shape.to == shape.from ? Vec3(0, 1, 0) : normalize(shape.to - shape.from);
    const Quat turn = turn_between({0, 1, 0}, axis);
    const int rings = shape.around / 2 / 2 * 2 + 1;  // odd rows below and above the seam in the middle
    Surface surface;
    surface.name = "capsule";
    for (int row = 0; row <= rings; ++row) {
        // The middle row is there twice: once at each end of the cylinder.
        const bool lower = row <= rings / 2;
        const float latitude =
            kPi * (static_cast<float>(lower ? row : row - 1) / static_cast<float>(rings - 1) - 0.5f);
        for (int column = 0; column <= shape.around; ++column) {
            const float longitude = 2 * kPi * static_cast<float>(column) / static_cast<float>(shape.around);
            const Vec3 normal = turn * Vec3(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                                            std::cos(latitude) * std::cos(longitude));
            surface.positions.push_back((lower ? shape.from : shape.to) + shape.radius * normal);
            surface.normals.push_back(normal);
            surface.uvs.emplace_back(longitude / (2 * kPi), 0.5f - latitude / kPi);
        }
    }
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * (shape.around + 1) + column);
    };
    for (int row = 0; row < rings; ++row) {
        for (int column = 0; column < shape.around; ++column) {
            for (const auto vertex : {at(row, column), at(row, column + 1), at(row + 1, column + 1),
                                      at(row, column), at(row + 1, column + 1), at(row + 1, column)}) {
                surface.triangles.push_back(vertex);
            }
        }
    }
    return surface;
}

Avatar capsule_figure() {
    std::vector<Surface> parts;
    const auto add = [&](const Vec3& from, const Vec3& to, float radius) {
        parts.push_back(capsule({.from = from, .to = to, .radius = radius}));
    };
    add({0, 1.58f, 0}, {0, 1.60f, 0}, 0.10f);  // head
    add({0, 1.35f, 0}, {0, 1.5f, 0}, 0.05f);   // neck
    add({0, 0.98f, 0}, {0, 1.28f, 0}, 0.15f);  // trunk
    for (const float side : {-1.0f, 1.0f}) {
        add({0.19f * side, 1.36f, 0}, {0.30f * side, 1.10f, 0}, 0.045f);            // upper arm
        add({0.30f * side, 1.10f, 0}, {0.34f * side, 0.86f, 0.08f}, 0.038f);        // forearm
        add({0.34f * side, 0.84f, 0.08f}, {0.345f * side, 0.76f, 0.1f}, 0.035f);    // hand
        add({0.09f * side, 0.92f, 0}, {0.10f * side, 0.5f, 0}, 0.075f);             // thigh
        add({0.10f * side, 0.5f, 0}, {0.11f * side, 0.08f, 0}, 0.05f);              // shin
        add({0.11f * side, 0.04f, -0.02f}, {0.13f * side, 0.035f, 0.15f}, 0.035f);  // foot
    }
    return avatar_of(std::move(parts),
                     {.base_colour = {0.6f, 0.6f, 0.6f, 1}, .metallic = 0, .roughness = 0.7f});
}

Scene studio_scene() {
    Scene scene;
    scene.camera = {.eye = {0, 1.5f, 5.5f}, .target = {0, 0.95f, 0}, .fov_y = 0.42f};
    scene.lights = {
        {.towards = normalize(Vec3(-0.5f, 0.7f, 0.6f)),
         .radiance = Vec3(0.85f),
         .casts_shadow = true,
         .wrap = 0.15f},
        {.towards = normalize(Vec3(0.8f, 0.2f, 0.6f)), .radiance = Vec3(0.15f, 0.17f, 0.2f), .wrap = 0.4f},
        {.towards = normalize(Vec3(0.4f, 0.6f, -0.8f)), .radiance = Vec3(0.4f)}};
    scene.sky = Vec3(0.40f, 0.41f, 0.43f);
    scene.ground = Vec3(0.28f, 0.26f, 0.24f);
    scene.floor_colour = Vec3(0.65f, 0.63f, 0.60f);
    scene.backdrop_bottom = Vec3(0.71f, 0.69f, 0.66f);
    scene.backdrop_top = Vec3(0.81f, 0.80f, 0.77f);
    return scene;
}

}  // namespace chironomia::testing
