#include "study/server/answer_store.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study::server {
namespace {

constexpr const char* kFormat = "chironomia answers database 1";

constexpr const char* kTables = R"(
CREATE TABLE IF NOT EXISTS study (format TEXT NOT NULL, study TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS participants (
    id INTEGER PRIMARY KEY, session TEXT NOT NULL UNIQUE, identity TEXT UNIQUE, name TEXT NOT NULL,
    sheet INTEGER NOT NULL, arrived_with TEXT NOT NULL, browser TEXT NOT NULL, started INTEGER NOT NULL,
    seen INTEGER NOT NULL, finished INTEGER, questionnaire TEXT NOT NULL DEFAULT '{}',
    failed INTEGER NOT NULL DEFAULT 0, declined INTEGER NOT NULL DEFAULT 0);
CREATE TABLE IF NOT EXISTS answers (
    participant INTEGER NOT NULL REFERENCES participants (id), number INTEGER NOT NULL, entry TEXT NOT NULL,
    received INTEGER NOT NULL, PRIMARY KEY (participant, number)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS withdrawals (count INTEGER NOT NULL);
INSERT INTO withdrawals SELECT 0 WHERE NOT EXISTS (SELECT 1 FROM withdrawals);
CREATE INDEX IF NOT EXISTS participants_by_name ON participants (name);
CREATE INDEX IF NOT EXISTS answers_by_time ON answers (received);
)";

Participant participant_of(const Statement& row) {
    Participant found{.id = row.integer(0),
                      .session = row.text(1),
                      .identity = row.text(2),
                      .name = row.text(3),
                      .sheet = static_cast<std::size_t>(row.integer(4)),
                      .arrived_with = row.text(5),
                      .browser = row.text(6),
                      .started = row.integer(7),
                      .seen = row.integer(8),
                      .questionnaire = row.text(10),
                      .failed = row.integer(11) != 0,
                      .declined = row.integer(12) != 0};
    if (row.is_null(2)) found.identity.reset();
    if (!row.is_null(9)) found.finished = row.integer(9);
    return found;
}

std::vector<StoredAnswer> answers_in(Statement rows) {
    std::vector<StoredAnswer> found;
    while (rows.step()) {
        found.push_back({.participant = rows.integer(0),
                         .number = static_cast<std::size_t>(rows.integer(1)),
                         .entry = rows.text(2),
                         .received = rows.integer(3)});
    }
    return found;
}

constexpr const char* kSelectAnswers = "SELECT participant, number, entry, received FROM answers ";

void check_study(Database& database, const std::filesystem::path& file, const std::string& study) {
    Statement row = database.prepare("SELECT format, study FROM study");
    const bool found = row.step();
    if (!found || row.text(0) != kFormat || row.text(1) != study) {
        throw Error(
            format("{}: holds \"{}\" of study {}, but \"{}\" of study {} is needed; give another file with "
                   "--database",
                   file.string(), found ? row.text(0) : "", found ? row.text(1) : "", kFormat, study));
    }
}

}  // namespace

const std::filesystem::path& check_database(const std::filesystem::path& file, const std::string& study) {
    std::error_code missing;
    if (const auto bytes = std::filesystem::file_size(file, missing); missing || bytes == 0) return file;
    Database database(file, Database::Use::read);
    // One that was being made when the program was killed has no tables yet.
    if (database.prepare("SELECT 1 FROM sqlite_master").step()) check_study(database, file, study);
    return file;
}

AnswerStore::AnswerStore(const std::filesystem::path& file, Database::Use use, const std::string& study)
    : database_(use == Database::Use::write ? check_database(file, study) : file, use) {
    if (use == Database::Use::write) {
        database_.run(std::string("BEGIN IMMEDIATE;") + kTables);
        if (!database_.prepare("SELECT 1 FROM study").step()) {
            database_.prepare("INSERT INTO study VALUES (?1, ?2)")
                .bind(1, std::string(kFormat))
                .bind(2, study)
                .step();
        }
        database_.run("COMMIT");
    }
    check_study(database_, file, study);
}

std::vector<Participant> AnswerStore::select(const std::string& where,
                                             const std::optional<std::string>& value) {
    Statement rows = database_.prepare(
        "SELECT id, session, identity, name, sheet, arrived_with, browser, started, seen, finished, "
        "questionnaire, failed, declined FROM participants " +
        where);
    if (value) rows.bind(1, *value);
    std::vector<Participant> found;
    while (rows.step()) found.push_back(participant_of(rows));
    return found;
}

std::optional<Participant> AnswerStore::find_by_session(const std::string& session) {
    const auto found = select("WHERE session = ?1", session);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<Participant> AnswerStore::find_by_identity(const std::string& identity) {
    const auto found = select("WHERE identity = ?1", identity);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<Participant> AnswerStore::find_by_name(const std::string& name) {
    const auto named = select("WHERE name = ?1", name);
    return named.empty() ? select("WHERE identity IN ('prolific:' || ?1, 'name:' || ?1)", name) : named;
}

std::vector<Participant> AnswerStore::participants() {
    return select("ORDER BY id", std::nullopt);
}

void AnswerStore::add(const Participant& participant) {
    database_
        .prepare(
            "INSERT INTO participants (session, identity, name, sheet, arrived_with, browser, started, seen) "
            "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)")
        .bind(1, participant.session)
        .bind(2, participant.identity)
        .bind(3, free_name(participant.name))
        .bind(4, static_cast<std::int64_t>(participant.sheet))
        .bind(5, participant.arrived_with)
        .bind(6, participant.browser)
        .bind(7, participant.started)
        .bind(8, participant.seen)
        .step();
}

// The analysis knows participants by their names.
std::string AnswerStore::free_name(const std::string& wanted) {
    Statement row = database_.prepare("SELECT coalesce(max(id), 0) FROM participants");
    row.step();
    std::string name = wanted.empty() ? format("p-{}", row.integer(0) + 1) : wanted;
    for (int number = 2; !select("WHERE name = ?1", name).empty(); ++number)
        name = format("{}-{}", wanted.empty() ? "p" : wanted, number);
    return name;
}

void AnswerStore::mark_active(std::int64_t participant, std::int64_t now) {
    database_.prepare("UPDATE participants SET seen = ?2, declined = 0 WHERE id = ?1")
        .bind(1, participant)
        .bind(2, now)
        .step();
}

void AnswerStore::shift_last_active(std::int64_t by) {
    database_.prepare("UPDATE participants SET seen = seen + ?1 WHERE finished IS NULL").bind(1, by).step();
}

void AnswerStore::limit_last_active(std::int64_t now) {
    database_.prepare("UPDATE participants SET seen = ?1 WHERE seen > ?1").bind(1, now).step();
}

void AnswerStore::finish(const Participant& participant) {
    database_.prepare("UPDATE participants SET finished = ?2, questionnaire = ?3, failed = ?4 WHERE id = ?1")
        .bind(1, participant.id)
        .bind(2, participant.finished.value())
        .bind(3, participant.questionnaire)
        .bind(4, std::int64_t{participant.failed})
        .step();
}

void AnswerStore::decline(std::int64_t participant) {
    database_.prepare("UPDATE participants SET declined = 1 WHERE id = ?1").bind(1, participant).step();
}

void AnswerStore::forget(std::int64_t participant) {
    database_.prepare("DELETE FROM answers WHERE participant = ?1").bind(1, participant).step();
    database_.prepare("DELETE FROM participants WHERE id = ?1").bind(1, participant).step();
    database_.run("UPDATE withdrawals SET count = count + 1");
}

std::size_t AnswerStore::count_withdrawals() {
    Statement row = database_.prepare("SELECT count FROM withdrawals");
    return row.step() ? static_cast<std::size_t>(row.integer(0)) : 0;
}

std::size_t AnswerStore::count_answers(std::int64_t participant) {
    Statement row = database_.prepare("SELECT count(*) FROM answers WHERE participant = ?1");
    row.bind(1, participant).step();
    return static_cast<std::size_t>(row.integer(0));
}

std::optional<std::string> AnswerStore::find_answer(std::int64_t participant, std::size_t number) {
    Statement row = database_.prepare("SELECT entry FROM answers WHERE participant = ?1 AND number = ?2");
    if (!row.bind(1, participant).bind(2, static_cast<std::int64_t>(number)).step()) return std::nullopt;
    return row.text(0);
}

void AnswerStore::add(const StoredAnswer& answer) {
    database_.prepare("INSERT INTO answers VALUES (?1, ?2, ?3, ?4)")
        .bind(1, answer.participant)
        .bind(2, static_cast<std::int64_t>(answer.number))
        .bind(3, answer.entry)
        .bind(4, answer.received)
        .step();
}

std::vector<StoredAnswer> AnswerStore::answers_of(std::int64_t participant) {
    Statement rows =
        database_.prepare(std::string(kSelectAnswers) + "WHERE participant = ?1 ORDER BY number");
    rows.bind(1, participant);
    return answers_in(std::move(rows));
}

std::vector<StoredAnswer> AnswerStore::last_answers(std::size_t most) {
    Statement rows = database_.prepare(std::string(kSelectAnswers) + "ORDER BY received DESC LIMIT ?1");
    rows.bind(1, static_cast<std::int64_t>(most));
    return answers_in(std::move(rows));
}

std::size_t AnswerStore::count_answers() {
    Statement row = database_.prepare("SELECT count(*) FROM answers");
    row.step();
    return static_cast<std::size_t>(row.integer(0));
}

std::vector<SheetLoad> AnswerStore::loads(std::size_t sheets, std::int64_t since) {
    Statement rows = database_.prepare(
        "SELECT sheet, sum(finished IS NOT NULL), sum(finished IS NULL AND seen >= ?1) FROM participants "
        "WHERE NOT failed AND NOT declined GROUP BY sheet");
    rows.bind(1, since);
    std::vector<SheetLoad> loads(sheets);
    while (rows.step()) {
        loads.at(static_cast<std::size_t>(rows.integer(0))) = {
            .finished = static_cast<std::size_t>(rows.integer(1)),
            .active = static_cast<std::size_t>(rows.integer(2))};
    }
    return loads;
}

}  // namespace chironomia::study::server
