// Who takes part and what they answered, in a database.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/server/assignment.h"
#include "study/server/database.h"

namespace chironomia::study::server {

// Times are milliseconds since 1970.
struct Participant {
    std::int64_t id = 0;
    std::string session;                  // a secret
    std::optional<std::string> identity;  // recognises who comes back; none: only the session does
    std::string name;
    std::size_t sheet = 0;
    std::string arrived_with;  // JSON object of texts
    std::string browser;
    std::int64_t started = 0;
    std::int64_t seen = 0;  // last active
    std::optional<std::int64_t> finished{};
    std::string questionnaire = "{}";  // JSON object of values
    bool failed = false;               // too many attention checks
    bool declined = false;
};

struct StoredAnswer {
    std::int64_t participant = 0;
    std::size_t number = 0;  // of the step on the participant's sheet
    std::string entry;       // JSON, an entry of `answers`
    std::int64_t received = 0;
};

// Reads alone, so that another program's database stays as it is. Throws Error if there is a file and it holds
// anything but answers to this study; gives the file back.
const std::filesystem::path& check_database(const std::filesystem::path& file, const std::string& study);

class AnswerStore {
  public:
    // Throws Error if the database cannot be opened or holds answers to another study.
    AnswerStore(const std::filesystem::path& file, Database::Use use, const std::string& study);

    std::optional<Participant> find_by_session(const std::string& session);
    std::optional<Participant> find_by_identity(const std::string& identity);
    std::vector<Participant> participants();  // in the order in which they came
    // By the name, or by the PROLIFIC_PID or the name of the link where another one was given.
    std::vector<Participant> find_by_name(const std::string& name);

    // Chooses the id; and where there is no name, or another participant has it, another one: "p-7", "ada-2".
    void add(const Participant& participant);
    void mark_active(std::int64_t participant, std::int64_t now);  // seen now, and has not declined
    // The clock was set by so many milliseconds: participants at work still are.
    void shift_last_active(std::int64_t by);
    // None is later than `now`: a clock that was set back while no server ran would keep places taken.
    void limit_last_active(std::int64_t now);
    void finish(const Participant& participant);  // finished, questionnaire, failed
    void decline(std::int64_t participant);

    // Deletes the participant with all answers; only the number of those who were deleted stays.
    void forget(std::int64_t participant);
    std::size_t count_withdrawals();

    std::size_t count_answers(std::int64_t participant);
    std::optional<std::string> find_answer(std::int64_t participant, std::size_t number);  // the entry
    void add(const StoredAnswer& answer);
    std::vector<StoredAnswer> answers_of(std::int64_t participant);  // in order
    std::vector<StoredAnswer> last_answers(std::size_t most);        // the latest first
    std::size_t count_answers();

    // Of each sheet. Active is who was seen at `since` or later.
    std::vector<SheetLoad> loads(std::size_t sheets, std::int64_t since);

    Database& database() { return database_; }

  private:
    std::string free_name(const std::string& wanted);
    std::vector<Participant> select(const std::string& where, const std::optional<std::string>& value);

    Database database_;
};

}  // namespace chironomia::study::server
