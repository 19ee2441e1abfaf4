// An OpenGL 4.5 core context without a window, made by OSMesa or by EGL.
#pragma once

#include <string>

#include "raster/gl/gl_backend.h"
#include "raster/gl/gl_functions.h"
#include "raster/gl/gl_renderer.h"

namespace chironomia {

class GlContext {
  public:
    // For pictures of `size`. `threads` above 0 becomes LP_NUM_THREADS, which Mesa reads when the first
    // context of a process is made. Throws Error if there is no such OpenGL, or too little address space for
    // it.
    GlContext(GlBackend backend, RenderSize size, int threads);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    void make_current();
    void release();

    const GlFunctions& functions() const { return gl_; }
    std::string description() const;  // GL_RENDERER and GL_VERSION; the context must be current

  private:
    GlBackendContext context_;
    GlFunctions gl_;
};

// Keeps a context current for one block.
class CurrentGlContext {
  public:
    explicit CurrentGlContext(GlContext& context) : context_(context) { context_.make_current(); }
    ~CurrentGlContext() { context_.release(); }
    CurrentGlContext(const CurrentGlContext&) = delete;
    CurrentGlContext& operator=(const CurrentGlContext&) = delete;

  private:
    GlContext& context_;
};

}  // namespace chironomia
