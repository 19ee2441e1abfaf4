#include "study/server/forget.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/json_depth.h"
#include "core/text.h"
#include "study/record/link_parameters.h"
#include "study/record/pages.h"
#include "study/record/study_folder.h"
#include "study/server/answer_store.h"
#include "study/server/answers_file.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;

bool begins_with(const fs::path& file, std::string_view beginning) {
    std::string bytes(beginning.size(), '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return stream && bytes == beginning;
}

bool is_database(const fs::path& file) {
    return begins_with(file, std::string_view("SQLite format 3\0", 16));
}

bool is_of(const Json& answers, const std::string& study) {
    return answers.is_object() && answers.value("format", Json()) == "chironomia answers 2" &&
           answers.value("study", Json()) == study && answers.value("simulated", Json(false)) != true;
}

bool is_named(const Json& answers, const std::string& name) {
    const auto is_name = [&](const Json& text) {
        return text.is_string() && plain_name(text.get_ref<const std::string&>()) == plain_name(name);
    };
    const Json arrived = answers.value("arrived_with", Json());
    return is_name(answers.value("participant", Json())) ||
           (arrived.is_object() && is_name(arrived.value("PROLIFIC_PID", Json())));
}

enum class Held { nothing, others, the_participant };

// Whose answers are looked for, and whether they are deleted where they are found.
struct Sought {
    std::string study;
    std::string name;
    bool is_deleted = true;
};

// One participant's answers in a file of their own, or a list of those of many.
Held forget_in_answers(const fs::path& file, const Sought& sought) {
    const std::string text = read_text(file);
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded() || json_depth(text) > kDeepestJson) return Held::nothing;
    const bool is_list = json.is_array();
    if (!is_list) json = Json::array({json});
    const auto fits = [&](const Json& answers) { return is_of(answers, sought.study); };
    if (!std::all_of(json.begin(), json.end(), fits)) return Held::nothing;
    Json kept = Json::array();
    for (Json& answers : json) {
        if (!is_named(answers, sought.name)) kept.push_back(std::move(answers));
    }
    if (kept.size() == json.size()) return Held::others;
    if (!sought.is_deleted) return Held::the_participant;
    if (is_list) {
        write_text(file, kept.dump(1) + "\n");
    } else {
        fs::remove(fs::canonical(file));
        fs::remove(file);  // where it was a link
    }
    return Held::the_participant;
}

void forget_in(AnswerStore& store, const Participant& participant) {
    store.database().run("BEGIN IMMEDIATE");
    store.forget(participant.id);
    store.database().run("COMMIT");
    store.database().empty_log();
}

Held forget_in_copy(const fs::path& file, const Sought& sought) {
    const std::vector<Participant> found =
        AnswerStore(file, Database::Use::read, sought.study).find_by_name(sought.name);
    if (found.empty()) return Held::others;
    if (sought.is_deleted) {
        AnswerStore store(file, Database::Use::write, sought.study);
        for (const Participant& participant : found) forget_in(store, participant);
    }
    return Held::the_participant;
}

// Copies of databases of other studies are left as they are.
Held forget_in_file(const fs::path& file, const Sought& sought) {
    if (!is_database(file)) return forget_in_answers(file, sought);
    try {
        return forget_in_copy(file, sought);
    } catch (const Error&) {
        return Held::nothing;
    }
}

bool is_letter_of_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

// Whether a text has the name as a word of its own.
bool names(const std::string& text, const std::string& name) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool begins = at == 0 || !is_letter_of_name(text[at - 1]);
        if (begins && (end == text.size() || !is_letter_of_name(text[end]))) return true;
    }
    return false;
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    if (!fs::is_directory(folder)) return files;
    for (const std::string& name : list_files(folder)) {
        if (fs::is_regular_file(folder / name)) files.push_back(folder / name);
    }
    return files;
}

std::vector<fs::path> files_naming(const fs::path& folder, const std::string& name) {
    std::vector<fs::path> found;
    for (const fs::path& file : files_in(folder)) {
        if (names(read_text(file), name)) found.push_back(file);
    }
    return found;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code none;
    return fs::equivalent(a, b, none);
}

// The database that is in use is changed by its own store, and its log and lock with it. They must not even be opened
// here (database.cpp).
bool belongs_to(const fs::path& file, const fs::path& database) {
    const auto is_beside = [&](const char* ending) { return is_same_file(file, database.string() + ending); };
    return std::ranges::any_of(std::array{"", "-wal", "-shm", "-journal", ".lock"}, is_beside);
}

// Nobody: they have withdrawn on the page, or were deleted by an earlier call.
std::optional<Participant> find_only(AnswerStore& store, const fs::path& database, const std::string& name) {
    const std::vector<Participant> found = store.find_by_name(name);
    if (found.empty()) return std::nullopt;
    if (found.size() > 1) {
        throw Error(
            format("{}: {} participants came as \"{}\", \"{}\" and \"{}\" among them; give the name of one",
                   database.string(), found.size(), name, found[0].name, found[1].name));
    }
    return found.front();
}

// Those of the files given that hold the participant. Throws Error if one holds no answers to the study.
std::vector<fs::path> given_files_with(const ForgetJob& job, const Sought& sought) {
    std::vector<fs::path> found;
    for (const fs::path& file : job.also) {
        const Held held = forget_in_file(file, sought);
        if (held == Held::nothing) {
            throw Error(
                format("{}: holds no answers to study {}, and nothing was deleted anywhere; give files that "
                       "`study answers` wrote, or copies of the database",
                       file.string(), sought.study));
        }
        if (held == Held::the_participant) found.push_back(file);
    }
    return found;
}

// Files that are replaced or removed where a participant is deleted, while their other names keep the old bytes.
std::vector<fs::path> files_with_more_names(const ForgetJob& job) {
    std::vector<fs::path> found = files_in(StudyFolder{job.study}.closed());
    found.insert(found.end(), job.also.begin(), job.also.end());
    std::erase_if(found, [](const fs::path& file) {
        return !fs::is_regular_file(file) || fs::hard_link_count(file) < 2 || is_database(file);
    });
    return found;
}

}  // namespace

std::vector<fs::path> forget_in_copies(const fs::path& study, const fs::path& database,
                                       const std::string& name) {
    const std::string token = read_study_pages(StudyFolder{study}.open() / "pages.json").study;
    std::vector<fs::path> changed;
    for (const fs::path& file : files_in(StudyFolder{study}.closed())) {
        if (belongs_to(file, database) || (!file.string().ends_with(".json") && !is_database(file))) continue;
        if (forget_in_file(file, {token, name}) == Held::the_participant) changed.push_back(file);
    }
    return changed;
}

ForgetSummary forget_participant(const ForgetJob& job) {
    const StudyFolder study{job.study};
    const fs::path database = job.database.empty() ? default_database(job.study) : job.database;
    const std::string token = read_study_pages(study.open() / "pages.json").study;
    require_database(database);
    ForgetSummary summary{.name = job.name};
    const std::vector<fs::path> with_more_names = files_with_more_names(job);
    {
        AnswerStore store(database, Database::Use::write, token);
        const std::optional<Participant> participant = find_only(store, database, job.name);
        if (participant) summary.name = participant->name;
        // Before anything is deleted: a file that cannot be read must not end this half way.
        const bool is_in_files = !given_files_with(job, {token, summary.name, false}).empty();
        if (!participant && !is_in_files) {
            throw Error(format(
                "{}: no participant is called \"{}\"{}; the names are those that `chironomia study answers` "
                "writes",
                database.string(), job.name, job.also.empty() ? "" : ", nor in the files of --also"));
        }
        if (participant) {
            summary.was_in_database = true;
            summary.answers = store.count_answers(participant->id);
            summary.changed.push_back(database);
            forget_in(store, *participant);
        }
    }
    for (const auto& files :
         {forget_in_copies(job.study, database, summary.name), given_files_with(job, {token, summary.name})})
        summary.changed.insert(summary.changed.end(), files.begin(), files.end());
    for (const fs::path& file : summary.changed) {
        if (std::ranges::find(with_more_names, file) != with_more_names.end())
            summary.elsewhere.push_back(file);
    }
    const fs::path analysis = study.closed() / "analysis";
    if (!files_naming(analysis, summary.name).empty()) {
        fs::remove_all(analysis);
        summary.removed.push_back(analysis);
    }
    summary.naming = files_naming(study.closed(), summary.name);
    return summary;
}

}  // namespace chironomia::study::server
