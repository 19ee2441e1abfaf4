// Points of a person in a picture, as intervals hold them.
#pragma once

#include <optional>
#include <vector>

namespace chironomia {

// x of all points, then y of all points, in each frame; relative to the neck, y down.
struct PicturePoints {
    std::vector<float> places;  // (T, 2 N) [px]
    // alike, as if the shoulders were 100 px apart in the middle one of the frames
    std::vector<float> normalized;
    std::vector<float> confidence;  // (T, 2 N) in [0, 1]; 0: the point was lost
};

// The middle one of the distances of both shoulders [px], over the frames that show them; nothing if none does.
//   pose   of the 52 joints of PATS
std::optional<float> shoulder_width(const PicturePoints& pose);

// Of places whose shoulders are `width` > 0 apart.
std::vector<float> with_equal_shoulders(std::vector<float> places, float width);

}  // namespace chironomia
