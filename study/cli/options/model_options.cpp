#include "study/cli/options/model_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "core/text.h"

namespace chironomia::study {

Json option_value(const std::string& text) {
    if (text == "true" || text == "false") return text == "true";
    if (const auto whole = parse_integer(text)) return *whole;
    if (const auto number = parse_number(text)) return *number;
    return text;
}

std::optional<std::pair<std::string, Json>> model_option(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) return std::nullopt;
    std::string key = text.substr(0, equals);
    const auto reading = std::ranges::find(readings(), key, &Reading::name);
    if (reading != readings().end()) key = reading->key;
    return std::pair(std::move(key), option_value(text.substr(equals + 1)));
}

const std::vector<Reading>& readings() {
    static const std::vector<Reading> all = {
        {"ast-token", "A24", "class|mean",
         "zs-mstm: AST's vector is its class token, or the mean of its two tokens"},
        {"encoder-sharing", "A08", "shared|separate",
         "amii: one intra-personal encoder for both people, or one each"},
        {"output-layer", "A25", "joint|per_person",
         "amii: one dense layer for both faces, or one for each person"},
        {"encoder-activation", "A26", "tanh|linear|residual",
         "amii: activation of the dense layers of its encoders"},
        {"encoder-output", "A27", "sequence|last", "amii: all states of a memory, or the last"},
        {"lstm-units", "A34", "direction|total", "model1: units of an LSTM for each direction, or in total"},
        {"autoencoders", "A35", "one|nine", "model1: one auto-encoder of faces, or one for each channel"},
        {"batch-of", "A38", "words|units", "model1, model2: a batch has 128 words, or 128 units"},
        {"decoding", "A39", "argmax|expectation",
         "model1, model2: the likeliest value of each channel, or its expected value"},
        {"pitch-input", "A40", "tokens|values|relative|rise", "model2: how the pitch is represented"},
        {"cross-attention", "A41", "layer|equation",
         "model2: a decoder layer, or equation (5.12) as printed"},
        {"decoder-memory", "A42", "attended|speech",
         "model2: decoders attend to the words after cross-attention, or to the speech encoder's output"},
        {"sequence-of", "A45", "words|frames", "model2: what its sequences consist of"},
        {"ast-sharing", "A48", "separate|shared", "zs-mstm: one AST each for content and style, or one"},
        {"fader-gradient", "A53", "content|both",
         "zs-mstm: the adversary changes the content's encoder, or the style's too"},
        {"fader-limit", "A54", "capped|unbounded", "zs-mstm: the adversary's weight stays at 1, or grows on"},
        {"style-segment", "A55", "half|same", "zs-mstm: half of the styles are of another segment, or none"},
        {"rate-after-warm-up", "A56", "falling|constant", "zs-mstm: the learning rate after its warm-up"},
        {"adversary-weight", "A62", "constant|rising",
         "mix-stage: the discriminator's part of the losses stays, or doubles at first"},
    };
    return all;
}

std::string in_options(std::string message) {
    const auto replace = [&](const std::string& part, const std::string& by) {
        for (std::size_t at = 0; (at = message.find(part, at)) != std::string::npos; at += by.size())
            message.replace(at, part.size(), by);
    };
    replace("job: preset:", "--preset:");
    for (const Reading& reading : readings()) {
        replace("job: options." + reading.key + ":", "--" + reading.name + ":");
        replace("\"" + reading.key + "\"", "\"" + reading.name + "\"");
    }
    replace("job: options.", "--option ");
    return message;
}

void add_threads(CLI::App& verb, int& threads) {
    verb.add_option("--threads", threads, "Threads that compute [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
}

void add_model_options(CLI::App& verb, ModelOptions& options) {
    const auto read = [&options](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            const auto option = model_option(text);
            if (!option) throw CLI::ValidationError("--option", format("\"{}\" is no KEY=VALUE", text));
            options[option->first] = option->second;
        }
    };
    verb.add_option_function<std::vector<std::string>>(
            "--option", read, "An option of the model, by its name (docs/learning.md)")
        ->type_name("KEY=VALUE");
    for (const Reading& reading : readings()) {
        verb.add_option_function<std::string>(
                "--" + reading.name,
                [&options, key = reading.key](const std::string& text) { options[key] = option_value(text); },
                reading.help)
            ->type_name(reading.values)
            ->group("Readings of the papers, of those models that have them (docs/learning.md)");
    }
}

}  // namespace chironomia::study
