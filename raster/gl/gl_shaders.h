// The one shader of the figure, in the few variants that its materials need.
#pragma once

#include <memory>

#include "raster/gl/gl_functions.h"
#include "raster/studio/figure_light.h"

namespace chironomia {

namespace attribute {
enum Place : GLuint { position, normal, tangent, uv, colour, ambient_occlusion, shadow, sample_order };
}

namespace texture_unit {
enum Place : GLint { base_colour, normal, metallic_roughness, occlusion, emissive, anisotropy, shadow };
}

class GlProgram {
  public:
    // With more `samples` than one a cut edge may take some of the samples of a pixel.
    GlProgram(const GlFunctions& gl, const SurfaceFeatures& features, int samples);
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
