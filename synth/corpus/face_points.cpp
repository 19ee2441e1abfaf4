#include "synth/corpus/face_points.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace chironomia {
namespace {

// In millimetres. Of pairs the person's right one stands here; the left one is its mirror image.
struct TemplatePoint {
    std::size_t right;
    std::size_t left;  // as `right` in the middle of the face
    Vec3 place;
};
constexpr TemplatePoint kTemplate[] = {
    {0, 16, {-73, 0, -90}},    {1, 15, {-72, -20, -88}},   {2, 14, {-70, -40, -84}},
    {3, 13, {-66, -58, -76}},  {4, 12, {-58, -75, -64}},   {5, 11, {-47, -89, -48}},
    {6, 10, {-33, -100, -32}}, {7, 9, {-17, -107, -20}},   {8, 8, {0, -110, -15}},
    {17, 26, {-58, 18, -22}},  {18, 25, {-48, 26, -10}},   {19, 24, {-36, 29, -3}},
    {20, 23, {-24, 27, 1}},    {21, 22, {-13, 22, 4}},     {27, 27, {0, 5, 10}},
    {28, 28, {0, -10, 17}},    {29, 29, {0, -25, 25}},     {30, 30, {0, -40, 32}},
    {31, 35, {-14, -48, 14}},  {32, 34, {-7, -51, 19}},    {33, 33, {0, -53, 21}},
    {36, 45, {-46, 0, -18}},   {37, 44, {-38, 6, -10}},    {38, 43, {-28, 6, -8}},
    {39, 42, {-18, -1, -10}},  {40, 47, {-28, -5, -9}},    {41, 46, {-38, -5, -11}},
    {48, 54, {-25, -75, 3}},   {49, 53, {-15, -70, 11}},   {50, 52, {-6, -67, 16}},
    {51, 51, {0, -69, 17}},    {59, 55, {-15, -82, 9}},    {58, 56, {-6, -86, 13}},
    {57, 57, {0, -87, 14}},    {60, 64, {-21, -75, 4}},    {61, 63, {-8, -74.5f, 12}},
    {62, 62, {0, -74.5f, 14}}, {67, 65, {-8, -76.5f, 12}}, {66, 66, {0, -77, 14}},
    {68, 69, {-32, 0.5f, -8}},
};

// How far an action unit moves a point of the right side, or of the middle, at its full intensity.
struct UnitMove {
    int unit;
    std::size_t point;
    Vec3 move;  // [mm]
};
constexpr UnitMove kMoves[] = {
    {1, 21, {0, 10, 0}},    {1, 20, {0, 9, 0}},       {1, 19, {0, 4, 0}},       {2, 17, {0, 8, 0}},
    {2, 18, {0, 10, 0}},    {2, 19, {0, 7, 0}},       {4, 21, {5, -6, 0}},      {4, 20, {4, -6, 0}},
    {4, 19, {2, -4, 0}},    {4, 18, {0, -3, 0}},      {5, 37, {0, 4, 0}},       {5, 38, {0, 4, 0}},
    {6, 40, {0, 2.5f, 0}},  {6, 41, {0, 2.5f, 0}},    {6, 36, {0, 1, 0}},       {7, 37, {0, -1.5f, 0}},
    {7, 38, {0, -1.5f, 0}}, {7, 40, {0, 2, 0}},       {7, 41, {0, 2, 0}},       {9, 31, {-1, 4, 0}},
    {9, 32, {0, 3, 0}},     {9, 21, {3, -3, 0}},      {9, 50, {0, 2, 0}},       {10, 49, {0, 3, 0}},
    {10, 50, {0, 4, 0}},    {10, 51, {0, 4, 0}},      {10, 61, {0, 3, 0}},      {10, 62, {0, 3, 0}},
    {12, 48, {-8, 9, -5}},  {12, 60, {-7, 8, -5}},    {12, 49, {-5, 4, -2}},    {12, 59, {-5, 4, -2}},
    {15, 48, {-2, -8, -1}}, {15, 60, {-2, -7, -1}},   {15, 59, {0, -3, 0}},     {17, 57, {0, 4, 2}},
    {17, 58, {0, 4, 2}},    {17, 8, {0, 3, 0}},       {18, 48, {8, 0, 4}},      {18, 60, {7, 0, 4}},
    {18, 49, {4, 0, 5}},    {18, 59, {4, 0, 5}},      {20, 48, {-8, -2, -4}},   {20, 60, {-7, -2, -4}},
    {20, 59, {-4, -1, -1}}, {22, 48, {6, 0, 5}},      {22, 60, {5, 0, 5}},      {22, 50, {0, 2, 6}},
    {22, 58, {0, -2, 6}},   {23, 48, {4, 0, 0}},      {23, 50, {0, -2, 0}},     {23, 51, {0, -2, 0}},
    {23, 57, {0, 2, 0}},    {23, 58, {0, 2, 0}},      {25, 66, {0, -5, 0}},     {25, 67, {0, -4, 0}},
    {25, 57, {0, -5, 0}},   {25, 58, {0, -4, 0}},     {25, 59, {0, -2, 0}},     {25, 62, {0, 1, 0}},
    {25, 61, {0, 1, 0}},    {26, 66, {0, -17, -3}},   {26, 67, {0, -15, -3}},   {26, 57, {0, -18, -3}},
    {26, 58, {0, -17, -3}}, {26, 59, {0, -12, -2}},   {26, 48, {3, -6, 0}},     {26, 60, {3, -6, 0}},
    {26, 8, {0, -19, -4}},  {26, 7, {0, -19, -4}},    {26, 6, {0, -17, -4}},    {26, 5, {0, -13, -3}},
    {26, 4, {0, -8, -2}},   {26, 3, {0, -4, -1}},     {28, 57, {0, 3, -3}},     {28, 58, {0, 3, -3}},
    {28, 66, {0, 3, -3}},   {45, 37, {0, -11.5f, 0}}, {45, 38, {0, -11.5f, 0}},
};

Vec3 mirrored(const Vec3& place) {
    return {-place.x, place.y, place.z};
}

// Of the point with this number on the right side.
const TemplatePoint& pair_of(std::size_t right) {
    return *std::find_if(std::begin(kTemplate), std::end(kTemplate),
                         [&](const TemplatePoint& point) { return point.right == right; });
}

void move(FacePoints& points, const FaceChannel& channel, float share) {
    for (const UnitMove& unit : kMoves) {
        if (unit.unit != channel.unit) continue;
        const TemplatePoint& pair = pair_of(unit.point);
        if (channel.side != FaceSide::left) points[pair.right] += share * unit.move;
        if (channel.side != FaceSide::right && pair.left != pair.right)
            points[pair.left] += share * mirrored(unit.move);
    }
}

// Pupils go with the eyeballs, 12 mm in front of their middle.
void look(FacePoints& points, const Gaze& gaze) {
    constexpr float kRadius = 12;  // [mm]
    const auto moved = [](const Vec2& turn) { return kRadius * Vec3(std::sin(turn.x), std::sin(turn.y), 0); };
    points[kRightPupil] += moved(gaze.right);
    points[kLeftPupil] += moved(gaze.left);
}

}  // namespace

FacePoints place_face_points(const FaceTrack& face, std::size_t frame) {
    constexpr float kMost = 5, kMillimetre = 1e-3f;
    FacePoints points;
    for (const TemplatePoint& point : kTemplate) {
        points[point.left] = mirrored(point.place);
        points[point.right] = point.place;
    }
    const std::size_t count = face.channels.size();
    for (std::size_t c = 0; c < count; ++c)
        move(points, face.channels[c], face.intensities[frame * count + c] / kMost);
    if (!face.gaze.empty()) look(points, face.gaze[frame]);
    // Lids meet, they do not cross.
    for (const auto& [upper, lower] : {std::pair{37, 41}, {38, 40}, {43, 47}, {44, 46}})
        points[upper].y = std::max(points[upper].y, points[lower].y);
    for (Vec3& point : points) point *= kMillimetre;
    return points;
}

}  // namespace chironomia
