// How far a joint of a moved avatar is from where the motion has it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace chironomia {

// All in shoulder widths of the person.
struct ErrorSpread {
    std::size_t n = 0;  // frames in which the joint was seen
    double median = 0;
    double p95 = 0;  // nearest rank
    double max = 0;
};

struct JointError {
    std::string part;                     // "left_elbow"
    ErrorSpread reprojected;              // in the picture; of a motion in space, as seen from the front
    std::optional<ErrorSpread> in_space;  // where the truth is known: not for what was lifted from a picture
    std::vector<float> course;            // (T) reprojected, at the rate of the fit; below 0: not seen
};

}  // namespace chironomia
