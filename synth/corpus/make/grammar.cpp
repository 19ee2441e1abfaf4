// Reads the grammar's files.
#include <algorithm>
#include <filesystem>

#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "synth/corpus/make/text.h"
#include "synth/markup/functions.h"
#include "synth/text/dialog_acts.h"

namespace chironomia {
namespace {

const std::vector<std::string> kTopicClasses = {"thing", "person", "place", "act", "quality", "idea"};
const std::vector<std::string> kVerbs = {"act", "think", "know", "do", "change"};  // of all classes
constexpr std::string_view kVowels = "aeiou";

bool ends_in_consonant_and(const std::string& word, char last) {
    return word.size() > 1 && word.back() == last &&
           kVowels.find(word[word.size() - 2]) == std::string_view::npos;
}

// "watches", "carries", "days".
std::string with_s(const std::string& word) {
    if (ends_in_consonant_and(word, 'y')) return word.substr(0, word.size() - 1) + "ies";
    for (const std::string_view hiss : {"s", "x", "z", "ch", "sh"})
        if (word.ends_with(hiss)) return word + "es";
    if (word == "go" || word == "do") return word + "es";
    return word + "s";
}

std::string with_ed(const std::string& word, bool doubles) {
    if (ends_in_consonant_and(word, 'y')) return word.substr(0, word.size() - 1) + "ied";
    if (word.back() == 'e') return word + "d";
    return doubles ? word + word.back() + "ed" : word + "ed";
}

std::string with_ing(const std::string& word, bool doubles) {
    const bool drops_e = word.back() == 'e' && !word.ends_with("ee") && !word.ends_with("ye");
    if (drops_e) return word.substr(0, word.size() - 1) + "ing";
    return doubles ? word + word.back() + "ing" : word + "ing";
}

// "focus on": the verb changes, not what goes with it.
GrammarWord verb_of(std::string_view written) {
    const std::vector<std::string_view> forms = split(written, '/');
    std::string base(forms[0]);
    const std::size_t plus = base.find('+');
    const bool doubles = plus != std::string::npos;
    if (doubles) base.erase(plus, 1);
    const std::size_t space = base.find(' ');
    const std::string first = base.substr(0, space);
    const std::string rest = space == std::string::npos ? "" : base.substr(space);
    GrammarWord verb{.base = base, .plural = with_s(first) + rest, .past = {}, .participle = {}, .ing = {}};
    verb.past = forms.size() > 1 ? std::string(forms[1]) : with_ed(first, doubles) + rest;
    verb.participle = forms.size() > 2 ? std::string(forms[2]) : verb.past;
    verb.ing = with_ing(first, doubles) + rest;
    return verb;
}

GrammarWord noun_of(std::string_view written) {
    const std::vector<std::string_view> forms = split(written, '/');
    std::string base(forms[0]);
    std::string plural = forms.size() > 1 ? std::string(forms[1]) : with_s(base);
    return {.base = std::move(base), .plural = std::move(plural), .past = {}, .participle = {}, .ing = {}};
}

// "star, planet, black hole"
std::vector<GrammarWord> words_in(const JsonValue& value, bool are_verbs) {
    std::vector<GrammarWord> words;
    const std::string listed = value.text();
    for (const std::string_view written : split(listed, ',')) {
        const std::string_view word = trim(written);
        if (word.empty() || word.front() == '/')
            value.refuse(format("is {}; there is nothing between two commas", value.shown()));
        words.push_back(are_verbs ? verb_of(word) : noun_of(word));
    }
    return words;
}

bool are_verbs(const std::string& name) {
    return std::find(kVerbs.begin(), kVerbs.end(), name) != kVerbs.end();
}

// "world=size-big"
void read_mark(const JsonValue& value, WordClass& read) {
    const std::string written = value.text();
    const std::vector<std::string_view> parts = split(written, '=');
    const FunctionKind* kind = function_of_element(parts[0]);
    if (!kind || parts.size() != 2 || known_value(*kind, parts[1]) != parts[1])
        value.refuse(
            format("is {}, a function of docs/markup.md is needed, such as world=size-big", value.shown()));
    read.mark = kind->kind;
    read.value = parts[1];
}

void read_classes(const Json& json, const std::string& file, Grammar& grammar) {
    for (const auto& [name, entry] : json.items()) {
        if (name == "$comment") continue;
        const JsonValue value = JsonValue(json, file).at(name);
        value.allow_only({"mark", "weight", "words"});
        WordClass read{.words = words_in(value.at("words"), are_verbs(name)), .mark = {}, .value = {}};
        if (const auto mark = value.find("mark")) read_mark(*mark, read);
        if (const auto weight = value.find("weight")) read.weight = weight->number(0, 1);
        grammar.classes.emplace(name, std::move(read));
    }
}

void read_topics(const Json& json, const std::string& file, Grammar& grammar) {
    for (const auto& [name, entry] : json.items()) {
        if (name == "$comment") continue;
        const JsonValue value = JsonValue(json, file).at(name);
        std::vector<std::string> keys = kTopicClasses;
        keys.push_back("genres");
        value.allow_only(keys);
        for (const std::string& key : kTopicClasses)
            grammar.topics[name][key] = {
                .words = words_in(value.at(key), are_verbs(key)), .mark = {}, .value = {}};
        const std::string listed = value.at("genres").text();
        for (const std::string_view genre : split(listed, ','))
            grammar.topics_of[std::string(trim(genre))].push_back(name);
    }
}

// Every slot of a template has a class and a form that there is.
void check_slots(const JsonValue& value, const std::string& text, const Grammar& grammar) {
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
        const std::size_t end = text.find('}', at);
        if (end == std::string::npos) value.refuse(format("has a {{ without a }}: {}", value.shown()));
        const std::string inside = text.substr(at + 1, end - at - 1);
        const std::string name = inside.substr(0, inside.find_first_of(".#"));
        const bool is_known =
            grammar.classes.contains(name) ||
            std::find(kTopicClasses.begin(), kTopicClasses.end(), name) != kTopicClasses.end();
        if (!is_known)
            value.refuse(format("has the slot {{{}}}, but there is no class \"{}\"", inside, name));
    }
}

void read_sentences(const std::filesystem::path& file, Grammar& grammar) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.allow_only({"$comment", "sentences"});
    const std::vector<std::string> acts(kDialogActNames.begin(), kDialogActNames.end());
    for (const JsonValue& group : whole.at("sentences").items(1)) {
        group.allow_only({"tag", "act", "weight", "say"});
        for (const JsonValue& text : group.at("say").items(1)) {
            Template read{
                .text = text.text(),
                .genre = file.stem().string(),
                .dialog_act = group.at("tag").choice(acts),
                .performative = group.at("act").choice(values_of(function_kind(MarkKind::performative))),
                .weight = {}};
            if (const auto weight = group.find("weight")) read.weight = weight->number(0, 1);
            check_slots(text, read.text, grammar);
            grammar.templates.push_back(std::move(read));
        }
    }
}

}  // namespace

const std::vector<std::string>& genres() {
    static const std::vector<std::string> names = {"lecture", "host", "tutorial", "sermon"};
    return names;
}

Grammar read_grammar(const std::filesystem::path& folder) {
    Grammar grammar;
    const auto read = [&](const char* name, auto&& reader) {
        const std::filesystem::path file = folder / name;
        const Json json = read_json(file);
        reader(json, file.string(), grammar);
    };
    read("classes.json", read_classes);
    read("topics.json", read_topics);
    read_sentences(folder / "common.json", grammar);
    for (const std::string& genre : genres()) read_sentences(folder / (genre + ".json"), grammar);
    return grammar;
}

const Grammar& bundled_grammar() {
    static const Grammar grammar = read_grammar(find_asset("synth/corpus/grammar/common.json").parent_path());
    return grammar;
}

}  // namespace chironomia
