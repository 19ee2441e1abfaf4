#include "study/exports/pack_study.h"

#include <map>

#include "core/error.h"
#include "core/files/json.h"
#include "core/files/zip_archive.h"
#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/record/study_folder.h"
#include "study/record/study_record.h"
#include "study/server/answers_file.h"
#include "study/server/served_study.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

// By path the hash that the build wrote down; empty without a manifest.
std::map<std::string, std::string> hashes_of_build(const StudyFolder& study) {
    std::map<std::string, std::string> hashes;
    if (!fs::exists(study.manifest())) return hashes;
    for (const ListedFile& file : read_manifest(study.manifest()).outputs) hashes[file.path] = file.sha256;
    return hashes;
}

void require_as_built(const std::map<std::string, std::string>& built, const std::string& path,
                      const std::string& hash) {
    const auto known = built.find(path);
    if (known == built.end() || known->second == hash) return;
    throw Error(format(
        "{}: has the SHA-256 {}, private/manifest.json says {}; build the study again before it is packed",
        path, hash, known->second));
}

// Without names, links and browsers.
Json numbered_answers(const PackJob& job, const std::string& study) {
    const fs::path file = job.database.empty() ? server::default_database(job.study) : job.database;
    server::require_database(file);
    server::AnswerStore store(file, server::Database::Use::read, study);
    store.database().run("BEGIN");
    Json all = Json::array();
    for (const server::Participant& participant : store.participants()) {
        Json answers = answers_json(store, participant, study);
        answers["participant"] = format("p-{}", participant.id);
        answers["browser"] = "";
        answers["arrived_with"] = Json::object();
        all.push_back(std::move(answers));
    }
    return all;
}

}  // namespace

PackSummary pack_study(const PackJob& job) {
    const server::ServedStudy study = server::read_served_study(job.study);
    const StudyFolder folder{job.study};
    std::vector<ZipEntry> entries;
    for (const std::string& name : list_files(folder.open()))
        entries.push_back({.name = "public/" + name, .file = folder.open() / name, .text = {}});
    if (job.with_key) {
        for (const fs::path& file :
             {folder.key(), folder.plan(), folder.recordings(), folder.report(), folder.manifest()}) {
            if (fs::exists(file))
                entries.push_back({.name = "private/" + file.filename().string(), .file = file, .text = {}});
        }
    }
    PackSummary summary;
    if (job.with_answers) {
        const Json answers = numbered_answers(job, study.pages.study);
        summary.participants = answers.size();
        entries.push_back({.name = "answers.json", .file = {}, .text = answers.dump(1) + "\n"});
    }

    const std::map<std::string, std::string> built = hashes_of_build(folder);
    Json files = Json::array();
    std::string sums;
    for (const ZipEntry& entry : entries) {
        const std::string hash = entry.file.empty() ? sha256(entry.text) : sha256_of_file(entry.file);
        require_as_built(built, entry.name, hash);
        const std::uintmax_t bytes = entry.file.empty() ? entry.text.size() : fs::file_size(entry.file);
        files.push_back({{"path", entry.name}, {"sha256", hash}, {"bytes", bytes}});
        sums += format("{}  {}\n", hash, entry.name);
    }
    const Json manifest = {
        {"format", "chironomia archive 1"}, {"study", study.pages.study}, {"title", study.pages.title},
        {"program", program_version()},     {"key", job.with_key},        {"answers", job.with_answers},
        {"files", std::move(files)}};
    entries.push_back({.name = "archive.json", .file = {}, .text = manifest.dump(2) + "\n"});
    entries.push_back({.name = "SHA256SUMS", .file = {}, .text = sums});
    write_zip(job.out, entries, job.with_key);
    summary.files = entries.size();
    summary.bytes = fs::file_size(job.out);
    return summary;
}

}  // namespace chironomia::study
