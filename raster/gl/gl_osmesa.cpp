#include <dlfcn.h>

#include <array>
#include <memory>

#include "core/error.h"
#include "raster/gl/gl_backend.h"
#include "raster/gl/gl_renderer.h"

namespace chironomia {
namespace {

// As GL/osmesa.h has it, which came with Mesa until 25.0.
enum Attribute {
    kFormat = 0x22,
    kDepthBits = 0x30,
    kProfile = 0x33,
    kCoreProfile = 0x34,
    kMajorVersion = 0x36,
    kMinorVersion = 0x37,
    kRgba = 0x1908,
    kUnsignedByte = 0x1401
};

struct OsMesa {
    void* (*create)(const int* attributes, void* shared) = nullptr;
    unsigned char (*make_current)(void* context, void* window, unsigned type, int width,
                                  int height) = nullptr;
    void (*destroy)(void* context) = nullptr;
    GlAddress (*find)(const char* name) = nullptr;
};

constexpr std::array kNames = {"libOSMesa.so.8", "libOSMesa.so"};

OsMesa load_osmesa() {
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

// A context and the window that it needs, though everything is drawn into textures.
struct Context {
    void* context = nullptr;
    std::array<unsigned char, kWindowSide * kWindowSide * 4> window{};
};

}  // namespace

bool has_osmesa() {
    return find_library(kNames) != nullptr;
}

GlBackendContext open_osmesa() {
    static const OsMesa mesa = load_osmesa();
    const int attributes[] = {kFormat,       kRgba, kDepthBits,    0, kProfile, kCoreProfile,
                              kMajorVersion, 4,     kMinorVersion, 5, 0};
    auto made = std::make_unique<Context>();
    made->context = mesa.create(attributes, nullptr);
    if (!made->context)
        throw Error(
            "OSMesa: no OpenGL 4.5 core context can be made; unset GALLIUM_DRIVER or install Mesa 22.3");

    Context* const context = made.get();
    return {.make_current =
                [context] {
                    return mesa.make_current(context->context, context->window.data(), kUnsignedByte,
                                             kWindowSide, kWindowSide) != 0;
                },
            .release = [] { mesa.make_current(nullptr, nullptr, 0, 0, 0); },
            .find = [](const char* name) { return mesa.find(name); },
            .handle = {made.release(), [](void* handle) {
                           const std::unique_ptr<Context> owned(static_cast<Context*>(handle));
                           mesa.destroy(owned->context);
                       }}};
}

}  // namespace chironomia
