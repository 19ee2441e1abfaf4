// How far the joints of a healthy adult turn, and postures that go further.
#pragma once

#include <array>
#include <bitset>
#include <string_view>

#include "skinning/body/posture.h"

namespace chironomia {

// A joint, or a way in which it turns, that has a limit of its own.
enum class Limit {
    spine,  // shoulders against the hips
    neck,   // head against the shoulders
    left_clavicle,
    left_shoulder,  // where the upper arm points
    left_elbow,     // flexion
    left_forearm,   // pronation and supination
    left_wrist,     // flexion and deviation
    left_hip,       // where the thigh points
    left_knee,      // flexion
    right_clavicle,
    right_shoulder,
    right_elbow,
    right_forearm,
    right_wrist,
    right_hip,
    right_knee,
};

inline constexpr size_t kLimits = 16;

// "left_elbow"
std::string_view name_of(Limit limit);

struct LimitedPosture {
    Posture posture;              // the same posture, brought within every limit
    std::bitset<kLimits> passed;  // the limits that the given posture went past, by Limit
};

// Brings a posture within the limits, from the trunk outward; what hangs from a limited joint turns with it.
// The ranges are those of clinical goniometry, rounded up so that recorded motion passes: spine 95, head 95,
// clavicle 35, elbow -10 to 155, forearm +-110, wrist 90 flexed and 45 sideways, knee -10 to 160 degrees; the
// upper arm within 118 degrees of a direction forward, outward and down, the thigh within 125 degrees of one
// forward and down.
LimitedPosture limit_posture(const Posture& posture);

}  // namespace chironomia
