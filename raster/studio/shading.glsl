// How a surface looks in the light of the studio: the one formula of every renderer. It is read as GLSL 4.50 by
// the rasterizer and as C++ through raster/studio/shading.h, so it keeps to what both languages share: float
// literals with an f, no swizzles, no uniforms, SHARED before every function.
//
// Light is linear throughout; radiances are such that a white Lambert surface that faces a light of radiance 1
// shows 1. All directions are unit and in the world.

// A point of a surface, seen from one side.
struct ShadedPoint {
    vec3 normal;
    vec3 towards_eye;
    vec3 mirror;  // reflectance straight on
    float rough;  // perceptual, as in glTF, in [0.2, 1]
    float open;   // to light from everywhere, in [0, 1]
};

// Light from one direction.
struct Illuminant {
    vec3 towards;  // the light
    vec3 radiance;
    float wrap;  // how far it reaches round into the shade; 0: Lambert
};

struct Lit {
    vec3 diffuse;   // to be multiplied with the surface's colour
    vec3 mirrored;  // as it is
};

// Cosine between the normal and the eye; grazing views stop short of dividing by zero.
SHARED float facing_of(ShadedPoint point) {
    return max(dot(point.normal, point.towards_eye), 1e-3f);
}

// Light from everywhere, for a direction that points up by `upwards` in [-1, 1].
SHARED vec3 ambient_from(float upwards, vec3 sky, vec3 ground) {
    return mix(ground, sky, 0.5f + 0.5f * upwards);
}

// The share of uniform light from everywhere that a rough surface mirrors.
// Karis, "Physically Based Shading on Mobile", 2014: the fit of the split sum.
SHARED vec3 mirrored_ambient(vec3 mirror, float rough, float facing) {
    vec4 r = rough * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a = min(r.x * r.x, exp2(-9.28f * facing)) * r.x + r.y;
    return mirror * (-1.04f * a + r.z) + (1.04f * a + r.w);
}

SHARED Lit light_from_everywhere(ShadedPoint point, vec3 sky, vec3 ground) {
    float facing = facing_of(point);
    vec3 mirrored = mirrored_ambient(point.mirror, point.rough, facing);
    float mirrored_upwards = 2.0f * facing * point.normal.y - point.towards_eye.y;
    Lit lit;
    lit.diffuse = (1.0f - mirrored) * ambient_from(point.normal.y, sky, ground) * point.open;
    lit.mirrored = mirrored * ambient_from(mirrored_upwards, sky, ground) * point.open;
    return lit;
}

// The part of a light that arrives, where `visible` in [0, 1] of it is not hidden. Faces turned from the light
// are dark by themselves; fading out there spares them false shadows.
SHARED float arriving(ShadedPoint point, Illuminant light, float visible) {
    float faced = max(dot(point.normal, light.towards), 0.0f);
    return mix(1.0f, visible, smoothstep(-0.05f, 0.25f, faced));
}

// `arrives` in [0, 1]: the part of the light that is not hidden.
SHARED Lit light_from(ShadedPoint point, Illuminant light, float arrives) {
    float facing = facing_of(point);
    float alpha = point.rough * point.rough;
    float alpha2 = alpha * alpha;
    float faced = dot(point.normal, light.towards);
    float soft_faced = clamp((faced + light.wrap) / (1.0f + light.wrap), 0.0f, 1.0f);
    faced = max(faced, 0.0f);
    // GGX, with the height-correlated masking of Hammon's fit.
    vec3 half_way = normalize(light.towards + point.towards_eye);
    float aligned = max(dot(point.normal, half_way), 0.0f);
    float spread = aligned * aligned * (alpha2 - 1.0f) + 1.0f;
    float peak = alpha2 / (spread * spread);
    float masking = 0.5f / mix(2.0f * faced * facing, faced + facing, alpha);
    float grazing = 1.0f - max(dot(point.towards_eye, half_way), 0.0f);
    float grazing2 = grazing * grazing;
    vec3 fresnel = point.mirror + (1.0f - point.mirror) * (grazing2 * grazing2 * grazing);
    vec3 radiance = light.radiance * arrives;
    Lit lit;
    lit.diffuse = radiance * (1.0f - fresnel) * soft_faced;
    lit.mirrored = radiance * fresnel * (peak * masking * faced);
    return lit;
}

SHARED Lit sum_of(Lit a, Lit b) {
    Lit lit;
    lit.diffuse = a.diffuse + b.diffuse;
    lit.mirrored = a.mirrored + b.mirrored;
    return lit;
}

// Reflectance straight on of a surface of this base colour: 4 % of what is no metal, the colour of what is.
SHARED vec3 mirror_of(vec3 base, float metal) {
    return mix(vec3(0.04f), base, metal);
}

// What the eye sees of a lit surface that also glows by itself.
SHARED vec3 seen(vec3 base, float metal, Lit lit, vec3 glow) {
    return base * (1.0f - metal) * lit.diffuse + lit.mirrored + glow;
}

// Khronos PBR Neutral: base colours stay as they are, highlights roll off without a change of hue.
SHARED vec3 neutral_tone(vec3 colour) {
    const float start = 0.8f - 0.04f;
    const float room = 1.0f - start;
    float least = min(colour.r, min(colour.g, colour.b));
    colour -= least < 0.08f ? least - 6.25f * least * least : 0.04f;
    float peak = max(colour.r, max(colour.g, colour.b));
    float new_peak = 1.0f - room * room / (max(peak, start) + room - start);
    float bleached = 1.0f - 1.0f / (0.15f * (peak - new_peak) + 1.0f);
    vec3 rolled = mix(colour * (new_peak / peak), vec3(new_peak), bleached);
    return peak < start ? colour : rolled;
}

// IEC 61966-2-1; what is outside [0, 1] is clamped.
SHARED vec3 encoded_srgb(vec3 colour) {
    colour = clamp(colour, 0.0f, 1.0f);
    vec3 curve = 1.055f * pow(colour, vec3(1.0f / 2.4f)) - 0.055f;
    return mix(curve, 12.92f * colour, lessThanEqual(colour, vec3(0.0031308f)));
}
