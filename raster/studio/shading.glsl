// How a surface looks in the light of the studio: the one formula of every renderer. It is read as GLSL 4.50 by
// the rasterizer of raster/gl, as C++ through raster/studio/shading.h, and as C++ on several pixels at once by
// raster/tiles. So it keeps to what all share: float literals with an f, no swizzles, no uniforms, SHARED before
// every function, mix() in place of ?:, and `if` only on what is the same for a whole surface.
//
// Light is linear throughout; radiances are such that a white Lambert surface that faces a light of radiance 1
// shows 1. All directions are unit and in the world.

// A point of a surface, seen from one side.
struct ShadedPoint {
    vec3 normal;
    vec3 towards_eye;
    vec3 mirror;  // reflectance straight on
    float rough;  // perceptual, as in glTF, in [0.2, 1]
    float ambient_occlusion;  // share of ambient light that arrives, in [0, 1]; 1: nothing is occluded
    vec3 scatter;      // how far red, green and blue light creep round into the shade, as cosines
    float coat;        // of a clear, wet layer, in [0, 1]
    float coat_rough;  // as `rough`
    float anisotropy;  // how much rougher it is along a direction than across it, in [0, 1]
    vec3 along;        // that direction, at right angles to the normal; read where `anisotropy` is above 0
};

// Light from one direction, or from a disc of directions.
struct Illuminant {
    vec3 towards;  // the middle of the light
    vec3 radiance;
    float wrap;  // how far it reaches round into the shade, as a cosine; 0: Lambert
    float size;  // sine of its angular radius; 0 for one direction, as of one ray to a light
};

// How a light and the eye lie to a point, whose normal is half-way between them in a mirror.
struct Reflection {
    vec3 half_way;  // between the light and the eye
    float aligned;  // cosine between the normal and that
    float faced;    // cosine between the normal and the light, at least 0
    float facing;   // facing_of
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

// Light that strikes several facets of a rough surface before it leaves. One reflection alone, as GGX describes
// it, sends back 1 - 0.55 * rough of uniform light from a perfect mirror; what is missing leaves after more
// reflections, coloured each time. This is the factor for one reflection.
SHARED vec3 reflected_on(vec3 mirror, float rough) {
    return 1.0f + mirror * (1.0f / (1.0f - 0.55f * rough) - 1.0f);
}

// Reflectance at grazing angles: all, but less where so little is mirrored straight on that the surface must be
// occluded in itself. Lagarde and de Rousiers, "Moving Frostbite to Physically Based Rendering", 2014.
SHARED float mirrored_at_grazing(vec3 mirror) {
    return min((mirror.x + mirror.y + mirror.z) * (50.0f / 3.0f), 1.0f);
}

// The share of uniform light from everywhere that a rough surface mirrors.
// Karis, "Physically Based Shading on Mobile", 2014: the fit of the split sum; and what is reflected on.
SHARED vec3 mirrored_ambient(vec3 mirror, float rough, float facing) {
    vec4 r = rough * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a = min(r.x * r.x, exp2(-9.28f * facing)) * r.x + r.y;
    float grazing = mirrored_at_grazing(mirror);
    return (mirror * (-1.04f * a + r.z) + grazing * (1.04f * a + r.w)) * reflected_on(mirror, rough);
}

// What the coat mirrors of uniform light from everywhere; 4 % straight on, as water, tears and oil do.
SHARED float coat_ambient(ShadedPoint point, float facing) {
    return point.coat * mirrored_ambient(vec3(0.04f), point.coat_rough, facing).x;
}

// Light that scatters under the surface softens the shade that lies on it, red furthest.
SHARED vec3 bled(float arrives, vec3 scatter) {
    return arrives + 2.0f * scatter * (arrives * (1.0f - arrives));
}

SHARED Lit light_from_everywhere(ShadedPoint point, vec3 sky, vec3 ground) {
    float facing = facing_of(point);
    vec3 mirrored = mirrored_ambient(point.mirror, point.rough, facing);
    float coated = coat_ambient(point, facing);
    vec3 around = ambient_from(2.0f * facing * point.normal.y - point.towards_eye.y, sky, ground) *
                  point.ambient_occlusion;
    Lit lit;
    lit.diffuse = (1.0f - coated) * (1.0f - mirrored) * ambient_from(point.normal.y, sky, ground) *
                  bled(point.ambient_occlusion, point.scatter);
    lit.mirrored = ((1.0f - coated) * mirrored + coated) * around;
    return lit;
}

// The part of a light that arrives, where `visible` in [0, 1] of it is not hidden. Faces turned from the light
// are dark by themselves; fading out there spares them false shadows.
SHARED float arriving(ShadedPoint point, Illuminant light, float visible) {
    float faced = max(dot(point.normal, light.towards), 0.0f);
    return mix(1.0f, visible, smoothstep(-0.05f, 0.25f, faced));
}

// The cosine law, softened where the light is about to set: the mean of max(0, cosine) over `faced` +- `soft`.
SHARED float softened(float faced, float soft) {
    float above = clamp(faced + soft, 0.0f, 2.0f * soft);
    return max(faced - soft, 0.0f) + above * above / max(4.0f * soft, 1e-4f);
}

// GGX, with the height-correlated masking of Hammon's fit; times the cosine to the light, over that of a white
// Lambert surface. A light of some size widens the peak, which keeps what it holds.
SHARED float highlight(float rough, float size, Reflection way) {
    float alpha = rough * rough;
    float wide2 = min(alpha * alpha + 0.25f * size * size, 1.0f);
    float spread = way.aligned * way.aligned * (wide2 - 1.0f) + 1.0f;
    float peak = wide2 / (spread * spread);
    float masking = 0.5f / mix(2.0f * way.faced * way.facing, way.faced + way.facing, alpha);
    return peak * masking * way.faced;
}

// The direction along which a surface is rougher, from its tangent and bitangent, whose handedness is `tangent.w`:
// `turn` holds the shares of both. At right angles to the normal, or 0 where there is none.
SHARED vec3 rough_along(vec3 normal, vec4 tangent, float turn_x, float turn_y) {
    vec3 right = vec3(tangent.x, tangent.y, tangent.z);
    vec3 along = right * turn_x + cross(normal, right) * (turn_y * tangent.w);
    along = along - normal * dot(normal, along);
    return along * (1.0f / sqrt(max(dot(along, along), 1e-12f)));
}

// KHR_materials_anisotropy: D_GGX_anisotropic and V_GGX_anisotropic, times what `highlight` is times. As there a light
// of some size widens the peak. We differ: what is reflected on, and light from everywhere, know `rough` alone.
SHARED float stretched_highlight(ShadedPoint point, Illuminant light, Reflection way) {
    vec3 across = cross(point.normal, point.along);
    float alpha = point.rough * point.rough;
    float alpha_along = mix(alpha, 1.0f, point.anisotropy * point.anisotropy);
    float wide_along = sqrt(min(alpha_along * alpha_along + 0.25f * light.size * light.size, 1.0f));
    float wide_across = sqrt(min(alpha * alpha + 0.25f * light.size * light.size, 1.0f));
    float both = wide_along * wide_across;
    vec3 spread = vec3(wide_across * dot(point.along, way.half_way), wide_along * dot(across, way.half_way),
                       both * dot(point.normal, way.half_way));
    float narrow = both / max(dot(spread, spread), 1e-12f);
    float peak = both * narrow * narrow;
    vec3 from = vec3(alpha_along * dot(point.along, light.towards), alpha * dot(across, light.towards), way.faced);
    vec3 eye = point.towards_eye;
    vec3 to = vec3(alpha_along * dot(point.along, eye), alpha * dot(across, eye), way.facing);
    float masking = 0.5f / (way.faced * sqrt(dot(to, to)) + way.facing * sqrt(dot(from, from)));
    return peak * min(masking, 1.0f) * way.faced;
}

// `arrives` in [0, 1]: the part of the light that is not hidden. A full coat mirrors its lights whatever shades
// the surface: lids, lashes and brow hide but a part of the large face of a lamp from an eye, and an eye without
// its highlight looks dead.
SHARED Lit light_from(ShadedPoint point, Illuminant light, float arrives) {
    float cosine = dot(point.normal, light.towards);
    Reflection way;
    way.half_way = normalize(light.towards + point.towards_eye);
    way.aligned = max(dot(point.normal, way.half_way), 0.0f);
    way.faced = max(cosine, 0.0f);
    way.facing = facing_of(point);
    float grazing = 1.0f - max(dot(point.towards_eye, way.half_way), 0.0f);
    float grazing5 = grazing * grazing * (grazing * grazing) * grazing;
    vec3 fresnel = point.mirror + (mirrored_at_grazing(point.mirror) - point.mirror) * grazing5;
    float coated = point.coat * (0.04f + 0.96f * grazing5);
    float softness = light.wrap + light.size;
    vec3 soft_faced = vec3(softened(cosine, softness + point.scatter.x), softened(cosine, softness + point.scatter.y),
                           softened(cosine, softness + point.scatter.z));
    float shine = highlight(point.rough, light.size, way);
    if (point.anisotropy > 0.0f) {
        float stretched = stretched_highlight(point, light, way);
        shine = mix(shine, stretched, point.anisotropy > 0.0f);
    }
    Lit lit;
    lit.diffuse = light.radiance * (1.0f - coated) * (1.0f - fresnel) * soft_faced * bled(arrives, point.scatter);
    lit.mirrored = light.radiance * (1.0f - coated) * fresnel * reflected_on(point.mirror, point.rough) *
                   (arrives * shine);
    if (point.coat > 0.0f) {
        float shines = mix(arrives, 1.0f, point.coat * point.coat);
        lit.mirrored += light.radiance * (coated * shines * highlight(max(point.coat_rough, 0.1f), light.size, way));
    }
    return lit;
}

SHARED Lit sum_of(Lit a, Lit b) {
    Lit lit;
    lit.diffuse = a.diffuse + b.diffuse;
    lit.mirrored = a.mirrored + b.mirrored;
    return lit;
}

// Reflectance straight on of a surface of this base colour: `reflectance` of what is no metal, the colour of what is.
SHARED vec3 mirror_of(vec3 base, float metal, vec3 reflectance) {
    return mix(reflectance, base, metal);
}

// What the eye sees of a lit surface that also glows by itself.
SHARED vec3 seen(vec3 base, float metal, Lit lit, vec3 glow) {
    return base * (1.0f - metal) * lit.diffuse + lit.mirrored + glow;
}

// Tone mapping, Khronos PBR Neutral: base colours stay as they are, highlights roll off without a change of hue.
SHARED vec3 neutral_tone(vec3 colour) {
    const float start = 0.8f - 0.04f;
    const float room = 1.0f - start;
    float least = min(colour.x, min(colour.y, colour.z));
    colour -= mix(0.04f, least - 6.25f * least * least, least < 0.08f);
    float peak = max(colour.x, max(colour.y, colour.z));
    float new_peak = 1.0f - room * room / (max(peak, start) + room - start);
    float bleached = 1.0f - 1.0f / (0.15f * (peak - new_peak) + 1.0f);
    vec3 rolled = mix(colour * (new_peak / peak), vec3(new_peak), bleached);
    return mix(rolled, colour, bvec3(peak < start));
}

// IEC 61966-2-1; what is outside [0, 1] is clamped. Two roots take the place of the power 1/2.4, which costs a
// software rasteriser as much as all the light: the fit is off by 0.03 of 255 levels at most, and exact at white.
SHARED vec3 encoded_srgb(vec3 colour) {
    colour = clamp(colour, 0.0f, 1.0f);
    vec3 root = sqrt(colour);
    vec3 curve = 0.9089801f * root + 0.2564261f * sqrt(root) + colour * (0.0334454f * root - 0.1280713f) - 0.0707803f;
    return mix(curve, 12.92f * colour, lessThanEqual(colour, vec3(0.0031308f)));
}
