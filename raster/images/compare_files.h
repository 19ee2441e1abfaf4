// Comparing what lies on disk: two images, two stacks of frames, two clips, or a stack with a clip.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/render/frame.h"
#include "raster/images/compare.h"

namespace chironomia {

// Two frames that were just compared.
struct FramePair {
    size_t index = 0;  // of so many frames
    size_t count = 0;
    const Frame& a;
    const Frame& b;
    const FrameComparison& comparison;
};

// For quiet sounds the limit of a sample's error is a quarter of the peak instead, at least 0.0005 (ours: 12 dB below
// the peak, and -66 dB).
struct CompareOptions {
    CompareLimits limits = {};
    double sound_limit = 0.01;  // largest error of a sample, of [-1, 1]
    // Frames beyond the limits still count as the same if at most this share of their pixels is seen to
    // differ (visible_difference.h); none: levels alone decide.
    std::optional<double> seen_share = {};
    std::function<void(const FramePair&)> on_frame = {};  // called after each, in order
};

struct FileComparison {
    int width = 0;
    int height = 0;
    std::vector<FrameComparison> frames;  // in order
    size_t worst = 0;                     // the first frame with the largest root-mean-square error
    std::optional<double> sound_error;    // the largest of a sample; nothing unless both clips have sound
    double sound_limit = 0;               // what it may be
    bool within_limits = true;            // of all frames and the sound
};

// Both can be read, but are not of one form: sizes, numbers of frames, rates, time stamps, tracks, the shape of pixels,
// how players turn them, transfer or primaries of their colours, or the sound or its beginning differ.
class DifferentForm : public Error {
  public:
    using Error::Error;
};

// Recognises by content what `a` and `b` are: a folder is a stack, a file is an image or else a clip.
// Throws DifferentForm with both values if they are not of one form, and whatever reading them throws.
FileComparison compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                             const CompareOptions& options = {});

}  // namespace chironomia
