// Numbers, vectors and booleans of several pixels or vertices at once, with what the light formula of
// raster/studio/shading.glsl asks of them. Included once for each instruction set, between HWY_BEFORE_NAMESPACE and
// HWY_AFTER_NAMESPACE.

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMostLanes = 16;

using FloatTag = hn::CappedTag<float, kMostLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using FloatLanes = hn::Vec<FloatTag>;
using IntLanes = hn::Vec<IntTag>;
using MaskLanes = hn::Mask<FloatTag>;

struct Mask {
    MaskLanes lanes;
    // Whether it holds in any lane. The light formula asks that only of what is the same in all lanes.
    HWY_INLINE explicit operator bool() const { return !hn::AllFalse(FloatTag(), lanes); }
};

struct Float {
    FloatLanes lanes;
    Float() = default;
    HWY_INLINE Float(float value) : lanes(hn::Set(FloatTag(), value)) {}
    HWY_INLINE Float(FloatLanes from) : lanes(from) {}
};

HWY_INLINE Float operator+(Float a, Float b) {
    return hn::Add(a.lanes, b.lanes);
}
HWY_INLINE Float operator-(Float a, Float b) {
    return hn::Sub(a.lanes, b.lanes);
}
HWY_INLINE Float operator*(Float a, Float b) {
    return hn::Mul(a.lanes, b.lanes);
}
HWY_INLINE Float operator/(Float a, Float b) {
    return hn::Div(a.lanes, b.lanes);
}
HWY_INLINE Float operator-(Float a) {
    return hn::Neg(a.lanes);
}
HWY_INLINE Float& operator+=(Float& a, Float b) {
    return a = a + b;
}
HWY_INLINE Float& operator*=(Float& a, Float b) {
    return a = a * b;
}
HWY_INLINE Mask operator&(Mask a, Mask b) {
    return {hn::And(a.lanes, b.lanes)};
}
HWY_INLINE Mask operator<(Float a, Float b) {
    return {hn::Lt(a.lanes, b.lanes)};
}
HWY_INLINE Mask operator>(Float a, Float b) {
    return {hn::Gt(a.lanes, b.lanes)};
}
HWY_INLINE Mask operator<=(Float a, Float b) {
    return {hn::Le(a.lanes, b.lanes)};
}
HWY_INLINE Mask operator>=(Float a, Float b) {
    return {hn::Ge(a.lanes, b.lanes)};
}

// `b` where the condition holds.
HWY_INLINE Float mix(Float a, Float b, Mask condition) {
    return hn::IfThenElse(condition.lanes, b.lanes, a.lanes);
}
HWY_INLINE Float min(Float a, Float b) {
    return hn::Min(a.lanes, b.lanes);
}
HWY_INLINE Float max(Float a, Float b) {
    return hn::Max(a.lanes, b.lanes);
}
HWY_INLINE Float clamp(Float x, Float low, Float high) {
    return min(max(x, low), high);
}
HWY_INLINE Float mix(Float a, Float b, Float share) {
    return a * (Float(1.0f) - share) + b * share;
}
HWY_INLINE Float sqrt(Float x) {
    return hn::Sqrt(x.lanes);
}
HWY_INLINE Float abs(Float x) {
    return hn::Abs(x.lanes);
}
HWY_INLINE Float floor(Float x) {
    return hn::Floor(x.lanes);
}
HWY_INLINE Float smoothstep(Float low, Float high, Float x) {
    const Float t = clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (Float(3.0f) - Float(2.0f) * t);
}

HWY_INLINE int lanes() {
    return static_cast<int>(hn::Lanes(FloatTag()));
}
HWY_INLINE IntLanes whole(int value) {
    return hn::Set(IntTag(), value);
}
HWY_INLINE IntLanes to_int(Float x) {
    return hn::ConvertTo(IntTag(), x.lanes);
}
HWY_INLINE Float to_float(IntLanes x) {
    return hn::ConvertTo(FloatTag(), x);
}

HWY_INLINE Float load(const float* from) {
    return hn::LoadU(FloatTag(), from);
}
HWY_INLINE void store(Float value, float* to) {
    hn::StoreU(value.lanes, FloatTag(), to);
}

// For x in [-126, 0]. The polynomial is ours, least relative error on [0, 1): 8e-8.
HWY_INLINE Float exp2(Float x) {
    const Float whole = floor(x);
    const Float f = x - whole;
    const Float power =
        Float(1.0f) +
        f * (Float(0.69315129f) +
             f * (Float(0.24016476f) +
                  f * (Float(0.055798794f) + f * (Float(0.0090185992f) + f * Float(0.0018663882f)))));
    const IntLanes exponent = hn::ShiftLeft<23>(hn::Add(to_int(whole), hn::Set(IntTag(), 127)));
    return power * Float(hn::BitCast(FloatTag(), exponent));
}

struct bvec3 {
    Mask x, y, z;
    bvec3() = default;
    HWY_INLINE bvec3(Mask a, Mask b, Mask c) : x(a), y(b), z(c) {}
    HWY_INLINE explicit bvec3(Mask all) : x(all), y(all), z(all) {}
};

struct vec3 {
    Float x, y, z;
    vec3() = default;
    HWY_INLINE vec3(Float a, Float b, Float c) : x(a), y(b), z(c) {}
    HWY_INLINE explicit vec3(Float all) : x(all), y(all), z(all) {}
    HWY_INLINE explicit vec3(const Vec3& same) : x(same.x), y(same.y), z(same.z) {}
};

struct vec4 {
    Float x, y, z, w;
    vec4() = default;
    HWY_INLINE vec4(Float a, Float b, Float c, Float d) : x(a), y(b), z(c), w(d) {}
};

HWY_INLINE vec3 operator+(const vec3& a, const vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE vec3 operator-(const vec3& a, const vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE vec3 operator*(const vec3& a, const vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE vec3 operator+(const vec3& a, Float b) {
    return a + vec3(b);
}
HWY_INLINE vec3 operator+(Float a, const vec3& b) {
    return vec3(a) + b;
}
HWY_INLINE vec3 operator-(const vec3& a, Float b) {
    return a - vec3(b);
}
HWY_INLINE vec3 operator-(Float a, const vec3& b) {
    return vec3(a) - b;
}
HWY_INLINE vec3 operator-(const vec3& a) {
    return {-a.x, -a.y, -a.z};
}
HWY_INLINE vec3 operator*(const vec3& a, Float b) {
    return a * vec3(b);
}
HWY_INLINE vec3 operator*(Float a, const vec3& b) {
    return vec3(a) * b;
}
HWY_INLINE vec3& operator+=(vec3& a, const vec3& b) {
    return a = a + b;
}
HWY_INLINE vec3& operator-=(vec3& a, Float b) {
    return a = a - b;
}
HWY_INLINE vec3& operator*=(vec3& a, const vec3& b) {
    return a = a * b;
}

HWY_INLINE vec4 operator*(Float a, const vec4& b) {
    return {a * b.x, a * b.y, a * b.z, a * b.w};
}
HWY_INLINE vec4 operator*(const vec4& a, const vec4& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}
HWY_INLINE vec4 operator+(const vec4& a, const vec4& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}

HWY_INLINE Float dot(const vec3& a, const vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE vec3 cross(const vec3& a, const vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE vec3 normalize(const vec3& a) {
    return a * (Float(1.0f) / sqrt(dot(a, a)));
}
HWY_INLINE vec3 sqrt(const vec3& a) {
    return {sqrt(a.x), sqrt(a.y), sqrt(a.z)};
}
HWY_INLINE vec3 clamp(const vec3& a, Float low, Float high) {
    return {clamp(a.x, low, high), clamp(a.y, low, high), clamp(a.z, low, high)};
}
HWY_INLINE vec3 mix(const vec3& a, const vec3& b, Float share) {
    return a * (Float(1.0f) - share) + b * share;
}
HWY_INLINE vec3 mix(const vec3& a, const vec3& b, const bvec3& condition) {
    return {mix(a.x, b.x, condition.x), mix(a.y, b.y, condition.y), mix(a.z, b.z, condition.z)};
}
HWY_INLINE bvec3 lessThanEqual(const vec3& a, const vec3& b) {
    return {a.x <= b.x, a.y <= b.y, a.z <= b.z};
}
