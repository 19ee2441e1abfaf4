#include "core/render/camera.h"

#include <cmath>

namespace chironomia {

Mat4 view_from_world(const Camera& camera) {
    const Vec3 back = normalize(camera.eye - camera.target);
    const Vec3 right = normalize(cross(camera.up, back));
    const Vec3 up = cross(back, right);
    Mat4 view(1);
    for (int axis = 0; axis < 3; ++axis) {
        view[axis] = {right[axis], up[axis], back[axis], 0};
    }
    view[3] = {-dot(right, camera.eye), -dot(up, camera.eye), -dot(back, camera.eye), 1};
    return view;
}

Mat4 clip_from_view(const Camera& camera, RenderSize size) {
    const float cotangent = 1.0f / std::tan(camera.fov_y / 2);
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    const float depth = camera.near - camera.far;
    Mat4 clip(0);
    clip[0][0] = cotangent / aspect;
    clip[1][1] = cotangent;
    clip[2][2] = (camera.far + camera.near) / depth;
    clip[2][3] = -1;
    clip[3][2] = 2 * camera.far * camera.near / depth;
    return clip;
}

Mat4 clip_from_world(const Camera& camera, RenderSize size) {
    return clip_from_view(camera, size) * view_from_world(camera);
}

Vec2 pixel_of(const Camera& camera, RenderSize size, const Vec3& point) {
    const Vec4 clip = clip_from_world(camera, size) * Vec4(point, 1);
    return {(0.5f + 0.5f * clip.x / clip.w) * static_cast<float>(size.width),
            (0.5f - 0.5f * clip.y / clip.w) * static_cast<float>(size.height)};
}

}  // namespace chironomia
