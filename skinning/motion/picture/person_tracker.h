// Which of the people in a picture is the one of the frame before.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/math.h"

namespace chironomia {

// A point that a detector saw.
struct PersonPoint {
    Vec2 place{0};         // [px]
    float confidence = 0;  // 0: not found
};

// Goes through the frames of a clip in order.
class PersonTracker {
  public:
    // Of the people in the next frame the one whose points are nearest to those of the frame before, if the person goes
    // on as it moved; in the beginning the one that is seen most surely; nothing in an empty picture. `people` have the
    // same points each, of which the first `body_points` count.
    std::optional<std::size_t> choose(const std::vector<std::vector<PersonPoint>>& people,
                                      std::size_t body_points);

    std::size_t crowded() const { return crowded_; }    // frames in which there were others
    std::size_t doubtful() const { return doubtful_; }  // of them those in which another was nearly as near

  private:
    using Points = std::vector<PersonPoint>;
    double distance_from_last(const Points& person) const;
    void go_on(const Points& person);

    Points last_;             // of the body, when the person was seen last; empty: never
    Vec2 velocity_{0};        // of the whole person, smoothed [px a frame]
    std::size_t unseen_ = 0;  // frames since then
    std::size_t crowded_ = 0;
    std::size_t doubtful_ = 0;
};

}  // namespace chironomia
