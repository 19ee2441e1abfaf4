#include "synth/gestures/sectors.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace chironomia {
namespace {

constexpr SectorName kAcross[] = {{"XOppC", "across", -0.25f},
                                  {"XCC", "middle", 0},
                                  {"XC", "centre", 0.25f},
                                  {"XP", "side", 0.5f},
                                  {"XEP", "far side", 0.8f}};
constexpr SectorName kUpward[] = {{"YLowerEP", "thigh", -0.5f},    {"YLowerP", "hip", -0.3f},
                                  {"YLowerC", "belly", 0},         {"YCC", "chest", 0.25f},
                                  {"YUpperC", "shoulder", 0.6f},   {"YUpperP", "face", 0.9f},
                                  {"YUpperEP", "above head", 1.2f}};
constexpr SectorName kForward[] = {
    {"ZNear", "near", 0.4f}, {"ZMiddle", "halfway", 0.65f}, {"ZFar", "far", 0.95f}};
constexpr DirectionName kDirections[] = {{"up", {0, 1, 0}},  {"down", {0, -1, 0}}, {"in", {-1, 0, 0}},
                                         {"out", {1, 0, 0}}, {"front", {0, 0, 1}}, {"back", {0, 0, -1}}};

}  // namespace

std::span<const SectorName> sectors_along(int axis) {
    assert(axis >= 0 && axis < 3);
    if (axis == 0) return kAcross;
    if (axis == 1) return kUpward;
    return kForward;
}

std::span<const DirectionName> directions() {
    return kDirections;
}

float usual_swivel(const Vec3& wrist) {
    constexpr float kCentre = 0.35f, kPeriphery = 0.9f;
    // From the border of the centre to the extreme periphery, and from the chest to the shoulder.
    const float outward = (wrist.x - 0.375f) / (0.8f - 0.375f);
    const float upward = (wrist.y - 0.25f) / (0.6f - 0.25f);
    return kCentre + (kPeriphery - kCentre) * std::clamp(std::max(outward, upward), 0.0f, 1.0f);
}

}  // namespace chironomia
