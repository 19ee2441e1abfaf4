// How Mix-StAGE is built and trained: its presets, and what is left open (docs/learned_styles.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json_value.h"
#include "synth/features/spectrum.h"
#include "synth/learned/styles/mix_stage.h"
#include "synth/learned/styles/style_windows.h"
#include "synth/learned/training/learning_rate.h"

namespace chironomia {

// "paper", "small".
const std::vector<std::string>& mix_stage_presets();

// The choices of a job or a checkpoint, each with its value. Throws Error for another key or value.
Json mix_stage_choices(std::string_view preset, const JsonValue& asked);

MixStageSize mix_stage_size(std::string_view preset, std::int64_t speakers);
MelResampling mix_stage_resampling(const Json& choices);

// As the authors' code has it, or smaller.
struct MixStageTraining {
    EqualPlan epoch;
    std::size_t epochs = 20;
    LearningRate rate;
    std::size_t curriculum = 1000;  // steps until the content is of the sound alone
    std::size_t rise = 0;  // steps in which the weights of the adversary grow from 1 to 2; 0: they stay (A62)
    std::int64_t hop = 5;  // frames between the segments that it learns from

    // Of the adversary in a step, from 1 to 2.
    double adversary_weight(std::size_t step) const;
    // How likely it is in a step that the content is made of the pose.
    double pose_share(std::size_t step) const;
};
MixStageTraining mix_stage_training(std::string_view preset, const Json& choices);

}  // namespace chironomia
