#include "synth/learned/training/model_choices.h"

namespace chironomia {
namespace {

// Of an option whose value looks like a number, the command line makes one.
std::string one_of(const std::vector<std::string>& values, const JsonValue& asked) {
    if (!asked.json().is_number()) return asked.choice(values);
    const Json text = asked.json().dump();
    return JsonValue(text, "job").called(asked.key()).choice(values);
}

}  // namespace

Json chosen(const std::vector<ModelChoice>& choices, const JsonValue& asked) {
    std::vector<std::string> keys;
    Json all = Json::object();
    for (const ModelChoice& choice : choices) {
        const auto value = asked.find(choice.key);
        keys.push_back(choice.key);
        all[choice.key] = value ? one_of(choice.values, *value) : choice.usual;
    }
    asked.allow_only(keys);
    return all;
}

}  // namespace chironomia
