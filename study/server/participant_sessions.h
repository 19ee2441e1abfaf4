// What the server answers to the page: who gets which sheet, what is stored, and where people go at the end.
// It uses no sockets; times and secrets are arguments.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/record/failed_checks.h"
#include "study/server/answer_store.h"
#include "study/server/served_study.h"

namespace chironomia::study::server {

struct Reply {
    int status = 200;  // of HTTP
    Json body;         // {"error": "..."} of a refusal
};

// What the server knows of a participant who arrives.
struct Arrival {
    std::int64_t now = 0;                                // ms since 1970
    std::string session;                                 // a fresh secret, for a newcomer
    std::function<bool()> admits = [] { return true; };  // whether the client may bring one more newcomer
};

class ParticipantSessions {
  public:
    // A participant who sends nothing for `timeout` milliseconds has dropped out: the sheet is free again.
    ParticipantSessions(const ServedStudy& study, std::int64_t timeout) : study_(study), timeout_(timeout) {}

    // `body` is what the page sent, `now` in milliseconds since 1970. A participant who comes back needs no admission.
    Reply begin(AnswerStore& store, const Json& body, const Arrival& arrival) const;
    Reply answer(AnswerStore& store, const Json& body, std::int64_t now) const;
    Reply finish(AnswerStore& store, const Json& body, std::int64_t now) const;
    Reply decline(AnswerStore& store, const Json& body) const;

    // All that is stored of the one who asks, under the names of the columns, with "answers" as a list. Videos have the
    // names under which they were shown.
    Reply stored(AnswerStore& store, const Json& body) const;

    struct Withdrawal {
        Reply reply;
        std::string name;  // who is gone; empty: nobody
    };
    // Deletes the one who asks, with all answers (AnswerStore::forget). The log and copies are left to
    // Site::withdraw().
    Withdrawal withdraw(AnswerStore& store, const Json& body) const;

  private:
    // An answer as the page sent it.
    struct SentAnswer {
        std::size_t number = 0;  // of the participant's answers
        Json entry;
        std::int64_t received = 0;  // ms since 1970
    };

    std::vector<PageAnswer> answers_of(AnswerStore& store, const Participant& participant) const;
    Json tokens_of_showings(const Participant& participant, std::size_t number) const;
    Json with_own_tokens(const Participant& participant, std::size_t number, Json entry) const;
    Reply store_answer(AnswerStore& store, const Participant& participant, const SentAnswer& sent) const;
    Json stored_json(AnswerStore& store, const Participant& participant) const;
    Json completion_of(const Participant& participant) const;

    const ServedStudy& study_;
    std::int64_t timeout_;
};

}  // namespace chironomia::study::server
