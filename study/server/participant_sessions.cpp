#include "study/server/participant_sessions.h"

#include <algorithm>

#include "core/text.h"
#include "study/build/participant_pages.h"
#include "study/record/link_parameters.h"
#include "study/server/answer_validation.h"
#include "study/server/clock.h"

namespace chironomia::study::server {
namespace {

constexpr std::size_t kLongestName = 1'000;     // bytes: participant, session, and what they arrived with
constexpr std::size_t kLongestBrowser = 1'000;  // bytes
constexpr std::size_t kMostParameters = 20;

Reply refusal(int status, const std::string& why) {
    return {.status = status, .body = {{"error", why}}};
}

bool is_text(const Json& value, std::size_t longest) {
    return value.is_string() && value.get_ref<const std::string&>().size() <= longest;
}

// Names go into tables and names of files: no control characters, such as NUL or line breaks.
bool is_plain_text(const Json& value, std::size_t longest) {
    if (!is_text(value, longest)) return false;
    const auto& text = value.get_ref<const std::string&>();
    return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

bool are_parameters(const Json& object) {
    return object.is_object() && object.size() <= kMostParameters &&
           std::all_of(object.items().begin(), object.items().end(), [](const auto& item) {
               return is_plain_text(item.key(), kLongestName) && is_plain_text(item.value(), kLongestName);
           });
}

// The text at a key without the blanks around it, or "" if there is none.
std::string text_at(const Json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_string()) return "";
    return std::string(trim(found->get_ref<const std::string&>()));
}

std::string fault_of_begin(const Json& body) {
    if (!body.is_object()) return "an object is needed";
    for (const char* name : {"participant", "session"}) {
        if (body.contains(name) && !body[name].is_null() && !is_plain_text(body[name], kLongestName)) {
            return format("{}: a text of at most {} bytes without control characters is needed", name,
                          kLongestName);
        }
    }
    if (body.contains("browser") && !is_plain_text(body["browser"], kLongestBrowser)) {
        return format("browser: a text of at most {} bytes without control characters is needed",
                      kLongestBrowser);
    }
    if (body.contains("arrived_with") && !are_parameters(body["arrived_with"])) {
        return format(
            "arrived_with: an object of at most {} short texts without control characters is needed",
            kMostParameters);
    }
    return "";
}

Json parameters_of(const Json& body) {
    return body.contains("arrived_with") ? body["arrived_with"] : Json(Json::object());
}

// The text at a key that names somebody, or "" if there is none.
std::string name_at(const Json& object, const char* key) {
    const std::string name = plain_name(text_at(object, key));
    return is_unfilled(name) ? "" : name;
}

// By what somebody is known who comes back, perhaps in another browser.
std::optional<std::string> identity_of(const Json& body) {
    const std::string prolific = name_at(parameters_of(body), "PROLIFIC_PID");
    if (!prolific.empty()) return "prolific:" + prolific;
    const std::string name = name_at(body, "participant");
    if (!name.empty()) return "name:" + name;
    return std::nullopt;
}

// A link with a PROLIFIC_PID may give all participants of a wave one `p`.
std::string name_of(const Json& body) {
    const std::string prolific = name_at(parameters_of(body), "PROLIFIC_PID");
    return prolific.empty() ? name_at(body, "participant") : prolific;
}

// A browser may keep the session of somebody who used it before: an identity counts more.
std::optional<Participant> find_participant(AnswerStore& store, const Json& body) {
    if (const auto identity = identity_of(body)) return store.find_by_identity(*identity);
    const std::string session = text_at(body, "session");
    return session.empty() ? std::nullopt : store.find_by_session(session);
}

// Who asks, if the session is known.
std::optional<Participant> find_by_session(AnswerStore& store, const Json& body) {
    if (!body.is_object()) return std::nullopt;
    const std::string session = text_at(body, "session");
    return session.empty() ? std::nullopt : store.find_by_session(session);
}

Reply unknown_session() {
    return refusal(403, "the session is not known here; open the page of the study again");
}

Json completion_json(const std::string& url, const std::string& code) {
    if (url.empty() && code.empty()) return nullptr;
    return {{"url", url.empty() ? Json(nullptr) : Json(url)},
            {"code", code.empty() ? Json(nullptr) : Json(code)}};
}

}  // namespace

Reply ParticipantSessions::begin(AnswerStore& store, const Json& body, const Arrival& arrival) const {
    if (const std::string fault = fault_of_begin(body); !fault.empty()) return refusal(400, fault);
    std::optional<Participant> participant = find_participant(store, body);
    if (!participant) {
        const std::vector<SheetLoad> loads = store.loads(study_.sheets.size(), arrival.now - timeout_);
        if (study_.wanted && count_taken(loads) >= *study_.wanted) {
            Reply full = refusal(409, "enough people have taken part already; thank you for coming");
            full.body["full"] = true;
            full.body["completion"] = completion_json(study_.completion.declined_url, "");
            return full;
        }
        if (!arrival.admits())
            return refusal(429, "too many people have begun from this address of late; try again later");
        participant = Participant{.session = arrival.session,
                                  .identity = identity_of(body),
                                  .name = name_of(body),
                                  .sheet = most_needed_sheet(loads),
                                  .arrived_with = parameters_of(body).dump(),
                                  .browser = text_at(body, "browser"),
                                  .started = arrival.now,
                                  .seen = arrival.now};
        store.add(*participant);
    } else {
        store.mark_active(participant->id, arrival.now);
    }
    return {.status = 200,
            .body = {{"session", participant->session},
                     {"sheet", participant->sheet},
                     {"pages", pages_of_sheet(study_.data, participant->sheet, study_.key.secret)},
                     {"answered", store.count_answers(participant->id)},
                     {"finished", participant->finished.has_value()}}};
}

Reply ParticipantSessions::answer(AnswerStore& store, const Json& body, std::int64_t now) const {
    const std::optional<Participant> participant = find_by_session(store, body);
    if (!participant) return unknown_session();
    if (!body.contains("number") || !body["number"].is_number_unsigned()) {
        return refusal(400, "number: a whole number from 0 is needed");
    }
    if (!body.contains("answer")) return refusal(400, "answer: it is missing");
    store.mark_active(participant->id, now);
    const auto number = body["number"].get<std::size_t>();
    return store_answer(
        store, *participant,
        {.number = number, .entry = with_own_tokens(*participant, number, body["answer"]), .received = now});
}

Json ParticipantSessions::tokens_of_showings(const Participant& participant, std::size_t number) const {
    const Step& step = study_.sheets[participant.sheet][number];
    const StudyPage& page = study_.pages.pages[step.page];
    Json shown = Json::array();
    for (std::size_t place = 0; place < step.order.size(); ++place) {
        const VideoShowing showing = {.sheet = participant.sheet, .at = step.at, .place = place};
        shown.push_back(
            token_of(video_of_showing(page.videos[step.order[place]], showing, study_.key.secret)));
    }
    return shown;
}

// The page knows videos by the names of their showings.
Json ParticipantSessions::with_own_tokens(const Participant& participant, std::size_t number,
                                          Json entry) const {
    const std::vector<Step>& steps = study_.sheets[participant.sheet];
    if (number >= steps.size() || !entry.is_object() || !entry.contains("videos")) return entry;
    if (entry["videos"] == tokens_of_showings(participant, number)) {
        const Step& step = steps[number];
        entry["videos"] = tokens_as_shown(study_.pages.pages[step.page], step.order);
    }
    return entry;
}

Reply ParticipantSessions::store_answer(AnswerStore& store, const Participant& participant,
                                        const SentAnswer& sent) const {
    const auto& [number, entry, received] = sent;
    const std::vector<Step>& steps = study_.sheets[participant.sheet];
    const std::size_t stored = store.count_answers(participant.id);
    if (number > stored || number >= steps.size()) {
        return refusal(409, format("number {} is not the next one; {} of {} answers are stored", number,
                                   stored, steps.size()));
    }
    const EntryFault fault = fault_of_entry(study_.pages, steps[number], entry);
    if (!fault.order.empty()) return refusal(409, fault.order);
    if (!fault.fit.empty()) return refusal(400, fault.fit);
    const std::string text = as_stored(entry).dump();
    if (number < stored) {
        // The page sends again when it did not hear that an answer had arrived.
        if (store.find_answer(participant.id, number) != text) {
            return refusal(409, format("number {} has been answered otherwise", number));
        }
        return {.status = 200, .body = {{"stored", stored}}};
    }
    store.add(
        StoredAnswer{.participant = participant.id, .number = number, .entry = text, .received = received});
    return {.status = 200, .body = {{"stored", stored + 1}}};
}

Reply ParticipantSessions::finish(AnswerStore& store, const Json& body, std::int64_t now) const {
    std::optional<Participant> participant = find_by_session(store, body);
    if (!participant) return unknown_session();
    if (participant->finished) return {.status = 200, .body = {{"completion", completion_of(*participant)}}};
    const std::vector<Step>& steps = study_.sheets[participant->sheet];
    const std::vector<PageAnswer> answers = answers_of(store, *participant);
    const std::size_t answered = count_answered(steps, answers);
    if (answered < steps.size())
        return refusal(409, format("{} of {} answers are stored", answered, steps.size()));
    const Json questionnaire = body.contains("questionnaire") ? body["questionnaire"] : Json(Json::object());
    const std::string fault = fault_of_questionnaire(study_.pages, questionnaire);
    if (!fault.empty()) return refusal(400, fault);
    participant->finished = now;
    participant->questionnaire = questionnaire.dump();
    participant->failed =
        failed_checks(study_.key, study_.pages, answers).size() >= study_.key.exclusions.failed_checks;
    store.mark_active(participant->id, now);
    store.finish(*participant);
    return {.status = 200, .body = {{"completion", completion_of(*participant)}}};
}

Reply ParticipantSessions::decline(AnswerStore& store, const Json& body) const {
    const std::optional<Participant> participant = find_by_session(store, body);
    if (participant && !participant->finished) store.decline(participant->id);
    return {.status = 200, .body = {{"completion", completion_json(study_.completion.declined_url, "")}}};
}

// Every column of the tables that hold something of a participant.
Json ParticipantSessions::stored_json(AnswerStore& store, const Participant& participant) const {
    Json answers = Json::array();
    for (const StoredAnswer& answer : store.answers_of(participant.id)) {
        Json entry = Json::parse(answer.entry);
        entry["videos"] = tokens_of_showings(participant, answer.number);
        answers.push_back({{"participant", answer.participant},
                           {"number", answer.number},
                           {"entry", std::move(entry)},
                           {"received", utc_text(answer.received)}});
    }
    return {{"id", participant.id},
            {"session", participant.session},
            {"identity", participant.identity ? Json(*participant.identity) : Json(nullptr)},
            {"name", participant.name},
            {"sheet", participant.sheet},
            {"arrived_with", Json::parse(participant.arrived_with)},
            {"browser", participant.browser},
            {"started", utc_text(participant.started)},
            {"seen", utc_text(participant.seen)},
            {"finished", participant.finished ? Json(utc_text(*participant.finished)) : Json(nullptr)},
            {"questionnaire", Json::parse(participant.questionnaire)},
            {"failed", participant.failed},
            {"declined", participant.declined},
            {"answers", std::move(answers)}};
}

Reply ParticipantSessions::stored(AnswerStore& store, const Json& body) const {
    const std::optional<Participant> participant = find_by_session(store, body);
    if (!participant) return unknown_session();
    return {.status = 200, .body = stored_json(store, *participant)};
}

ParticipantSessions::Withdrawal ParticipantSessions::withdraw(AnswerStore& store, const Json& body) const {
    const std::optional<Participant> participant = find_by_session(store, body);
    if (!participant) return {.reply = unknown_session(), .name = ""};
    store.forget(participant->id);
    return {.reply = {.status = 200, .body = {{"withdrawn", true}}}, .name = participant->name};
}

std::vector<PageAnswer> ParticipantSessions::answers_of(AnswerStore& store,
                                                        const Participant& participant) const {
    const std::vector<Step>& steps = study_.sheets[participant.sheet];
    std::vector<PageAnswer> answers;
    for (const StoredAnswer& stored : store.answers_of(participant.id)) {
        const Step& step = steps[stored.number];
        const Json entry = Json::parse(stored.entry);
        answers.push_back({.page = step.page,
                           .pass = step.pass,
                           .order = step.order,
                           .values = entry["values"],
                           .skipped = entry["skipped"].get<bool>(),
                           .seconds = entry["seconds"].get<double>()});
    }
    return answers;
}

Json ParticipantSessions::completion_of(const Participant& participant) const {
    const Completion& completion = study_.completion;
    const bool failed_go_elsewhere = !completion.failed_url.empty() || !completion.failed_code.empty();
    if (participant.failed && failed_go_elsewhere)
        return completion_json(completion.failed_url, completion.failed_code);
    return completion_json(completion.url, completion.code);
}

}  // namespace chironomia::study::server
