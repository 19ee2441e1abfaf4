// How well a model of style moves as somebody else: of clips of one person in the style of another.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "study/measure/bootstrap.h"
#include "study/measure/pose_errors.h"
#include "study/measure/stroke_timing.h"
#include "study/measure/style_distance.h"
#include "synth/predictions.h"

namespace chironomia::study {

// Of which points Dist_avg is: as they are, or their three_frame_means(). What is recorded carries a tracker's noise,
// what a model makes hardly does.
enum class StylePoints { raw, smoothed };

// Of Fares 2023, sections 6.7 and 7.5.
struct StyleScores {
    std::size_t clips = 0;  // of one speaker in the style of another
    std::array<std::optional<StyleDistance>, kStyleMetricNames.size()> distances;
    Bootstrapped content;           // content_preservation() of the source, as printed [%]
    Bootstrapped content_centred;   // with the means taken off
    Bootstrapped minkowski_source;  // minkowski_distance() to the source, p = 3 [px]
    Bootstrapped minkowski_target;  // to a clip of the target, both cut to the shorter one
    StrokeTiming timing;
};

// How near poses are to those that people took: clips in their speakers' own style.
struct PoseScores {
    std::size_t clips = 0;
    Bootstrapped l1;              // mean |y - z| [px]
    Bootstrapped velocity_l1;     // of what changes from frame to frame [px/frame]
    Bootstrapped pck_01, pck_02;  // share of points within 0.1, and 0.2, of the larger side of the body's box
    std::optional<double> frechet;  // of all poses [px^2]; none of fewer than dimensions + 1
};

// Of items in their speakers' own style; none without points of a body.
std::optional<PoseScores> score_poses(const Predictions& own, const Resampling& resampling);

// Whether some of the items are in the style of another speaker.
bool has_transfers(const Predictions& predictions);

// The items in the style of their own speaker, or of none.
Predictions own_styles(const Predictions& predictions);

// The target of a clip is what its speaker's own items did: metrics are means over them. Clips whose target has no item
// are left out. None without transfers or points of a body.
std::optional<StyleScores> score_styles(const Predictions& predictions, const Resampling& resampling,
                                        StylePoints points = StylePoints::raw);

}  // namespace chironomia::study
