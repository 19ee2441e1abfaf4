// The interface of all renderers: a posed mesh in, its picture out.
#pragma once

#include <span>

#include "core/body/avatar.h"
#include "core/render/frame.h"
#include "core/render/scene.h"

namespace chironomia {

struct RenderSize {
    int width = 1280;
    int height = 720;
};

// Made for one avatar in one scene at one size; used from the thread that made it, or from frames_at_once() threads.
class Renderer {
  public:
    virtual ~Renderer() = default;
    // How many calls of render() may be under way at the same time, above 1 from any threads.
    virtual int frames_at_once() const { return 1; }
    // `exposure` is the mesh at even distances in time from the opening to the closing of the shutter, at
    // least once; a renderer without motion blur draws the middle one.
    virtual Frame render(std::span<const PosedMesh> exposure) = 0;

    Frame render(const PosedMesh& still) { return render(std::span(&still, 1)); }
};

}  // namespace chironomia
