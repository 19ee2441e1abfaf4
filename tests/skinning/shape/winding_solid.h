// What is inside a mesh that need not be closed, and how deep.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace chironomia::testing {

using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise outside

// Triangles between points that move. The generalised winding number of a point is the sum of the solid angles under
// which it sees the triangles, over 4 pi: 1 inside a closed surface and 0 outside; a hole lets it change smoothly
// (Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding numbers",
// SIGGRAPH 2013). Groups of triangles that are far away count by the dipole of their areas, after Barill et al., "Fast
// winding numbers for soups and clouds", SIGGRAPH 2018; we have one level of groups.
class WindingSolid {
  public:
    // `points` (V) [m] say which triangles are near each other.
    WindingSolid(std::vector<Triangle> triangles, std::span<const Vec3> points);

    // The triangles in their new order.
    const std::vector<Triangle>& triangles() const { return triangles_; }

    // Points (V) that have moved.
    void move(std::span<const Vec3> points);

    double winding_at(const Vec3& place) const;

    struct Nearest {
        float distance = 0;        // [m]
        std::size_t triangle = 0;  // index into triangles()
    };
    // Infinite if there are no triangles.
    Nearest nearest(const Vec3& place) const;

    // Whether a ray meets a triangle more than a hundredth of a millimetre away. `direction` is unit.
    bool is_met(const Vec3& from, const Vec3& direction) const;

  private:
    struct Group {
        std::size_t first = 0, end = 0;  // of triangles_
        Vec3 centre{0};                  // [m]
        Vec3 area{0};                    // sum of the normals, each as long as its area [m^2]
        float radius = 0;                // [m]
    };

    void split(std::size_t first, std::size_t end, const std::vector<Vec3>& middles,
               std::vector<std::uint32_t>& order);

    std::vector<Triangle> triangles_;
    std::vector<Vec3> corners_;  // (3 F) of triangles_, moved
    std::vector<Group> groups_;
};

// The distance of a point from a triangle [m].
float distance_to_triangle(const Vec3& place, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace chironomia::testing
