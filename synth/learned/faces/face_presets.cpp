#include "synth/learned/faces/face_presets.h"

#include "core/text.h"
#include "synth/learned/training/model_choices.h"

namespace chironomia {

const std::vector<std::string>& model1_presets() {
    static const std::vector<std::string> names{"paper", "small"};
    return names;
}

const std::vector<std::string>& model2_presets() {
    static const std::vector<std::string> names{"paper", "small", "m2_2051133"};
    return names;
}

Json model1_choices(const JsonValue& asked) {
    return chosen({{"A34", {"direction", "total"}}, {"A35", {"one", "nine"}}, {"A38", {"words", "units"}}},
                  asked);
}

Json model2_choices(std::string_view preset, const JsonValue& asked) {
    const auto usual = [&](const char* of_thesis, const char* of_small) {
        return std::string(preset == "small" ? of_small : of_thesis);
    };
    return chosen({{"A38", {"words", "units"}},
                   {"A40", {"tokens", "values", "relative", "rise"}, usual("tokens", "relative")},
                   {"A41", {"layer", "equation"}},
                   {"A42", {"attended", "speech"}},
                   {"A45", {"words", "frames"}},
                   {"ablation", {"none", "speech", "text", "A", "D1"}},
                   {"attention", {"everywhere", "near"}, usual("everywhere", "near")},
                   {"inputs", {"plain", "level"}, usual("plain", "level")},
                   {"feedback", {"argmax", "expected"}, usual("argmax", "expected")},
                   {"forgotten", {"0", "0.25", "0.5", "1"}, usual("0", "1")},
                   {"unplaced", {"0", "0.5"}, usual("0", "0.5")},
                   {"unread", {"0", "0.25", "0.5"}, usual("0", "0.25")}},
                  asked);
}

Model1Options model1_options(std::string_view preset, const Json& choices) {
    Model1Options options;
    options.per_direction = choices.at("A34") == "direction";
    options.nine_autoencoders = choices.at("A35") == "nine";
    if (preset == "small") {
        options.hidden = 32;
        options.shared_trunk = !options.nine_autoencoders;
        options.most_frames = 48;
    }
    return options;
}

Model2Options model2_options(std::string_view preset, const Json& choices) {
    Model2Options options;
    const auto number = [&](const char* key) { return *parse_number(choices.at(key).get<std::string>()); };
    const std::string pitch = choices.at("A40").get<std::string>();
    options.pitch = pitch == "tokens"     ? Model2Options::Pitch::tokens
                    : pitch == "values"   ? Model2Options::Pitch::values
                    : pitch == "relative" ? Model2Options::Pitch::relative
                                          : Model2Options::Pitch::rise;
    options.near = choices.at("attention") == "near";
    options.level_inputs = choices.at("inputs") == "level";
    options.expected_feedback = choices.at("feedback") == "expected";
    options.forgotten = number("forgotten");
    options.unplaced = number("unplaced");
    options.unread = number("unread");
    options.attention_layer = choices.at("A41") == "layer";
    options.by_frames = choices.at("A45") == "frames";
    options.attended_memory = choices.at("A42") == "attended";
    if (preset == "small") {
        options.width = 32;
        options.heads = 2;
        options.hidden = 64;
        options.encoder_layers = 2;
        options.decoder_layers = 1;
        options.dropout = 0.2;
    } else if (preset == "m2_2051133") {
        options.counted = true;
        options.decoder_layers = 2;
        options.levels = face_levels(100, 151);
    }
    ablate(options, choices.at("ablation").get<std::string>());
    return options;
}

void ablate(Model2Options& options, std::string_view part) {
    options.with_speech = part != "speech";
    options.with_text = part != "text";
    options.with_cross = part != "A";
    options.with_frames = part != "D1";
}

Model1Training model1_training(std::string_view preset) {
    if (preset == "small") {
        return {.speech = {.epochs = 40, .batch = 128},
                .face = {.epochs = 6, .batch = 128},
                .model = {.epochs = 40}};
    }
    return {.speech = {.epochs = 500, .batch = 10},
            .face = {.epochs = 300, .batch = 128},
            .model = {.epochs = 300}};
}

}  // namespace chironomia
