#include "raster/gl/gl_functions.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia {

GlFunctions load_gl_functions(const std::function<GlAddress(const char*)>& find) {
    GlFunctions gl;
    const auto look_up = [&](const char* name) {
        const GlAddress address = find(name);
        if (!address) {
            throw Error(format(
                "OpenGL: the library has no function {}, version 4.5 has it; install Mesa 22.3", name));
        }
        return address;
    };
#define CHIRONOMIA_GL_LOAD(type, name) gl.name = reinterpret_cast<decltype(gl.name)>(look_up("gl" #name));
    CHIRONOMIA_GL_FUNCTIONS(CHIRONOMIA_GL_LOAD)
#undef CHIRONOMIA_GL_LOAD
    return gl;
}

}  // namespace chironomia
