#include "study/plan/plan.h"

#include <algorithm>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "study/plan/default_texts.h"
#include "study/plan/parts.h"
#include "study/plan/presets.h"
#include "study/plan/secret_names.h"
#include "synth/markup/letters.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

std::string read_language(const JsonValue& value) {
    const std::string language = value.text();
    const bool plain = std::all_of(language.begin(), language.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
    });
    if (!plain || language.size() < 2)
        value.refuse(format("is {}, a language tag such as \"en\" or \"pt-BR\" is needed", value.shown()));
    return language;
}

// What the program cannot say in that language.
void require_texts_of_language(const JsonValue& whole, const std::string& language) {
    if (is_bundled(language)) return;
    const bool asks = whole.find("questions") || (whole.find("question") && whole.find("answers"));
    for (const auto& [key, there] : {std::pair{"questions", asks},
                                     {"instructions", whole.find("instructions").has_value()},
                                     {"texts", whole.find("texts").has_value()}}) {
        if (there) continue;
        whole.at("language")
            .refuse(format("is \"{}\", and the program's own texts are in {} alone; write \"{}\" too",
                           language, join(bundled_languages(), " and "), key));
    }
}

}  // namespace

const std::vector<std::string>& keys_of(std::string_view object) {
    const auto& all = plan_keys();
    return std::find_if(all.begin(), all.end(), [&](const PlanKeys& each) { return each.object == object; })
        ->keys;
}

// The path below a folder whose names are these letter by letter, even where one writes an accent as a letter of its
// own, as file systems of Apple do; as it is written if there is none. The folder itself may not be there yet.
fs::path find_path(const fs::path& folder, const fs::path& written) {
    fs::path found = folder.empty() || fs::exists(folder) ? folder : fs::absolute(folder);
    for (const fs::path& name : written) {
        const bool leaves_new_folder = name == ".." && !found.empty() && !fs::exists(found);
        fs::path next = leaves_new_folder ? found.parent_path() : found / name;
        if (std::error_code ignored; !fs::exists(next)) {
            const std::string wanted = composed(name.string());
            for (const auto& entry : fs::directory_iterator(found.empty() ? "." : found, ignored)) {
                if (composed(entry.path().filename().string()) == wanted) next = entry.path();
            }
        }
        found = std::move(next);
    }
    return found;
}

fs::path read_path(const JsonValue& value, const fs::path& folder) {
    const fs::path written = value.text();
    const fs::path file = find_path(folder, written);
    if (fs::is_directory(file)) {
        value.refuse(format("\"{}\" is a folder, a file is needed; name a file in it", written.string()));
    }
    if (!fs::is_regular_file(file)) {
        value.refuse(
            format("there is no file \"{}\" (looked for {}); check the path, it is taken relative to the "
                   "plan",
                   written.string(), file.string()));
    }
    return file;
}

fs::path read_path_or_name(const JsonValue& value, const fs::path& folder,
                           const std::vector<std::string>& names) {
    const fs::path written = value.text();
    if (written.has_extension()) return read_path(value, folder);
    return value.choice(names);
}

std::string read_speaker_name(const JsonValue& value, const Plan& plan,
                              const std::vector<std::string>& names) {
    const fs::path speaker = read_path_or_name(value, plan.file.parent_path(), names);
    if (speaker.has_extension()) read_speaker(speaker);
    return speaker.string();
}

const std::vector<PlanKeys>& plan_keys() {
    static const std::vector<PlanKeys> keys = {
        {.object = "",
         .keys = {"$schema",
                  "preset",
                  "from_preset",
                  "title",
                  "language",
                  "layout",
                  "presentation",
                  "conditions",
                  "reference",
                  "compare",
                  "sides",
                  "mismatched",
                  "length_tolerance",
                  "instructions",
                  "consent",
                  "training",
                  "sound_check",
                  "question",
                  "answers",
                  "questions",
                  "scales",
                  "right_answers",
                  "passes",
                  "shuffle_questions",
                  "skip_after",
                  "questionnaire",
                  "texts",
                  "checks",
                  "exclusions",
                  "participants",
                  "blocks",
                  "each_clip_once",
                  "pages_per_participant",
                  "orders",
                  "completion",
                  "preregistration",
                  "silent",
                  "render",
                  "hints",
                  "modes",
                  "clips"},
         .required = {"title", "layout", "conditions", "clips"}},
        {.object = "conditions[]",
         .keys = {"name", "from", "by", "ms", "factor", "degrees", "manner", "style_of", "engine",
                  "checkpoint"},
         .required = {"name"}},
        {.object = "render",
         .keys = {"avatar", "scene", "size", "fps", "body", "travel", "renderer", "samples", "motion_blur",
                  "face_mode", "hands", "format", "partner_side", "cue", "loudness"},
         .required = {}},
        {.object = "hints.*",
         .keys = {"fps", "up", "unit", "facing", "picture_size", "field_of_view", "lift_filter", "smooth",
                  "animation", "names"},
         .required = {}},
        {.object = "modes.*", .keys = {"face_mode", "hands"}, .required = {}},
        {.object = "clips[]",
         .keys = {"id", "speaker", "audio", "words", "text", "script", "voice", "seed", "transcript",
                  "caption", "cut", "practice", "block", "motion", "face", "partner"},
         .required = {"id"}},
        {.object = "clips[].partner",
         .keys = {"motion", "hints", "face", "audio", "avatar"},
         .required = {"motion"}},
        {.object = "questions[]", .keys = question_keys(), .required = {"id", "kind", "text"}},
        {.object = "scales[]", .keys = {"id", "items", "reversed"}, .required = {"id", "items"}},
        {.object = "passes[]", .keys = {"sound", "questions"}, .required = {"questions"}},
        {.object = "checks",
         .keys = {"count", "kinds", "at_beginning", "instruction", "instruction_of_video"},
         .required = {"count"}},
        {.object = "exclusions",
         .keys = {"failed_checks", "lenient_failed_checks", "fastest_seconds"},
         .required = {}},
        {.object = "completion",
         .keys = {"url", "code", "failed_url", "failed_code", "declined_url", "shown_by"},
         .required = {}},
        {.object = "preregistration",
         .keys = {"description", "hypotheses", "additional_blinding", "existing_data",
                  "existing_data_explanation", "data_collection", "smallest_effect", "sample_size_rationale",
                  "stopping_rule", "indices", "models", "transformations", "inference", "missing_data",
                  "exploratory", "other"},
         .required = {}},
    };
    return keys;
}

namespace {

// What the plan itself says was looked at as it was read; the rest is ours.
void require_no_condition_in_bundled_texts(const JsonValue& whole, const Plan& plan) {
    for (const std::string& text : public_texts(plan)) {
        if (const auto name = find_condition(text, condition_names(plan))) {
            whole.at("conditions")
                .refuse(format("\"{}\" stands in what participants read, \"{}\"; rename the condition, or "
                               "write \"instructions\" and \"question\" yourself",
                               *name, text));
        }
    }
}

}  // namespace

Plan read_plan(const fs::path& file) {
    return read_plan(read_json(file), file);
}

Plan read_plan(const Json& written, const fs::path& file) {
    const Json json = with_preset(written, file.string());
    const JsonValue whole(json, file.string());
    whole.allow_only(keys_of(""));
    const fs::path folder = file.parent_path();

    Plan plan;
    plan.file = file;
    for (const char* key : {"preset", "from_preset"}) {
        if (const auto preset = whole.find(key)) plan.preset = preset->text();
    }
    if (const auto language = whole.find("language")) {
        plan.texts.language = read_language(*language);
        require_texts_of_language(whole, plan.texts.language);
    }
    if (const auto silent = whole.find("silent")) plan.silent = silent->flag();
    read_conditions(whole, plan);
    if (const auto render = whole.find("render")) {
        plan.render = read_render(*render, folder, plan.presentation);
    }
    read_hints(whole, folder, plan);
    read_modes_of_conditions(whole, plan);
    read_clips(whole, folder, plan);
    read_participants(whole, written, plan);
    read_questions(whole, plan);
    read_scales_of_plan(whole, plan);
    read_right_answers(whole, plan);
    read_texts(whole, plan);
    read_preregistration(whole, plan);
    require_no_condition_in_bundled_texts(whole, plan);
    return plan;
}

std::vector<std::string> condition_names(const Plan& plan) {
    std::vector<std::string> names;
    for (const PlanCondition& condition : plan.conditions) names.push_back(condition.name);
    return names;
}

bool has_sound(const Plan& plan) {
    return !plan.silent && plan.clips.front().has_speech();
}

bool has_mismatch(const Plan& plan) {
    return std::any_of(plan.conditions.begin(), plan.conditions.end(), [](const PlanCondition& condition) {
        return condition.making == Making::mismatched_speech || condition.making == Making::mismatched_motion;
    });
}

std::vector<std::string> public_texts(const Plan& plan) {
    const PlanTexts& own = plan.texts;
    std::vector<std::string> texts = {own.title, own.instructions};
    for (const std::string& text : {own.consent, own.training}) {
        if (!text.empty()) texts.push_back(text);
    }
    for (const auto* list : {&plan.questions, &plan.questionnaire}) {
        for (const Question& question : *list) {
            const std::vector<std::string> more = texts_of(question);
            texts.insert(texts.end(), more.begin(), more.end());
        }
    }
    for (const PlanClip& clip : plan.clips) {
        if (!clip.caption.empty()) texts.push_back(clip.caption);
    }
    return texts;
}

std::string path_in_plan(const Plan& plan, const fs::path& path) {
    const fs::path relative = path.lexically_relative(plan.file.parent_path());
    return relative.empty() || *relative.begin() == ".." ? path.string() : relative.string();
}

Json modes_by_condition(const Plan& plan) {
    Json json = Json::object();
    for (std::size_t i = 0; i < plan.conditions.size(); ++i)
        json[plan.conditions[i].name] = to_json(plan.modes[i]);
    return json;
}

}  // namespace chironomia::study
