#include "study/server/operator_page.h"

#include <map>
#include <utility>
#include <vector>

#include "core/text.h"
#include "study/html/html.h"
#include "study/record/link_parameters.h"
#include "study/server/clock.h"

namespace chironomia::study::server {
namespace {

constexpr std::size_t kLastShown = 20;

struct Counts {
    std::size_t begun = 0, finished = 0, active = 0, dropped_out = 0, failed_checks = 0, declined = 0;
};

void count(const Participant& participant, std::int64_t since, Counts& counts) {
    ++counts.begun;
    counts.failed_checks += participant.failed;
    if (participant.finished) {
        counts.finished += !participant.failed;
    } else if (participant.declined) {
        ++counts.declined;
    } else if (participant.seen >= since) {
        ++counts.active;
    } else {
        ++counts.dropped_out;
    }
}

Json json_of(const Counts& counts) {
    return {{"begun", counts.begun},
            {"finished", counts.finished},
            {"active", counts.active},
            {"dropped_out", counts.dropped_out},
            {"failed_checks", counts.failed_checks},
            {"declined", counts.declined}};
}

// The conditions of a step from left to right as shown.
std::vector<std::string> conditions_shown(const ServedStudy& study, const Step& step) {
    const std::vector<KeyPlace>& places = study.key.pages[step.page].places;
    std::vector<std::string> shown;
    if (step.order.size() != places.size()) {  // one video with both figures
        for (const KeyPlace& place : places) shown.push_back(condition_at(study.key, place));
    } else {
        for (const std::size_t place : step.order) shown.push_back(condition_at(study.key, places[place]));
    }
    return shown;
}

struct Balance {
    std::map<std::pair<std::string, std::string>, std::size_t> pairs;   // left, right
    std::map<std::pair<std::size_t, std::string>, std::size_t> places;  // place, condition
};

Balance count_balance(const ServedStudy& study, AnswerStore& store,
                      const std::vector<Participant>& participants) {
    Balance balance;
    for (const Participant& participant : participants) {
        const std::size_t answered = store.count_answers(participant.id);
        for (std::size_t number = 0; number < answered; ++number) {
            const Step& step = study.sheets[participant.sheet][number];
            if (study.key.pages[step.page].kind != PageKind::trial) continue;
            const std::vector<std::string> shown = conditions_shown(study, step);
            if (shown.size() > 1) ++balance.pairs[{shown.front(), shown.back()}];
            for (std::size_t place = 0; place < shown.size(); ++place)
                ++balance.places[{place, shown[place]}];
        }
    }
    return balance;
}

Json last_answers(const ServedStudy& study, AnswerStore& store,
                  const std::vector<Participant>& participants) {
    std::map<std::int64_t, const Participant*> by_id;
    for (const Participant& participant : participants) by_id[participant.id] = &participant;
    Json last = Json::array();
    for (const StoredAnswer& answer : store.last_answers(kLastShown)) {
        const auto found = by_id.find(answer.participant);
        if (found == by_id.end()) continue;
        const Step& step = study.sheets[found->second->sheet][answer.number];
        last.push_back({{"time", utc_text(answer.received)},
                        {"participant", found->second->name},
                        {"number", answer.number},
                        {"clip", study.key.pages[step.page].clip},
                        {"conditions", conditions_shown(study, step)}});
    }
    return last;
}

// For people: `column`, which numbers from 0, from 1.
Json numbered_from_1(Json rows, const char* column) {
    for (Json& row : rows) row[column] = row[column].get<std::size_t>() + 1;
    return rows;
}

// A table of an array of objects: one column for each of `columns`, headed by their names.
std::string table(const std::string& title, const std::vector<std::string>& columns, const Json& rows) {
    std::string html = format("<h2>{}</h2>\n<table><thead><tr>", title);
    for (const std::string& column : columns) {
        std::string heading = column;
        for (char& letter : heading) letter = letter == '_' ? ' ' : letter;
        html += format("<th>{}</th>", heading);
    }
    html += "</tr></thead><tbody>\n";
    for (const Json& row : rows) {
        html += "<tr>";
        for (const std::string& column : columns) {
            const Json& value = row.at(column);
            std::string cell = value.is_string() ? value.get<std::string>() : value.dump();
            if (value.is_array()) cell = join(value.get<std::vector<std::string>>(), " · ");
            html += format("<td>{}</td>", escape_html(value.is_null() ? "–" : cell));
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

std::string page(const std::string& title, const std::string& head, const std::string& body) {
    return format(R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="robots" content="noindex"><title>{}</title>{}
<link rel="icon" href="data:,"><link rel="stylesheet" href="/operator/style.css"></head>
<body><main>
{}</main></body></html>
)",
                  escape_html(title), head, body);
}

// Nothing if nobody was.
std::string note_of_those_sent_away(const Json& sent_away) {
    const auto connections = sent_away.at("connections").get<std::size_t>();
    const auto requests = sent_away.at("requests").get<std::size_t>();
    std::string note;
    if (connections > 0)
        note += format("<p>Connections asked to come again, because too many waited: {}</p>\n", connections);
    if (requests > 0)
        note += format(
            "<p>Requests refused, because one client asked for too much (--connections, --requests, "
            "--newcomers): {}</p>\n",
            requests);
    return note;
}

}  // namespace

Json study_progress(const ServedStudy& study, AnswerStore& store, std::int64_t now, std::int64_t timeout) {
    const std::vector<Participant> participants = store.participants();
    Counts all;
    std::vector<Counts> by_sheet(study.sheets.size());
    for (const Participant& participant : participants) {
        count(participant, now - timeout, all);
        count(participant, now - timeout, by_sheet.at(participant.sheet));
    }
    Json people = json_of(all);
    people["withdrawn"] = store.count_withdrawals();
    people["wanted"] = study.wanted ? Json(*study.wanted) : Json(nullptr);
    const auto unfilled = std::ranges::count_if(participants, [](const Participant& participant) {
        return has_unfilled(Json::parse(participant.arrived_with));
    });
    const std::size_t taken = count_taken(store.loads(study.sheets.size(), now - timeout));
    Json sheets = Json::array(), pairs = Json::array(), places = Json::array();
    for (std::size_t i = 0; i < by_sheet.size(); ++i) {
        sheets.push_back({{"sheet", i}});
        sheets.back().update(json_of(by_sheet[i]));
    }
    const Balance balance = count_balance(study, store, participants);
    for (const auto& [pair, answers] : balance.pairs) {
        pairs.push_back({{"left", pair.first}, {"right", pair.second}, {"answers", answers}});
    }
    for (const auto& [place, answers] : balance.places) {
        places.push_back({{"place", place.first}, {"condition", place.second}, {"answers", answers}});
    }
    return {{"time", utc_text(now)},
            {"participants", std::move(people)},
            {"full", study.wanted && taken >= *study.wanted},
            {"unfilled_links", unfilled},
            {"answers", store.count_answers()},
            {"sheets", std::move(sheets)},
            {"pairs", std::move(pairs)},
            {"places", std::move(places)},
            {"last", last_answers(study, store, participants)}};
}

Json to_json(const Failures& failures) {
    if (failures.count == 0) return nullptr;
    return {{"count", failures.count}, {"last", failures.last}, {"time", utc_text(failures.time)}};
}

Json to_json(const std::vector<Incident>& incidents) {
    Json list = Json::array();
    for (const Incident& incident : incidents)
        list.push_back({{"what", incident.what}, {"time", utc_text(incident.time)}});
    return list;
}

std::string operator_page(const ServedStudy& study, const Json& progress) {
    const std::vector<std::string> people = {"begun",       "finished",      "active",
                                             "dropped_out", "failed_checks", "declined"};
    std::vector<std::string> all = people, sheet = people;
    all.insert(all.end(), {"withdrawn", "wanted"});
    sheet.insert(sheet.begin(), "sheet");
    std::string body = format(
        "<h1>{}</h1>\n<p>{}, serving since {} · {} answers · <a href=\"/operator/answers.json\" "
        "download>Download all answers</a> · <a href=\"/operator/progress.json\">These numbers as "
        "JSON</a></p>\n",
        escape_html(study.pages.title), progress.at("time").get<std::string>(),
        progress.at("serving_since").get<std::string>(), progress.at("answers").get<std::size_t>());
    if (const Json& failures = progress.at("failures"); !failures.is_null()) {
        body += format(
            "<p role=\"alert\"><strong>{} requests could not be stored or read, the last one at {}: "
            "{}</strong></p>\n",
            failures.at("count").get<std::size_t>(), failures.at("time").get<std::string>(),
            escape_html(failures.at("last").get<std::string>()));
    }
    for (const Json& incident : progress.at("incidents")) {
        body +=
            format("<p role=\"alert\"><strong>{}: {}</strong></p>\n", incident.at("time").get<std::string>(),
                   escape_html(incident.at("what").get<std::string>()));
    }
    if (progress.at("full") == true)
        body +=
            "<p>Newcomers are sent away: as many as are wanted have finished or are at work. To let more come, start "
            "the server again with --participants N, the number of all.</p>\n";
    if (const auto unfilled = progress.at("unfilled_links").get<std::size_t>(); unfilled > 0) {
        body += format(
            "<p role=\"alert\"><strong>Participants who came by a link that the panel had not filled in, such as "
            "{{{{%PROLIFIC_PID%}}}}: {}. Their names are drawn; correct the link.</strong></p>\n",
            unfilled);
    }
    body += note_of_those_sent_away(progress.at("sent_away"));
    body += table("Participants", all, Json::array({progress.at("participants")}));
    if (!progress.at("pairs").empty()) {
        body += table("Pairs as shown", {"left", "right", "answers"}, progress.at("pairs"));
    }
    if (!progress.at("places").empty()) {
        body += table("Conditions at each place, from left to right", {"place", "condition", "answers"},
                      numbered_from_1(progress.at("places"), "place"));
    }
    body += table("Sheets", sheet, progress.at("sheets"));
    body += table("Last answers", {"time", "participant", "number", "clip", "conditions"},
                  numbered_from_1(progress.at("last"), "number"));
    return page(study.pages.title, "<meta http-equiv=\"refresh\" content=\"15\">", body);
}

std::string login_page(bool wrong) {
    const std::string note = wrong ? "<p role=\"alert\">This is not the token.</p>\n" : "";
    return page("Operator", "",
                "<h1>Operator</h1>\n" + note +
                    "<form method=\"post\" action=\"/operator/login\"><label>Token, as it was given to the "
                    "server or printed at its start <input type=\"password\" name=\"token\" "
                    "autocomplete=\"off\" required autofocus></label> "
                    "<button>Open</button></form>\n");
}

}  // namespace chironomia::study::server
