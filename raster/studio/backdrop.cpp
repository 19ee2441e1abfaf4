#include "raster/studio/backdrop.h"

#include <cmath>

#include "core/render/camera.h"
#include "core/smooth_step.h"
#include "raster/studio/share_work.h"
#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

// The backdrop runs from its bottom to its top colour between these slopes of the line of sight.
constexpr float kLowestSlope = -0.30f;
constexpr float kHighestSlope = 0.35f;

// From 0 at `low` to 1 at `high`.
float rise(float low, float high, float value) {
    return smooth_step((value - low) / (high - low));
}

// Between 0 and 1, spread evenly over neighbouring pixels: interleaved gradient noise.
// Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
float dither(int x, int y) {
    const float place = 0.06711056f * static_cast<float>(x) + 0.00583715f * static_cast<float>(y);
    const float turned = 52.9829189f * (place - std::floor(place));
    return turned - std::floor(turned);
}

Vec3 colour_along(const Scene& scene, const Vec3& eye, const Vec3& ray) {
    const float slope = ray.y / std::sqrt(ray.x * ray.x + ray.z * ray.z);
    const Vec3 backdrop =
        glm::mix(scene.backdrop_bottom, scene.backdrop_top, rise(kLowestSlope, kHighestSlope, slope));
    const float drop = scene.floor_height - eye.y;
    // Above the horizon, or from under the floor, there is none.
    if (!scene.floor || ray.y >= 0 || drop >= 0) return backdrop;
    const Vec3 hit = eye + ray * (drop / ray.y);
    const float away = std::hypot(hit.x - scene.camera.target.x, hit.z - scene.camera.target.z);
    return glm::mix(scene.floor_colour, backdrop, rise(0.1f * scene.floor_reach, scene.floor_reach, away));
}

}  // namespace

PixelRays pixel_rays(const Camera& camera, RenderSize size) {
    const Mat4 world_from_view = inverse(view_from_world(camera));
    const float half_height = std::tan(camera.fov_y / 2);
    const float step = 2 * half_height / static_cast<float>(size.height);
    const float half_width = step * static_cast<float>(size.width) / 2;
    const Vec3 corner(-half_width + step / 2, half_height - step / 2, -1);
    const Mat3 turn(world_from_view);
    return {.eye = camera.eye,
            .corner = turn * corner,
            .right = turn * Vec3(step, 0, 0),
            .down = turn * Vec3(0, -step, 0)};
}

Frame draw_backdrop(const Scene& scene, RenderSize size, int threads) {
    const SrgbTables& tables = SrgbTables::get();
    const PixelRays rays = pixel_rays(scene.camera, size);
    Frame frame{.width = size.width, .height = size.height, .rgba = {}};
    frame.rgba.resize(static_cast<size_t>(size.width) * static_cast<size_t>(size.height) * 4);
    share_work(size.height, threads, [&](int y) {
        std::uint8_t* pixel =
            frame.rgba.data() + 4 * static_cast<size_t>(y) * static_cast<size_t>(size.width);
        for (int x = 0; x < size.width; ++x, pixel += 4) {
            const Vec3 ray =
                rays.corner + static_cast<float>(x) * rays.right + static_cast<float>(y) * rays.down;
            const Vec3 colour = colour_along(scene, rays.eye, ray);
            const float noise = dither(x, y);
            for (int i = 0; i < 3; ++i) {
                pixel[i] = static_cast<std::uint8_t>(std::min(255.0f, tables.level(colour[i]) + noise));
            }
            pixel[3] = 255;
        }
    });
    return frame;
}

}  // namespace chironomia
