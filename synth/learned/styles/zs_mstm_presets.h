// How ZS-MSTM is built and trained: its presets, and what the thesis leaves open (docs/learned_styles.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json_value.h"
#include "synth/features/spectrum.h"
#include "synth/learned/styles/zs_mstm.h"
#include "synth/learned/training/learning_rate.h"

namespace chironomia {

enum class ZsMstmVersion {
    one,  // Fares 2023, chapter 6: pose, segments of 64 frames
    two,  // chapter 7: pose and face, segments of 16 frames
};

// "paper", "small"; of version 2.0 also "literal", with the learning rate as printed (A61).
const std::vector<std::string>& zs_mstm_presets(ZsMstmVersion version);

// The choices of a job or a checkpoint, each with its value. Throws Error for another key or value.
Json zs_mstm_choices(std::string_view preset, const JsonValue& asked);

ZsMstmSize zs_mstm_size(ZsMstmVersion version, std::string_view preset, const Json& choices);
MelResampling zs_mstm_resampling(const Json& choices);

struct ZsMstmTraining {
    std::size_t batch = 24;
    std::size_t epochs = 200;
    std::optional<std::size_t> steps;
    LearningRate rate;
    double clip = 0;
    double lambda_step = 0.01;           // by which the weight of L_adv grows in each step
    double lambda_most = 1;              // where it stays (A54); 0: no adversary
    bool adversary_moves_style = false;  // whether L_adv changes the style encoder too (A53)
    double same_share = 0.5;             // A55
    std::int64_t hop = 64;               // frames between the segments that it learns from
};
ZsMstmTraining zs_mstm_training(ZsMstmVersion version, std::string_view preset, const Json& choices);

}  // namespace chironomia
