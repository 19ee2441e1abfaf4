#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>

#include "core/error.h"
#include "raster/gl/gl_backend.h"

namespace chironomia {
namespace {

struct OsMesa {
    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaGetProcAddress) find = nullptr;
};

OsMesa load_osmesa() {
    constexpr std::array kNames = {"libOSMesa.so.8", "libOSMesa.so"};
    void* library = open_library(kNames, "libosmesa6");
    OsMesa mesa;
    mesa.create = reinterpret_cast<decltype(mesa.create)>(dlsym(library, "OSMesaCreateContextAttribs"));
    mesa.make_current = reinterpret_cast<decltype(mesa.make_current)>(dlsym(library, "OSMesaMakeCurrent"));
    mesa.destroy = reinterpret_cast<decltype(mesa.destroy)>(dlsym(library, "OSMesaDestroyContext"));
    mesa.find = reinterpret_cast<decltype(mesa.find)>(dlsym(library, "OSMesaGetProcAddress"));
    if (!mesa.create || !mesa.make_current || !mesa.destroy || !mesa.find) {
        throw Error("libOSMesa: too old to make a core context; install Mesa 22.3");
    }
    return mesa;
}

// OSMesa wants a window of its own; everything is drawn into framebuffer objects, so it stays tiny.
constexpr int kWindowSide = 16;

}  // namespace

GlBackendContext open_osmesa() {
    static const OsMesa mesa = load_osmesa();
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    const OSMesaContext context = mesa.create(attributes, nullptr);
    if (!context)
        throw Error(
            "OSMesa: no OpenGL 4.5 core context can be made; unset GALLIUM_DRIVER or install Mesa 22.3");

    auto window = std::make_shared<std::array<unsigned char, kWindowSide * kWindowSide * 4>>();
    return {.make_current =
                [context, window] {
                    return mesa.make_current(context, window->data(), GL_UNSIGNED_BYTE, kWindowSide,
                                             kWindowSide) == GL_TRUE;
                },
            .release = [] { mesa.make_current(nullptr, nullptr, 0, 0, 0); },
            .find = [](const char* name) { return reinterpret_cast<GlAddress>(mesa.find(name)); },
            .handle = {context, [](void* handle) { mesa.destroy(static_cast<OSMesaContext>(handle)); }}};
}

}  // namespace chironomia
