#include "skinning/shape/capsule.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr float kNoLength = 1e-12f;  // squared length below which a line is a point [m^2]

// Where on the line from `from` along `line` the point lies nearest, in [0, 1].
float share_nearest(const Vec3& from, const Vec3& line, const Vec3& point) {
    const float squared = dot(line, line);
    return squared < kNoLength ? 0.0f : std::clamp(dot(point - from, line) / squared, 0.0f, 1.0f);
}

}  // namespace

Overlap overlap_of(const Capsule& first, const Capsule& second) {
    const Vec3 a = first.to - first.from, b = second.to - second.from, between = first.from - second.from;
    const float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
    // The nearest point of the first line to the second one, both endless; any for parallel lines.
    const float bent = aa * bb - ab * ab;
    float along = 0;
    if (bent > 1e-6f * aa * bb)
        along = std::clamp((ab * dot(b, between) - bb * dot(a, between)) / bent, 0.0f, 1.0f);
    // Clamped to the ends of both: the second follows the first, and the first the second.
    const Vec3 on_second = second.from + b * share_nearest(second.from, b, first.from + a * along);
    along = share_nearest(first.from, a, on_second);
    const Vec3 on_first = first.from + a * along;
    const Vec3 way = on_first - (second.from + b * share_nearest(second.from, b, on_first));
    const float apart = length(way);
    const float radii = first.radius + second.radius;
    Overlap overlap{.depth = radii - apart, .radii = radii, .along = along};
    if (apart > 1e-6f) overlap.away = way / apart;
    return overlap;
}

}  // namespace chironomia
