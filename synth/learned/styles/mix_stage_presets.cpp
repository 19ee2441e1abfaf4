#include "synth/learned/styles/mix_stage_presets.h"

#include <algorithm>

#include "synth/learned/training/model_choices.h"

namespace chironomia {
namespace {

// Ours, chosen by the validation error of three seeds on 16 made speakers: .371 to .377 after 40 epochs, .379 to .383
// after 20 (docs/learned_styles.md).
constexpr std::size_t kSmallEpochs = 40;

}  // namespace

const std::vector<std::string>& mix_stage_presets() {
    static const std::vector<std::string> presets{"paper", "small"};
    return presets;
}

Json mix_stage_choices(std::string_view preset, const JsonValue& asked) {
    return chosen({{"A62", {"constant", "rising"}},
                   {"mel", {"average", "stride"}, preset == "small" ? "average" : "stride"}},
                  asked);
}

MixStageSize mix_stage_size(std::string_view preset, std::int64_t speakers) {
    if (preset == "small") return {.speakers = speakers, .clusters = 4, .divisor = 4};
    return {.speakers = speakers};
}

MelResampling mix_stage_resampling(const Json& choices) {
    return choices.at("mel") == "average" ? MelResampling::average : MelResampling::stride;
}

double MixStageTraining::adversary_weight(std::size_t step) const {
    return rise == 0 ? 1 : 1 + std::min(1.0, static_cast<double>(step) / static_cast<double>(rise));
}

double MixStageTraining::pose_share(std::size_t step) const {
    return 1 - std::min(1.0, static_cast<double>(step) / static_cast<double>(curriculum));
}

MixStageTraining mix_stage_training(std::string_view preset, const Json& choices) {
    MixStageTraining training;
    double peak = 1e-4;
    if (preset == "small") {
        training.epoch.batches = 100;
        training.epochs = kSmallEpochs;
        peak = 1e-3;
    }
    training.rate = {.kind = LearningRate::Kind::exponential,
                     .peak = peak,
                     .decay = 0.99,
                     .period = training.epoch.batches};
    if (choices.at("A62") == "rising") training.rise = 300;
    return training;
}

}  // namespace chironomia
