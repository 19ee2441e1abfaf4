// Comparing what lies on disk: two images, two stacks of frames, two clips, or a stack with a clip.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "raster/images/compare.h"

namespace chironomia {

struct CompareOptions {
    CompareLimits limits = {};
    double sound_limit = 0.01;                     // largest error of a sample, of [-1, 1]
    std::filesystem::path difference_folder = {};  // empty: no difference images
};

struct FileComparison {
    int width = 0;
    int height = 0;
    std::vector<FrameComparison> frames;  // in order
    size_t worst = 0;                     // the first frame with the largest root-mean-square error
    std::optional<double> sound_error;    // the largest of a sample; nothing unless both clips have sound
    bool within_limits = true;            // of all frames and the sound

    // One per frame beyond the limits, "difference_00012.png".
    std::vector<std::filesystem::path> difference_images;
};

// Recognises by content what `a` and `b` are: a folder is a stack, a file is an image or else a clip.
// Throws Error with both values if their sizes, numbers of frames, rates, or presence or form of sound
// differ, and whatever reading them throws.
FileComparison compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                             const CompareOptions& options = {});

}  // namespace chironomia
