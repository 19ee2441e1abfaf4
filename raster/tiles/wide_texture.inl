// Textures and the depth map as several pixels read them at once. Included after wide.inl.

// What items have; they have room for a whole vector beyond the last.
HWY_INLINE vec3 load3(const float (*from)[TileItems::kRoom], int i) {
    return {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
}
HWY_INLINE vec4 load4(const float (*from)[TileItems::kRoom], int i) {
    return {load(from[0] + i), load(from[1] + i), load(from[2] + i), load(from[3] + i)};
}

// The share of an image that a coordinate stands for, in [0, 1].
HWY_INLINE Float wrapped(Float place, Wrap wrap) {
    if (wrap == Wrap::clamp) return clamp(place, 0.0f, 1.0f);
    if (wrap == Wrap::repeat) return place - floor(place);
    const Float half = place * Float(0.5f);
    const Float round = (half - floor(half)) * Float(2.0f);  // in [0, 2)
    return mix(round, Float(2.0f) - round, round > Float(1.0f));
}

// Two neighbouring texels along a side, and how far the place lies from the first to the second.
struct Neighbours {
    IntLanes first, second;
    Float share;
};

HWY_INLINE Neighbours neighbours(Float place, IntLanes size, const TileImage& image, Wrap wrap) {
    const IntLanes zero = whole(0), last = hn::Sub(size, whole(1));
    const Float texels = place * to_float(size) - Float(image.smooth ? 0.5f : 0.0f);
    const Float left = floor(texels);
    IntLanes first = to_int(left), second = hn::Add(first, whole(image.smooth ? 1 : 0));
    if (wrap == Wrap::repeat) {
        first = hn::IfThenElse(hn::Lt(first, zero), last, first);
        second = hn::IfThenElse(hn::Gt(second, last), zero, second);
    }
    // Within the image whatever the coordinate was.
    first = hn::Max(zero, hn::Min(first, last));
    second = hn::Max(zero, hn::Min(second, last));
    return {first, second, image.smooth ? texels - left : Float(0.0f)};
}

HWY_INLINE Float channel(IntLanes texel, int shift, int mask, bool is_sqrt_encoded) {
    const IntLanes number = hn::And(hn::ShiftRightSame(texel, shift), whole(mask));
    const Float value = to_float(number);
    return is_sqrt_encoded ? value * value : value;
}

// Numbers from 0 to the largest of the image, not yet scaled.
HWY_INLINE vec4 unpacked(IntLanes texel, const TileImage& image) {
    const int bits = image.bits, mask = (1 << bits) - 1;
    const Float alpha = bits == 8 ? channel(texel, 24, 255, false) : Float(255.0f);
    return {channel(texel, 0, mask, image.is_sqrt_encoded), channel(texel, bits, mask, image.is_sqrt_encoded),
            channel(texel, 2 * bits, mask, image.is_sqrt_encoded), alpha};
}

HWY_INLINE vec4 blend(const vec4& a, const vec4& b, Float share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z),
            a.w + share * (b.w - a.w)};
}

// Linear between the four texels around a place of one level of an image.
HWY_INLINE vec4 sample_level(const TileImage& image, IntLanes level, Float u, Float v) {
    const IntTag d;
    const IntLanes width = hn::Max(whole(1), hn::Shr(whole(image.width), level));
    const IntLanes height = hn::Max(whole(1), hn::Shr(whole(image.height), level));
    const IntLanes start = hn::GatherIndex(d, image.starts, level);
    const Neighbours x = neighbours(u, width, image, image.wrap_u);
    const Neighbours y = neighbours(v, height, image, image.wrap_v);
    const auto* texels = reinterpret_cast<const std::int32_t*>(image.texels);
    const IntLanes upper = hn::Add(start, hn::Mul(y.first, width));
    const IntLanes lower = hn::Add(start, hn::Mul(y.second, width));
    const vec4 a = unpacked(hn::GatherIndex(d, texels, hn::Add(upper, x.first)), image);
    const vec4 b = unpacked(hn::GatherIndex(d, texels, hn::Add(upper, x.second)), image);
    const vec4 c = unpacked(hn::GatherIndex(d, texels, hn::Add(lower, x.first)), image);
    const vec4 e = unpacked(hn::GatherIndex(d, texels, hn::Add(lower, x.second)), image);
    return blend(blend(a, b, x.share), blend(c, e, x.share), y.share);
}

// Where pixels see a texture.
struct TexturePlace {
    Float u, v;
    Float footprint_u, footprint_v;  // how much u and v change over a pixel
};

// How many texels of the first level a pixel is wide: the largest change of a coordinate, as Mesa takes it.
HWY_INLINE Float texels_per_pixel(const TileImage& image, const TexturePlace& place) {
    return max(place.footprint_u * Float(static_cast<float>(image.width)),
               place.footprint_v * Float(static_cast<float>(image.height)));
}

// The binary exponent of a positive number, and the number over that power of two, in [1, 2).
HWY_INLINE IntLanes exponent_of(Float x) {
    return hn::Sub(hn::ShiftRight<23>(hn::BitCast(IntTag(), x.lanes)), whole(127));
}
HWY_INLINE Float mantissa_of(Float x) {
    const IntLanes bits = hn::BitCast(IntTag(), x.lanes);
    return Float(hn::BitCast(FloatTag(), hn::Or(hn::And(bits, whole(0x7fffff)), whole(0x3f800000))));
}

// For x above 0. The polynomial is ours, off by 1e-4 at most: a level of detail needs no more.
HWY_INLINE Float log2(Float x) {
    const Float f = mantissa_of(x) - Float(1.0f);
    return to_float(exponent_of(x)) +
           f * (Float(1.4417562f) +
                f * (Float(-0.7079401f) +
                     f * (Float(0.4129175f) + f * (Float(-0.1910835f) + f * Float(0.0443550f)))));
}

// An image as a pixel sees it, linear between two levels of detail.
HWY_INLINE vec4 sample(const TileImage& image, const TexturePlace& place) {
    const IntLanes coarsest = whole(image.levels - 1);
    const Float detail = log2(max(texels_per_pixel(image, place), 1e-6f));
    const Float inside_u = wrapped(place.u, image.wrap_u), inside_v = wrapped(place.v, image.wrap_v);
    const Float finer = floor(detail);
    IntLanes level = to_int(finer);
    Float further = detail - finer;
    const auto outside = hn::Or(hn::Lt(level, whole(0)), hn::Gt(level, whole(image.levels - 2)));
    further = mix(further, 0.0f, Mask{hn::RebindMask(FloatTag(), outside)});
    level = hn::Max(whole(0), hn::Min(level, coarsest));
    vec4 seen = sample_level(image, level, inside_u, inside_v);
    if (image.smooth && (further > Float(0.0f))) {
        const IntLanes next = hn::Min(hn::Add(level, whole(1)), coarsest);
        seen = blend(seen, sample_level(image, next, inside_u, inside_v), further);
    }
    const float most = static_cast<float>((1 << image.bits) - 1);
    const Float scale = 1.0f / (image.is_sqrt_encoded ? most * most : most);
    return {seen.x * scale, seen.y * scale, seen.z * scale, seen.w * Float(1.0f / 255.0f)};
}

// The lit share of the four texels of the depth map around a place, as seen at `depth`.
HWY_INLINE Float lit_share(const TileLights& lights, Float x, Float y, Float depth) {
    const IntLanes zero = whole(0), last = whole(lights.side - 1), side = whole(lights.side);
    const Float left = floor(x), bottom = floor(y);
    const IntLanes column = to_int(left), row = to_int(bottom);
    const IntLanes x0 = hn::Max(zero, hn::Min(column, last));
    const IntLanes x1 = hn::Max(zero, hn::Min(hn::Add(column, whole(1)), last));
    const IntLanes y0 = hn::Mul(hn::Max(zero, hn::Min(row, last)), side);
    const IntLanes y1 = hn::Mul(hn::Max(zero, hn::Min(hn::Add(row, whole(1)), last)), side);
    const FloatTag f;
    const Float one = 1.0f, none = 0.0f;
    const Float a = mix(none, one, depth <= Float(hn::GatherIndex(f, lights.depth, hn::Add(y0, x0))));
    const Float b = mix(none, one, depth <= Float(hn::GatherIndex(f, lights.depth, hn::Add(y0, x1))));
    const Float c = mix(none, one, depth <= Float(hn::GatherIndex(f, lights.depth, hn::Add(y1, x0))));
    const Float e = mix(none, one, depth <= Float(hn::GatherIndex(f, lights.depth, hn::Add(y1, x1))));
    const Float across = x - left;
    const Float low = a + across * (b - a), high = c + across * (e - c);
    return low + (y - bottom) * (high - low);
}
