#include "synth/learned/training/checkpoint_json.h"

#include <limits>

#include "core/text.h"
#include "core/version.h"

namespace chironomia {
namespace {

constexpr const char* kFormat = "chironomia checkpoint 1";

Json json_of(const std::vector<Feature>& features) {
    Json list = Json::array();
    for (const Feature& f : features) list.push_back({{"name", f.name}, {"low", f.low}, {"high", f.high}});
    return list;
}

std::vector<Feature> features_in(const JsonValue& list) {
    constexpr double kMost = std::numeric_limits<double>::max();
    std::vector<Feature> features;
    for (const JsonValue& entry : list.items(0)) {
        entry.allow_only({"name", "low", "high"});
        features.push_back({.name = entry.at("name").text(),
                            .low = entry.at("low").number(-kMost, kMost),
                            .high = entry.at("high").number(-kMost, kMost)});
        if (features.back().high <= features.back().low)
            entry.refuse(format("has the range {} to {}, which is none; train again", features.back().low,
                                features.back().high));
    }
    return features;
}

std::vector<CurvePoint> curve_in(const JsonValue& list) {
    constexpr double kMost = std::numeric_limits<double>::max();
    std::vector<CurvePoint> curve;
    for (const JsonValue& entry : list.items(0)) {
        const std::vector<JsonValue> numbers = entry.items(3);
        curve.push_back({.step = static_cast<std::size_t>(
                             numbers[0].integer(0, std::numeric_limits<std::int64_t>::max())),
                         .train = numbers[1].number(-kMost, kMost),
                         .validation = numbers[2].number(-kMost, kMost)});
    }
    return curve;
}

std::string plain_text(const JsonValue& value) {
    if (!value.json().is_string()) value.refuse(format("is {}, a text is needed", value.shown()));
    return value.json().get<std::string>();
}

const Json& object_in(const JsonValue& value) {
    if (!value.json().is_object())
        value.refuse(format("is {}, an object in curly brackets is needed", value.shown()));
    return value.json();
}

}  // namespace

Json json_of(const Checkpoint& checkpoint) {
    Json curve = Json::array();
    for (const CurvePoint& p : checkpoint.curve)
        curve.push_back(Json::array({p.step, p.train, p.validation}));
    return {{"format", kFormat},
            {"model", checkpoint.model},
            {"preset", checkpoint.preset},
            {"options", checkpoint.options},
            {"text_encoder", checkpoint.text_encoder},
            {"inputs", json_of(checkpoint.inputs)},
            {"outputs", json_of(checkpoint.outputs)},
            {"seed", checkpoint.seed},
            {"step", checkpoint.step},
            {"training", checkpoint.training},
            {"curve", std::move(curve)},
            {"version", std::string(program_version())}};
}

Checkpoint checkpoint_of(const JsonValue& json) {
    constexpr long long kMost = std::numeric_limits<long long>::max();
    if (plain_text(json.at("format")) != kFormat)
        json.at("format").refuse(format("is {}, this program reads \"{}\"; train again with this version",
                                        json.at("format").shown(), kFormat));
    return {.model = json.at("model").text(),
            .preset = json.at("preset").text(),
            .options = object_in(json.at("options")),
            .text_encoder = plain_text(json.at("text_encoder")),
            .inputs = features_in(json.at("inputs")),
            .outputs = features_in(json.at("outputs")),
            .seed = static_cast<std::uint64_t>(json.at("seed").integer(0, kMost)),
            .step = static_cast<std::size_t>(json.at("step").integer(0, kMost)),
            .training = object_in(json.at("training")),
            .curve = curve_in(json.at("curve")),
            .version = plain_text(json.at("version"))};
}

}  // namespace chironomia
