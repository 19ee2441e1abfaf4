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

// What of a triangle is the same in all rows of a column of pixels, as wide as a vector.
struct SampleColumn {
    const TileTriangle& triangle;
    const TriangleInTile& seen;
    IntLanes edges[3];  // at the left upper corner of each pixel of the tile's first row
    std::int32_t from_corner[kTileSamples][3];  // to the samples
    Float across[kTileSamples];                 // nearness, as far as it changes along a row
    float first_y;                              // from the anchor to the middles of the first row

    HWY_INLINE SampleColumn(const TileTriangle& t, const TriangleInTile& s, const Tile& tile, int x)
        : triangle(t), seen(s), first_y(static_cast<float>(tile.y) + 0.5f - t.anchor_y) {
        const IntLanes lane = hn::Iota(IntTag(), 0);
        const Float first_x = to_float(lane) + Float(static_cast<float>(tile.x) + 0.5f - t.anchor_x);
        for (int i = 0; i < 3; ++i)
            edges[i] = hn::Add(hn::Mul(hn::ShiftLeft<3>(lane), whole(s.right[i])),
                               whole(s.start[i] + 8 * x * s.right[i]));
        for (int k = 0; k < kTileSamples; ++k) {
            for (int i = 0; i < 3; ++i)
                from_corner[k][i] = s.right[i] * kSampleRight[k] + s.down[i] * kSampleDown[k];
            const float dx = static_cast<float>(x) + static_cast<float>(kSampleRight[k] - 4) / 8;
            across[k] = (first_x + Float(dx)) * Float(t.nearness.per_x);
        }
    }
};

// Which pixels of a vector see a triangle at one of their samples, and its nearness there.
struct Covered {
    Mask which;
    Float nearness;
};

// The samples of a row of pixels in a column.
struct SampleRow {
    const SampleColumn& column;
    IntLanes edges[3];
    float y;  // from the anchor to the middle

    HWY_INLINE SampleRow(const SampleColumn& c, int row) : column(c), y(c.first_y + static_cast<float>(row)) {
        for (int i = 0; i < 3; ++i) edges[i] = hn::Add(c.edges[i], whole(8 * row * c.seen.down[i]));
    }

    HWY_INLINE Covered covered(int s) const {
        const std::int32_t* further = column.from_corner[s];
        const IntLanes outside =
            hn::Or(hn::Or(hn::Add(edges[0], whole(further[0])), hn::Add(edges[1], whole(further[1]))),
                   hn::Add(edges[2], whole(further[2])));
        const TileTriangle& triangle = column.triangle;
        const float dy = y + static_cast<float>(kSampleDown[s] - 4) / 8;
        const Float at_row = triangle.nearness.at_anchor + triangle.nearness.per_y * dy;
        return {{hn::RebindMask(FloatTag(), hn::Gt(outside, whole(-1)))},
                clamp(at_row + column.across[s], triangle.least_near, triangle.most_near)};
    }
};

// One sample of each pixel of a vector.
struct SamplePlace {
    int sample = 0;
    int pixel = 0;  // the first of them, in the tile
};

HWY_INLINE void keep(Tile& tile, const SamplePlace& at, const Covered& covered, std::uint32_t id) {
    const FloatTag f;
    const IntTag d;
    float* kept = tile.nearness[at.sample] + at.pixel;
    auto* ids = reinterpret_cast<std::int32_t*>(tile.triangle[at.sample] + at.pixel);
    const MaskLanes which = covered.which.lanes;
    hn::Store(hn::IfThenElse(which, covered.nearness.lanes, hn::Load(f, kept)), f, kept);
    hn::Store(
        hn::IfThenElse(hn::RebindMask(d, which), whole(static_cast<std::int32_t>(id)), hn::Load(d, ids)), d,
        ids);
}

// What of it lies before all that is kept.
HWY_INLINE Covered nearer(const Tile& tile, const SamplePlace& at, const Covered& covered) {
    const Float kept = hn::Load(FloatTag(), tile.nearness[at.sample] + at.pixel);
    return {covered.which & (covered.nearness > kept), covered.nearness};
}

// Calls `visit` for each block that a triangle may touch, until it gives false.
template <typename Visit>
HWY_INLINE void visit_blocks(const TriangleInTile& seen, const Visit& visit) {
    for (int y = seen.top / kBlockHeight; y <= seen.last_y / kBlockHeight; ++y) {
        for (int x = seen.left / kBlockWidth; x <= seen.last_x / kBlockWidth; ++x)
            if (!visit(y * kBlocksAcross + x)) return;
    }
}

HWY_INLINE bool is_hidden(const Tile& tile, const TileTriangle& triangle, const TriangleInTile& seen) {
    bool hidden = true;
    visit_blocks(seen, [&](int block) { return hidden = triangle.most_near <= tile.block_near[block]; });
    return hidden;
}

inline float least_near_of(const Tile& tile, int block) {
    const int left = block % kBlocksAcross * kBlockWidth, top = block / kBlocksAcross * kBlockHeight;
    Float least = load(tile.nearness[0] + top * kTileWidth + left);
    for (int s = 0; s < kTileSamples; ++s) {
        for (int y = top; y < top + kBlockHeight; ++y) {
            for (int x = left; x < left + kBlockWidth; x += lanes())
                least = min(least, load(tile.nearness[s] + y * kTileWidth + x));
        }
    }
    return hn::GetLane(hn::MinOfLanes(FloatTag(), least.lanes));
}

// Looks again now and then how near blocks are that a triangle was drawn into.
HWY_INLINE void note_drawn(Tile& tile, const TriangleInTile& seen) {
    constexpr int kOften = 16;  // ours: half of it and twice of it take longer
    visit_blocks(seen, [&](int block) {
        if (++tile.drawn[block] < kOften) return true;
        tile.drawn[block] = 0;
        tile.block_near[block] = least_near_of(tile, block);
        return true;
    });
}

void CoverSolid(Tile& tile, const TileTriangle& triangle, std::uint32_t id) {
    TriangleInTile seen;
    if (!find_in_tile(triangle, tile, seen) || is_hidden(tile, triangle, seen)) return;
    note_drawn(tile, seen);
    const int step = lanes();
    for (int x = seen.left / step * step; x <= seen.last_x; x += step) {
        const SampleColumn column(triangle, seen, tile, x);
        for (int y = seen.top; y <= seen.last_y; ++y) {
            const SampleRow row(column, y);
            for (int s = 0; s < kTileSamples; ++s) {
                const SamplePlace at{.sample = s, .pixel = y * kTileWidth + x};
                const Covered covered = nearer(tile, at, row.covered(s));
                if (covered.which) keep(tile, at, covered, id);
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

// For what rounding has put beside the triangle.
HWY_INLINE Weights inside(Weights weights) {
    weights.second = clamp(weights.second, 0.0f, 1.0f);
    weights.third = clamp(weights.third, 0.0f, Float(1.0f) - weights.second);
    return weights;
}

// A value at the corners of a triangle.
struct CornerValues {
    float a, b, c;
};

HWY_INLINE Float between(const Weights& weights, const CornerValues& at) {
    return Float(at.a) + weights.second * Float(at.b - at.a) + weights.third * Float(at.c - at.a);
}

// How much a value changes over a pixel, where it is `value`.
HWY_INLINE Float change_of(const TileTriangle& triangle, const Weights& weights, const CornerValues& at,
                           Float value) {
    const auto [a, b, c] = at;
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
        result.alpha *= between(weights, {surface.colours[a].w, surface.colours[b].w, surface.colours[c].w});
    if (!surface.base_colour.texels) return result;
    const CornerValues us{surface.uvs[a].x, surface.uvs[b].x, surface.uvs[c].x};
    const CornerValues vs{surface.uvs[a].y, surface.uvs[b].y, surface.uvs[c].y};
    const Float u = between(weights, us), v = between(weights, vs);
    const TexturePlace place{u, v, change_of(triangle, weights, us, u), change_of(triangle, weights, vs, v)};
    result.alpha *= sample(surface.base_colour, place).w;
    const Float texels = max(texels_per_pixel(surface.base_colour, place), 1.0f);
    result.detail = log2(texels);
    return result;
}

// How many samples are covered, to be rounded down, in two rows of up to a vector of pixels, and at least two columns:
// squares of four pixels, in which alpha changes from one to the next.
struct CoveredSamples {
    alignas(64) float rows[2][kMostTileLanes];
};

// Seen from near the step at the cutoff becomes a ramp as wide as a pixel, from afar alpha is the covered share
// itself; its height is a number of samples.
inline CoveredSamples find_coverage(const TileTriangle& triangle, const TileSurface& surface, float left,
                                    float top) {
    const float cutoff = surface.lit->material.alpha_cutoff;
    const int step = lanes(), columns = std::max(step, 2);
    alignas(64) float alphas[2][kMostTileLanes], details[2][kMostTileLanes];
    const Float right = to_float(hn::Iota(IntTag(), 0));
    for (int row = 0; row < 2; ++row) {
        for (int i = 0; i < columns; i += step) {
            const AlphaOfPixels at = alpha_at(triangle, surface, right + Float(left + static_cast<float>(i)),
                                              Float(top + static_cast<float>(row)));
            hn::StoreU(at.alpha.lanes, FloatTag(), alphas[row] + i);
            hn::StoreU(at.detail.lanes, FloatTag(), details[row] + i);
        }
    }
    CoveredSamples covered;
    for (int row = 0; row < 2; ++row) {
        alignas(64) float beside[kMostTileLanes];
        for (int i = 0; i < columns; ++i) beside[i] = alphas[row][i ^ 1];
        for (int i = 0; i < columns; i += step) {
            const Float alpha = load(alphas[row] + i);
            const Float change =
                abs(alpha - load(beside + i)) + abs(load(alphas[0] + i) - load(alphas[1] + i));
            const Float ramp = clamp((alpha - Float(cutoff)) / max(change, 1e-4f) + Float(0.5f), 0.0f, 1.0f);
            const Float samples =
                mix(ramp, alpha, min(load(details[row] + i), 1.0f)) * Float(4.0f) + Float(0.5f);
            store(samples, covered.rows[row] + i);
        }
    }
    return covered;
}

void CoverCutOut(Tile& tile, const TileTriangle& triangle, const TileSurface& surface, std::uint32_t id) {
    // From how many covered samples on each one is, in each order: they are taken across the pixel from each other.
    constexpr float kFrom[kSampleOrders][kTileSamples] = {
        {1, 3, 4, 2}, {4, 2, 3, 1}, {3, 1, 2, 4}, {2, 4, 1, 3}};
    const float* from = kFrom[surface.sample_orders[triangle.corners[0]]];
    TriangleInTile seen;
    if (!find_in_tile(triangle, tile, seen) || is_hidden(tile, triangle, seen)) return;
    note_drawn(tile, seen);
    const int step = lanes(), columns = std::max(step, 2);
    for (int x = seen.left / columns * columns; x <= seen.last_x; x += columns) {
        const SampleColumn left(triangle, seen, tile, x), right(triangle, seen, tile, x + columns - step);
        for (int y = seen.top / 2 * 2; y <= seen.last_y; y += 2) {
            CoveredSamples samples;
            bool known = false;
            for (int row = std::max(y, seen.top); row < y + 2 && row <= seen.last_y; ++row) {
                for (int i = 0; i < columns; i += step) {
                    const SampleRow samples_of_row(i == 0 ? left : right, row);
                    for (int s = 0; s < kTileSamples; ++s) {
                        const SamplePlace at{.sample = s, .pixel = row * kTileWidth + x + i};
                        Covered covered = nearer(tile, at, samples_of_row.covered(s));
                        covered.which = covered.which & (covered.nearness > Float(0.0f));
                        if (!covered.which) continue;
                        if (!known)
                            samples = find_coverage(triangle, surface, static_cast<float>(tile.x + x) + 0.5f,
                                                    static_cast<float>(tile.y + y) + 0.5f);
                        known = true;
                        covered.which = covered.which & (load(samples.rows[row - y] + i) >= Float(from[s]));
                        if (covered.which) keep(tile, at, covered, id);
                    }
                }
            }
        }
    }
}

int CoverTranslucent(const Tile& tile, const TileTriangle& triangle, TileCoverage& covered) {
    TriangleInTile seen;
    if (!find_in_tile(triangle, tile, seen) || is_hidden(tile, triangle, seen)) return 0;
    const int step = lanes();
    int count = 0;
    for (int x = seen.left / step * step; x <= seen.last_x; x += step) {
        const SampleColumn column(triangle, seen, tile, x);
        for (int y = seen.top; y <= seen.last_y; ++y) {
            const SampleRow row(column, y);
            alignas(64) std::int32_t samples[kMostTileLanes];
            IntLanes bits = whole(0);
            for (int s = 0; s < kTileSamples; ++s) {
                const SamplePlace at{.sample = s, .pixel = y * kTileWidth + x};
                const Mask which = nearer(tile, at, row.covered(s)).which;
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
