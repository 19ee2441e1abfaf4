// The seam between a posed mesh and its picture.
#pragma once

#include "core/avatar.h"
#include "core/frame.h"
#include "core/scene.h"

namespace chironomia {

struct RenderSize {
    int width = 1280;
    int height = 720;
};

// Made for one avatar in one scene at one size; used from the thread that made it.
class Renderer {
  public:
    virtual ~Renderer() = default;
    virtual Frame render(const PosedMesh& mesh) = 0;
};

}  // namespace chironomia
