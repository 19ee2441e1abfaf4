#include "raster/gl/gl_context.h"

#include <dlfcn.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// Address space that Mesa, its compiler and our buffers take; measured with Mesa 22.3 on two cores, ours.
constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr std::uint64_t kNeededByOpenGl = 800 * kMegabyte;
constexpr std::uint64_t kNeededByPixel = 100;

std::uint64_t address_space_in_use() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

// Mesa crashes where it gets less.
void expect_address_space(RenderSize size) {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
    const std::uint64_t needed = address_space_in_use() + kNeededByOpenGl + kNeededByPixel * pixels;
    if (needed <= limit.rlim_cur) return;
    throw Error(format(
        "OpenGL: pictures of {}x{} need {} MB of address space, and the program may use {} MB; raise the limit "
        "(ulimit -v), or choose a smaller --size",
        size.width, size.height, needed / kMegabyte, limit.rlim_cur / kMegabyte));
}

}  // namespace

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
    GlContext context(backend, {.width = 1, .height = 1}, 0);
    const CurrentGlContext current(context);
    return context.description();
} catch (const Error& missing) {
    return missing.what();
}

GlContext::GlContext(GlBackend backend, RenderSize size, int threads) {
    expect_address_space(size);
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
