#include "synth/learned/styles/zs_mstm_presets.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "synth/learned/training/model_choices.h"

namespace chironomia {
namespace {

constexpr std::int64_t kSmallWidth = 64;

// Without weights of the authors: MODELS' `ast_small` of 1.0, and the narrow one of 2.0, whose 12 heads do not divide
// its width (A58).
AstSize narrow_ast(std::int64_t frames, std::int64_t depth) {
    return {.frames = frames, .width = kSmallWidth, .heads = 4, .depth = depth, .hidden = 256};
}

StyleSources sources_of(const std::string& ablation) {
    if (ablation == "pose_only") return {.speech = false, .text = false};
    if (ablation == "speech_only") return {.text = false, .pose = false};
    if (ablation == "text_only") return {.speech = false, .pose = false};
    return {};
}

ZsMstmSize small_size(std::int64_t frames) {
    return {.ast = narrow_ast(frames, 4),
            .text = kSmallWidth,
            .memory = kSmallWidth,
            .width = kSmallWidth,
            .hidden = 256,
            .adversary = 128};
}

ZsMstmSize second_size(std::int64_t frames, bool has_weights) {
    ZsMstmSize size{
        .ast = narrow_ast(frames, 12), .memory = kSmallWidth, .width = kSmallWidth, .adversary = 256};
    if (has_weights) {
        size.ast = {.frames = frames};
        size.speech = kSmallWidth;
    }
    return size;
}

// Up to `peak` in a straight line, then down with the root of the step (A56).
LearningRate warm_up_and_fall(double peak, std::size_t warm_up) {
    return {.kind = LearningRate::Kind::noam,
            .peak = peak,
            .warm_up = warm_up,
            .factor = peak * std::sqrt(static_cast<double>(warm_up)),
            .width = 1};
}

}  // namespace

const std::vector<std::string>& zs_mstm_presets(ZsMstmVersion version) {
    static const std::vector<std::string> first{"paper", "small"}, second{"paper", "small", "literal"};
    return version == ZsMstmVersion::one ? first : second;
}

Json zs_mstm_choices(std::string_view preset, const JsonValue& asked) {
    const bool is_small = preset == "small";
    return chosen({{"A24", {"class", "mean"}},
                   {"A48", {"separate", "shared"}},
                   {"A53", {"content", "both"}},
                   {"A54", {"capped", "unbounded"}},
                   {"A55", {"half", "same"}},
                   {"A56", {"falling", "constant"}},
                   {"ast", {"new", "pretrained"}},
                   {"mel", {"average", "stride"}, is_small ? "average" : "stride"},
                   {"ablation", {"none", "fader", "pose_only", "speech_only", "text_only"}}},
                  asked);
}

ZsMstmSize zs_mstm_size(ZsMstmVersion version, std::string_view preset, const Json& choices) {
    const std::int64_t frames = version == ZsMstmVersion::one ? 64 : 16;
    const bool is_small = preset == "small";
    ZsMstmSize size = is_small ? small_size(frames)
                      : version == ZsMstmVersion::one
                          ? ZsMstmSize{.ast = {.frames = frames}}
                          : second_size(frames, choices.at("ast") == "pretrained");
    size.has_face = version == ZsMstmVersion::two;
    size.shares_ast = choices.at("A48") == "shared";
    size.averages_tokens = choices.at("A24") == "mean";
    size.sources = sources_of(choices.at("ablation").get<std::string>());
    return size;
}

MelResampling zs_mstm_resampling(const Json& choices) {
    return choices.at("mel") == "average" ? MelResampling::average : MelResampling::stride;
}

ZsMstmTraining zs_mstm_training(ZsMstmVersion version, std::string_view preset, const Json& choices) {
    ZsMstmTraining training;
    if (preset == "small") {
        training.steps = version == ZsMstmVersion::one ? 6000 : 8000;
        training.epochs = std::numeric_limits<std::int32_t>::max();
        training.rate = warm_up_and_fall(1e-3, 500);
        training.lambda_step = 0.001;
        training.hop = 8;
    } else if (version == ZsMstmVersion::one) {
        training.rate = warm_up_and_fall(1e-5, 20'000);
    } else {
        training.steps = 78'400;  // section 7.4: 200 cycles of 392
        training.epochs = std::numeric_limits<std::int32_t>::max();
        training.rate = {.kind = LearningRate::Kind::triangular,
                         .peak = preset == "literal" ? 0.1 : 1e-3,
                         .base = 1e-7,
                         .half_cycle = 196};
        training.clip = 5;
        training.hop = 16;
    }
    if (choices.at("A56") == "constant") {
        if (training.rate.kind != LearningRate::Kind::noam) {
            throw Error(
                format("A56 is \"constant\", but the learning rate of ZS-MSTM 2.0 goes up and down without a "
                       "warm-up with the preset \"{}\"; leave --rate-after-warm-up out",
                       preset));
        }
        training.rate.kind = LearningRate::Kind::warm_up;
    }
    if (choices.at("A54") == "unbounded") training.lambda_most = std::numeric_limits<double>::infinity();
    if (choices.at("ablation") == "fader") training.lambda_most = 0;
    training.adversary_moves_style = choices.at("A53") == "both";
    training.same_share = choices.at("A55") == "same" ? 1 : 0.5;
    return training;
}

}  // namespace chironomia
