// Light at vertices, values between them, and the colours of pixels: what raster/gl/gl_shaders.cpp does. Included
// after wide_cover.inl.

// Up to a vector of vertices of a surface.
struct WideVertices {
    std::span<const std::uint32_t> indices;

    // The first three components.
    template <typename Vector>
    HWY_INLINE vec3 load(const Vector* from) const {
        alignas(64) float numbers[3][kMostLanes] = {};
        for (std::size_t k = 0; k < indices.size(); ++k) {
            for (int axis = 0; axis < 3; ++axis) numbers[axis][k] = from[indices[k]][axis];
        }
        return {hn::Load(FloatTag(), numbers[0]), hn::Load(FloatTag(), numbers[1]),
                hn::Load(FloatTag(), numbers[2])};
    }

    HWY_INLINE vec4 load4(const Vec4* from) const {
        alignas(64) float w[kMostLanes] = {};
        for (std::size_t k = 0; k < indices.size(); ++k) w[k] = from[indices[k]].w;
        const vec3 others = load(from);
        return {others.x, others.y, others.z, hn::Load(FloatTag(), w)};
    }

    HWY_INLINE void store(const vec3& values, Vec3* to) const {
        alignas(64) float numbers[3][kMostLanes];
        hn::Store(values.x.lanes, FloatTag(), numbers[0]);
        hn::Store(values.y.lanes, FloatTag(), numbers[1]);
        hn::Store(values.z.lanes, FloatTag(), numbers[2]);
        for (std::size_t k = 0; k < indices.size(); ++k)
            to[indices[k]] = {numbers[0][k], numbers[1][k], numbers[2][k]};
    }
};

constexpr float kLeastRough = 0.2f;  // as ShadedPoint::rough

HWY_INLINE ShadedPoint point_at(const TileLights& lights, const Material& material, const vec3& position,
                                const vec3& normal) {
    return {normal,
            normalize(vec3(lights.eye) - position),
            vec3(material.reflectance),
            clamp(material.roughness, kLeastRough, 1.0f),
            1.0f,
            vec3(material.scatter),
            material.coat,
            material.coat > 0 ? material.coat_roughness : 1.0f,
            0.0f,
            normal};
}

// `visible`: part of the first light that arrives.
HWY_INLINE Lit light_of(const TileLights::One& one, const ShadedPoint& point, bool shadowed, Float visible) {
    const Illuminant light{vec3(one.towards), vec3(one.radiance), one.wrap, one.size};
    return light_from(point, light, shadowed ? arriving(point, light, visible) : point.ambient_occlusion);
}

// From everywhere and from all lights but the first.
HWY_INLINE Lit further_light(const TileLights& lights, const SurfaceFeatures& features,
                             const ShadedPoint& point) {
    Lit lit = ambient_light(point, vec3(lights.sky), vec3(lights.ground));
    for (int i = 1; i < features.lights; ++i)
        lit = sum_of(lit, light_of(lights.lights[i], point, false, 1.0f));
    return lit;
}

inline Lit light_on(const TileLights& lights, const SurfaceFeatures& features, const ShadedPoint& point,
                    Float visible) {
    const Lit lit = further_light(lights, features, point);
    if (features.lights == 0) return lit;
    return sum_of(lit, light_of(lights.lights[0], point, features.shadow, visible));
}

void LightVertices(const TileSurface& surface, const TileLights& lights,
                   std::span<const std::uint32_t> vertices) {
    const SurfaceFeatures& features = surface.lit->features;
    const Material& material = surface.lit->material;
    const auto step = static_cast<std::size_t>(lanes());
    for (std::size_t i = 0; i < vertices.size(); i += step) {
        const WideVertices some{vertices.subspan(i, std::min(step, vertices.size() - i))};
        alignas(64) float visible[kMostLanes] = {}, occlusion[kMostLanes] = {};
        for (std::size_t k = 0; k < some.indices.size(); ++k) {
            visible[k] = surface.shadows[some.indices[k]].visible;
            occlusion[k] = surface.ambient_occlusion[some.indices[k]];
        }
        ShadedPoint point =
            point_at(lights, material, some.load(surface.positions), some.load(surface.normals));
        point.ambient_occlusion = load(occlusion);
        if (features.anisotropic) {
            point.anisotropy = material.anisotropy;
            point.along = rough_along(point.normal, some.load4(surface.tangents),
                                      std::cos(material.anisotropy_turn), std::sin(material.anisotropy_turn));
        }
        Lit lit = light_on(lights, features, point, features.pixel_shadow ? Float(0.0f) : load(visible));
        if (features.pixel_shadow) {
            const Lit unhidden = light_on(lights, features, point, 1.0f);
            some.store(unhidden.diffuse - lit.diffuse, surface.more_diffuse);
            some.store(unhidden.specular - lit.specular, surface.more_specular);
        }
        if (features.finished()) {
            const vec3 base(Vec3(material.base_colour));
            lit.diffuse = encoded_srgb(neutral_tone(seen(base, 0.0f, lit, vec3(material.emissive))));
        }
        some.store(lit.diffuse, surface.diffuse);
        some.store(lit.specular, surface.specular);
        if (features.lit_on_both_sides()) {
            point.normal = -point.normal;
            const Lit behind = light_on(lights, features, point, load(visible));
            some.store(behind.diffuse, surface.more_diffuse);
            some.store(behind.specular, surface.more_specular);
        }
    }
}

// The items from `i` on, between the corners of their triangle.
struct ItemWeights {
    const TileTriangle& triangle;
    Weights weights;
    int i;

    // A value with three or four components.
    template <int kCount, typename Vector>
    HWY_INLINE void interpolate(const Vector* values, float (*to)[TileItems::kRoom]) const {
        const auto& [a, b, c] = triangle.corners;
        for (int k = 0; k < kCount; ++k)
            store(between(weights, {values[a][k], values[b][k], values[c][k]}), to[k] + i);
    }
};

// From the middle of a pixel to the middle of those of its samples whose bits are set [px]. It lies in the triangle
// that covers these, where the middle of the pixel may lie far outside of one that is thinner than a pixel.
struct SampleMiddles {
    float right[1 << kTileSamples] = {}, down[1 << kTileSamples] = {};

    constexpr SampleMiddles() {
        for (int set = 1; set < 1 << kTileSamples; ++set) {
            int count = 0, x = 0, y = 0;
            for (int s = 0; s < kTileSamples; ++s) {
                if ((set >> s & 1) == 0) continue;
                ++count;
                x += kSampleRight[static_cast<std::size_t>(s)] - 4;
                y += kSampleDown[static_cast<std::size_t>(s)] - 4;
            }
            right[set] = static_cast<float>(x) / static_cast<float>(8 * count);
            down[set] = static_cast<float>(y) / static_cast<float>(8 * count);
        }
    }
};
constexpr SampleMiddles kSampleMiddles;

void Interpolate(TileItems& items, const Tile& tile, const TileTriangle& triangle,
                 const TileSurface& surface) {
    const SurfaceFeatures& features = surface.lit->features;
    const auto [a, b, c] = triangle.corners;
    const bool at_pixels = !features.per_vertex && !features.unlit;
    const bool shadow_at_pixels = features.shadow && (at_pixels || features.pixel_shadow);
    const bool behind = features.lit_on_both_sides() && !triangle.front;
    const Vec3* diffuse = behind ? surface.more_diffuse : surface.diffuse;
    const Vec3* specular = behind ? surface.more_specular : surface.specular;
    const Float left = static_cast<float>(tile.x) + 0.5f, top = static_cast<float>(tile.y) + 0.5f;
    static_assert(kTileWidth == 64);
    for (int i = items.first; i < items.count; i += lanes()) {
        const IntLanes pixel = hn::LoadU(IntTag(), items.pixel + i);
        const IntLanes samples =
            hn::And(hn::LoadU(IntTag(), items.samples + i), whole((1 << kTileSamples) - 1));
        const Float x = to_float(hn::And(pixel, whole(kTileWidth - 1))) + left +
                        Float(hn::GatherIndex(FloatTag(), kSampleMiddles.right, samples));
        const Float y = to_float(hn::ShiftRight<6>(pixel)) + top +
                        Float(hn::GatherIndex(FloatTag(), kSampleMiddles.down, samples));
        const Weights weights = inside(weights_at(triangle, x, y));
        const ItemWeights some{triangle, weights, i};
        store(triangle.front ? 1.0f : -1.0f, items.facing + i);
        if (features.textured()) {
            for (int k = 0; k < 2; ++k) {
                const CornerValues at{surface.uvs[a][k], surface.uvs[b][k], surface.uvs[c][k]};
                const Float place = between(weights, at);
                store(place, items.uv[k] + i);
                store(change_of(triangle, weights, at, place), items.footprint[k] + i);
            }
        }
        if (features.vertex_colour) some.interpolate<4>(surface.colours, items.colour);
        if (features.per_vertex) {
            some.interpolate<3>(diffuse, items.diffuse);
            if (!features.finished()) some.interpolate<3>(specular, items.specular);
        }
        if (features.pixel_shadow) {
            some.interpolate<3>(surface.more_diffuse, items.more_diffuse);
            some.interpolate<3>(surface.more_specular, items.more_specular);
        }
        if (at_pixels || shadow_at_pixels) {
            some.interpolate<3>(surface.positions, items.position);
            some.interpolate<3>(surface.normals, items.normal);
        }
        if (at_pixels) {
            const float* occlusion = surface.ambient_occlusion;
            store(between(weights, {occlusion[a], occlusion[b], occlusion[c]}), items.ambient_occlusion + i);
            if (features.normal_map || features.anisotropic)
                some.interpolate<4>(surface.tangents, items.tangent);
        }
        if (shadow_at_pixels) {
            const VertexShadow &at_a = surface.shadows[a], &at_b = surface.shadows[b],
                               &at_c = surface.shadows[c];
            store(between(weights, {at_a.visible, at_b.visible, at_c.visible}), items.shadow[0] + i);
            store(between(weights, {at_a.radius, at_b.radius, at_c.radius}), items.shadow[1] + i);
        }
    }
}

HWY_INLINE vec3 rgb(const vec4& colour) {
    return {colour.x, colour.y, colour.z};
}

// Up to a vector of items of a surface, from `i` on.
struct WideItems {
    const TileSurface& surface;
    const TileLights& lights;
    const TileItems& items;
    int i;

    HWY_INLINE vec4 image_at(const TileImage& image) const {
        return sample(image, {load(items.uv[0] + i), load(items.uv[1] + i), load(items.footprint[0] + i),
                              load(items.footprint[1] + i)});
    }

    // The part of the first light that arrives. Where the penumbra is narrow the disc it covers on the map is filtered
    // along a spiral of golden angles (Vogel); the plane of the surface is compared, not its depth alone.
    Float visible_at(const vec3& normal) const {
        constexpr int kTaps = 16;
        const PixelShadow& shadow = surface.pixel_shadow;
        const Float vertex_visible = load(items.shadow[0] + i), vertex_radius = load(items.shadow[1] + i);
        const Float radius = max(vertex_radius, shadow.least);
        const Float wide = smoothstep(0.6f * shadow.wide, shadow.wide, radius);
        const Mask sought{hn::And((vertex_radius > Float(0.0f)).lanes, (wide < Float(1.0f)).lanes)};
        if (!sought) return vertex_visible;
        const Mat4& map = shadow.map_from_world;
        const vec3 x_axis(map[0][0], map[1][0], map[2][0]), y_axis(map[0][1], map[1][1], map[2][1]),
            z_axis(map[0][2], map[1][2], map[2][2]);
        const vec3 point = load3(items.position, i) + normal * Float(shadow.offset);
        const Float side = static_cast<float>(lights.side);
        const Float x = (dot(x_axis, point) + Float(map[3][0])) * side - Float(0.5f);
        const Float y = (dot(y_axis, point) + Float(map[3][1])) * side - Float(0.5f);
        const Float depth = dot(z_axis, point) + Float(map[3][2]) - Float(shadow.bias);
        const Float seen_z = max(dot(z_axis, normal) * Float(-shadow.range), 0.1f);
        const Float per_depth = shadow.extent / shadow.range;
        const Float slope_x = dot(x_axis, normal) * Float(shadow.extent) / seen_z * per_depth;
        const Float slope_y = dot(y_axis, normal) * Float(shadow.extent) / seen_z * per_depth;
        Float right = radius / Float(shadow.extent), up = 0.0f, sum = 0.0f;
        for (int k = 0; k < kTaps; ++k) {
            const Float reach = std::sqrt((static_cast<float>(k) + 0.5f) / kTaps);
            const Float step_x = right * reach, step_y = up * reach;
            sum += lit_share(lights, x + step_x * side, y + step_y * side,
                             depth + step_x * slope_x + step_y * slope_y);
            const Float turned = right * Float(-0.737369f) + up * Float(-0.675490f);
            up = right * Float(0.675490f) + up * Float(-0.737369f);
            right = turned;
        }
        return mix(vertex_visible, mix(sum * Float(1.0f / kTaps), vertex_visible, wide), sought);
    }

    HWY_INLINE vec3 seen_normal() const {
        const Material& material = surface.lit->material;
        vec3 normal = normalize(load3(items.normal, i));
        if (surface.lit->features.normal_map) {
            const vec4 tangent = load4(items.tangent, i);
            const vec3 bitangent = cross(normal, rgb(tangent)) * tangent.w;
            const vec3 bump = rgb(image_at(surface.normal)) * Float(2.0f) - Float(1.0f);
            normal = normalize(rgb(tangent) * (bump.x * Float(material.normal_scale)) +
                               bitangent * (bump.y * Float(material.normal_scale)) + normal * bump.z);
        }
        if (surface.lit->features.double_sided) normal = normal * load(items.facing + i);
        return normal;
    }

    HWY_INLINE void set_anisotropy(ShadedPoint& point) const {
        const Material& material = surface.lit->material;
        const Float cosine = std::cos(material.anisotropy_turn), sine = std::sin(material.anisotropy_turn);
        point.anisotropy = material.anisotropy;
        Float right = 1.0f, up = 0.0f;
        if (surface.lit->features.anisotropy_map) {
            const vec4 image = image_at(surface.anisotropy);
            right = image.x * Float(2.0f) - Float(1.0f);
            up = image.y * Float(2.0f) - Float(1.0f);
            point.anisotropy *= image.z;
        }
        vec4 tangent = load4(items.tangent, i);
        // The bitangent is that of the front.
        if (surface.lit->features.double_sided) tangent.w *= load(items.facing + i);
        point.along =
            rough_along(point.normal, tangent, cosine * right - sine * up, sine * right + cosine * up);
    }

    // Light is worked out here.
    vec3 lit_at_pixels(const vec3& base, const vec3& glow) const {
        const SurfaceFeatures& features = surface.lit->features;
        const Material& material = surface.lit->material;
        const vec3 normal = seen_normal();
        Float metal = material.metallic, rough = material.roughness;
        if (features.metallic_roughness_map) {
            const vec4 image = image_at(surface.metallic_roughness);
            metal *= image.z;
            rough *= image.y;
        }
        Float ambient_occlusion = load(items.ambient_occlusion + i);
        if (features.occlusion_map)
            ambient_occlusion *= Float(1.0f) + Float(material.occlusion_strength) *
                                                   (image_at(surface.occlusion).x - Float(1.0f));
        const Float visible = features.shadow ? visible_at(normal) : Float(1.0f);
        ShadedPoint point = point_at(lights, material, load3(items.position, i), normal);
        point.f0 = f0_of(base, metal, vec3(material.reflectance));
        point.rough = clamp(rough, kLeastRough, 1.0f);
        point.ambient_occlusion = ambient_occlusion;
        if (features.anisotropic) set_anisotropy(point);
        return seen(base, metal, light_on(lights, features, point, visible), glow);
    }

    // Light was worked out at the vertices.
    vec3 lit_at_vertices(const vec3& base, const vec3& glow) const {
        const SurfaceFeatures& features = surface.lit->features;
        Lit lit{load3(items.diffuse, i), load3(items.specular, i)};
        if (features.pixel_shadow && features.shadow) {
            const Float visible = visible_at(normalize(load3(items.normal, i)));
            lit.diffuse += visible * load3(items.more_diffuse, i);
            lit.specular += visible * load3(items.more_specular, i);
        }
        const vec3 colour = seen(base, 0.0f, lit, glow);
        if (!features.double_sided || features.lit_on_both_sides()) return colour;
        return colour *
               mix(1.0f, 0.5f, load(items.facing + i) < Float(0.0f));  // the inside of a sleeve or collar
    }
};

HWY_INLINE IntLanes level_of(Float value) {
    return to_int(clamp(value, 0.0f, 1.0f) * Float(255.0f) + Float(0.5f));
}

void Shade(TileItems& items, const TileSurface& surface, const TileLights& lights) {
    const SurfaceFeatures& features = surface.lit->features;
    const Material& material = surface.lit->material;
    for (int i = 0; i < items.count; i += lanes()) {
        const WideItems some{surface, lights, items, i};
        vec4 base(material.base_colour.x, material.base_colour.y, material.base_colour.z,
                  material.base_colour.w);
        if (features.vertex_colour) base = base * load4(items.colour, i);
        if (features.base_colour_map) base = base * some.image_at(surface.base_colour);
        vec3 glow(material.emissive);
        if (features.emissive_map) glow *= rgb(some.image_at(surface.emissive));
        vec3 shown;
        if (features.finished()) {
            shown = load3(items.diffuse, i);
            if (features.double_sided) shown = shown * mix(1.0f, 0.7f, load(items.facing + i) < Float(0.0f));
        } else if (features.unlit) {
            shown = encoded_srgb(rgb(base));
        } else if (features.per_vertex) {
            shown = encoded_srgb(neutral_tone(some.lit_at_vertices(rgb(base), glow)));
        } else {
            shown = encoded_srgb(neutral_tone(some.lit_at_pixels(rgb(base), glow)));
        }
        const Float alpha = features.translucent ? base.w : Float(1.0f);
        IntLanes result = hn::ShiftLeft<24>(level_of(alpha));
        result = hn::Or(result, hn::ShiftLeft<16>(level_of(shown.z * alpha)));
        result = hn::Or(result, hn::ShiftLeft<8>(level_of(shown.y * alpha)));
        result = hn::Or(result, level_of(shown.x * alpha));
        hn::StoreU(result, IntTag(), reinterpret_cast<std::int32_t*>(items.result + i));
    }
}
