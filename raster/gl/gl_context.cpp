#include "raster/gl/gl_context.h"

#include <dlfcn.h>

#include <cstdlib>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {

void* find_library(std::span<const char* const> names) {
    for (const char* name : names) {
        if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
    }
    return nullptr;
}

void* open_library(std::span<const char* const> names, const std::string& package) {
    if (void* library = find_library(names)) return library;
    throw Error(format("{}: the library is not on this machine ({}); install the package {}", names.front(),
                       dlerror(), package));
}

namespace {

// What stands in for OSMesa draws on the processor, too.
GlBackendContext open(GlBackend backend) {
    if (backend == GlBackend::osmesa || (backend == GlBackend::any && has_osmesa())) return open_osmesa();
    if (backend == GlBackend::any) setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    return open_egl();
}

}  // namespace

std::string describe_gl(GlBackend backend) try {
    GlContext context(backend, 0);
    const CurrentGlContext current(context);
    return context.description();
} catch (const Error& missing) {
    return missing.what();
}

GlContext::GlContext(GlBackend backend, int threads) {
    if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    context_ = open(backend);
    make_current();
    gl_ = load_gl_functions(context_.find);
    release();
}

GlContext::~GlContext() = default;

void GlContext::make_current() {
    if (!context_.make_current()) {
        throw Error("OpenGL: the context cannot be used from this thread; use it where it was made");
    }
}

void GlContext::release() {
    context_.release();
}

std::string GlContext::description() const {
    const auto text = [this](GLenum name) { return reinterpret_cast<const char*>(gl_.GetString(name)); };
    return format("{} / {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace chironomia
