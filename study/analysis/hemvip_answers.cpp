#include "study/analysis/hemvip_answers.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/files/files.h"
#include "core/text.h"
#include "study/record/answer_values.h"
#include "study/record/link_parameters.h"

namespace chironomia::study::analysis {
namespace {

namespace fs = std::filesystem;

constexpr int kBroken = 99;             // the score of a page that was reported
constexpr const char* kOfCheck = "at";  // in place of the token of a video
constexpr double kMillisecondsOfSecond = 1000;

struct SourceOfHemvip {
    const StudyKey& key;
    const StudyPages& pages;
};

// A page as it was answered.
struct HemvipPage {
    JsonValue value;
    std::size_t page = 0;
    bool is_pair = false;
    bool is_broken = false;
    std::vector<std::string> stimuli;  // from left to right
    std::vector<Json> scores;
    std::optional<double> seconds;  // none: HEMVIP saved no time
};

std::size_t page_named(const JsonValue& id, const StudyKey& key) {
    const std::string token = id.text();
    const auto found = std::ranges::find(key.pages, token, &KeyPage::token);
    if (found == key.pages.end())
        id.refuse(
            format("is {}, which is no page of the study; give the folder of the study that was exported",
                   id.shown()));
    return static_cast<std::size_t>(found - key.pages.begin());
}

HemvipPage read_page(const JsonValue& value, const StudyKey& key) {
    HemvipPage read{.value = value, .page = page_named(value.at("id"), key)};
    read.is_pair = value.at("type").text() == "videopc";
    for (const JsonValue& response : value.at("responses").items(1)) {
        read.stimuli.push_back(response.at("stimulus").text());
        read.scores.push_back(as_number(response.at("score").json()));
        read.is_broken = read.is_broken || (read.is_pair && read.scores.back() == kBroken);
        const auto time = response.filled("time");
        if (time && time->json().is_number())
            read.seconds = time->json().get<double>() / kMillisecondsOfSecond;
    }
    return read;
}

bool shows(const SourceOfHemvip& source, const Step& step, const HemvipPage& answered) {
    if (step.page != answered.page || step.order.size() != answered.stimuli.size()) return false;
    const std::vector<std::string> tokens = tokens_as_shown(source.pages.pages[step.page], step.order);
    for (std::size_t place = 0; place < tokens.size(); ++place) {
        const bool is_marked =
            answered.stimuli[place] == kOfCheck && source.key.pages[step.page].kind == PageKind::check;
        if (!is_marked && answered.stimuli[place] != tokens[place]) return false;
    }
    return true;
}

// For each page the step of the sheet that shows it, if they are in the same order.
std::optional<std::vector<Step>> steps_on(const SourceOfHemvip& source, std::size_t sheet,
                                          const std::vector<HemvipPage>& answered) {
    const std::vector<Step> steps = steps_of_sheet(source.pages, sheet);
    std::vector<Step> found;
    auto next = steps.begin();
    for (const HemvipPage& page : answered) {
        next = std::find_if(next, steps.end(), [&](const Step& step) { return shows(source, step, page); });
        if (next == steps.end()) return std::nullopt;
        found.push_back(*next++);
    }
    return found;
}

Json answer_of_pair(const HemvipPage& page) {
    const std::size_t count = page.scores.size();
    const bool are_flags =
        count == 2 && std::ranges::all_of(page.scores, [](const Json& score) { return score.is_boolean(); });
    if (!are_flags) page.value.refuse("has scores that are not two of true and false");
    if (page.scores[0] == true && page.scores[1] == true)
        page.value.refuse("has two scores that are true; one of two is preferred, or none");
    return page.scores[0] == true ? 1 : page.scores[1] == true ? 3 : 2;
}

Json value_of_page(const HemvipPage& page, const Question& question) {
    constexpr std::size_t kAnswersOfPair = 3;
    if (page.is_pair && question.answers.size() != kAnswersOfPair)
        page.value.refuse(format("is of type \"videopc\", but \"{}\" is no preference with {} answers",
                                 question.id, kAnswersOfPair));
    const Json value = page.is_pair ? answer_of_pair(page) : Json(page.scores);
    const std::string fault = fault_of_answer(question, value, page.stimuli.size());
    if (!fault.empty()) page.value.refuse(format("has the scores {}: {}", Json(page.scores).dump(), fault));
    return value;
}

PageAnswer answer_on(const SourceOfHemvip& source, const Step& step, const HemvipPage& page) {
    PageAnswer answer{.page = step.page,
                      .pass = step.pass,
                      .order = step.order,
                      .values = Json::object(),
                      .reasons = Json::object(),
                      .skipped = page.is_broken,
                      .seconds = page.seconds};
    if (answer.skipped) return answer;
    const std::vector<std::size_t>& asked = source.pages.pages[step.page].passes[step.pass].questions;
    if (asked.size() != 1)
        page.value.refuse(format("asks {} questions in the study, HEMVIP one", asked.size()));
    const Question& question = source.key.questions[asked.front()];
    answer.values[question.id] = value_of_page(page, question);
    return answer;
}

// {"name": [...], "response": [...]}; what was left open is left out.
Json questionnaire_of(const JsonValue& whole, const StudyPages& pages) {
    Json answers = Json::object();
    const auto given = whole.filled("participant");
    if (!given || !given->json().is_object() || !given->find("name") || !given->find("response"))
        return answers;
    const std::vector<JsonValue> names = given->at("name").items(0), said = given->at("response").items(0);
    for (std::size_t i = 0; i < std::min(names.size(), said.size()); ++i) {
        const std::string name = names[i].text();
        const Json& answer = said[i].json();
        if (answer.is_null() || answer == "") continue;
        const auto asked = std::ranges::find(pages.questionnaire, name, &Question::id);
        const bool is_number = asked != pages.questionnaire.end() && asked->kind == QuestionKind::number;
        answers[name] = is_number ? as_number(answer) : answer;
    }
    return answers;
}

Respondent read_participant(const JsonValue& whole, const SourceOfHemvip& source, const fs::path& file) {
    Respondent participant{.name = user_of(whole), .file = file.string(), .finished = true};
    std::vector<HemvipPage> answered;
    for (const JsonValue& trial : whole.at("trials").items(0)) {
        const std::string type = trial.at("type").text();
        if (type == "video" || type == "videopc") answered.push_back(read_page(trial, source.key));
    }
    std::optional<std::vector<Step>> steps;
    for (std::size_t sheet = 0; sheet < source.pages.sheets.size() && !steps; ++sheet) {
        steps = steps_on(source, sheet, answered);
        participant.sheet = sheet;
    }
    if (!steps)
        whole.at("trials").refuse(
            "has pages or videos in an order that no sheet of the study has; give the folder of the study that was "
            "exported");
    for (std::size_t i = 0; i < answered.size(); ++i)
        participant.answers.push_back(answer_on(source, (*steps)[i], answered[i]));
    participant.questionnaire = questionnaire_of(whole, source.pages);
    return participant;
}

}  // namespace

Json as_number(const Json& value) {
    if (!value.is_string()) return value;
    const Json number = Json::parse(value.get<std::string>(), nullptr, false);
    return number.is_number() ? number : value;
}

bool marks_check(std::string_view stimulus, bool is_pair) {
    if (stimulus == "at") return true;
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const std::string_view mark = is_pair ? "attn" : "attn_check_";
    for (std::size_t at = stimulus.find(mark); at != stimulus.npos; at = stimulus.find(mark, at + 1)) {
        const char before = at == 0 ? ' ' : stimulus[at - 1];
        const std::size_t end = at + mark.size();
        const char next = end < stimulus.size() ? stimulus[end] : ' ';
        if (is_pair ? !is_letter(before) && !is_letter(next) : is_digit(next)) return true;
    }
    return false;
}

std::string user_of(const JsonValue& whole) {
    return plain_name(whole.at("userId").text());
}

bool is_of_hemvip(const fs::path& file) {
    const Json json = read_json(file);
    const Json& first = json.is_array() && !json.empty() ? json.front() : json;
    return first.is_object() && first.contains("userId") && !first.contains("format");
}

HemvipAnswers read_hemvip_answers(const std::vector<fs::path>& files, const StudyKey& key,
                                  const StudyPages& pages) {
    HemvipAnswers read;
    std::map<std::string, std::string> names;
    std::size_t broken = 0, without_time = 0;
    for (const fs::path& file : files) {
        const Json json = read_json(file);
        const JsonValue whole(json, file.string());
        for (const JsonValue& value : json.is_array() ? whole.items(0) : std::vector<JsonValue>{whole}) {
            read.participants.push_back(read_participant(value, {.key = key, .pages = pages}, file));
            const Respondent& participant = read.participants.back();
            broken +=
                static_cast<std::size_t>(std::ranges::count(participant.answers, true, &PageAnswer::skipped));
            without_time += static_cast<std::size_t>(std::ranges::count_if(
                participant.answers, [](const PageAnswer& answer) { return !answer.seconds; }));
            const auto [before, is_new] = names.emplace(participant.name, file.string());
            if (!is_new)
                value.at("userId").refuse(
                    format("\"{}\" is already in {}; give the answers of each participant once",
                           participant.name, before->second));
        }
    }
    if (broken > 0)
        read.notes.push_back(format("{} reported as broken and {} as skipped.",
                                    broken == 1 ? "1 page was" : format("{} pages were", broken),
                                    broken == 1 ? "counts" : "count"));
    if (without_time > 0 && key.exclusions.fastest_seconds)
        read.notes.push_back(format("{} no time, so \"fastest_seconds\" does not judge {}.",
                                    without_time == 1 ? "1 page has" : format("{} pages have", without_time),
                                    without_time == 1 ? "it" : "them"));
    return read;
}

}  // namespace chironomia::study::analysis
