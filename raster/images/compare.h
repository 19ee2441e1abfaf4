// How far two pictures are apart, with the measures of OpenImageIO's image comparison.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "core/render/frame.h"

namespace chironomia {

// When two frames still count as the same. The defaults are what tests allow against stored frames.
struct CompareLimits {
    int small_step = 1;                 // [1/255] an error above this one is counted
    double share_above_small = 0.0002;  // of the pixels that may be counted
    int large_step = 3;                 // [1/255] no error may be above this one
};

// Errors are over red, green and blue, and over alpha too where one of the frames is not opaque; 1 is the
// distance from black to white.
struct FrameComparison {
    double mean_error = 0;
    double rms_error = 0;
    double psnr = std::numeric_limits<double>::infinity();  // [dB], infinite for equal frames
    double max_error = 0;
    int max_x = 0;  // the first pixel with the largest error
    int max_y = 0;
    size_t pixels = 0;
    size_t pixels_above_small = 0;
    size_t pixels_above_large = 0;
    std::optional<size_t> visible_differences;  // pixels; set where visible_difference.h counted them
    bool within_limits = true;
};

// Both frames have the same size.
FrameComparison compare(const Frame& a, const Frame& b, const CompareLimits& limits = {});

// What is beyond the limits, in numbers, as one line: "12 of 3072 pixels differ by more than 1 of 255, ...".
std::string describe(const FrameComparison& comparison, const CompareLimits& limits);

// A picture of the differences, opaque: black where the frames are the same; elsewhere the difference of each
// colour 16-fold, and at least 64 of 255 so that one step is seen; a difference of alpha shows in all
// colours. Both frames have the same size.
Frame difference_image(const Frame& a, const Frame& b);

}  // namespace chironomia
