#include "raster/gl/gl_target.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

void expect_complete(const GlFunctions& gl, RenderSize size) {
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw Error(format("OpenGL: cannot make pictures of {}x{} px; free memory, or choose a smaller --size",
                       size.width, size.height));
}

}  // namespace

GlTarget::GlTarget(const GlFunctions& gl, RenderSize size, int samples)
    : gl_(gl),
      size_(size),
      colour_(make_renderbuffer(gl)),
      depth_(make_renderbuffer(gl)),
      resolved_colour_(make_renderbuffer(gl)),
      many_(make_framebuffer(gl)),
      one_(make_framebuffer(gl)) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_SAMPLES, &most);
    if (samples > most) {
        throw Error(format("OpenGL: {} samples a pixel are wanted, this driver has at most {}; ask for fewer",
                           samples, most));
    }
    const auto attach = [&](const GlName& buffer, GLenum point, GLenum kind, int of_pixel) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, *buffer);
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, of_pixel, kind, size.width, size.height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, *buffer);
    };
    gl.BindFramebuffer(GL_FRAMEBUFFER, *one_);
    attach(resolved_colour_, GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
    expect_complete(gl, size);
    gl.BindFramebuffer(GL_FRAMEBUFFER, *many_);
    const int many = samples > 1 ? samples : 0;
    attach(colour_, GL_COLOR_ATTACHMENT0, GL_RGBA8, many);
    attach(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, many);
    expect_complete(gl, size);
}

void GlTarget::begin(const Rectangle& area) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, *many_);
    gl_.Viewport(0, 0, size_.width, size_.height);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(area.x, area.y, area.width, area.height);
    gl_.ClearColor(0, 0, 0, 0);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

const std::vector<std::uint8_t>& GlTarget::read(const Rectangle& area) {
    const int right = area.x + area.width;
    const int bottom = area.y + area.height;
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, *many_);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, *one_);
    gl_.BlitFramebuffer(area.x, area.y, right, bottom, area.x, area.y, right, bottom, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, *one_);
    pixels_.resize(static_cast<size_t>(area.width) * static_cast<size_t>(area.height) * 4);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(area.x, area.y, area.width, area.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
    return pixels_;
}

}  // namespace chironomia
