// What the verbs are made of: a verb with examples, and kinds of options.
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "study/cli/options/option_values.h"

namespace chironomia::study {

inline CLI::App* add_verb(CLI::App& app, const std::string& name, const std::string& what,
                          const std::string& examples) {
    CLI::App* verb = app.add_subcommand(name, what);
    verb->footer("Examples:\n" + examples);
    return verb;
}

// The names of the options in one group of the verb's help.
inline std::vector<std::string> options_in(const CLI::App& verb, const std::string& group) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb.get_options()) {
        if (option->get_group() == group) names.push_back(option->get_name());
    }
    return names;
}

// An option whose text `read` understands; an Error of `read` becomes a message about the option.
template <typename Read>
CLI::Option* add_read_option(CLI::App& verb, const std::string& name, Read read, const std::string& help) {
    const auto read_or_complain = [name, read](const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            throw CLI::ValidationError(name, error.what());
        }
    };
    return verb.add_option_function<std::string>(name, read_or_complain, help);
}

template <typename Value>
std::vector<std::string> keys_of(const std::map<std::string, Value>& words) {
    std::vector<std::string> names;
    for (const auto& [word, meaning] : words) names.push_back(word);
    return names;
}

// What one of a few words means. Throws Error that names them for any other.
template <typename Value>
Value meaning_of(const std::string& text, const std::map<std::string, Value>& words) {
    const auto found = words.find(text);
    if (found == words.end()) throw Error(format("\"{}\" is none of {}", text, join(keys_of(words))));
    return found->second;
}

// An option that takes one of a few words. Its help is what the caller gives as its description().
template <typename Value>
CLI::Option* add_choice(CLI::App& verb, const std::string& name, Value& value,
                        const std::map<std::string, Value>& words) {
    const auto read = [&value, words](const std::string& text) { value = meaning_of(text, words); };
    return add_read_option(verb, name, read, "")->type_name(join(keys_of(words), "|"));
}

inline CLI::Option* add_seed(CLI::App& verb, std::uint64_t& seed, const std::string& help) {
    const auto read = [&seed](const std::string& text) { seed = parse_seed(text); };
    return add_read_option(verb, "--seed", read, help)->type_name("N");
}

// --shard: one part of the work. `take` receives it, `help` says what is divided.
template <typename Take>
CLI::Option* add_shard(CLI::App& verb, Take take, const std::string& help) {
    const auto read = [take](const std::string& text) { take(parse_shard(text)); };
    return add_read_option(verb, "--shard", read, help)->type_name("PART/PARTS");
}

}  // namespace chironomia::study
