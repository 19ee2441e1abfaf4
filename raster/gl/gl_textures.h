// The images of an avatar as OpenGL textures, each uploaded once for every way it is read.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "core/avatar.h"
#include "raster/gl/gl_objects.h"

namespace chironomia {

enum class ImageUse { colour, data };  // sRGB or linear

class GlTextures {
  public:
    explicit GlTextures(const GlFunctions& gl) : gl_(gl) {}

    // 0 for a material without this texture. Throws Error if the image is larger than this OpenGL can take.
    GLuint upload(const std::vector<Image>& images, const Texture& texture, ImageUse use);

  private:
    using Key = std::tuple<int, Wrap, Wrap, bool, ImageUse>;
    const GlFunctions& gl_;
    std::map<Key, GlName> textures_;
};

}  // namespace chironomia
