// From the world to the picture.
#pragma once

#include "core/math.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"

namespace chironomia {

// The camera looks along -z of its view space, +x right, +y up.
Mat4 view_from_world(const Camera& camera);

// The cube [-1, 1] that the camera sees: x right, y up, z from near to far.
Mat4 clip_from_view(const Camera& camera, RenderSize size);
Mat4 clip_from_world(const Camera& camera, RenderSize size);

// Where a point in front of the camera lies in the picture: x right, y down from the top left corner [px].
Vec2 pixel_of(const Camera& camera, RenderSize size, const Vec3& point);

}  // namespace chironomia
