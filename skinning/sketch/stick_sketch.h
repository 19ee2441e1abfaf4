// What a stick figure consists of: points, the lines between them, and where the points are over time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/body/humanoid.h"
#include "core/math.h"

namespace chironomia {

// What a point or a line belongs to; it decides the colour and how thick the line is.
enum class StickKind { trunk, left_arm, right_arm, left_leg, right_leg, left_hand, right_hand, face };
inline constexpr int kStickKinds = 8;

struct StickPoint {
    std::string name;
    StickKind kind = StickKind::trunk;
    Vec3 rest{0};       // of a person who stands and faces +z, soles at y = 0 [m]
    bool dot = true;    // drawn as a joint; otherwise no more than where lines meet
    bool foot = false;  // may stand on the floor
};

struct StickLine {
    std::size_t from = 0;
    std::size_t to = 0;
    StickKind kind = StickKind::trunk;
};

// T frames of P points. Frame t, point p lies at t * P + p.
struct StickSketch {
    std::vector<StickPoint> points;  // (P)
    std::vector<StickLine> lines;
    HumanoidMap parts;         // which point stands for which part; both upper arms are there
    float size = 1;            // of the person, against an adult of 1.72 m
    std::size_t frames = 0;    // T
    std::vector<Vec3> places;  // (T, P) [m]; of a point that is not seen it means nothing
    std::vector<bool> seen;    // (T, P)

    const Vec3& place(std::size_t frame, std::size_t point) const {
        return places[frame * points.size() + point];
    }
    bool sees(std::size_t frame, std::size_t point) const { return seen[frame * points.size() + point]; }
};

}  // namespace chironomia
