#include "study/plan/presets.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

std::vector<Preset> read_presets() {
    std::vector<Preset> all;
    const fs::path folder = find_asset("study/presets/README.md").parent_path();
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        const Json json = read_json(entry.path());
        all.push_back({.name = entry.path().stem().string(),
                       .source = json.at("source"),
                       .protocol = json.at("protocol"),
                       .plan = json.at("plan")});
    }
    std::sort(all.begin(), all.end(), [](const Preset& a, const Preset& b) { return a.name < b.name; });
    return all;
}

// The keys of `over` win; objects are merged.
void merge(Json& under, const Json& over) {
    for (const auto& [key, value] : over.items()) {
        if (value.is_object() && under.contains(key) && under[key].is_object()) {
            merge(under[key], value);
        } else {
            under[key] = value;
        }
    }
}

// One text, or a list of paragraphs.
void add_paragraphs(const Json& text, std::set<std::string, std::less<>>& texts) {
    if (text.is_string()) texts.insert(text.get<std::string>());
    if (!text.is_array()) return;
    for (const Json& paragraph : text) texts.insert(paragraph.get<std::string>());
}

// Title, instructions, training and the texts of questions.
void add_sentences(const Json& plan, std::set<std::string, std::less<>>& texts) {
    for (const char* key : {"title", "instructions", "training"})
        add_paragraphs(plan.value(key, Json()), texts);
    for (const Json& question : plan.value("questions", Json::array()))
        add_paragraphs(question.at("text"), texts);
    for (const Json& translation : plan.value("in_language", Json::object()))
        add_sentences(translation, texts);
}

// Throws Error where a participant would read English, by a preset, in a study of another language.
void require_translated(const JsonValue& plan, const JsonValue& language, const Json& preset,
                        const Json& translation) {
    std::vector<std::string> lacking;
    for (const char* key :
         {"title", "instructions", "training", "consent", "questions", "questionnaire", "texts"}) {
        if (preset.contains(key) && !translation.contains(key) && !plan.find(key))
            lacking.push_back(format("\"{}\"", key));
    }
    if (lacking.empty()) return;
    language.refuse(format("is {}, and the preset has {} in English alone; write the plan's own",
                           language.shown(), join(lacking)));
}

// Throws Error where the study is about the person on the right, and texts of the preset speak of the one on the left.
void require_texts_of_side(const JsonValue& plan, const Json& preset) {
    const auto render = plan.find("render");
    const auto side = render && render->json().is_object() ? render->find("partner_side") : std::nullopt;
    if (!side || side->json() != Json("left")) return;
    for (const char* key : {"instructions", "questions"}) {
        const bool speaks_of_left = preset.value(key, Json()).dump().find("on the left") != std::string::npos;
        if (speaks_of_left && !plan.find(key))
            side->refuse(
                format("is \"left\", so the study is about the person on the right, and the preset's {} "
                       "speak of the one on the left; write the plan's own",
                       key));
    }
}

std::set<std::string, std::less<>> sentences_of_presets() {
    std::set<std::string, std::less<>> texts;
    for (const Preset& preset : presets()) add_sentences(preset.plan, texts);
    return texts;
}

}  // namespace

const std::vector<Preset>& presets() {
    static const std::vector<Preset> all = read_presets();
    return all;
}

std::string numbers_of(const Preset& preset) {
    std::vector<std::string> parts;
    for (const auto& [name, value] : preset.protocol.items()) {
        std::string words = name;
        std::replace(words.begin(), words.end(), '_', ' ');
        parts.push_back(format("{} {}", words, value.is_string() ? value.get<std::string>() : value.dump()));
    }
    return parts.empty() ? "not reported" : join(parts);
}

bool is_text_of_a_preset(std::string_view text) {
    static const std::set<std::string, std::less<>> texts = sentences_of_presets();
    return texts.find(text) != texts.end();
}

Json with_preset(const Json& plan, const std::string& file) {
    const JsonValue whole(plan, file);
    const auto named = whole.find("preset");
    if (!named) return plan;
    std::vector<std::string> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    const std::string name = named->choice(names);
    Json merged = std::find_if(presets().begin(), presets().end(), [&](const Preset& each) {
                      return each.name == name;
                  })->plan;
    // The same in other languages, by their names.
    const Json translations = merged.value("in_language", Json::object());
    merged.erase("in_language");
    if (const auto language = whole.find("language"); language && !language->text().starts_with("en")) {
        const Json translation = translations.value(language->text(), Json::object());
        require_translated(whole, *language, merged, translation);
        merge(merged, translation);
    }
    require_texts_of_side(whole, merged);
    merge(merged, plan);
    return merged;
}

}  // namespace chironomia::study
