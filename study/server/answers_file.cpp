#include "study/server/answers_file.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_depth.h"
#include "core/files/private_output.h"
#include "core/text.h"
#include "study/record/pages.h"
#include "study/record/study_folder.h"
#include "study/server/clock.h"

namespace chironomia::study::server {
namespace {

std::string text_of(const Json& answers, const std::filesystem::path& database) {
    try {
        return answers.dump();
    } catch (const Json::exception&) {
        throw Error(format("{}: holds text that is not UTF-8; take a whole copy of it", database.string()));
    }
}

// Hands the text of the array of answers to `write_piece`, a participant at a time.
AnswersSummary stream_answers(const std::filesystem::path& database, const std::string& study,
                              const std::function<void(std::string_view)>& write_piece) {
    AnswerStore store(database, Database::Use::read, study);
    // One transaction, so that answers that come in meanwhile change nothing.
    store.database().run("BEGIN");
    AnswersSummary summary;
    for (const Participant& participant : store.participants()) {
        const Json answers = answers_json(store, participant, study);
        write_piece(summary.participants == 0 ? "[\n" : ",\n");
        write_piece(text_of(answers, database));
        ++summary.participants;
        summary.finished += participant.finished.has_value();
        summary.answers += answers.at("answers").size();
    }
    write_piece(summary.participants == 0 ? "[]\n" : "\n]\n");
    return summary;
}

Json parse_stored(const std::string& text, const std::string& participant) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded() || json_depth(text) > kDeepestJson)
        throw Error(
            format("what is stored of {} is no JSON; take a whole copy of the database", participant));
    return json;
}

}  // namespace

Json answers_json(AnswerStore& store, const Participant& participant, const std::string& study) {
    Json answers = Json::array();
    for (const StoredAnswer& answer : store.answers_of(participant.id))
        answers.push_back(parse_stored(answer.entry, participant.name));
    return {{"format", "chironomia answers 2"},
            {"study", study},
            {"participant", participant.name},
            {"sheet", participant.sheet},
            {"simulated", false},
            {"started", utc_text(participant.started)},
            {"finished", participant.finished ? Json(utc_text(*participant.finished)) : Json(nullptr)},
            {"browser", participant.browser},
            {"arrived_with", parse_stored(participant.arrived_with, participant.name)},
            {"questionnaire", parse_stored(participant.questionnaire, participant.name)},
            {"answers", std::move(answers)}};
}

AnswersFile open_answers(const std::filesystem::path& database, const std::string& study) {
    std::string name = (database.parent_path() / ".answers.XXXXXX").string();
    AnswersFile answers{.file = OpenFile(mkstemp(name.data()))};
    if (answers.file.descriptor() < 0) {
        throw Error(format("{}: cannot be written; check the permissions of its folder", name));
    }
    unlink(name.c_str());
    stream_answers(database, study, [&](std::string_view piece) {
        while (!piece.empty()) {
            const ssize_t count = write(answers.file.descriptor(), piece.data(), piece.size());
            if (count < 0) throw Error(format("{}: cannot be written; check that the disk has space", name));
            answers.size += static_cast<std::uint64_t>(count);
            piece.remove_prefix(static_cast<std::size_t>(count));
        }
    });
    return answers;
}

std::filesystem::path default_database(const std::filesystem::path& study) {
    return StudyFolder{study}.answers();
}

void require_database(const std::filesystem::path& file) {
    if (std::filesystem::exists(file)) return;
    throw Error(
        format("{}: there is no database of answers; `chironomia study serve` makes it, or name it with "
               "--database",
               file.string()));
}

AnswersSummary write_answers(const std::filesystem::path& study, const std::filesystem::path& database,
                             const std::filesystem::path& out) {
    const std::filesystem::path file = database.empty() ? default_database(study) : database;
    const StudyPages pages = read_study_pages(study / "public" / "pages.json");
    require_database(file);
    PendingOutput pending(out, PendingOutput::Kind::file);
    keep_private(pending);
    std::ofstream stream(pending.path(), std::ios::binary);
    const AnswersSummary summary =
        stream_answers(file, pages.study, [&stream](std::string_view piece) { stream << piece; });
    stream.close();
    if (!stream) throw Error(format("{}: cannot be written; check that the disk has space", out.string()));
    pending.commit();
    return summary;
}

}  // namespace chironomia::study::server
