#include "synth/learned/training/training_state.h"

#include <string>

#include "core/files/json_value.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLast = "last/";
constexpr const char* kBest = "best/";
constexpr const char* kMade = "made/";
constexpr const char* kOptimiser = "optimiser/";

void add_with_prefix(Tensors& all, const std::string& prefix, const Tensors& tensors) {
    for (const auto& [name, tensor] : tensors) all[prefix + name] = tensor;
}

Tensors with_prefix(const Tensors& all, const std::string& prefix) {
    Tensors found;
    for (const auto& [name, tensor] : all)
        if (name.starts_with(prefix)) found[name.substr(prefix.size())] = tensor;
    return found;
}

std::size_t count_at(const JsonValue& json, std::string_view key) {
    return static_cast<std::size_t>(json.at(key).integer(0, std::numeric_limits<long long>::max()));
}

double number_at(const JsonValue& json, std::string_view key) {
    constexpr double kMost = std::numeric_limits<double>::max();
    return json.at(key).number(-kMost, kMost);
}

}  // namespace

Tensors to_tensors(const TrainingState& state, const torch::nn::Module& model, const Optimiser& optimiser) {
    Tensors all;
    add_with_prefix(all, kLast, weights_of(model));
    add_with_prefix(all, kBest, state.best_weights);
    add_with_prefix(all, kMade, state.made);
    add_with_prefix(all, kOptimiser, optimiser.state());
    return all;
}

Json to_json(const TrainingState& state) {
    Json json{{"epoch", state.epoch},           {"batch", state.batch}, {"loss_sum", state.loss_sum},
              {"loss_count", state.loss_count}, {"stale", state.stale}, {"points", state.curve.size()}};
    if (!state.curve.empty()) json["best"] = state.best;
    return json;
}

TrainingState training_state(const StoredCheckpoint& checkpoint, torch::nn::Module& model,
                             Optimiser& optimiser, const fs::path& file) {
    const JsonValue json = JsonValue(checkpoint.description.training, file.string()).at("state");
    TrainingState state{.step = checkpoint.description.step,
                        .epoch = count_at(json, "epoch"),
                        .batch = count_at(json, "batch"),
                        .loss_sum = number_at(json, "loss_sum"),
                        .loss_count = count_at(json, "loss_count"),
                        .stale = count_at(json, "stale"),
                        .best_weights = with_prefix(checkpoint.resume, kBest),
                        .curve = checkpoint.description.curve,
                        .made = with_prefix(checkpoint.resume, kMade)};
    const std::size_t points = count_at(json, "points");
    if (points > state.curve.size())
        json.refuse(format("names {} points, the curve has {}", points, state.curve.size()));
    state.curve.resize(points);
    if (points > 0) state.best = number_at(json, "best");
    set_weights(model, with_prefix(checkpoint.resume, kLast), file);
    optimiser.restore(with_prefix(checkpoint.resume, kOptimiser), file);
    return state;
}

}  // namespace chironomia
