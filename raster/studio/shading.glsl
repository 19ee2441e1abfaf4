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
    vec3 f0;      // reflectance at normal incidence
    float rough;  // perceptual, as in glTF, in [0.2, 1]
    float ambient_occlusion;  // share of ambient light that arrives, in [0, 1]; 1: nothing is occluded
    vec3 scatter;      // by how much red, green and blue light wrap round into the shade, as cosines
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

// The directions of a light and of the eye against the normal of a point.
struct ShadingAngles {
    vec3 half_way;  // between the light and the eye
    float n_dot_h;  // cosine between the normal and `half_way`, at least 0
    float n_dot_l;  // cosine between the normal and the light, at least 0
    float n_dot_v;  // n_dot_v_of
};

struct Lit {
    vec3 diffuse;   // to be multiplied with the surface's colour
    vec3 specular;  // as it is
};

// Cosine between the normal and the eye; grazing views stop short of dividing by zero.
SHARED float n_dot_v_of(ShadedPoint point) {
    return max(dot(point.normal, point.towards_eye), 1e-3f);
}

// Ambient light from a direction that points up by `upwards` in [-1, 1].
SHARED vec3 ambient_from(float upwards, vec3 sky, vec3 ground) {
    return mix(ground, sky, 0.5f + 0.5f * upwards);
}

// Light that is reflected by several facets of a rough surface before it leaves. One reflection alone, as GGX describes
// it, sends back 1 - 0.55 * rough of uniform light from a perfect mirror; what is missing leaves after more
// reflections, coloured each time. This is the factor for the first one.
SHARED vec3 multiple_scattering(vec3 f0, float rough) {
    return 1.0f + f0 * (1.0f / (1.0f - 0.55f * rough) - 1.0f);
}

// Reflectance at grazing angles, f90: 1, but less where f0 is so low that the surface must occlude itself. Lagarde and
// de Rousiers, "Moving Frostbite to Physically Based Rendering", 2014.
SHARED float f90_of(vec3 f0) {
    return min((f0.x + f0.y + f0.z) * (50.0f / 3.0f), 1.0f);
}

// The share of uniform ambient light that a rough surface reflects as specular light. Karis, "Physically Based Shading
// on Mobile", 2014: the fit of the split sum; times `multiple_scattering`.
SHARED vec3 specular_ambient(vec3 f0, float rough, float n_dot_v) {
    vec4 r = rough * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a = min(r.x * r.x, exp2(-9.28f * n_dot_v)) * r.x + r.y;
    float grazing = f90_of(f0);
    return (f0 * (-1.04f * a + r.z) + grazing * (1.04f * a + r.w)) * multiple_scattering(f0, rough);
}

// The share of uniform ambient light that the coat reflects; 4 % at normal incidence, as water, tears and oil do.
SHARED float coat_ambient(ShadedPoint point, float n_dot_v) {
    return point.coat * specular_ambient(vec3(0.04f), point.coat_rough, n_dot_v).x;
}

// Light that scatters under the surface softens the shade that lies on it, red furthest.
SHARED vec3 scattered_shadow(float arrives, vec3 scatter) {
    return arrives + 2.0f * scatter * (arrives * (1.0f - arrives));
}

SHARED Lit ambient_light(ShadedPoint point, vec3 sky, vec3 ground) {
    float n_dot_v = n_dot_v_of(point);
    vec3 specular = specular_ambient(point.f0, point.rough, n_dot_v);
    float coated = coat_ambient(point, n_dot_v);
    vec3 around = ambient_from(2.0f * n_dot_v * point.normal.y - point.towards_eye.y, sky, ground) *
                  point.ambient_occlusion;
    Lit lit;
    lit.diffuse = (1.0f - coated) * (1.0f - specular) * ambient_from(point.normal.y, sky, ground) *
                  scattered_shadow(point.ambient_occlusion, point.scatter);
    lit.specular = ((1.0f - coated) * specular + coated) * around;
    return lit;
}

// The part of a light that arrives, where `visible` in [0, 1] of it is not hidden. Faces turned from the light
// are dark by themselves; fading out there spares them false shadows.
SHARED float arriving(ShadedPoint point, Illuminant light, float visible) {
    float n_dot_l = max(dot(point.normal, light.towards), 0.0f);
    return mix(1.0f, visible, smoothstep(-0.05f, 0.25f, n_dot_l));
}

// The cosine law, softened where the light is about to set: the mean of max(0, cosine) over `n_dot_l` +- `soft`.
SHARED float softened(float n_dot_l, float soft) {
    float above = clamp(n_dot_l + soft, 0.0f, 2.0f * soft);
    return max(n_dot_l - soft, 0.0f) + above * above / max(4.0f * soft, 1e-4f);
}

// GGX, with the height-correlated masking of Hammon's fit; times the cosine to the light, over that of a white
// Lambert surface. A light of some size widens the peak, which keeps what it holds.
SHARED float highlight(float rough, float size, ShadingAngles angles) {
    float alpha = rough * rough;
    float wide2 = min(alpha * alpha + 0.25f * size * size, 1.0f);
    float spread = angles.n_dot_h * angles.n_dot_h * (wide2 - 1.0f) + 1.0f;
    float peak = wide2 / (spread * spread);
    float masking = 0.5f / mix(2.0f * angles.n_dot_l * angles.n_dot_v, angles.n_dot_l + angles.n_dot_v, alpha);
    return peak * masking * angles.n_dot_l;
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
// of some size widens the peak. We differ: multiple scattering and ambient light use `rough` alone.
SHARED float stretched_highlight(ShadedPoint point, Illuminant light, ShadingAngles angles) {
    vec3 across = cross(point.normal, point.along);
    float alpha = point.rough * point.rough;
    float alpha_along = mix(alpha, 1.0f, point.anisotropy * point.anisotropy);
    float wide_along = sqrt(min(alpha_along * alpha_along + 0.25f * light.size * light.size, 1.0f));
    float wide_across = sqrt(min(alpha * alpha + 0.25f * light.size * light.size, 1.0f));
    float both = wide_along * wide_across;
    vec3 spread = vec3(wide_across * dot(point.along, angles.half_way), wide_along * dot(across, angles.half_way),
                       both * dot(point.normal, angles.half_way));
    float narrow = both / max(dot(spread, spread), 1e-12f);
    float peak = both * narrow * narrow;
    vec3 from = vec3(alpha_along * dot(point.along, light.towards), alpha * dot(across, light.towards), angles.n_dot_l);
    vec3 eye = point.towards_eye;
    vec3 to = vec3(alpha_along * dot(point.along, eye), alpha * dot(across, eye), angles.n_dot_v);
    float masking = 0.5f / (angles.n_dot_l * sqrt(dot(to, to)) + angles.n_dot_v * sqrt(dot(from, from)));
    return peak * min(masking, 1.0f) * angles.n_dot_l;
}

// `arrives` in [0, 1]: the part of the light that is not hidden. A full coat reflects its lights even where the
// surface lies in shadow: lids, lashes and brow hide only a part of a large lamp from an eye, and an eye without
// a highlight looks lifeless.
SHARED Lit light_from(ShadedPoint point, Illuminant light, float arrives) {
    float cosine = dot(point.normal, light.towards);
    ShadingAngles angles;
    angles.half_way = normalize(light.towards + point.towards_eye);
    angles.n_dot_h = max(dot(point.normal, angles.half_way), 0.0f);
    angles.n_dot_l = max(cosine, 0.0f);
    angles.n_dot_v = n_dot_v_of(point);
    float grazing = 1.0f - max(dot(point.towards_eye, angles.half_way), 0.0f);
    float grazing5 = grazing * grazing * (grazing * grazing) * grazing;
    vec3 fresnel = point.f0 + (f90_of(point.f0) - point.f0) * grazing5;
    float coated = point.coat * (0.04f + 0.96f * grazing5);
    float softness = light.wrap + light.size;
    vec3 soft_n_dot_l = vec3(softened(cosine, softness + point.scatter.x), softened(cosine, softness + point.scatter.y),
                             softened(cosine, softness + point.scatter.z));
    float shine = highlight(point.rough, light.size, angles);
    if (point.anisotropy > 0.0f) {
        float stretched = stretched_highlight(point, light, angles);
        shine = mix(shine, stretched, point.anisotropy > 0.0f);
    }
    Lit lit;
    lit.diffuse = light.radiance * (1.0f - coated) * (1.0f - fresnel) * soft_n_dot_l *
                  scattered_shadow(arrives, point.scatter);
    lit.specular = light.radiance * (1.0f - coated) * fresnel * multiple_scattering(point.f0, point.rough) *
                   (arrives * shine);
    if (point.coat > 0.0f) {
        float shines = mix(arrives, 1.0f, point.coat * point.coat);
        lit.specular += light.radiance * (coated * shines * highlight(max(point.coat_rough, 0.1f), light.size, angles));
    }
    return lit;
}

SHARED Lit sum_of(Lit a, Lit b) {
    Lit lit;
    lit.diffuse = a.diffuse + b.diffuse;
    lit.specular = a.specular + b.specular;
    return lit;
}

// Reflectance at normal incidence: that of a metal is its base colour, that of anything else is `reflectance`.
SHARED vec3 f0_of(vec3 base, float metal, vec3 reflectance) {
    return mix(reflectance, base, metal);
}

// What the eye sees of a lit surface that also glows by itself.
SHARED vec3 seen(vec3 base, float metal, Lit lit, vec3 glow) {
    return base * (1.0f - metal) * lit.diffuse + lit.specular + glow;
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
