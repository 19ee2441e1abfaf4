#include <array>
#include <cstddef>
#include <string>

#include "core/text.h"
#include "synth/gestures/hand_shape.h"
#include "synth/gestures/lexicon_parts.h"

namespace chironomia {
namespace {

constexpr std::array<const char*, 4> kFingerNames = {"index", "middle", "ring", "little"};

double read_bend(const JsonValue& value, const BendRange& range) {
    return value.number(range.least, range.most);
}

std::array<double, 3> read_flexion(const JsonValue& value, const std::array<BendRange, 3>& ranges) {
    const std::vector<JsonValue> joints = value.items(3);
    if (joints.size() != 3) {
        value.refuse(format("has {} entries, the flexion of 3 joints is needed, from the palm outward",
                            joints.size()));
    }
    std::array<double, 3> flexion{};
    for (std::size_t k = 0; k < 3; ++k) flexion[k] = read_bend(joints[k], ranges[k]);
    return flexion;
}

void read_finger(const JsonValue& value, FingerBends& finger) {
    check_keys(value, "shapes.*.index");
    if (const auto flexion = value.find("flexion")) finger.flexion = read_flexion(*flexion, kFingerFlexion);
    if (const auto spread = value.find("spread")) finger.spread = read_bend(*spread, kFingerSpread);
}

void read_thumb(const JsonValue& value, ThumbBends& thumb) {
    check_keys(value, "shapes.*.thumb");
    if (const auto flexion = value.find("flexion")) thumb.flexion = read_flexion(*flexion, kThumbFlexion);
    if (const auto spread = value.find("spread")) thumb.spread = read_bend(*spread, kThumbSpread);
    if (const auto oppose = value.find("oppose")) thumb.oppose = read_bend(*oppose, kThumbOppose);
}

}  // namespace

HandBends read_hand_bends(const JsonValue& value, const HandBends& start) {
    HandBends bends = start;
    if (const auto thumb = value.find("thumb")) read_thumb(*thumb, bends.thumb);
    if (const auto all = value.find("fingers"))
        for (FingerBends& finger : bends.fingers) read_finger(*all, finger);
    for (std::size_t f = 0; f < kFingerNames.size(); ++f)
        if (const auto finger = value.find(kFingerNames[f])) read_finger(*finger, bends.fingers[f]);
    return bends;
}

}  // namespace chironomia
