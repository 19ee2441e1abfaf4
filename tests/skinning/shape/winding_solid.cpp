#include "tests/skinning/shape/winding_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace chironomia::testing {
namespace {

constexpr std::size_t kOfAGroup = 16;  // triangles at most
constexpr float kFar = 2.5f;           // radii of a group, from where it counts as a dipole

// Twice the angle whose tangent van Oosterom and Strackee give ("The solid angle of a plane triangle", 1983).
double solid_angle(const Vec3& place, const Vec3* corner) {
    const glm::dvec3 a(corner[0] - place), b(corner[1] - place), c(corner[2] - place);
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    return 2 *
           std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

float distance_to_line(const Vec3& place, const Vec3& a, const Vec3& b) {
    const Vec3 line = b - a;
    const float squared = dot(line, line);
    const float share = squared > 0 ? std::clamp(dot(place - a, line) / squared, 0.0f, 1.0f) : 0.0f;
    return distance(place, a + share * line);
}

// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; from both sides.
bool meets(const Vec3& from, const Vec3& direction, const Vec3* corner) {
    const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], p = cross(direction, b);
    const float volume = dot(a, p);
    if (std::abs(volume) < 1e-15f) return false;
    const Vec3 way = from - corner[0], q = cross(way, a);
    const float u = dot(way, p) / volume, v = dot(direction, q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && dot(b, q) / volume > 1e-5f;
}

}  // namespace

float distance_to_triangle(const Vec3& place, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = cross(b - a, c - a);
    const auto beside = [&](const Vec3& from, const Vec3& to) {
        return dot(cross(to - from, place - from), normal) >= 0;
    };
    if (dot(normal, normal) > 0 && beside(a, b) && beside(b, c) && beside(c, a))
        return std::abs(dot(place - a, normalize(normal)));
    return std::min(
        {distance_to_line(place, a, b), distance_to_line(place, b, c), distance_to_line(place, c, a)});
}

WindingSolid::WindingSolid(std::vector<Triangle> triangles, std::span<const Vec3> points) {
    std::vector<Vec3> middles;
    for (const Triangle& t : triangles)
        middles.push_back((points[t[0]] + points[t[1]] + points[t[2]]) / 3.0f);
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!triangles.empty()) split(0, triangles.size(), middles, order);
    for (const std::uint32_t index : order) triangles_.push_back(triangles[index]);
    move(points);
}

// Halves at the median of the longest side.
void WindingSolid::split(std::size_t first, std::size_t end, const std::vector<Vec3>& middles,
                         std::vector<std::uint32_t>& order) {
    if (end - first <= kOfAGroup) {
        groups_.push_back({.first = first, .end = end});
        return;
    }
    Vec3 low = middles[order[first]], high = low;
    for (std::size_t i = first; i < end; ++i) {
        low = glm::min(low, middles[order[i]]);
        high = glm::max(high, middles[order[i]]);
    }
    const Vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t half = (first + end) / 2;
    std::nth_element(at(first), at(half), at(end), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
    });
    split(first, half, middles, order);
    split(half, end, middles, order);
}

void WindingSolid::move(std::span<const Vec3> points) {
    corners_.clear();
    for (const Triangle& triangle : triangles_)
        for (const std::uint32_t corner : triangle) corners_.push_back(points[corner]);
    for (Group& group : groups_) {
        float areas = 0;
        Vec3 sum(0), plain(0);
        group.area = Vec3(0);
        for (std::size_t i = group.first; i < group.end; ++i) {
            const Vec3 *corner = &corners_[3 * i], middle = (corner[0] + corner[1] + corner[2]) / 3.0f;
            const Vec3 area = 0.5f * cross(corner[1] - corner[0], corner[2] - corner[0]);
            group.area += area;
            areas += length(area);
            sum += length(area) * middle;
            plain += middle;
        }
        group.centre = areas > 0 ? sum / areas : plain / static_cast<float>(group.end - group.first);
        group.radius = 0;
        for (std::size_t i = 3 * group.first; i < 3 * group.end; ++i)
            group.radius = std::max(group.radius, distance(corners_[i], group.centre));
    }
}

double WindingSolid::winding_at(const Vec3& place) const {
    double angle = 0;
    for (const Group& group : groups_) {
        const Vec3 way = group.centre - place;
        const float far = length(way);
        if (far > kFar * group.radius) {
            angle += static_cast<double>(dot(group.area, way) / (far * far * far));
            continue;
        }
        for (std::size_t i = group.first; i < group.end; ++i) angle += solid_angle(place, &corners_[3 * i]);
    }
    return angle / (4 * 3.14159265358979323846);
}

WindingSolid::Nearest WindingSolid::nearest(const Vec3& place) const {
    Nearest nearest{.distance = std::numeric_limits<float>::infinity()};
    for (const Group& group : groups_) {
        if (distance(place, group.centre) - group.radius >= nearest.distance) continue;
        for (std::size_t i = group.first; i < group.end; ++i) {
            const Vec3* corner = &corners_[3 * i];
            const float apart = distance_to_triangle(place, corner[0], corner[1], corner[2]);
            if (apart < nearest.distance) nearest = {apart, i};
        }
    }
    return nearest;
}

bool WindingSolid::is_met(const Vec3& from, const Vec3& direction) const {
    return std::any_of(groups_.begin(), groups_.end(), [&](const Group& group) {
        const Vec3 way = group.centre - from;
        const float along = dot(way, direction), reach = group.radius;
        if (along < -reach || dot(way, way) - along * along > reach * reach) return false;
        for (std::size_t i = group.first; i < group.end; ++i)
            if (meets(from, direction, &corners_[3 * i])) return true;
        return false;
    });
}

}  // namespace chironomia::testing
