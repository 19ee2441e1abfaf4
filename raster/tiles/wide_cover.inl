// Which samples of a tile see which triangle. Included after wide_texture.inl.

// A triangle as one tile sees it. An edge that the whole tile lies inside of is 0 everywhere.
struct TriangleInTile {
    std::int32_t right[3], down[3], start[3];  // per eighth of a pixel
    int left, top, last_x, last_y;             // pixels of the tile; the last included
};

// False where the tile lies outside of an edge.
HWY_INLINE bool find_in_tile(const TileTriangle& triangle, const Tile& tile, TriangleInTile& seen) {
    seen.left = std::max(triangle.left - tile.x, 0);
    seen.top = std::max(triangle.top - tile.y, 0);
    seen.last_x = std::min(triangle.right - tile.x, kTileWidth - 1);
    seen.last_y = std::min(triangle.bottom - tile.y, kTileHeight - 1);
    if (seen.left > seen.last_x || seen.top > seen.last_y) return false;
    for (int i = 0; i < 3; ++i) {
        const std::int64_t right = triangle.edge_right[i], down = triangle.edge_down[i];
        const std::int64_t start = triangle.edge_start[i] + 8 * (right * tile.x + down * tile.y);
        const std::int64_t across = right * (8 * kTileWidth), along = down * (8 * kTileHeight);
        const std::int64_t least =
            start + std::min<std::int64_t>(across, 0) + std::min<std::int64_t>(along, 0);
        const std::int64_t most =
            start + std::max<std::int64_t>(across, 0) + std::max<std::int64_t>(along, 0);
        if (most < 0) return false;
        const bool inside = least >= 0;
        seen.right[i] = inside ? 0 : static_cast<std::int32_t>(right);
        seen.down[i] = inside ? 0 : static_cast<std::int32_t>(down);
        seen.start[i] = inside ? 0 : static_cast<std::int32_t>(start);
    }
    return true;
}

// Walks over the samples of a row of pixels, a vector of pixels at a time.
struct SampleWalk {
    const TileTriangle& triangle;
    TriangleInTile seen;
    IntLanes steps[3];  // of the edges over the lanes
    Float first_x;      // middles of the pixels of the first vector, from the anchor
    float first_y;

    HWY_INLINE SampleWalk(const TileTriangle& t, const TriangleInTile& s, const Tile& tile)
        : triangle(t), seen(s) {
        const IntLanes eighths = hn::Iota(IntTag(), 0);
        for (int i = 0; i < 3; ++i) steps[i] = hn::Mul(hn::ShiftLeft<3>(eighths), whole(seen.right[i]));
        first_x = to_float(eighths) + Float(static_cast<float>(tile.x) + 0.5f - t.anchor_x);
        first_y = static_cast<float>(tile.y) + 0.5f - t.anchor_y;
    }

    // Those of the pixels at (x + lane, y) whose sample `s` is covered; `nearness` is that of the triangle there.
    HWY_INLINE Mask covered(int x, int y, int s, Float& nearness) const {
        const IntTag d;
        const int right = 8 * x + kSampleRight[s], down = 8 * y + kSampleDown[s];
        IntLanes outside = hn::Zero(d);
        for (int i = 0; i < 3; ++i) {
            const std::int32_t here = seen.start[i] + seen.right[i] * right + seen.down[i] * down;
            outside = hn::Or(outside, hn::Add(steps[i], whole(here)));
        }
        const float dx = static_cast<float>(x) + static_cast<float>(kSampleRight[s] - 4) / 8;
        const float dy = first_y + static_cast<float>(y) + static_cast<float>(kSampleDown[s] - 4) / 8;
        const TilePlane& plane = triangle.nearness;
        const Float at_row = plane.at_anchor + plane.per_y * dy;
        nearness = clamp(at_row + (first_x + Float(dx)) * Float(plane.per_x), triangle.least_near,
                         triangle.most_near);
        return {hn::RebindMask(FloatTag(), hn::Gt(outside, whole(-1)))};
    }
};

HWY_INLINE void keep(Tile& tile, int s, int place, Mask which, Float nearness, std::uint32_t id) {
    const FloatTag f;
    const IntTag d;
    float* kept = tile.nearness[s] + place;
    auto* ids = reinterpret_cast<std::int32_t*>(tile.triangle[s] + place);
    hn::Store(hn::IfThenElse(which.lanes, nearness.lanes, hn::Load(f, kept)), f, kept);
    hn::Store(hn::IfThenElse(hn::RebindMask(d, which.lanes), whole(static_cast<std::int32_t>(id)),
                             hn::Load(d, ids)),
              d, ids);
}

HWY_INLINE Mask nearer(const Tile& tile, int s, int place, Mask covered, Float nearness) {
    const Float kept = hn::Load(FloatTag(), tile.nearness[s] + place);
    return {hn::And(covered.lanes, (nearness > kept).lanes)};
}

void CoverSolid(Tile& tile, const TileTriangle& triangle, std::uint32_t id) {
    TriangleInTile seen;
    if (!find_in_tile(triangle, tile, seen)) return;
    const SampleWalk walk(triangle, seen, tile);
    const int step = lanes();
    for (int y = seen.top; y <= seen.last_y; ++y) {
        for (int x = seen.left / step * step; x <= seen.last_x; x += step) {
            for (int s = 0; s < kTileSamples; ++s) {
                Float nearness;
                const int place = y * kTileWidth + x;
                const Mask covered = walk.covered(x, y, s, nearness);
                const Mask seen_here = nearer(tile, s, place, covered, nearness);
                if (seen_here) keep(tile, s, place, seen_here, nearness, id);
            }
        }
    }
}

// Weights of the second and third corner at the middles of pixels.
struct Weights {
    Float second, third, nearness;
};

HWY_INLINE Float on_plane(const TilePlane& plane, Float dx, Float dy) {
    return Float(plane.at_anchor) + Float(plane.per_x) * dx + Float(plane.per_y) * dy;
}

// Middles of pixels may lie beside the triangle.
HWY_INLINE Weights weights_at(const TileTriangle& triangle, Float x, Float y) {
    const Float dx = x - Float(triangle.anchor_x), dy = y - Float(triangle.anchor_y);
    Weights weights;
    weights.nearness = clamp(on_plane(triangle.nearness, dx, dy), triangle.least_near, triangle.most_near);
    const Float scale = Float(1.0f) / weights.nearness;
    weights.second = on_plane(triangle.second, dx, dy) * scale;
    weights.third = on_plane(triangle.third, dx, dy) * scale;
    return weights;
}

// Those of the nearest edge for what lies beside it.
HWY_INLINE Weights inside(Weights weights) {
    weights.second = clamp(weights.second, 0.0f, 1.0f);
    weights.third = clamp(weights.third, 0.0f, Float(1.0f) - weights.second);
    return weights;
}

HWY_INLINE Float between(const Weights& weights, float a, float b, float c) {
    return Float(a) + weights.second * Float(b - a) + weights.third * Float(c - a);
}

// How much a value changes over a pixel.
HWY_INLINE Float change_of(const TileTriangle& triangle, const Weights& weights, Float value, float a,
                           float b, float c) {
    const float x =
        a * triangle.nearness.per_x + (b - a) * triangle.second.per_x + (c - a) * triangle.third.per_x;
    const float y =
        a * triangle.nearness.per_y + (b - a) * triangle.second.per_y + (c - a) * triangle.third.per_y;
    const Float along_x = abs(Float(x) - value * Float(triangle.nearness.per_x));
    const Float along_y = abs(Float(y) - value * Float(triangle.nearness.per_y));
    return max(along_x, along_y) / weights.nearness;
}

// Alpha at pixels, and the binary logarithm of how wide they are in texels of the first level, at least 0.
struct AlphaOfPixels {
    Float alpha, detail;
};

HWY_INLINE AlphaOfPixels alpha_at(const TileTriangle& triangle, const TileSurface& surface, Float x,
                                  Float y) {
    const Weights weights = weights_at(triangle, x, y);
    const auto& [a, b, c] = triangle.corners;
    AlphaOfPixels result{surface.lit->material.base_colour.w, 0.0f};
    if (surface.colours)
        result.alpha *= between(weights, surface.colours[a].w, surface.colours[b].w, surface.colours[c].w);
    if (!surface.base_colour.texels) return result;
    const Vec2 at_a = surface.uvs[a], at_b = surface.uvs[b], at_c = surface.uvs[c];
    const Float u = between(weights, at_a.x, at_b.x, at_c.x), v = between(weights, at_a.y, at_b.y, at_c.y);
    const Float width = change_of(triangle, weights, u, at_a.x, at_b.x, at_c.x);
    const Float height = change_of(triangle, weights, v, at_a.y, at_b.y, at_c.y);
    result.alpha *= sample(surface.base_colour, u, v, width, height).w;
    const Float texels = max(texels_per_pixel(surface.base_colour, width, height), 1.0f);
    result.detail = log2(texels);
    return result;
}

// Two rows of up to a vector of pixels, and at least two columns: squares of four pixels, in which alpha changes
// from one to the next.
struct AlphaBlock {
    alignas(64) float alpha[2][kMostTileLanes];
    alignas(64) float samples[2][kMostTileLanes];  // covered, of all four, to be rounded down
};

// Seen from near the step at the cutoff becomes a ramp as wide as a pixel, from afar alpha is the covered share
// itself; its height is a number of samples.
inline void find_coverage(const TileTriangle& triangle, const TileSurface& surface, float left, float top,
                          int columns, AlphaBlock& block) {
    const float cutoff = surface.lit->material.alpha_cutoff;
    const int step = lanes();
    alignas(64) float details[2][kMostTileLanes];
    const Float right = to_float(hn::Iota(IntTag(), 0));
    for (int row = 0; row < 2; ++row) {
        for (int i = 0; i < columns; i += step) {
            const AlphaOfPixels at = alpha_at(triangle, surface, right + Float(left + static_cast<float>(i)),
                                              Float(top + static_cast<float>(row)));
            hn::StoreU(at.alpha.lanes, FloatTag(), block.alpha[row] + i);
            hn::StoreU(at.detail.lanes, FloatTag(), details[row] + i);
        }
    }
    for (int row = 0; row < 2; ++row) {
        alignas(64) float beside[kMostTileLanes];
        for (int i = 0; i < columns; ++i) beside[i] = block.alpha[row][i ^ 1];
        for (int i = 0; i < columns; i += step) {
            const Float alpha = load(block.alpha[row] + i);
            const Float change =
                abs(alpha - load(beside + i)) + abs(load(block.alpha[0] + i) - load(block.alpha[1] + i));
            const Float ramp = clamp((alpha - Float(cutoff)) / max(change, 1e-4f) + Float(0.5f), 0.0f, 1.0f);
            const Float samples =
                mix(ramp, alpha, min(load(details[row] + i), 1.0f)) * Float(4.0f) + Float(0.5f);
            store(samples, block.samples[row] + i);
        }
    }
}

void CoverCutOut(Tile& tile, const TileTriangle& triangle, const TileSurface& surface, std::uint32_t id) {
    // From how many covered samples on each one is: they are taken across the pixel from each other.
    constexpr float kFrom[kTileSamples] = {1, 3, 4, 2};
    TriangleInTile seen;
    if (!find_in_tile(triangle, tile, seen)) return;
    const SampleWalk walk(triangle, seen, tile);
    const int step = lanes(), columns = std::max(step, 2);
    for (int y = seen.top / 2 * 2; y <= seen.last_y; y += 2) {
        for (int x = seen.left / columns * columns; x <= seen.last_x; x += columns) {
            AlphaBlock block;
            bool known = false;
            for (int row = std::max(y, seen.top); row < y + 2 && row <= seen.last_y; ++row) {
                for (int i = 0; i < columns; i += step) {
                    for (int s = 0; s < kTileSamples; ++s) {
                        Float nearness;
                        const int place = row * kTileWidth + x + i;
                        Mask which = nearer(tile, s, place, walk.covered(x + i, row, s, nearness), nearness);
                        which.lanes = hn::And(which.lanes, (nearness > Float(0.0f)).lanes);
                        if (!which) continue;
                        if (!known)
                            find_coverage(triangle, surface, static_cast<float>(tile.x + x) + 0.5f,
                                          static_cast<float>(tile.y + y) + 0.5f, columns, block);
                        known = true;
                        const Float samples = hn::LoadU(FloatTag(), block.samples[row - y] + i);
                        which.lanes = hn::And(which.lanes, (samples >= Float(kFrom[s])).lanes);
                        if (which) keep(tile, s, place, which, nearness, id);
                    }
                }
            }
        }
    }
}

int CoverTranslucent(const Tile& tile, const TileTriangle& triangle, TileCoverage& covered) {
    TriangleInTile seen;
    if (!find_in_tile(triangle, tile, seen)) return 0;
    const SampleWalk walk(triangle, seen, tile);
    const int step = lanes();
    int count = 0;
    for (int y = seen.top; y <= seen.last_y; ++y) {
        for (int x = seen.left / step * step; x <= seen.last_x; x += step) {
            alignas(64) std::int32_t samples[kMostTileLanes];
            IntLanes bits = whole(0);
            for (int s = 0; s < kTileSamples; ++s) {
                Float nearness;
                const Mask mask = walk.covered(x, y, s, nearness);
                const Mask which = nearer(tile, s, y * kTileWidth + x, mask, nearness);
                bits = hn::Or(bits, hn::IfThenElseZero(hn::RebindMask(IntTag(), which.lanes), whole(1 << s)));
            }
            hn::Store(bits, IntTag(), samples);
            for (int i = 0; i < step && x + i < kTileWidth; ++i) {
                if (samples[i] == 0) continue;
                covered.pixel[count] = y * kTileWidth + x + i;
                covered.samples[count++] = samples[i];
            }
        }
    }
    return count;
}

// Two channels of a byte each are added in the halves of a number of 32 bits.
void Resolve(const Tile& tile, std::uint32_t* pixels) {
    const IntTag d;
    const IntLanes low = whole(0x00ff00ff), half = whole(0x00020002);
    for (int i = 0; i < kTilePixels; i += lanes()) {
        IntLanes even = half, odd = half;
        for (int s = 0; s < kTileSamples; ++s) {
            const IntLanes colour = hn::Load(d, reinterpret_cast<const std::int32_t*>(tile.colour[s] + i));
            even = hn::Add(even, hn::And(colour, low));
            odd = hn::Add(odd, hn::And(hn::ShiftRight<8>(colour), low));
        }
        even = hn::And(hn::ShiftRight<2>(even), low);
        odd = hn::And(hn::ShiftRight<2>(odd), low);
        hn::StoreU(hn::Or(even, hn::ShiftLeft<8>(odd)), d, reinterpret_cast<std::int32_t*>(pixels + i));
    }
}
