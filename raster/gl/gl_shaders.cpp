#include "raster/gl/gl_shaders.h"

#include <array>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "raster/studio/shading.h"

namespace chironomia {
namespace {

// The lights of the scene, and their sum at a point.
constexpr const char* kLighting = R"(
uniform vec3 eye;
uniform vec3 reflectance;
uniform vec3 sky;
uniform vec3 ground;
#if LIGHTS > 0
uniform vec3 light_towards[LIGHTS];
uniform vec3 light_radiance[LIGHTS];
uniform float light_wrap[LIGHTS];
uniform float light_size[LIGHTS];
#endif
#ifdef SCATTERING
uniform vec3 scatter;
#else
const vec3 scatter = vec3(0.0);
#endif
#ifdef COATED
uniform float coat;
uniform float coat_roughness;
#else
const float coat = 0.0;
const float coat_roughness = 1.0;
#endif

#ifdef ANISOTROPIC
uniform float anisotropy;
uniform float anisotropy_turn;
#else
const float anisotropy = 0.0;
#endif

ShadedPoint point_at(vec3 position, vec3 normal, vec3 f0, float rough) {
    return ShadedPoint(normal, normalize(eye - position), f0, clamp(rough, 0.2, 1.0), 1.0,
                       scatter, coat, coat_roughness, anisotropy, normal);
}

// `visible`: part of the first light that arrives.
Lit light_on(ShadedPoint point, float visible) {
    Lit lit = ambient_light(point, sky, ground);
#if LIGHTS > 0
    for (int i = 0; i < LIGHTS; ++i) {
        Illuminant light = Illuminant(light_towards[i], light_radiance[i], light_wrap[i], light_size[i]);
        float arrives = point.ambient_occlusion;
#ifdef SHADOW
        if (i == 0) arrives = arriving(point, light, visible);
#endif
        lit = sum_of(lit, light_from(point, light, arrives));
    }
#endif
    return lit;
}
)";

constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 colour;
layout(location = 5) in float ambient_occlusion;
layout(location = 6) in vec2 shadow;  // VertexShadow
layout(location = 7) in float sample_order;

uniform mat4 clip_from_world;
uniform float roughness;

uniform vec4 base_colour;
uniform vec3 emissive;

#if defined(FINISHED)
out vec3 shown;
#elif defined(PER_VERTEX)
out vec3 lit_diffuse;
out vec3 lit_specular;
#ifdef LIT_ON_BOTH_SIDES
out vec3 lit_diffuse_behind;
out vec3 lit_specular_behind;
#endif
#endif
#ifdef PIXEL_SHADOW
out vec3 key_diffuse;  // what the first light adds where it is not hidden
out vec3 key_specular;
#endif
#ifdef SURFACE
out vec3 world_position;
out vec4 world_normal;  // w: ambient_occlusion
#ifdef SHADOW
out vec2 vertex_shadow;
#endif
#endif
#ifdef TEXTURED
out vec2 texture_place;
#endif
#ifdef WORLD_TANGENT
out vec4 world_tangent;
#endif
#ifdef VERTEX_COLOUR
out vec4 vertex_colour;
#endif
#ifdef MANY_SAMPLES
flat out float order_of_samples;
#endif

void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
#ifdef PER_VERTEX
    ShadedPoint point = point_at(position, normal, reflectance, roughness);
    point.ambient_occlusion = ambient_occlusion;
#ifdef ANISOTROPIC
    point.along = rough_along(normal, tangent, cos(anisotropy_turn), sin(anisotropy_turn));
#endif
#ifdef PIXEL_SHADOW
    Lit lit = light_on(point, 0.0);
    Lit unhidden = light_on(point, 1.0);
    key_diffuse = unhidden.diffuse - lit.diffuse;
    key_specular = unhidden.specular - lit.specular;
#else
    Lit lit = light_on(point, shadow.x);
#endif
#ifdef FINISHED
    shown = encoded_srgb(neutral_tone(seen(base_colour.rgb, 0.0, lit, emissive)));
#else
    lit_diffuse = lit.diffuse;
    lit_specular = lit.specular;
#ifdef LIT_ON_BOTH_SIDES
    point.normal = -point.normal;
    Lit behind = light_on(point, shadow.x);
    lit_diffuse_behind = behind.diffuse;
    lit_specular_behind = behind.specular;
#endif
#endif
#endif
#ifdef SURFACE
    world_position = position;
    world_normal = vec4(normal, ambient_occlusion);
#ifdef SHADOW
    vertex_shadow = shadow;
#endif
#endif
#ifdef TEXTURED
    texture_place = uv;
#endif
#ifdef WORLD_TANGENT
    world_tangent = tangent;
#endif
#ifdef VERTEX_COLOUR
    vertex_colour = colour;
#endif
#ifdef MANY_SAMPLES
    order_of_samples = sample_order;
#endif
}
)";

// The result is sRGB, multiplied by its alpha.
constexpr const char* kFragmentShader = R"(
#if defined(FINISHED)
in vec3 shown;
#elif defined(PER_VERTEX)
in vec3 lit_diffuse;
in vec3 lit_specular;
#ifdef LIT_ON_BOTH_SIDES
in vec3 lit_diffuse_behind;
in vec3 lit_specular_behind;
#endif
#endif
#ifdef PIXEL_SHADOW
in vec3 key_diffuse;
in vec3 key_specular;
#endif
#ifdef SURFACE
in vec3 world_position;
in vec4 world_normal;
#endif
#ifdef TEXTURED
in vec2 texture_place;
#endif
#ifdef WORLD_TANGENT
in vec4 world_tangent;
#endif
#ifdef VERTEX_COLOUR
in vec4 vertex_colour;
#endif

out vec4 result;

uniform vec4 base_colour;
uniform float metallic;
uniform float roughness;
uniform vec3 emissive;
uniform float normal_scale;
uniform float occlusion_strength;
uniform float alpha_cutoff;
uniform sampler2D base_colour_map;
uniform sampler2D normal_map;
uniform sampler2D metallic_roughness_map;
uniform sampler2D occlusion_map;
uniform sampler2D emissive_map;
uniform sampler2D anisotropy_map;
#if defined(SHADOW) && defined(SURFACE)
in vec2 vertex_shadow;
uniform sampler2DShadow shadow_map;
uniform mat4 map_from_world;
uniform float shadow_extent;  // side of the map [m]
uniform float shadow_range;   // depth of the map [m]
uniform float shadow_offset;  // along the normal [m]
uniform float shadow_bias;    // in depth
uniform float shadow_least;   // radius of the sharpest edge [m]
uniform float shadow_wide;    // radius from which shadows are smooth enough to be known at the vertices [m]

// The part of the first light that arrives. Where the penumbra is narrow the disc it covers on the map is
// filtered along a spiral of golden angles (Vogel); the plane of the surface is compared, not its depth alone.
// A loop of no rounds is what this rasteriser skips; both ways of an `if` it would walk.
float visibility(vec3 normal) {
    const mat2 golden = mat2(-0.737369, 0.675490, -0.675490, -0.737369);
    float radius = max(vertex_shadow.y, shadow_least);
    float wide = smoothstep(0.6 * shadow_wide, shadow_wide, radius);
    int taps = vertex_shadow.y > 0.0 && wide < 1.0 ? 16 : 0;
    vec3 place = (map_from_world * vec4(world_position + normal * shadow_offset, 1.0)).xyz;
    vec3 seen = mat3(map_from_world) * normal * vec3(shadow_extent, shadow_extent, -shadow_range);
    vec2 slope = seen.xy / max(seen.z, 0.1) * (shadow_extent / shadow_range);
    vec2 direction = vec2(radius / shadow_extent, 0.0);
    float sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 step = direction * sqrt((float(i) + 0.5) / 16.0);
        sum += textureLod(shadow_map, place + vec3(step, dot(step, slope) - shadow_bias), 0.0);
        direction = golden * direction;
    }
    return taps == 0 ? vertex_shadow.x : mix(sum / 16.0, vertex_shadow.x, wide);
}
#endif

#ifdef MANY_SAMPLES
flat in float order_of_samples;

// By order and number of samples, as in raster/tiles/wide_cover.inl.
const int kSampleMasks[20] = int[20](0, 1, 9, 11, 15, 0, 8, 10, 14, 15, 0, 2, 6, 7, 15, 0, 4, 5, 13, 15);
#endif

void main() {
    vec4 base = base_colour;
#ifdef VERTEX_COLOUR
    base *= vertex_colour;
#endif
#ifdef BASE_COLOUR_MAP
    base *= texture(base_colour_map, texture_place);
#endif
#ifdef CUT_OUT
#ifdef MANY_SAMPLES
    // Seen from near the step at the cutoff becomes a ramp as wide as a pixel, from afar alpha is the covered
    // share itself; its height is a number of samples.
    float ramp = clamp((base.a - alpha_cutoff) / max(fwidth(base.a), 1e-4) + 0.5, 0.0, 1.0);
#ifdef BASE_COLOUR_MAP
    float covered = mix(ramp, base.a, clamp(textureQueryLod(base_colour_map, texture_place).y, 0.0, 1.0));
#else
    float covered = ramp;
#endif
    int samples = int(covered * 4.0 + 0.5);
    if (samples == 0) discard;
    gl_SampleMask[0] = kSampleMasks[5 * int(order_of_samples) + samples];
#else
    if (base.a < alpha_cutoff) discard;
#endif
#endif
#ifdef TRANSLUCENT
    float alpha = base.a;
#else
    const float alpha = 1.0;
#endif
    vec3 glow = emissive;
#ifdef EMISSIVE_MAP
    glow *= texture(emissive_map, texture_place).rgb;
#endif

#if defined(FINISHED)
    result = vec4(shown, 1.0);
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) result.rgb *= 0.7;
#endif
#elif defined(UNLIT)
    result = vec4(encoded_srgb(base.rgb) * alpha, alpha);
#elif defined(PER_VERTEX)
    Lit lit = Lit(lit_diffuse, lit_specular);
#ifdef PIXEL_SHADOW
    float visible = visibility(normalize(world_normal.xyz));
    lit = sum_of(lit, Lit(visible * key_diffuse, visible * key_specular));
#endif
#ifdef LIT_ON_BOTH_SIDES
    if (!gl_FrontFacing) lit = Lit(lit_diffuse_behind, lit_specular_behind);
#endif
    vec3 colour = seen(base.rgb, 0.0, lit, glow);
#if defined(DOUBLE_SIDED) && !defined(LIT_ON_BOTH_SIDES)
    if (!gl_FrontFacing) colour *= 0.5;  // the inside of a sleeve or collar
#endif
    result = vec4(encoded_srgb(neutral_tone(colour)) * alpha, alpha);
#else
    vec3 normal = normalize(world_normal.xyz);
#ifdef NORMAL_MAP
    vec3 bitangent = cross(normal, world_tangent.xyz) * world_tangent.w;
    vec3 bump = texture(normal_map, texture_place).xyz * 2.0 - 1.0;
    bump.xy *= normal_scale;
    normal = normalize(bump.x * world_tangent.xyz + bump.y * bitangent + bump.z * normal);
#endif
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) normal = -normal;
#endif
    float metal = metallic;
    float rough = roughness;
#ifdef METALLIC_ROUGHNESS_MAP
    vec2 metal_rough = texture(metallic_roughness_map, texture_place).bg;
    metal *= metal_rough.x;
    rough *= metal_rough.y;
#endif
    float ambient_occlusion = world_normal.w;
#ifdef OCCLUSION_MAP
    ambient_occlusion *= 1.0 + occlusion_strength * (texture(occlusion_map, texture_place).r - 1.0);
#endif
    float visible = 1.0;
#ifdef SHADOW
    visible = visibility(normal);
#endif
    ShadedPoint point = point_at(world_position, normal, f0_of(base.rgb, metal, reflectance), rough);
    point.ambient_occlusion = ambient_occlusion;
#ifdef ANISOTROPIC
    vec2 turn = vec2(cos(anisotropy_turn), sin(anisotropy_turn));
#ifdef ANISOTROPY_MAP
    vec3 direction = texture(anisotropy_map, texture_place).rgb;
    turn = mat2(turn, -turn.y, turn.x) * (direction.xy * 2.0 - 1.0);
    point.anisotropy *= direction.z;
#endif
    vec4 tangent = world_tangent;
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) tangent.w = -tangent.w;  // the bitangent is that of the front
#endif
    point.along = rough_along(normal, tangent, turn.x, turn.y);
#endif
    vec3 colour = seen(base.rgb, metal, light_on(point, visible), glow);
    result = vec4(encoded_srgb(neutral_tone(colour)) * alpha, alpha);
#endif
}
)";

std::string defines(const SurfaceFeatures& features, int samples) {
    const std::pair<const char*, bool> switches[] = {
        {"TEXTURED", features.textured()},
        {"PER_VERTEX", features.per_vertex},
        {"PIXEL_SHADOW", features.pixel_shadow && features.shadow},
        {"SURFACE", !features.per_vertex || (features.pixel_shadow && features.shadow)},
        {"FINISHED", features.finished()},
        {"SHADOW", features.shadow},
        {"BASE_COLOUR_MAP", features.base_colour_map},
        {"NORMAL_MAP", features.normal_map},
        {"METALLIC_ROUGHNESS_MAP", features.metallic_roughness_map},
        {"OCCLUSION_MAP", features.occlusion_map},
        {"EMISSIVE_MAP", features.emissive_map},
        {"VERTEX_COLOUR", features.vertex_colour},
        {"COATED", features.coated},
        {"ANISOTROPIC", features.anisotropic},
        {"ANISOTROPY_MAP", features.anisotropy_map},
        {"WORLD_TANGENT", !features.per_vertex && (features.normal_map || features.anisotropic)},
        {"SCATTERING", features.scattering},
        {"UNLIT", features.unlit},
        {"CUT_OUT", features.cut_out},
        {"MANY_SAMPLES", features.cut_out && samples > 1},
        {"LIT_ON_BOTH_SIDES", features.lit_on_both_sides()},
        {"TRANSLUCENT", features.translucent},
        {"DOUBLE_SIDED", features.double_sided},
    };
    std::string text = format("#version 450 core\n#define LIGHTS {}\n", features.lights);
    for (const auto& [name, on] : switches) {
        if (on) text += format("#define {}\n", name);
    }
    return text;
}

GLuint compiled(const GlFunctions& gl, GLenum kind, const std::string& head, const char* body) {
    const GLuint shader = gl.CreateShader(kind);
    const std::array<const char*, 2> parts = {head.c_str(), body};
    gl.ShaderSource(shader, 2, parts.data(), nullptr);
    gl.CompileShader(shader);
    GLint worked = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &worked);
    if (worked) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<size_t>(length));
    gl.DeleteShader(shader);
    throw Error(format("OpenGL: this driver refuses a shader: {}; install Mesa 22.3", log));
}

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, const SurfaceFeatures& features, int samples) : gl_(gl) {
    const std::string head = defines(features, samples) + std::string(shading_in_glsl()) + kLighting;
    program_ = gl.CreateProgram();
    for (const auto& [kind, body] :
         {std::pair{GL_VERTEX_SHADER, kVertexShader}, {GL_FRAGMENT_SHADER, kFragmentShader}}) {
        const GLuint shader = compiled(gl, kind, head, body);
        gl.AttachShader(program_, shader);
        gl.DeleteShader(shader);  // goes with the program
    }
    gl.LinkProgram(program_);
    GLint worked = 0;
    gl.GetProgramiv(program_, GL_LINK_STATUS, &worked);
    if (!worked) throw Error("OpenGL: this driver cannot link the shaders; install Mesa 22.3");

    use();
    const std::pair<const char*, GLint> maps[] = {
        {"base_colour_map", texture_unit::base_colour},
        {"normal_map", texture_unit::normal},
        {"metallic_roughness_map", texture_unit::metallic_roughness},
        {"occlusion_map", texture_unit::occlusion},
        {"emissive_map", texture_unit::emissive},
        {"anisotropy_map", texture_unit::anisotropy},
        {"shadow_map", texture_unit::shadow},
    };
    for (const auto& [name, unit] : maps) gl.Uniform1i(uniform(name), unit);
}

GlProgram::~GlProgram() {
    gl_.DeleteProgram(program_);
}

}  // namespace chironomia
