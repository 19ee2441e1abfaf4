// Soft shadows at vertices. Included after wide.inl.

// Receivers of the shadow: places that may lie in it, in the grid of the map: x, y in texels, depth in [0, 1], and how
// the depth of the surface's plane changes per texel.
struct Receivers {
    Float x, y, depth, slope_x, slope_y;
};

struct WideShadow {
    const VertexShadowSearch& search;
    const DepthMap& map;
    vec3 right, up, towards;
    Float bias;

    HWY_INLINE explicit WideShadow(const VertexShadowSearch& from)
        : search(from),
          map(from.map),
          right(map.right),
          up(map.up),
          towards(map.towards),
          bias(map.texel / map.range) {}

    HWY_INLINE Receivers receivers_at(const vec3& position, const vec3& normal, Float lit) const {
        const vec3 place = position + normal * Float(map.off_surface());
        const Float per_depth = Float(map.texel) / (Float(map.range) * max(lit, 0.1f));
        return {(dot(right, place) - Float(map.left)) / Float(map.texel),
                (dot(up, place) - Float(map.bottom)) / Float(map.texel),
                (Float(map.top) - dot(towards, place)) / Float(map.range), dot(normal, right) * per_depth,
                dot(normal, up) * per_depth};
    }

    // How far the surface's planes lie under what the map shows at texels, in depth; negative where they are on top.
    HWY_INLINE Float under(const Receivers& receivers, IntLanes x, IntLanes y) const {
        const Float plane = receivers.depth + receivers.slope_x * (to_float(x) + Float(0.5f) - receivers.x) +
                            receivers.slope_y * (to_float(y) + Float(0.5f) - receivers.y);
        const IntLanes zero = whole(0), last = whole(map.side - 1);
        x = hn::Max(zero, hn::Min(x, last));
        y = hn::Max(zero, hn::Min(y, last));
        const IntLanes place = hn::Add(hn::Mul(y, whole(map.side)), x);
        return plane - Float(hn::GatherIndex(FloatTag(), map.depth.data(), place));
    }

    // How wide the penumbra of a caster at this height over the surface is [m].
    HWY_INLINE Float radius_under(Float height) const {
        const Penumbra& penumbra = search.penumbra;
        return clamp(height * Float(penumbra.spread), penumbra.least, penumbra.most);
    }

    // Above the receivers [m]; negative where nothing there can shade them.
    HWY_INLINE Float mean_height_of_casters(const Receivers& receivers) const {
        constexpr float kBulge = 0.3f;  // height over distance
        const float around = search.penumbra.around;
        Float sum = 0.0f, count = 0.0f;
        for (const ShadowTap& tap : search.taps) {
            const Float depth = under(receivers, to_int(receivers.x + Float(tap.step.x)),
                                      to_int(receivers.y + Float(tap.step.y)));
            Mask casts = depth > bias;
            if (!casts) continue;
            const Float height = depth * Float(map.range);
            // Between vertices that are far apart the surface itself rises over their planes.
            if (around > 0) casts = casts & (height >= Float(kBulge * tap.away));
            casts = casts & (Float(tap.away) <= radius_under(height) + Float(around) + Float(map.texel));
            sum += mix(0.0f, height, casts);
            count += mix(0.0f, 1.0f, casts);
        }
        return mix(-1.0f, sum / max(count, 1.0f), count > Float(0.0f));
    }

    // The lit part of a disc, each tap smooth between the texels around it.
    HWY_INLINE Float filtered(const Receivers& receivers, Float radius) const {
        Float sum = 0.0f;
        for (const Vec2& point : search.filter) {
            const Float x = receivers.x + Float(point.x) * radius - Float(0.5f);
            const Float y = receivers.y + Float(point.y) * radius - Float(0.5f);
            const Float left = floor(x), bottom = floor(y);
            const IntLanes column = to_int(left), row = to_int(bottom);
            const auto lit = [&](int i, int j) {
                const Float depth = under(receivers, hn::Add(column, whole(i)), hn::Add(row, whole(j)));
                return mix(0.0f, 1.0f, depth <= bias);
            };
            const Float at_low = lit(0, 0), at_high = lit(0, 1);
            const Float low = at_low + (x - left) * (lit(1, 0) - at_low);
            const Float high = at_high + (x - left) * (lit(1, 1) - at_high);
            sum += low + (y - bottom) * (high - low);
        }
        return sum / Float(static_cast<float>(search.filter.size()));
    }
};

void ShadowVertices(const VertexShadowSearch& search, const PosedSurface& surface,
                    std::span<const std::uint32_t> vertices, VertexShadow* shadows) {
    const WideShadow shadow(search);
    const Vec3* positions = surface.positions.data();
    const Vec3* normals = surface.normals.data();
    const int count = static_cast<int>(vertices.size());
    for (int i = 0; i < count; i += lanes()) {
        const int there = std::min(lanes(), count - i);
        alignas(64) float numbers[6][kMostLanes] = {};
        for (int k = 0; k < there; ++k) {
            const std::uint32_t vertex = vertices[static_cast<std::size_t>(i + k)];
            for (int axis = 0; axis < 3; ++axis) {
                numbers[axis][k] = positions[vertex][axis];
                numbers[3 + axis][k] = normals[vertex][axis];
            }
        }
        vec3 normal(load(numbers[3]), load(numbers[4]), load(numbers[5]));
        Float lit = dot(normal, shadow.towards);
        if (search.double_sided) {
            const Mask turned = lit < Float(0.0f);
            normal = mix(normal, -normal, bvec3(turned));
            lit = mix(lit, -lit, turned);
        }
        alignas(64) float visible[kMostLanes], radius[kMostLanes];
        store(1.0f, visible);
        store(0.0f, radius);
        if (lit > Float(0.0f)) {
            const vec3 position(load(numbers[0]), load(numbers[1]), load(numbers[2]));
            const Receivers receivers = shadow.receivers_at(position, normal, lit);
            const Float height = shadow.mean_height_of_casters(receivers);
            const Mask shaded = (lit > Float(0.0f)) & (height >= Float(0.0f));
            if (shaded) {
                const Float wide = shadow.radius_under(height);
                store(mix(1.0f, shadow.filtered(receivers, wide / Float(shadow.map.texel)), shaded), visible);
                store(mix(0.0f, wide, shaded), radius);
            }
        }
        for (int k = 0; k < there; ++k)
            shadows[vertices[static_cast<std::size_t>(i + k)]] = {.visible = visible[k], .radius = radius[k]};
    }
}
