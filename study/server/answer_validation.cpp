#include "study/server/answer_validation.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "study/record/answer_values.h"

namespace chironomia::study::server {
namespace {

constexpr std::size_t kLongestText = 20'000;  // bytes of one answer in words
constexpr std::size_t kMostEvents = 5'000;    // of one page
constexpr std::size_t kLongestEvent = 100;    // bytes
constexpr int kDeepest = 16;
constexpr double kLongestPage = 7 * 24 * 3600;  // seconds: a browser left open for a week

// The analysis does not accept 2.0 as a whole number either.
bool is_whole(const Json& value) {
    return value.is_number_integer();
}

bool lies_in(const Json& value, double least, double most) {
    return value.get<double>() >= least && value.get<double>() <= most;
}

const Json kNone = nullptr;

// A value as a message may show it: short, whatever was sent.
std::string shown(const Json& value) {
    const std::string text = value.dump(-1, ' ', true);
    return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

bool has_only_keys(const Json& object, const std::vector<std::string>& names) {
    return object.is_object() &&
           std::all_of(object.items().begin(), object.items().end(), [&](const auto& item) {
               return std::find(names.begin(), names.end(), item.key()) != names.end();
           });
}

bool is_left_open(const Json& values, const std::string& id) {
    return !values.contains(id) || values.at(id).is_null();
}

bool is_too_long(const Json& value) {
    return value.is_string() && value.get_ref<const std::string&>().size() > kLongestText;
}

std::string fault_of_value(const Question& question, const Json& value, std::size_t places) {
    const std::string needed = is_too_long(value)
                                   ? format("a text of at most {} bytes is needed", kLongestText)
                                   : fault_of_answer(question, value, places);
    return needed.empty() ? "" : format("{}: {} is no answer; {}", question.id, shown(value), needed);
}

// Every question has a value that fits it, and no other key is there.
std::string fault_of_values(const std::vector<const Question*>& asked, const Json& values,
                            std::size_t places) {
    std::vector<std::string> names;
    for (const Question* question : asked) names.push_back(question->id);
    if (!has_only_keys(values, names)) return "there are answers to questions that were not asked";
    for (const Question* question : asked) {
        if (is_left_open(values, question->id)) {
            if (!question->optional) return format("{}: it must be answered", question->id);
            continue;
        }
        const std::string fault = fault_of_value(*question, values.at(question->id), places);
        if (!fault.empty()) return fault;
    }
    return "";
}

std::string fault_of_reason(const Question& question, const Json& values, const Json& reasons) {
    const Json& given = reasons.contains(question.id) ? reasons.at(question.id) : kNone;
    if (given.is_object() && given.contains("other") && is_too_long(given["other"]))
        return format("{}: {} is no other reason", question.id, shown(given["other"]));
    const std::string fault = study::fault_of_reasons(
        question, is_left_open(values, question.id) ? kNone : values.at(question.id), given);
    return fault.empty() ? "" : format("{}: {}", question.id, fault);
}

std::string fault_of_reasons(const std::vector<const Question*>& asked, const Json& values,
                             const Json& reasons) {
    std::vector<std::string> names;
    for (const Question* question : asked) {
        if (question->reasons) names.push_back(question->id);
    }
    if (!has_only_keys(reasons, names)) return "there are reasons where none were asked for";
    for (const Question* question : asked) {
        if (!question->reasons) continue;
        const std::string fault = fault_of_reason(*question, values, reasons);
        if (!fault.empty()) return fault;
    }
    return "";
}

bool are_events(const Json& events) {
    if (!events.is_array() || events.size() > kMostEvents) return false;
    return std::all_of(events.begin(), events.end(), [](const Json& event) {
        return event.is_array() && event.size() == 2 && event[0].is_number() && event[1].is_string() &&
               event[1].get_ref<const std::string&>().size() <= kLongestEvent;
    });
}

const Json& part(const Json& entry, const char* name, const Json& without) {
    return entry.contains(name) ? entry.at(name) : without;
}

const Json kNothing = Json::object();
const Json kNo = false;
const Json kNoEvents = Json::array();

std::string fault_of_form(const Json& entry) {
    const std::vector<std::string> names = {"page",    "pass",    "videos",  "values",
                                            "reasons", "skipped", "seconds", "events"};
    if (!has_only_keys(entry, names)) return "the answer has a key that answers do not have";
    for (const char* name : {"page", "pass", "videos", "values", "seconds"}) {
        if (!entry.contains(name)) return format("the answer lacks \"{}\"", name);
    }
    if (!is_whole(entry["pass"])) return format("pass: {} is no whole number", shown(entry["pass"]));
    if (!entry["seconds"].is_number() || !lies_in(entry["seconds"], 0, kLongestPage)) {
        return format("seconds: {} is no time on a page", shown(entry["seconds"]));
    }
    if (!part(entry, "skipped", kNo).is_boolean()) return "skipped: true or false is needed";
    if (!are_events(part(entry, "events", kNoEvents))) {
        return "events: pairs of seconds and a short text are needed";
    }
    return "";
}

std::string fault_of_fit(const StudyPages& study, const Step& step, const Json& entry) {
    const StudyPage& page = study.pages[step.page];
    const Json& reasons = part(entry, "reasons", kNothing);
    if (part(entry, "skipped", kNo).get<bool>()) {
        if (!study.skip_after) return "skipped: pages of this study cannot be skipped";
        const bool empty = entry["values"] == kNothing && reasons == kNothing;
        return empty ? "" : "values: a skipped page has no answers";
    }
    std::vector<const Question*> asked;
    for (const std::size_t question : page.passes[step.pass].questions) {
        asked.push_back(&study.questions[question]);
    }
    if (entry["values"] == kNothing) return "values: a page that was not skipped has answers";
    const std::string fault = fault_of_values(asked, entry["values"], count_places(study, page));
    return fault.empty() ? fault_of_reasons(asked, entry["values"], reasons) : fault;
}

}  // namespace

std::optional<Json> parse_body(std::string_view body) {
    using Event = Json::parse_event_t;
    const auto not_too_deep = [](int depth, Event event, Json&) {
        const bool opens = event == Event::array_start || event == Event::object_start;
        if (opens && depth >= kDeepest) throw Error(format("nested deeper than {}", kDeepest));
        return true;
    };
    try {
        return Json::parse(body, not_too_deep);
    } catch (const Json::exception&) {
        return std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

EntryFault fault_of_entry(const StudyPages& study, const Step& step, const Json& entry) {
    if (const std::string fault = fault_of_form(entry); !fault.empty()) return {.order = "", .fit = fault};
    const StudyPage& page = study.pages[step.page];
    if (entry["page"] != page.id || entry["pass"] != step.pass) {
        return {.order = format("this is page {}, pass {}; page {}, pass {} is next", shown(entry["page"]),
                                shown(entry["pass"]), page.id, step.pass),
                .fit = ""};
    }
    const Json videos = tokens_as_shown(page, step.order);
    if (entry["videos"] != videos) {
        // Neither they nor the others are named: how often a token comes would show what is an attention check.
        return {
            .order = "videos: they are not those of this page in the order of the sheet; load the page again",
            .fit = ""};
    }
    return {.order = "", .fit = fault_of_fit(study, step, entry)};
}

std::string fault_of_questionnaire(const StudyPages& study, const Json& answers) {
    std::vector<const Question*> asked;
    for (const Question& question : study.questionnaire) asked.push_back(&question);
    return fault_of_values(asked, answers, 1);
}

Json as_stored(const Json& entry) {
    return {{"page", entry["page"]},
            {"pass", entry["pass"]},
            {"videos", entry["videos"]},
            {"values", entry["values"]},
            {"reasons", part(entry, "reasons", kNothing)},
            {"skipped", part(entry, "skipped", kNo)},
            {"seconds", entry["seconds"]},
            {"events", part(entry, "events", kNoEvents)}};
}

}  // namespace chironomia::study::server
