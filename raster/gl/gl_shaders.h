// The one shader of the figure, in the few variants that its materials need.
#pragma once

#include <compare>
#include <memory>

#include "raster/gl/gl_functions.h"

namespace chironomia {

// What a variant does beyond the plain material; a feature that is off costs nothing.
struct ShaderFeatures {
    int lights = 0;
    bool per_vertex = false;    // light is worked out at the vertices; for fine meshes without metal
    bool pixel_shadow = false;  // shadow and tone are worked out at the pixels even so
    bool shadow = false;        // of the first light
    bool base_colour_map = false;
    bool normal_map = false;
    bool metallic_roughness_map = false;
    bool occlusion_map = false;
    bool emissive_map = false;
    bool vertex_colour = false;
    bool coated = false;
    bool scattering = false;
    bool unlit = false;
    bool cut_out = false;       // alpha mask
    bool many_samples = false;  // a cut edge may take some of the samples of a pixel
    bool translucent = false;
    bool double_sided = false;

    auto operator<=>(const ShaderFeatures&) const = default;
};

namespace attribute {
enum Place : GLuint { position, normal, tangent, uv, colour, ambient_occlusion, shadow };
}

namespace texture_unit {
enum Place : GLint { base_colour, normal, metallic_roughness, occlusion, emissive, shadow };
}

inline constexpr int kMostLights = 8;

class GlProgram {
  public:
    GlProgram(const GlFunctions& gl, const ShaderFeatures& features);
    ~GlProgram();
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    void use() const { gl_.UseProgram(program_); }
    // -1, which OpenGL ignores, for what the variant does not use.
    GLint uniform(const char* name) const { return gl_.GetUniformLocation(program_, name); }

  private:
    const GlFunctions& gl_;
    GLuint program_ = 0;
};

}  // namespace chironomia
