// The answers as others read them: an array of `chironomia answers 2` (docs/study_files.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/files/json.h"
#include "study/server/answer_store.h"
#include "study/server/public_files.h"

namespace chironomia::study::server {

// One participant's answers.
Json answers_json(AnswerStore& store, const Participant& participant, const std::string& study);

// The array in a file without a name, which is gone when it is closed; memory does not grow with the
// participants.
struct AnswersFile {
    OpenFile file;
    std::uint64_t size = 0;  // bytes
};

// Throws Error if the database is missing, damaged or of another study, or its folder cannot be written.
AnswersFile open_answers(const std::filesystem::path& database, const std::string& study);

struct AnswersSummary {
    std::size_t participants = 0;
    std::size_t finished = 0;
    std::size_t answers = 0;
};

// Writes all answers of a study's folder to a file, whole or not at all; a server may be running. An empty
// `database` means private/answers.sqlite. Throws Error if there is no study or no database.
AnswersSummary write_answers(const std::filesystem::path& study, const std::filesystem::path& database,
                             const std::filesystem::path& out);

// Throws Error if there is no such file.
void require_database(const std::filesystem::path& file);

// DIR/private/answers.sqlite
std::filesystem::path default_database(const std::filesystem::path& study);

}  // namespace chironomia::study::server
