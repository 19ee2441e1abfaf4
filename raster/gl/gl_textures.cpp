#include "raster/gl/gl_textures.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

GLint gl_wrap(Wrap wrap) {
    if (wrap == Wrap::mirror) return GL_MIRRORED_REPEAT;
    return wrap == Wrap::clamp ? GL_CLAMP_TO_EDGE : GL_REPEAT;
}

void require_fitting(const GlFunctions& gl, const Image& image) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (image.width <= most && image.height <= most) return;
    throw Error(format("image \"{}\": {} x {} pixels, at most {} x {} can be drawn; make it smaller",
                       image.name, image.width, image.height, most, most));
}

}  // namespace

// Fills the bound texture. OpenGL averages what is solid by itself.
void GlTextures::upload_levels(const Image& image, ImageUse use, float cutoff) const {
    const GLint format = use == ImageUse::data ? GL_RGBA8 : GL_SRGB8_ALPHA8;
    const auto upload_level = [&](const Image& level, GLint index) {
        gl_.TexImage2D(GL_TEXTURE_2D, index, format, level.width, level.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                       level.rgba.data());
    };
    if (use == ImageUse::colour || use == ImageUse::data) {
        upload_level(image, 0);
        gl_.GenerateMipmap(GL_TEXTURE_2D);
        return;
    }
    GLint index = 0;
    for (const Image& level : mip_levels_for(image, use, cutoff)) upload_level(level, index++);
}

GLuint GlTextures::upload(const std::vector<Image>& images, const Texture& texture, ImageUse use,
                          float cutoff) {
    if (texture.image < 0) return 0;
    const Key key{texture.image, texture.wrap_u, texture.wrap_v, texture.smooth, use, cutoff};
    if (const auto known = textures_.find(key); known != textures_.end()) return *known->second;

    const Image& image = images[static_cast<size_t>(texture.image)];
    require_fitting(gl_, image);
    GlName name = make_texture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, *name);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    upload_levels(image, use, cutoff);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, texture.smooth ? GL_LINEAR : GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                      texture.smooth ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST);
    return *textures_.emplace(key, std::move(name)).first->second;
}

}  // namespace chironomia
