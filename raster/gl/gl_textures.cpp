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

GLuint GlTextures::upload(const std::vector<Image>& images, const Texture& texture, ImageUse use) {
    if (texture.image < 0) return 0;
    const Key key{texture.image, texture.wrap_u, texture.wrap_v, texture.smooth, use};
    if (const auto known = textures_.find(key); known != textures_.end()) return *known->second;

    const Image& image = images[static_cast<size_t>(texture.image)];
    require_fitting(gl_, image);
    GlName name = make_texture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, *name);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, use == ImageUse::colour ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width,
                   image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, texture.smooth ? GL_LINEAR : GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                      texture.smooth ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST);
    gl_.GenerateMipmap(GL_TEXTURE_2D);
    return *textures_.emplace(key, std::move(name)).first->second;
}

}  // namespace chironomia
