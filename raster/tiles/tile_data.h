// What the kernels of the tile renderer work on: plain numbers and arrays, because the kernels are compiled once
// for each instruction set.
#pragma once

#include <array>
#include <cstdint>

#include "core/body/avatar.h"
#include "raster/studio/figure_light.h"
#include "raster/studio/soft_shadow.h"

namespace chironomia {

// 64 x 32 pixels of four samples with depth, triangle and colour are 98 kB, which stay in a core's own cache.
inline constexpr int kTileWidth = 64;
inline constexpr int kTileHeight = 32;
inline constexpr int kTilePixels = kTileWidth * kTileHeight;
inline constexpr int kTileSamples = 4;
inline constexpr int kMostTileLanes = 16;  // of a vector of floats

// Where the samples of a pixel lie, in eighths of a pixel from its top left corner: the rotated grid of four,
// which Mesa uses too.
inline constexpr std::array<int, kTileSamples> kSampleRight = {3, 7, 1, 5};
inline constexpr std::array<int, kTileSamples> kSampleDown = {1, 3, 5, 7};

// A value that is linear over the picture.
struct TilePlane {
    float at_anchor = 0;
    float per_x = 0;  // per pixel to the right
    float per_y = 0;  // per pixel down
};

// One triangle, or a piece of one that reaches out of the picture far away or behind the eye.
struct TileTriangle {
    // Edge i covers the sample at (x, y), in eighths of a pixel from the picture's top left corner, where
    // edge_right * x + edge_down * y + edge_start >= 0. The unit is 1/64 px * 1/8 px.
    std::array<std::int32_t, 3> edge_right{}, edge_down{};
    std::array<std::int64_t, 3> edge_start{};
    int left = 0, top = 0, right = 0, bottom = 0;  // the pixels that it may cover, the last included
    // 1 / distance from the plane of the eye [1/m], and the shares of it that belong to the second and third
    // corner: their weights are these shares. Anchored at the middle of a pixel.
    float anchor_x = 0, anchor_y = 0;
    TilePlane nearness, second, third;
    float most_near = 0, least_near = 0;  // of all corners [1/m]
    std::uint32_t surface = 0;
    std::array<std::uint32_t, 3> corners{};  // vertices of the surface, in the order of the file
    bool front = true;
};

// A texture with its levels of detail.
struct TileImage {
    const std::uint32_t* texels = nullptr;  // of all levels, one after the other; nullptr: no texture
    const std::int32_t* starts = nullptr;   // (levels) where each level begins
    int levels = 0;
    int width = 0, height = 0;     // of the first level; each further one is half as large, rounded down
    int bits = 8;                  // of a channel; red lowest
    bool is_sqrt_encoded = false;  // colours are stored as their square roots
    bool smooth = true;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

// A surface in one frame. All arrays are (V); nullptr where the surface has none.
struct TileSurface {
    const LitSurface* lit = nullptr;
    const Vec3* positions = nullptr;
    const Vec3* normals = nullptr;
    const Vec4* tangents = nullptr;
    const Vec2* uvs = nullptr;
    const Vec4* colours = nullptr;
    const float* ambient_occlusion = nullptr;
    const VertexShadow* shadows = nullptr;
    const std::uint8_t* sample_orders = nullptr;  // of what is cut out
    TileImage base_colour, normal, metallic_roughness, occlusion, emissive, anisotropy;
    PixelShadow pixel_shadow;
    // Light that is worked out at the vertices. For a finished surface `diffuse` is the colour, in sRGB.
    Vec3* diffuse = nullptr;
    Vec3* specular = nullptr;
    // Of a surface that is lit on both sides: on its other side. Of one with shadow at the pixels: what the first light
    // adds.
    Vec3* more_diffuse = nullptr;
    Vec3* more_specular = nullptr;
};

struct TileLights {
    struct One {
        Vec3 towards{0}, radiance{0};
        float wrap = 0, size = 0;
    };
    Vec3 eye{0}, sky{0}, ground{0};
    std::array<One, kMostLights> lights{};
    const float* depth = nullptr;  // (side, side) of the depth map of the first light; nullptr: no shadow
    int side = 0;
};

// A part of a tile that knows how near all of it is at least: what is further away cannot be seen there.
inline constexpr int kBlockWidth = 16;
inline constexpr int kBlockHeight = 8;
inline constexpr int kBlocksAcross = kTileWidth / kBlockWidth;
inline constexpr int kBlocks = kBlocksAcross * kTileHeight / kBlockHeight;

struct Tile {
    alignas(64) float nearness[kTileSamples][kTilePixels];          // of what is seen [1/m]; 0: nothing
    alignas(64) std::uint32_t triangle[kTileSamples][kTilePixels];  // 1 + place in the tile's list; 0: none
    alignas(64) std::uint32_t colour[kTileSamples][kTilePixels];    // RGBA8, sRGB multiplied by alpha
    float block_near[kBlocks];  // no sample of the block is further away [1/m]
    int drawn[kBlocks];         // triangles drawn since block_near was updated
    int x = 0, y = 0;           // of its first pixel
};

// Pixels of one surface that are shaded together, each for one triangle.
struct alignas(64) TileItems {
    static constexpr int kMost = 128;
    static constexpr int kRoom = kMost + kMostTileLanes;  // a vector may write beyond the last item

    int count = 0;
    int first = 0;                // of the triangle that is added; its values are not known yet
    std::int32_t pixel[kRoom];    // in the tile
    std::int32_t samples[kRoom];  // a bit for each that is covered
    float facing[kRoom];          // 1: the front is seen; -1: the back
    float uv[2][kRoom];
    float footprint[2][kRoom];  // how much u and v change over a pixel
    float position[3][kRoom];
    float normal[3][kRoom];
    float tangent[4][kRoom];
    float colour[4][kRoom];
    float ambient_occlusion[kRoom];
    float shadow[2][kRoom];  // VertexShadow
    float diffuse[3][kRoom];
    float specular[3][kRoom];
    float more_diffuse[3][kRoom];
    float more_specular[3][kRoom];
    std::uint32_t result[kRoom];  // RGBA8, sRGB multiplied by alpha
};

}  // namespace chironomia
