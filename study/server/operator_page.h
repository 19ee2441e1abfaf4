// What the people who run a study see of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/server/answer_store.h"
#include "study/server/served_study.h"

namespace chironomia::study::server {

// Requests that could not be answered since the server began.
struct Failures {
    std::size_t count = 0;
    std::string last;       // why
    std::int64_t time = 0;  // of the last one, ms since 1970
};

// Something that happened to the server without a request failing.
struct Incident {
    std::string what;
    std::int64_t time = 0;  // ms since 1970
};

// How far a study is. Participants not seen since `now - timeout` (milliseconds) have dropped out.
//   {"participants": {"begun", "finished", "active", "dropped_out", "failed_checks", "declined", "withdrawn",
//   "wanted"},
//   "answers",
//    "sheets": [{"sheet", "begun", "finished", "active", "dropped_out"}],
//    "pairs": [{"left", "right", "answers"}], "places": [{"place", "condition", "answers"}],
//    "last": [{"time", "participant", "number", "clip", "conditions"}]}
// Pairs and places count the answers to trials as the participants saw them.
Json study_progress(const ServedStudy& study, AnswerStore& store, std::int64_t now, std::int64_t timeout);

// {"count", "last", "time"}, or null if there are none.
Json to_json(const Failures& failures);

// [{"what", "time"}]
Json to_json(const std::vector<Incident>& incidents);

// The page for the operator; it reloads itself. `progress` is that of the study with what the server adds: "failures",
// "incidents", "serving_since" (when it was started) and "sent_away" ({"connections", "requests"}).
std::string operator_page(const ServedStudy& study, const Json& progress);

// The page that asks for the token; `wrong` says that the last one was.
std::string login_page(bool wrong);

}  // namespace chironomia::study::server
