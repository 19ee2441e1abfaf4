// Triangles of a depth map. Included after wide.inl.

// Texel centres on an edge belong to both its triangles, whichever way the arithmetic rounds.
constexpr float kEdge = 1e-4f;

// The whole numbers next to a coordinate that is not far outside of the map.
HWY_INLINE int rounded_up(float x) {
    const int whole = static_cast<int>(x);
    return whole + (static_cast<float>(whole) < x ? 1 : 0);
}
HWY_INLINE int rounded_down(float x) {
    const int whole = static_cast<int>(x);
    return whole - (static_cast<float>(whole) > x ? 1 : 0);
}

// The texels of a row that a triangle may cover.
struct RowSpan {
    float first = 0, last = 0;
};

// Where a weight of a triangle is at least `least`, which is linear along a row.
struct WeightSpan {
    float per_texel, texels, least;

    HWY_INLINE WeightSpan(float change, float least_)
        : per_texel(change), texels(1 / change), least(least_) {}

    // `at` is the weight at texel 0. One more texel stays on either side against rounding.
    HWY_INLINE void narrow(RowSpan& span, float at) const {
        if (per_texel > 0) span.first = std::max(span.first, (least - at) * texels - 1);
        if (per_texel < 0) span.last = std::min(span.last, (least - at) * texels + 1);
    }
};

// x, y [texels], z [depth].
struct DepthCorners {
    const Vec3 &a, &b, &c;
    float twice_area;  // below 0: turned away from the light

    HWY_INLINE DepthCorners(const Vec3& a_, const Vec3& b_, const Vec3& c_)
        : a(a_), b(b_), c(c_), twice_area((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) {}
};

// A triangle whose barycentric weights of b and c are linear over the grid.
struct DepthTriangle {
    Vec3 a{0};
    float b_dx = 0, b_dy = 0, c_dx = 0, c_dy = 0;
    float b_z = 0, c_z = 0;  // depth from that of a

    HWY_INLINE explicit DepthTriangle(const DepthCorners& corners) : a(corners.a) {
        const Vec3 &b = corners.b, &c = corners.c;
        const float scale = 1.0f / corners.twice_area;
        b_dx = (c.y - a.y) * scale, b_dy = -(c.x - a.x) * scale;
        c_dx = -(b.y - a.y) * scale, c_dy = (b.x - a.x) * scale;
        b_z = b.z - a.z;
        c_z = c.z - a.z;
    }
};

// The texels from `x` on that one vector holds.
template <class D>
struct DepthLanes {
    hn::Vec<D> b, c;  // shares of the weights that change along a row
    hn::Mask<D> inside;

    HWY_INLINE DepthLanes(D d, const DepthTriangle& triangle, int x, const RowSpan& span) {
        const hn::Vec<D> column = hn::Iota(d, static_cast<float>(x));
        const hn::Vec<D> px = hn::Sub(hn::Add(column, hn::Set(d, 0.5f)), hn::Set(d, triangle.a.x));
        b = hn::Mul(px, hn::Set(d, triangle.b_dx));
        c = hn::Mul(px, hn::Set(d, triangle.c_dx));
        inside = hn::And(hn::Ge(column, hn::Set(d, span.first)), hn::Le(column, hn::Set(d, span.last)));
    }

    HWY_INLINE void draw(D d, const DepthTriangle& triangle, float py, float* depth) const {
        const hn::Vec<D> least = hn::Set(d, -kEdge);
        const hn::Vec<D> of_b = hn::Add(b, hn::Set(d, py * triangle.b_dy));
        const hn::Vec<D> of_c = hn::Add(c, hn::Set(d, py * triangle.c_dy));
        hn::Mask<D> covered = hn::And(inside, hn::And(hn::Ge(of_b, least), hn::Ge(of_c, least)));
        covered = hn::And(covered, hn::Le(hn::Add(of_b, of_c), hn::Set(d, 1 + kEdge)));
        if (hn::AllFalse(d, covered)) return;
        const hn::Vec<D> kept = hn::LoadU(d, depth);
        const hn::Vec<D> z =
            hn::Add(hn::Add(hn::Set(d, triangle.a.z), hn::Mul(of_b, hn::Set(d, triangle.b_z))),
                    hn::Mul(of_c, hn::Set(d, triangle.c_z)));
        hn::StoreU(hn::IfThenElse(covered, hn::Min(kept, z), kept), d, depth);
    }
};

template <class D>
HWY_INLINE void draw_depth_triangle(D d, DepthMap& map, const DepthRows& rows, const DepthCorners& corners) {
    const Vec3 &a = corners.a, &b = corners.b, &c = corners.c;
    const auto last = static_cast<float>(map.side - 1);
    const int x0 = rounded_up(std::max(0.0f, std::min({a.x, b.x, c.x}) - 0.5f));
    const int x1 = rounded_down(std::min(last, std::max({a.x, b.x, c.x}) - 0.5f));
    const int y0 = std::max(rounded_up(std::max(0.0f, std::min({a.y, b.y, c.y}) - 0.5f)), rows.first);
    const int y1 = std::min(rounded_down(std::min(last, std::max({a.y, b.y, c.y}) - 0.5f)), rows.last - 1);
    if (x0 > x1 || y0 > y1) return;

    const DepthTriangle triangle(corners);
    const RowSpan all{static_cast<float>(x0), static_cast<float>(x1)};
    const auto side = static_cast<std::size_t>(map.side);
    float* row = map.depth.data() + static_cast<std::size_t>(y0) * side;
    // A vector never reaches into the next row, which may be another thread's.
    const int step = static_cast<int>(hn::Lanes(d)), furthest = map.side - step;
    if (x1 - x0 < step) {
        const int x = std::min(x0, furthest);
        const DepthLanes<D> texels(d, triangle, x, all);
        for (int y = y0; y <= y1; ++y, row += side)
            texels.draw(d, triangle, static_cast<float>(y) + 0.5f - a.y, row + x);
        return;
    }
    const float b_dx = triangle.b_dx, c_dx = triangle.c_dx;
    const WeightSpan of_b(b_dx, -kEdge), of_c(c_dx, -kEdge), of_a(-b_dx - c_dx, -1 - kEdge);
    const float offset = 0.5f - a.x;
    for (int y = y0; y <= y1; ++y, row += side) {
        const float py = static_cast<float>(y) + 0.5f - a.y;
        RowSpan span = all;
        const float at_b = py * triangle.b_dy + offset * b_dx, at_c = py * triangle.c_dy + offset * c_dx;
        of_b.narrow(span, at_b);
        of_c.narrow(span, at_c);
        of_a.narrow(span, -at_b - at_c);
        if (!(span.first <= span.last)) continue;
        const int end = std::min(x1, static_cast<int>(span.last) + 1);
        for (int from = static_cast<int>(span.first); from <= end; from += step) {
            const int x = std::min(from, furthest);
            const RowSpan rest{static_cast<float>(from), static_cast<float>(end)};
            DepthLanes<D>(d, triangle, x, rest).draw(d, triangle, py, row + x);
        }
    }
}

template <class D>
void draw_depth_triangles(D d, DepthMap& map, const DepthRows& rows, const DepthTriangles& triangles) {
    const Vec3* points = triangles.points.data();
    const std::span<const std::uint32_t> indices = triangles.corners;
    const float low = static_cast<float>(rows.first) - 1, high = static_cast<float>(rows.last) + 1;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vec3& a = points[indices[i]];
        const Vec3& b = points[indices[i + 1]];
        const Vec3& c = points[indices[i + 2]];
        if (std::max({a.y, b.y, c.y}) < low || std::min({a.y, b.y, c.y}) > high) continue;
        const DepthCorners corners(a, b, c);
        // Faces turned away from the light lie behind others.
        if (corners.twice_area > 1e-9f || (triangles.both_sides && corners.twice_area < -1e-9f))
            draw_depth_triangle(d, map, rows, corners);
    }
}

void DrawDepthTriangles(DepthMap& map, const DepthRows& rows, const DepthTriangles& triangles) {
    if (map.side >= lanes()) {
        draw_depth_triangles(FloatTag(), map, rows, triangles);
    } else {
        draw_depth_triangles(hn::CappedTag<float, 1>(), map, rows, triangles);
    }
}
