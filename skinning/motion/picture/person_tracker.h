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
    // Of the people in the next frame the one that is nearest to where the person was before, and in the beginning
    // the one that is seen most surely; nothing in an empty picture. `people` have the same points each, of which
    // the first `body_points` count.
    std::optional<std::size_t> choose(const std::vector<std::vector<PersonPoint>>& people,
                                      std::size_t body_points);

    std::size_t crowded() const { return crowded_; }    // frames in which there were others
    std::size_t doubtful() const { return doubtful_; }  // of them those in which another was nearly as near

  private:
    struct Summary {
        Vec2 place{0};          // the mean of the points that are seen
        float size = 0;         // of the box around them
        double confidence = 0;  // of all
    };
    static Summary summary_of(const std::vector<PersonPoint>& person, std::size_t body_points);

    std::optional<Summary> last_;
    std::size_t crowded_ = 0;
    std::size_t doubtful_ = 0;
};

}  // namespace chironomia
