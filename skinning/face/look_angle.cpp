#include "skinning/face/look_angle.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace chironomia {
namespace {

constexpr size_t kFewestVertices = 6;
constexpr float kSmallestTurn = float(3 * kDegree);
constexpr float kStiff = 0.1f;  // of the mean move
constexpr int kSteps = 300;     // of the power iteration; the ratio of the eigenvalues is far below 1

using Vec3d = glm::dvec3;
using Vec4d = glm::dvec4;
using Mat4d = glm::dmat4;

Vec3d mean_of(std::span<const Vec3> points) {
    Vec3d sum(0);
    for (const Vec3& point : points) sum += Vec3d(point);
    return sum / static_cast<double>(points.size());
}

// Horn's symmetric matrix, whose eigenvector of the largest eigenvalue is the best turn (w, x, y, z).
Mat4d matrix_of(std::span<const Vec3> from, std::span<const Vec3> to) {
    const Vec3d from_mean = mean_of(from), to_mean = mean_of(to);
    glm::dmat3 s(0);  // s[b][a]: sum of from_a * to_b
    for (size_t i = 0; i < from.size(); ++i)
        s += glm::outerProduct(Vec3d(from[i]) - from_mean, Vec3d(to[i]) - to_mean);
    const auto at = [&](int a, int b) { return s[b][a]; };
    const double xx = at(0, 0), xy = at(0, 1), xz = at(0, 2), yx = at(1, 0), yy = at(1, 1), yz = at(1, 2),
                 zx = at(2, 0), zy = at(2, 1), zz = at(2, 2);
    return {xx + yy + zz, yz - zy,      zx - xz,       xy - yx,  //
            yz - zy,      xx - yy - zz, xy + yx,       zx + xz,  //
            zx - xz,      xy + yx,      -xx + yy - zz, yz + zy,  //
            xy - yx,      zx + xz,      yz + zy,       -xx - yy + zz};
}

glm::dquat best_turn(std::span<const Vec3> from, std::span<const Vec3> to) {
    Mat4d matrix = matrix_of(from, to);
    double norm = 0;
    for (int c = 0; c < 4; ++c) norm = std::max(norm, glm::length(matrix[c]));
    // Makes the largest eigenvalue the one of largest magnitude.
    matrix += 2 * norm * Mat4d(1);
    Vec4d q(1, 1e-3, 1e-3, 1e-3);
    for (int step = 0; step < kSteps; ++step) q = glm::normalize(matrix * q);
    return {q[0], q[1], q[2], q[3]};
}

}  // namespace

std::optional<float> turn_of_morph(const Surface& surface, const Morph& morph) {
    std::vector<Vec3> from, to;
    double moved = 0;
    for (size_t i = 0; i < morph.vertices.size(); ++i) {
        from.push_back(surface.positions[morph.vertices[i]]);
        to.push_back(from.back() + morph.moves[i]);
        moved += length(morph.moves[i]);
    }
    if (from.size() < kFewestVertices) return std::nullopt;

    const glm::dquat turn = best_turn(from, to);
    const Vec3d from_mean = mean_of(from), to_mean = mean_of(to);
    double missed = 0;
    for (size_t i = 0; i < from.size(); ++i)
        missed += glm::length(turn * (Vec3d(from[i]) - from_mean) - (Vec3d(to[i]) - to_mean));
    const auto angle = static_cast<float>(2 * std::acos(std::min(1.0, std::abs(turn.w))));
    if (!(missed <= kStiff * moved) || !(angle >= kSmallestTurn)) return std::nullopt;
    return angle;
}

float weight_of_turn(float angle, float whole) {
    if (angle >= whole) return 1;
    return std::sin(angle) / (std::sin(angle) + std::sin(whole - angle));
}

}  // namespace chironomia
