// How well a model of style moves as somebody else: of clips of one person in the style of another.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "study/measure/bootstrap.h"
#include "study/measure/stroke_timing.h"
#include "study/measure/style_distance.h"
#include "synth/predictions.h"

namespace chironomia {

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

// Whether some of the items are in the style of another speaker.
bool has_transfers(const Predictions& predictions);

// The items in the style of their own speaker, or of none.
Predictions own_styles(const Predictions& predictions);

// The target of a clip is what its speaker's own items did: metrics are means over them. Clips whose target has no item
// are left out. None without transfers or points of a body.
std::optional<StyleScores> score_styles(const Predictions& predictions, const Resampling& resampling);

}  // namespace chironomia
