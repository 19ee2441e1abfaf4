#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>

#include "core/error.h"
#include "core/text.h"
#include "raster/gl/gl_backend.h"

namespace chironomia {
namespace {

struct Egl {
    PFNEGLGETPROCADDRESSPROC find = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLBINDAPIPROC bind_api = nullptr;
    PFNEGLCHOOSECONFIGPROC choose_config = nullptr;
    PFNEGLCREATECONTEXTPROC create_context = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
    PFNEGLMAKECURRENTPROC make_current = nullptr;
    PFNEGLGETERRORPROC get_error = nullptr;
};

Egl load_egl() {
    constexpr std::array kNames = {"libEGL.so.1", "libEGL.so"};
    void* library = open_library(kNames, "libegl1");
    Egl egl;
    egl.find = reinterpret_cast<decltype(egl.find)>(dlsym(library, "eglGetProcAddress"));
    const auto load = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(egl.find ? egl.find(name)
                                                                                          : nullptr);
        if (!function) throw Error(format("EGL: the library has no function {}; install Mesa 22.3", name));
    };
    load(egl.get_display, "eglGetPlatformDisplayEXT");
    load(egl.initialize, "eglInitialize");
    load(egl.bind_api, "eglBindAPI");
    load(egl.choose_config, "eglChooseConfig");
    load(egl.create_context, "eglCreateContext");
    load(egl.destroy_context, "eglDestroyContext");
    load(egl.make_current, "eglMakeCurrent");
    load(egl.get_error, "eglGetError");
    return egl;
}

const Egl& egl() {
    static const Egl loaded = load_egl();
    return loaded;
}

void require(bool worked, const char* what) {
    if (worked) return;
    throw Error(format(
        "EGL: {} failed (0x{:04x}); install libegl-mesa0 and libgl1-mesa-dri, or use the other backend", what,
        egl().get_error()));
}

// One display serves the whole process; Mesa ends it at exit.
EGLDisplay open_display() {
    EGLDisplay display = egl().get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(display != EGL_NO_DISPLAY, "opening the surfaceless platform");
    require(egl().initialize(display, nullptr, nullptr), "starting the surfaceless platform");
    return display;
}

}  // namespace

GlBackendContext open_egl() {
    static const EGLDisplay display = open_display();
    require(egl().bind_api(EGL_OPENGL_API), "choosing OpenGL");
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    require(egl().choose_config(display, wanted, &config, 1, &found) && found > 0,
            "choosing a configuration");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    const EGLContext context = egl().create_context(display, config, EGL_NO_CONTEXT, attributes);
    require(context != EGL_NO_CONTEXT, "making an OpenGL 4.5 core context");

    return {.make_current =
                [context] {
                    egl().bind_api(EGL_OPENGL_API);
                    return egl().make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
                },
            .release = [] { egl().make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); },
            .find = [](const char* name) { return reinterpret_cast<GlAddress>(egl().find(name)); },
            .handle = {context, [](void* handle) { egl().destroy_context(display, handle); }}};
}

}  // namespace chironomia
