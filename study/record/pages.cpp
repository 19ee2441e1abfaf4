#include "study/record/pages.h"

#include <algorithm>
#include <limits>

#include "core/files/json_value.h"

namespace chironomia {
namespace {

constexpr long long kMany = 1'000'000;

// A text that may be empty, absent or null.
std::string any_text(const JsonValue& object, std::string_view name) {
    const auto value = object.find(name);
    if (!value || value->json().is_null()) return "";
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
    if (!value) return without;
    if (!value->json().is_boolean()) value->refuse("is " + value->shown() + ", true or false is needed");
    return value->json().get<bool>();
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

std::vector<std::string> texts(const JsonValue& list, std::size_t at_least) {
    std::vector<std::string> found;
    for (const JsonValue& item : list.items(at_least)) found.push_back(item.text());
    return found;
}

std::vector<NamedText> named_texts(const JsonValue& list, std::size_t at_least) {
    std::vector<NamedText> found;
    for (const JsonValue& item : list.items(at_least)) {
        found.push_back({.id = item.at("id").text(), .text = any_text(item, "text")});
    }
    return found;
}

AskedReasons read_reasons(const JsonValue& value) {
    AskedReasons reasons{.text = any_text(value, "text"),
                         .options = named_texts(value.at("options"), 1),
                         .other = any_text(value, "other")};
    const auto unless = value.find("unless");
    if (unless && !unless->json().is_null()) reasons.unless = static_cast<int>(unless->integer(1, 100));
    return reasons;
}

// Either limit may be left out.
void read_limits(const JsonValue& value, AskedQuestion& question) {
    const auto least = value.find("least"), most = value.find("most");
    constexpr double kAny = std::numeric_limits<double>::infinity();
    question.least = least ? number(*least) : -kAny;
    question.most = most ? number(*most) : kAny;
    if (question.least >= question.most) value.at("most").refuse("must be above \"least\"");
}

void read_range(const JsonValue& value, AskedQuestion& question) {
    value.at("least");
    value.at("most");
    read_limits(value, question);
}

void read_labels(const JsonValue& value, AskedQuestion& question) {
    const auto labels = value.find("labels");
    if (!labels) return;
    for (const auto& label : labels->json().items()) {
        question.labels[std::atoi(label.key().c_str())] = labels->at(label.key()).text();
    }
}

void read_options(const JsonValue& value, AskedQuestion& question) {
    question.of_videos = flag(value, "of_videos", false);
    if (!question.of_videos) question.options = named_texts(value.at("options"), 2);
}

QuestionKind kind_of(const JsonValue& value) {
    const std::vector<std::string> names = {"preference", "rating", "slider", "choice",
                                            "rank",       "text",   "number"};
    const std::string name = value.choice(names);
    return static_cast<QuestionKind>(std::find(names.begin(), names.end(), name) - names.begin());
}

AskedQuestion read_asked_question(const JsonValue& value) {
    AskedQuestion question{.id = value.at("id").text(),
                           .kind = kind_of(value.at("kind")),
                           .text = any_text(value, "text"),
                           .optional = flag(value, "optional", false),
                           .each = flag(value, "each", false)};
    switch (question.kind) {
        case QuestionKind::preference:
            question.answers = texts(value.at("answers"), 2);
            question.least = 1;
            question.most = static_cast<double>(question.answers.size());
            if (const auto reasons = value.find("reasons"); reasons && !reasons->json().is_null()) {
                question.reasons = read_reasons(*reasons);
            }
            break;
        case QuestionKind::rating:
            question.least = 1;
            question.most = static_cast<double>(value.at("points").integer(2, 11));
            read_labels(value, question);
            break;
        case QuestionKind::slider:
            read_range(value, question);
            if (const auto labels = value.find("labels")) question.scale = texts(*labels, 0);
            break;
        case QuestionKind::choice:
        case QuestionKind::rank:
            read_options(value, question);
            break;
        case QuestionKind::text:
            break;
        case QuestionKind::number:
            read_limits(value, question);
            break;
    }
    return question;
}

std::vector<AskedQuestion> read_questions(const JsonValue& list) {
    std::vector<AskedQuestion> questions;
    for (const JsonValue& item : list.items(0)) {
        AskedQuestion question = read_asked_question(item);
        const bool known = std::any_of(questions.begin(), questions.end(),
                                       [&](const AskedQuestion& other) { return other.id == question.id; });
        if (known) item.at("id").refuse("there is another question of this id");
        questions.push_back(std::move(question));
    }
    return questions;
}

StudyPage read_page(const JsonValue& value, std::size_t questions) {
    StudyPage page{.id = value.at("id").text(),
                   .videos = texts(value.at("videos"), 1),
                   .seconds = number(value.at("seconds")),
                   .caption = any_text(value, "caption"),
                   .passes = {}};
    for (const JsonValue& pass : value.at("passes").items(1)) {
        page.passes.push_back(
            {.sound = flag(pass, "sound", true), .questions = indices(pass.at("questions"), questions)});
    }
    return page;
}

std::vector<ShownPage> read_sheet(const JsonValue& value, const std::vector<StudyPage>& pages) {
    std::vector<ShownPage> sheet;
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
        sheet.push_back({.page = page, .order = std::move(order)});
    }
    return sheet;
}

void read_parts_before_trials(const JsonValue& whole, StudyPages& study) {
    study.instructions = any_text(whole, "instructions");
    if (const auto consent = whole.find("consent"); consent && !consent->json().is_null()) {
        study.consent = any_text(*consent, "text");
    }
    if (const auto training = whole.find("training"); training && !training->json().is_null()) {
        study.training = any_text(*training, "text");
        study.practice = indices(training->at("pages"), study.pages.size());
    }
    if (const auto completion = whole.find("completion"); completion && !completion->json().is_null()) {
        study.completion_url = any_text(*completion, "url");
    }
}

}  // namespace

StudyPages read_study_pages(const std::filesystem::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.at("format").choice({std::string(kPagesFormat)});
    StudyPages study{.study = whole.at("study").text(),
                     .language = any_text(whole, "language"),
                     .title = some_text(whole, "title"),
                     .layout = whole.at("layout").choice({"single", "pair", "triplet", "parallel"}),
                     .one_by_one = flag(whole, "one_by_one", false),
                     .width = static_cast<int>(whole.at("width").integer(1, kMany)),
                     .height = static_cast<int>(whole.at("height").integer(1, kMany)),
                     .sound = flag(whole, "sound", false)};
    const auto skip_after = whole.find("skip_after");
    study.may_skip = skip_after && !skip_after->json().is_null();
    study.questions = read_questions(whole.at("questions"));
    for (const JsonValue& page : whole.at("pages").items(1)) {
        study.pages.push_back(read_page(page, study.questions.size()));
    }
    for (const JsonValue& sheet : whole.at("sheets").items(1)) {
        study.sheets.push_back(read_sheet(sheet, study.pages));
    }
    if (const auto questionnaire = whole.find("questionnaire")) {
        study.questionnaire = read_questions(*questionnaire);
    }
    read_parts_before_trials(whole, study);
    return study;
}

std::vector<Step> steps_of_sheet(const StudyPages& pages, std::size_t sheet) {
    std::vector<Step> steps;
    const std::vector<ShownPage>& all = pages.sheets[sheet];
    for (std::size_t at = 0; at < all.size(); ++at) {
        for (std::size_t pass = 0; pass < pages.pages[all[at].page].passes.size(); ++pass)
            steps.push_back({.page = all[at].page, .pass = pass, .order = all[at].order, .at = at});
    }
    return steps;
}

std::size_t count_places(const StudyPages& pages, const StudyPage& page) {
    return pages.layout == "pair" ? 2 : page.videos.size();
}

std::string token_of(const std::string& video) {
    return std::filesystem::path(video).stem().string();
}

std::vector<std::string> tokens_as_shown(const StudyPage& page, const std::vector<std::size_t>& order) {
    std::vector<std::string> tokens;
    for (const std::size_t video : order) tokens.push_back(token_of(page.videos[video]));
    return tokens;
}

}  // namespace chironomia
