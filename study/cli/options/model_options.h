// Options of learned models, which each model knows by names of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/files/json.h"

namespace CLI {
class App;
}

namespace chironomia::study {

using ModelOptions = std::map<std::string, Json>;

// true, false and numbers as such, anything else as text.
Json option_value(const std::string& text);

// "ablate=text", or a reading by its name, "output-layer=joint"; nothing if there is no name or no value.
std::optional<std::pair<std::string, Json>> model_option(const std::string& text);

// A choice that a paper leaves open. Each model knows which of them it has.
struct Reading {
    std::string name;    // "output-layer", an option of the command line
    std::string key;     // "A25", in checkpoints: its number in docs/learning.md
    std::string values;  // "joint|per_person"
    std::string help;
};
const std::vector<Reading>& readings();

// What the helper refuses of a job, in the words of the command line: "--option stride" for "job: options.stride",
// and readings by their names.
std::string in_options(std::string message);

// --threads, and --option with one option for each reading.
void add_threads(CLI::App& verb, int& threads);
void add_model_options(CLI::App& verb, ModelOptions& options);

}  // namespace chironomia::study
