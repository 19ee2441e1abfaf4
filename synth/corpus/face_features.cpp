#include "synth/corpus/face_features.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chironomia {
namespace {

// The rows of the matrix of a turn that its angles are read from, without the rounding of floats in between.
struct Rows {
    std::array<double, 3> first;     // of the row of x
    double second_last, third_last;  // of the rows of y and z, the column of z
    double second_middle, third_middle;
};

Rows rows_of(const Quat& turn) {
    const double size = std::sqrt(double{turn.x} * turn.x + double{turn.y} * turn.y +
                                  double{turn.z} * turn.z + double{turn.w} * turn.w);
    const double x = turn.x / size, y = turn.y / size, z = turn.z / size, w = turn.w / size;
    return {.first = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            .second_last = 2 * (y * z - w * x),
            .third_last = 1 - 2 * (x * x + y * y),
            .second_middle = 1 - 2 * (x * x + z * z),
            .third_middle = 2 * (y * z + w * x)};
}

// Where the eyes look, seen by the head.
Vec3 way_of(const Vec2& angles) {
    return {std::sin(angles.x) * std::cos(angles.y), std::sin(angles.y),
            std::cos(angles.x) * std::cos(angles.y)};
}

}  // namespace

Vec3 openface_angles(const Quat& head) {
    const Rows rows = rows_of(head);
    const double side = std::hypot(rows.first[0], rows.first[1]);
    const double yaw = std::atan2(rows.first[2], side);
    // Gimbal lock: when the head looks straight to one side, roll and pitch turn about the same axis.
    constexpr double kLeastSide = 1e-6;
    if (side < kLeastSide) {
        return {static_cast<float>(std::atan2(rows.third_middle, rows.second_middle)),
                static_cast<float>(-yaw), 0};
    }
    return {static_cast<float>(std::atan2(-rows.second_last, rows.third_last)), static_cast<float>(-yaw),
            static_cast<float>(std::atan2(rows.first[1], rows.first[0]))};
}

Quat head_of_openface(const Vec3& angles) {
    return normalize(glm::angleAxis(angles.x, Vec3(1, 0, 0)) * glm::angleAxis(angles.y, Vec3(0, -1, 0)) *
                     glm::angleAxis(angles.z, Vec3(0, 0, -1)));
}

Vec2 openface_gaze(const Gaze& gaze, const Quat& head) {
    // Theirs is the mean of the ways of both eyes, in the camera's space: y down, z away from it.
    const Vec3 way = head * (way_of(gaze.left) + way_of(gaze.right));
    return {std::atan2(way.x, way.z), std::atan2(-way.y, way.z)};
}

Gaze gaze_of_openface(const Vec2& angles, const Quat& head) {
    const Vec3 way = conjugate(head) * Vec3(std::tan(angles.x), -std::tan(angles.y), 1);
    const Vec2 both = {std::atan2(way.x, way.z), std::atan2(way.y, std::hypot(way.x, way.z))};
    return {both, both};
}

std::vector<float> intensities_of(const FaceTrack& face, std::size_t frames, std::span<const int> units) {
    std::vector<float> intensities(frames * units.size(), 0);
    const std::size_t width = face.channels.size();
    for (std::size_t c = 0; c < width; ++c) {
        const auto unit = std::find(units.begin(), units.end(), face.channels[c].unit);
        if (unit == units.end()) continue;
        const auto column = static_cast<std::size_t>(unit - units.begin());
        for (std::size_t t = 0; t < frames; ++t) {
            float& intensity = intensities[t * units.size() + column];
            intensity = std::max(intensity, face.intensities[t * width + c]);
        }
    }
    return intensities;
}

}  // namespace chironomia
