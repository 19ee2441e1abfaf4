// Names that OpenGL gives out, returned to it at the end of a scope in which their context is current.
#pragma once

#include <utility>

#include "raster/gl/gl_functions.h"

namespace chironomia {

class GlName {
  public:
    using Make = void(APIENTRY*)(GLsizei, GLuint*);
    using Remove = void(APIENTRY*)(GLsizei, const GLuint*);

    GlName() = default;
    GlName(Make make, Remove remove) : remove_(remove) { make(1, &name_); }
    ~GlName() {
        if (name_ != 0) remove_(1, &name_);
    }
    GlName(GlName&& other) noexcept : remove_(other.remove_), name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(remove_, other.remove_);
        std::swap(name_, other.name_);
        return *this;
    }

    GLuint operator*() const { return name_; }

  private:
    Remove remove_ = nullptr;
    GLuint name_ = 0;
};

inline GlName make_buffer(const GlFunctions& gl) {
    return {gl.GenBuffers, gl.DeleteBuffers};
}
inline GlName make_texture(const GlFunctions& gl) {
    return {gl.GenTextures, gl.DeleteTextures};
}
inline GlName make_vertex_array(const GlFunctions& gl) {
    return {gl.GenVertexArrays, gl.DeleteVertexArrays};
}
inline GlName make_framebuffer(const GlFunctions& gl) {
    return {gl.GenFramebuffers, gl.DeleteFramebuffers};
}
inline GlName make_renderbuffer(const GlFunctions& gl) {
    return {gl.GenRenderbuffers, gl.DeleteRenderbuffers};
}

}  // namespace chironomia
