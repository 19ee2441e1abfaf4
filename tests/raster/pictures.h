// Small scenes and the pixels of their pictures, for the tests of both renderers.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>

#include "core/render/frame.h"
#include "core/render/scene.h"
#include "tests/raster/shapes.h"

namespace chironomia::testing {

// A camera 10 m away that sees 2 m of the plane z = 0 on the whole height: a metre is half the picture.
inline Scene dark_scene() {
    Scene scene;
    scene.camera = {
        .eye = {0, 0, 10}, .target = {0, 0, 0}, .fov_y = 2 * std::atan(0.1f), .near = 5, .far = 15};
    scene.floor = false;
    scene.sky = scene.ground = scene.backdrop_top = scene.backdrop_bottom = Vec3(0);
    return scene;
}

struct Pixel {
    int r = 0, g = 0, b = 0;
    bool operator==(const Pixel&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Pixel& pixel) {
    return out << "rgb(" << pixel.r << ", " << pixel.g << ", " << pixel.b << ")";
}

inline Pixel at(const Frame& frame, int x, int y) {
    const std::uint8_t* pixel =
        frame.rgba.data() +
        (static_cast<size_t>(y) * static_cast<size_t>(frame.width) + static_cast<size_t>(x)) * 4;
    EXPECT_EQ(pixel[3], 255);
    return {pixel[0], pixel[1], pixel[2]};
}

inline const Pixel kBlack{0, 0, 0};

inline Material unlit(const Vec4& colour) {
    return {.base_colour = colour, .unlit = true};
}

inline Image two_columns(const std::array<std::uint8_t, 4>& left, const std::array<std::uint8_t, 4>& right) {
    Image image{.name = "two", .width = 2, .height = 1, .rgba = {}};
    image.rgba.insert(image.rgba.end(), left.begin(), left.end());
    image.rgba.insert(image.rgba.end(), right.begin(), right.end());
    return image;
}

inline Avatar textured_quad(Material material, const Image& image) {
    material.base_colour_texture = {
        .image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp, .smooth = false};
    Avatar avatar = avatar_of({quad({})}, material);
    avatar.images.push_back(image);
    return avatar;
}

}  // namespace chironomia::testing
