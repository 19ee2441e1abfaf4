// The postures that limbs take most often. They decide where the picture is ambiguous.
#pragma once

#include <cstddef>
#include <vector>

#include "core/math.h"

namespace chironomia {

// Of both bones of a limb in the frame of its trunk: x outward, y up, z forward; unit.
struct LimbDirections {
    glm::dvec3 upper{0};
    glm::dvec3 lower{0};
};

// The postures in which the arms of a person were found, about five a second. People come back to the
// postures that they took a moment ago, with the same arm or the other, and hold them while they turn.
class FrequentPostures {
  public:
    explicit FrequentPostures(double fps);

    // Frames between two that are kept.
    size_t stride() const { return stride_; }

    // Frames ascend.
    void add(size_t frame, const LimbDirections& directions);

    // -log(share + 5 %), with the share of the postures within five seconds of a frame that are near this one. 0 while
    // fewer than eleven postures are known, which are too few to show what is frequent.
    double cost(size_t frame, const LimbDirections& directions) const;

  private:
    struct Posture {
        size_t frame = 0;
        LimbDirections directions;
    };
    size_t stride_, reach_;  // [frames]
    std::vector<Posture> postures_;
};

}  // namespace chironomia
