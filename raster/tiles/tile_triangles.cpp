#include "raster/tiles/tile_triangles.h"

#include <algorithm>
#include <cmath>

#include "core/render/camera.h"

namespace chironomia {
namespace {

constexpr double kStepsPerPixel = 64;
// Whole numbers of 32 bits hold the edges of triangles that lie within this of the picture's corner; the
// largest picture has a side of 8192.
constexpr double kLeastPlace = -2048, kMostPlace = 12288;  // [px]

using Point = glm::dvec3;  // as TileVertex::seen

// A vertex of a clipped triangle, on the grid of whole numbers.
struct GridPoint {
    std::int32_t x = 0, y = 0;  // [1/64 px]
};

GridPoint on_grid(const Point& seen) {
    return {static_cast<std::int32_t>(std::floor(seen.x / seen.z * kStepsPerPixel + 0.5)),
            static_cast<std::int32_t>(std::floor(seen.y / seen.z * kStepsPerPixel + 0.5))};
}

// The first and the last pixel of which a sample may lie in a stretch [1/64 px]. Samples lie 1/8 to 7/8 of a
// pixel from its left or upper side.
int first_pixel(std::int32_t least) {
    return (least + 64 - 56 - 1) >> 6;
}
int last_pixel(std::int32_t most) {
    return (most - 8) >> 6;
}

// Sets edges and the box of pixels; false if no sample can be covered. The corners run round the triangle with its
// inside on the right as seen on the screen.
bool set_edges(TileTriangle& triangle, const std::array<GridPoint, 3>& corners, RenderSize size) {
    const auto& [a, b, c] = corners;
    triangle.left = std::max(first_pixel(std::min({a.x, b.x, c.x})), 0);
    triangle.right = std::min(last_pixel(std::max({a.x, b.x, c.x})), size.width - 1);
    triangle.top = std::max(first_pixel(std::min({a.y, b.y, c.y})), 0);
    triangle.bottom = std::min(last_pixel(std::max({a.y, b.y, c.y})), size.height - 1);
    if (triangle.left > triangle.right || triangle.top > triangle.bottom) return false;
    const GridPoint points[] = {a, b, c, a};
    for (size_t i = 0; i < 3; ++i) {
        const GridPoint& from = points[i];
        const std::int32_t right = points[i + 1].x - from.x, down = points[i + 1].y - from.y;
        triangle.edge_right[i] = -down;
        triangle.edge_down[i] = right;
        // A sample on an edge between two triangles belongs to one of them.
        const bool owns_edge = down < 0 || (down == 0 && right > 0);
        const std::int64_t start = static_cast<std::int64_t>(down) * from.x -
                                   static_cast<std::int64_t>(right) * from.y - (owns_edge ? 0 : 1);
        triangle.edge_start[i] = start >> 3;  // samples lie on whole eighths: nothing is lost
    }
    return true;
}

std::int64_t twice_area(const std::array<GridPoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) -
           static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
}

// Adds the triangle of three points of the grid, whichever way they run.
void add_piece(TileTriangle triangle, std::array<GridPoint, 3> corners, RenderSize size,
               std::vector<TileTriangle>& triangles) {
    const std::int64_t area = twice_area(corners);
    if (area == 0) return;
    if (area < 0) std::swap(corners[1], corners[2]);
    if (set_edges(triangle, corners, size)) triangles.push_back(triangle);
}

TilePlane plane_of(const Point& row) {
    return {static_cast<float>(row.z), static_cast<float>(row.x), static_cast<float>(row.y)};
}

// Sets what is linear over the picture. Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous
// Coordinates", 1997: the inverse of the matrix of the corners, for which none of them need lie before the eye.
// False for a triangle that is seen from its edge, or from behind where that does not count.
bool set_planes(TileTriangle& triangle, const std::array<Point, 3>& corners, bool double_sided) {
    std::array<Point, 3> points = corners;
    for (Point& point : points) {
        point.x -= static_cast<double>(triangle.anchor_x) * point.z;
        point.y -= static_cast<double>(triangle.anchor_y) * point.z;
    }
    const Point first = glm::cross(points[1], points[2]);
    const double volume = glm::dot(points[0], first);
    triangle.front = volume < 0;  // y runs down
    if (!(std::abs(volume) > 1e-30) || (!triangle.front && !double_sided)) return false;
    const Point second = glm::cross(points[2], points[0]), third = glm::cross(points[0], points[1]);
    triangle.nearness = plane_of((first + second + third) / volume);
    triangle.second = plane_of(second / volume);
    triangle.third = plane_of(third / volume);
    return true;
}

// What of a polygon lies where `inside` is not negative. Sutherland and Hodgman, "Reentrant polygon clipping",
// 1974.
template <typename Inside>
std::vector<Point> clipped(const std::vector<Point>& polygon, const Inside& inside) {
    std::vector<Point> result;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double of_a = inside(a), of_b = inside(b);
        if (of_a >= 0) result.push_back(a);
        // From the inside to the outside, so that two triangles cut their common edge at one point.
        if (of_a >= 0 && of_b < 0) result.push_back(a + (b - a) * (of_a / (of_a - of_b)));
        if (of_a < 0 && of_b >= 0) result.push_back(b + (a - b) * (of_b / (of_b - of_a)));
    }
    return result;
}

std::vector<Point> clipped_to_reach(const std::array<Point, 3>& corners, const TileCamera& camera) {
    std::vector<Point> polygon(corners.begin(), corners.end());
    const double near = camera.near(), far = camera.far();
    polygon = clipped(polygon, [&](const Point& p) { return p.z - near; });
    polygon = clipped(polygon, [&](const Point& p) { return far - p.z; });
    polygon = clipped(polygon, [](const Point& p) { return p.x - kLeastPlace * p.z; });
    polygon = clipped(polygon, [](const Point& p) { return kMostPlace * p.z - p.x; });
    polygon = clipped(polygon, [](const Point& p) { return p.y - kLeastPlace * p.z; });
    return clipped(polygon, [](const Point& p) { return kMostPlace * p.z - p.y; });
}

}  // namespace

TileCamera::TileCamera(const Camera& camera, RenderSize size)
    : size_(size), near_(camera.near), far_(camera.far) {
    const Mat4 clip = clip_from_world(camera, size);
    const auto row = [&](int i) { return Vec4(clip[0][i], clip[1][i], clip[2][i], clip[3][i]); };
    distance_ = row(3);
    x_ = (0.5f * static_cast<float>(size.width)) * (distance_ + row(0));
    y_ = (0.5f * static_cast<float>(size.height)) * (distance_ - row(1));
}

TileVertex make_tile_vertex(const TileCamera& camera, const Vec3& position) {
    TileVertex vertex{.seen = camera.seen(position)};
    const Vec3& seen = vertex.seen;
    if (!(seen.z >= camera.near() && seen.z <= camera.far())) return vertex;
    const auto within = [&](float place) {
        return place >= static_cast<float>(kLeastPlace) * seen.z &&
               place <= static_cast<float>(kMostPlace) * seen.z;
    };
    if (!within(seen.x) || !within(seen.y)) return vertex;
    const GridPoint place = on_grid(Point(seen));
    vertex.x = place.x;
    vertex.y = place.y;
    vertex.plain = true;
    return vertex;
}

void set_up_triangle(const TileCamera& camera, std::span<const TileVertex> vertices, const TileFace& face,
                     std::vector<TileTriangle>& triangles) {
    const TileVertex& a = vertices[face.corners[0]];
    const TileVertex& b = vertices[face.corners[1]];
    const TileVertex& c = vertices[face.corners[2]];
    TileTriangle triangle{.surface = face.surface, .corners = face.corners};
    const std::array<Point, 3> points = {Point(a.seen), Point(b.seen), Point(c.seen)};
    if (a.plain && b.plain && c.plain) {
        std::array<GridPoint, 3> corners = {GridPoint{a.x, a.y}, {b.x, b.y}, {c.x, c.y}};
        const std::int64_t area = twice_area(corners);
        if (area == 0 || (area > 0 && !face.double_sided)) return;
        if (area < 0) std::swap(corners[1], corners[2]);
        if (!set_edges(triangle, corners, camera.size())) return;
        triangle.anchor_x = static_cast<float>(triangle.left) + 0.5f;
        triangle.anchor_y = static_cast<float>(triangle.top) + 0.5f;
        triangle.least_near = 1 / std::max({a.seen.z, b.seen.z, c.seen.z});
        triangle.most_near = 1 / std::min({a.seen.z, b.seen.z, c.seen.z});
        // The grid decides which side is seen: a sliver whose corners moved past each other leaves no hole.
        if (!set_planes(triangle, points, true)) return;
        triangle.front = area < 0;
        triangles.push_back(triangle);
        return;
    }
    const std::vector<Point> polygon = clipped_to_reach(points, camera);
    if (polygon.size() < 3) return;
    triangle.anchor_x = 0.5f * static_cast<float>(camera.size().width);
    triangle.anchor_y = 0.5f * static_cast<float>(camera.size().height);
    triangle.least_near = 1 / camera.far();
    triangle.most_near = 1 / camera.near();
    if (!set_planes(triangle, points, face.double_sided)) return;
    for (size_t i = 2; i < polygon.size(); ++i)
        add_piece(triangle, {on_grid(polygon[0]), on_grid(polygon[i - 1]), on_grid(polygon[i])},
                  camera.size(), triangles);
}

}  // namespace chironomia
