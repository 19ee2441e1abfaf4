// The images of an avatar as OpenGL textures, each uploaded once for every way it is read.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "core/body/avatar.h"
#include "raster/gl/gl_objects.h"
#include "raster/studio/mip_levels.h"

namespace chironomia {

class GlTextures {
  public:
    explicit GlTextures(const GlFunctions& gl) : gl_(gl) {}

    // 0 for a material without this texture; `cutoff` is that of a cut-out colour. Throws Error if the image
    // is larger than this OpenGL can take.
    GLuint upload(const std::vector<Image>& images, const Texture& texture, ImageUse use, float cutoff = 0);

  private:
    using Key = std::tuple<int, Wrap, Wrap, bool, ImageUse, float>;
    void upload_levels(const Image& image, ImageUse use, float cutoff) const;

    const GlFunctions& gl_;
    std::map<Key, GlName> textures_;
};

}  // namespace chironomia
