#include "study/record/pages.h"

#include <algorithm>

#include "core/files/json_value.h"

namespace chironomia::study {
namespace {

constexpr long long kMany = 1'000'000;

// A text that may be empty, absent or null.
std::string any_text(const JsonValue& object, std::string_view name) {
    const auto value = object.filled(name);
    if (!value) return "";
    if (!value->json().is_string()) value->refuse("is " + value->shown() + ", a text is needed");
    return value->json().get<std::string>();
}

std::string some_text(const JsonValue& object, std::string_view name) {
    const std::string text = any_text(object, name);
    if (text.empty()) object.at(name).refuse("is empty; write a text");
    return text;
}

bool flag(const JsonValue& object, std::string_view name, bool without) {
    const auto value = object.find(name);
    return value ? value->flag() : without;
}

double number(const JsonValue& value) {
    if (!value.json().is_number()) value.refuse("is " + value.shown() + ", a number is needed");
    return value.json().get<double>();
}

std::vector<std::size_t> indices(const JsonValue& list, std::size_t end) {
    std::vector<std::size_t> found;
    for (const JsonValue& item : list.items(0)) {
        found.push_back(static_cast<std::size_t>(item.integer(0, static_cast<long long>(end) - 1)));
    }
    return found;
}

StudyPage read_study_page(const JsonValue& value, std::size_t questions) {
    StudyPage page{.id = value.at("id").text(),
                   .videos = value.at("videos").texts(1),
                   .seconds = number(value.at("seconds")),
                   .caption = any_text(value, "caption"),
                   .passes = {}};
    for (const JsonValue& pass : value.at("passes").items(1)) {
        page.passes.push_back(
            {.sound = flag(pass, "sound", true), .questions = indices(pass.at("questions"), questions)});
    }
    return page;
}

Sheet read_sheet(const JsonValue& value, const std::vector<StudyPage>& pages) {
    Sheet sheet;
    std::vector<bool> shown(pages.size());
    for (const JsonValue& entry : value.at("pages").items(1)) {
        const std::vector<JsonValue> parts = entry.items(2);
        const auto page =
            static_cast<std::size_t>(parts[0].integer(0, static_cast<long long>(pages.size()) - 1));
        if (shown[page]) parts[0].refuse("stands twice on this sheet");
        shown[page] = true;
        std::vector<std::size_t> order = indices(parts[1], pages[page].videos.size());
        std::vector<std::size_t> sorted = order;
        std::sort(sorted.begin(), sorted.end());
        const bool once = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
        if (!once || order.size() != pages[page].videos.size()) {
            parts[1].refuse("is " + parts[1].shown() + ", each video of the page is needed once");
        }
        sheet.pages.push_back({.page = page, .order = std::move(order)});
    }
    return sheet;
}

void read_parts_before_trials(const JsonValue& whole, StudyPages& study) {
    study.instructions = any_text(whole, "instructions");
    if (const auto texts = whole.filled("texts")) {
        for (const auto& [name, text] : texts->json().items()) study.texts[name] = any_text(*texts, name);
    }
    if (const auto consent = whole.filled("consent")) {
        study.consent = any_text(*consent, "text");
        study.agreement = any_text(*consent, "agree");
    }
    if (const auto training = whole.filled("training")) {
        study.training = any_text(*training, "text");
        study.practice = indices(training->at("pages"), study.pages.size());
    }
    if (const auto check = whole.filled("sound_check")) {
        study.sounds = check->at("files").texts(1);
    }
    if (const auto completion = whole.filled("completion")) {
        study.completion_url = any_text(*completion, "url");
        study.completion_code = any_text(*completion, "code");
        study.declined_url = any_text(*completion, "declined_url");
    }
}

Json to_json(const StudyPage& page) {
    Json passes = Json::array();
    for (const PagePass& pass : page.passes)
        passes.push_back({{"sound", pass.sound}, {"questions", pass.questions}});
    return {{"id", page.id},
            {"videos", page.videos},
            {"seconds", page.seconds},
            {"caption", page.caption},
            {"passes", std::move(passes)}};
}

Json to_json(const Sheet& sheet) {
    Json pages = Json::array();
    for (const Showing& shown : sheet.pages) pages.push_back({shown.page, shown.order});
    return {{"pages", std::move(pages)}};
}

Json sound_check_of(const StudyPages& pages) {
    if (pages.sounds.empty()) return nullptr;
    Json choices = Json::array();
    for (std::size_t tones = 1; tones <= pages.sounds.size(); ++tones)
        choices.push_back(std::to_string(tones));
    return {{"files", pages.sounds}, {"choices", std::move(choices)}};
}

Json completion_of(const StudyPages& pages) {
    Json json;
    if (!pages.completion_url.empty()) json["url"] = pages.completion_url;
    if (!pages.completion_code.empty()) json["code"] = pages.completion_code;
    if (!pages.declined_url.empty()) json["declined_url"] = pages.declined_url;
    return json;
}

}  // namespace

StudyPages read_study_pages(const std::filesystem::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.at("format").choice({std::string(kPagesFormat)});
    StudyPages study{.study = whole.at("study").text(),
                     .language = any_text(whole, "language"),
                     .title = some_text(whole, "title"),
                     .layout = layout_named(whole.at("layout")),
                     .one_by_one = flag(whole, "one_by_one", false),
                     .width = static_cast<int>(whole.at("width").integer(1, kMany)),
                     .height = static_cast<int>(whole.at("height").integer(1, kMany)),
                     .sound = flag(whole, "sound", false),
                     .shuffle_questions = flag(whole, "shuffle_questions", false)};
    if (const auto skip = whole.filled("skip_after")) study.skip_after = number(*skip);
    study.questions = read_questions(whole.at("questions"), 0);
    for (const JsonValue& page : whole.at("pages").items(1)) {
        study.pages.push_back(read_study_page(page, study.questions.size()));
    }
    for (const JsonValue& sheet : whole.at("sheets").items(1)) {
        study.sheets.push_back(read_sheet(sheet, study.pages));
    }
    if (const auto questionnaire = whole.find("questionnaire")) {
        study.questionnaire = read_questions(*questionnaire, 0);
    }
    read_parts_before_trials(whole, study);
    return study;
}

Json to_json(const StudyPages& study) {
    const bool trains = !study.training.empty() || !study.practice.empty();
    Json pages = Json::array(), sheets = Json::array();
    for (const StudyPage& page : study.pages) pages.push_back(to_json(page));
    for (const Sheet& sheet : study.sheets) sheets.push_back(to_json(sheet));
    return {{"format", kPagesFormat},
            {"study", study.study},
            {"language", study.language},
            {"title", study.title},
            {"texts", study.texts},
            {"layout", to_text(study.layout)},
            {"one_by_one", study.one_by_one},
            {"width", study.width},
            {"height", study.height},
            {"sound", study.sound},
            {"shuffle_questions", study.shuffle_questions},
            {"skip_after", study.skip_after ? Json(*study.skip_after) : Json()},
            {"instructions", study.instructions},
            {"consent",
             study.consent.empty() ? Json() : Json{{"text", study.consent}, {"agree", study.agreement}}},
            {"training", trains ? Json{{"text", study.training}, {"pages", study.practice}} : Json()},
            {"sound_check", sound_check_of(study)},
            {"questionnaire", to_json(study.questionnaire)},
            {"completion", completion_of(study)},
            {"questions", to_json(study.questions)},
            {"pages", std::move(pages)},
            {"sheets", std::move(sheets)}};
}

std::vector<Step> steps_of_sheet(const StudyPages& pages, std::size_t sheet) {
    std::vector<Step> steps;
    const std::vector<Showing>& all = pages.sheets[sheet].pages;
    for (std::size_t at = 0; at < all.size(); ++at) {
        for (std::size_t pass = 0; pass < pages.pages[all[at].page].passes.size(); ++pass)
            steps.push_back({.page = all[at].page, .pass = pass, .order = all[at].order, .at = at});
    }
    return steps;
}

std::size_t count_places(const StudyPages& pages, const StudyPage& page) {
    return pages.layout == Layout::pair ? 2 : page.videos.size();
}

std::string token_of(const std::string& video) {
    return std::filesystem::path(video).stem().string();
}

std::vector<std::string> tokens_as_shown(const StudyPage& page, const std::vector<std::size_t>& order) {
    std::vector<std::string> tokens;
    for (const std::size_t video : order) tokens.push_back(token_of(page.videos[video]));
    return tokens;
}

}  // namespace chironomia::study
