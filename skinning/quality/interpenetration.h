// One part of a moved avatar that is inside another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "skinning/quality/motion_checks.h"

namespace chironomia {

// Less deep than this is a touch [m]. Ours: 96 of 100 points of the shirt of the neutral avatar are less than 18 mm
// from the capsules of its shape, and flesh and cloth give way.
inline constexpr double kTouchDepth = 0.02;

struct Interpenetration {
    std::string part;              // "left hand", "right forearm"
    std::string in;                // "trunk", "head", "left thigh", "left forearm"
    double deepest = 0;            // [m]
    std::vector<FrameSpan> spans;  // deeper than kTouchDepth; frames of the fit
    std::vector<float> course;     // (T) depth [m]; 0: not deeper than kTouchDepth
};

// How long two parts are in each other.
struct InsideTimes {
    std::size_t frames = 0;   // all
    std::size_t longest = 0;  // of the longest stretch
};

inline InsideTimes times_of(const Interpenetration& one) {
    InsideTimes times;
    for (const FrameSpan& span : one.spans) {
        times.frames += span.last - span.first + 1;
        times.longest = std::max(times.longest, span.last - span.first + 1);
    }
    return times;
}

}  // namespace chironomia
