#include "synth/learned/dyads/amii_options.h"

#include <algorithm>

namespace chironomia {
namespace {

// Two readings of the paper; the first is ours.
bool is_first(const JsonValue& options, const char* key, const char* first, const char* second) {
    const auto value = options.find(key);
    return !value || value->choice({first, second}) == first;
}

std::size_t count(const JsonValue& options, const char* key, std::size_t otherwise, long long least) {
    const auto value = options.find(key);
    return value ? static_cast<std::size_t>(value->integer(least, 1'000'000)) : otherwise;
}

double number(const JsonValue& options, const char* key, double otherwise, double most) {
    const auto value = options.find(key);
    return value ? value->number(0, most) : otherwise;
}

// "residual" also has tanh.
std::string activation_of(const AmiiParts& parts) {
    if (parts.residual) return "residual";
    return parts.tanh ? "tanh" : "linear";
}

}  // namespace

AmiiParts amii_parts(const std::string& preset, const JsonValue& options) {
    AmiiParts parts{.shared = is_first(options, "A08", "shared", "separate"),
                    .joint = is_first(options, "A25", "joint", "per_person"),
                    .residual = preset == "small",
                    .sequence = is_first(options, "A27", "sequence", "last")};
    if (const auto activation = options.find("A26")) {
        const std::string reading = activation->choice({"tanh", "linear", "residual"});
        parts.tanh = reading != "linear";
        parts.residual = reading == "residual";
    }
    if (const auto ablation = options.find("ablation"))
        parts.ablation = ablation->choice({"none", "noE_m", "noE_dual", "noE_inter"});
    return parts;
}

Json to_json(const AmiiParts& parts) {
    return {{"ablation", parts.ablation},
            {"A08", parts.shared ? "shared" : "separate"},
            {"A25", parts.joint ? "joint" : "per_person"},
            {"A26", activation_of(parts)},
            {"A27", parts.sequence ? "sequence" : "last"}};
}

DyadTraining dyad_training(const std::string& preset, const JsonValue& options) {
    DyadTraining training;
    if (preset == "small") {
        // Free runs of a minute are long enough to drift. A model that is trained on its own drift learns to
        // correct it.
        training = {.stride = 5,
                    .batch = 16,
                    .epochs = 8,
                    .peak = 2e-3,
                    .cycle = 4,
                    .own_past = 0.5,
                    .own_seconds = 60,
                    .own_from = 2};
    }
    training.stride = count(options, "stride", training.stride, 1);
    training.batch = count(options, "batch", training.batch, 2);
    training.epochs = count(options, "epochs", training.epochs, 1);
    training.peak = number(options, "peak", training.peak, 10);
    training.base = number(options, "base", training.base, 10);
    training.cycle = count(options, "cycle", training.cycle, 1);
    training.patience = count(options, "patience", training.patience, 0);
    training.clip = number(options, "clip", training.clip, 1e9);
    training.own_past = number(options, "own_past", training.own_past, 1);
    if (const auto seconds = options.find("own_seconds")) training.own_seconds = seconds->number(0.04, 3600);
    training.own_from = count(options, "own_from", training.own_from, 0);
    return training;
}

Json to_json(const DyadTraining& training) {
    return {{"stride", training.stride},
            {"batch", training.batch},
            {"peak", training.peak},
            {"base", training.base},
            {"cycle", training.cycle},
            {"patience", training.patience},
            {"clip", training.clip},
            {"own_past", training.own_past},
            {"own_seconds", training.own_seconds},
            {"own_from", training.own_from}};
}

}  // namespace chironomia
