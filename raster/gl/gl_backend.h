// The two libraries that make OpenGL contexts without a window. Names no OpenGL type: their headers do not
// agree.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace chironomia {

using GlAddress = void (*)();

// What a backend gives: the verbs of a context, and what ends it.
struct GlBackendContext {
    std::function<bool()> make_current;
    std::function<void()> release;
    std::function<GlAddress(const char*)> find;
    std::unique_ptr<void, std::function<void(void*)>> handle;
};

// A shared library by the first of `names` that is there; it stays loaded. Null where there is none.
void* find_library(std::span<const char* const> names);

// The same. Throws Error saying what to install.
void* open_library(std::span<const char* const> names, const std::string& package);

// Throw Error if the library is missing or makes no OpenGL 4.5 core context.
GlBackendContext open_osmesa();
GlBackendContext open_egl();  // by a GPU if there is one and LIBGL_ALWAYS_SOFTWARE is not set

}  // namespace chironomia
