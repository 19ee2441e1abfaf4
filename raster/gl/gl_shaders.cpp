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
uniform vec3 sky;
uniform vec3 ground;
#if LIGHTS > 0
uniform vec3 light_towards[LIGHTS];
uniform vec3 light_radiance[LIGHTS];
uniform float light_wrap[LIGHTS];
#endif

// `visible`: part of the first light that arrives.
Lit light_on(ShadedPoint point, float visible) {
    Lit lit = light_from_everywhere(point, sky, ground);
#if LIGHTS > 0
    for (int i = 0; i < LIGHTS; ++i) {
        Illuminant light = Illuminant(light_towards[i], light_radiance[i], light_wrap[i]);
        float arrives = point.open;
#ifdef SHADOW
        if (i == 0) arrives = arriving(point, light, visible);
#endif
        lit = sum_of(lit, light_from(point, light, arrives));
    }
#endif
    return lit;
}

vec3 towards_eye_from(vec3 position) { return normalize(eye - position); }
)";

constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 colour;
layout(location = 5) in float openness;
layout(location = 6) in float visible;

uniform mat4 clip_from_world;
uniform float roughness;

uniform vec4 base_colour;
uniform vec3 emissive;

#if defined(FINISHED)
out vec3 shown;
#elif defined(PER_VERTEX)
out vec3 lit_diffuse;
out vec3 lit_mirrored;
#else
out vec3 world_position;
out vec4 world_normal;  // w: openness
#endif
#ifdef TEXTURED
out vec2 texture_place;
#endif
#ifdef NORMAL_MAP
out vec4 world_tangent;
#endif
#ifdef VERTEX_COLOUR
out vec4 vertex_colour;
#endif

void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
#ifdef PER_VERTEX
    ShadedPoint point = ShadedPoint(normal, towards_eye_from(position), mirror_of(vec3(0.0), 0.0),
                                    max(roughness, 0.2), openness);
    Lit lit = light_on(point, visible);
#ifdef FINISHED
    shown = encoded_srgb(neutral_tone(seen(base_colour.rgb, 0.0, lit, emissive)));
#else
    lit_diffuse = lit.diffuse;
    lit_mirrored = lit.mirrored;
#endif
#else
    world_position = position;
    world_normal = vec4(normal, openness);
#endif
#ifdef TEXTURED
    texture_place = uv;
#endif
#ifdef NORMAL_MAP
    world_tangent = tangent;
#endif
#ifdef VERTEX_COLOUR
    vertex_colour = colour;
#endif
}
)";

// The result is sRGB, multiplied by its alpha.
constexpr const char* kFragmentShader = R"(
#if defined(FINISHED)
in vec3 shown;
#elif defined(PER_VERTEX)
in vec3 lit_diffuse;
in vec3 lit_mirrored;
#else
in vec3 world_position;
in vec4 world_normal;
#endif
#ifdef TEXTURED
in vec2 texture_place;
#endif
#ifdef NORMAL_MAP
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
#ifdef SHADOW
uniform sampler2DShadow shadow_map;
uniform mat4 map_from_world;
uniform float shadow_texel;   // in map coordinates
uniform float shadow_offset;  // along the normal [m]
#endif

#if defined(SHADOW) && !defined(PER_VERTEX)
// The part of the first light that arrives: nine bilinear comparisons over about five texels.
float visibility(vec3 normal) {
    vec3 place = (map_from_world * vec4(world_position + normal * shadow_offset, 1.0)).xyz;
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            vec2 step = vec2(1.5 * float(x) - 0.5 * float(y), 1.5 * float(y) + 0.5 * float(x));
            sum += texture(shadow_map, place + vec3(step * shadow_texel, 0.0));
        }
    }
    return sum / 9.0;
}
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
    if (base.a < alpha_cutoff) discard;
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
    vec3 colour = seen(base.rgb, 0.0, Lit(lit_diffuse, lit_mirrored), glow);
#ifdef DOUBLE_SIDED
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
    float open = world_normal.w;
#ifdef OCCLUSION_MAP
    open *= 1.0 + occlusion_strength * (texture(occlusion_map, texture_place).r - 1.0);
#endif
    float visible = 1.0;
#ifdef SHADOW
    visible = visibility(normal);
#endif
    ShadedPoint point = ShadedPoint(normal, towards_eye_from(world_position), mirror_of(base.rgb, metal),
                                    clamp(rough, 0.2, 1.0), open);
    vec3 colour = seen(base.rgb, metal, light_on(point, visible), glow);
    result = vec4(encoded_srgb(neutral_tone(colour)) * alpha, alpha);
#endif
}
)";

std::string defines(const ShaderFeatures& features) {
    const bool textured = features.base_colour_map || features.normal_map ||
                          features.metallic_roughness_map || features.occlusion_map || features.emissive_map;
    // Without anything that varies between vertices their colour can be finished there.
    const bool finished = features.per_vertex && !textured && !features.vertex_colour &&
                          !features.translucent && !features.cut_out;
    const std::pair<const char*, bool> switches[] = {
        {"TEXTURED", textured},
        {"PER_VERTEX", features.per_vertex},
        {"FINISHED", finished},
        {"SHADOW", features.shadow},
        {"BASE_COLOUR_MAP", features.base_colour_map},
        {"NORMAL_MAP", features.normal_map},
        {"METALLIC_ROUGHNESS_MAP", features.metallic_roughness_map},
        {"OCCLUSION_MAP", features.occlusion_map},
        {"EMISSIVE_MAP", features.emissive_map},
        {"VERTEX_COLOUR", features.vertex_colour},
        {"UNLIT", features.unlit},
        {"CUT_OUT", features.cut_out},
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

GlProgram::GlProgram(const GlFunctions& gl, const ShaderFeatures& features) : gl_(gl) {
    const std::string head = defines(features) + std::string(shading_in_glsl()) + kLighting;
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
        {"shadow_map", texture_unit::shadow},
    };
    for (const auto& [name, unit] : maps) gl.Uniform1i(uniform(name), unit);
}

GlProgram::~GlProgram() {
    gl_.DeleteProgram(program_);
}

}  // namespace chironomia
