#include "synth/corpus/make/unfinished_corpus.h"

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/corpus_entries.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOrder = ".order.json";
constexpr const char* kNotes = ".made";

// The settings in which two orders differ: "seed 2 and not 1".
std::string differences(const Json& asked, const Json& found) {
    std::vector<std::string> parts;
    for (const auto& [key, value] : asked.items()) {
        const Json other = found.value(key, Json());
        if (other != value) parts.push_back(format("{} {} and not {}", key, value.dump(), other.dump()));
    }
    return join(parts);
}

void check_order(const fs::path& folder, const Json& order) {
    const Json found = read_json(folder / kOrder);
    if (found == order) return;
    throw Error(
        format("{}: an unfinished making of another order waits here ({}); go on with that one, name another "
               "folder, or remove this one",
               folder.string(), differences(order, found)));
}

}  // namespace

UnfinishedCorpus::UnfinishedCorpus(const fs::path& corpus, const Json& order)
    : folder_(folder_beside(corpus)) {
    if (fs::exists(folder_ / kOrder)) {
        check_order(folder_, order);
        return;
    }
    std::error_code problem;
    fs::remove_all(folder_, problem);
    if (!fs::create_directories(folder_ / kNotes, problem)) {
        throw Error(format("{}: cannot be written ({}); check that the folder exists and is writable",
                           folder_.string(), problem.message()));
    }
    write_json(folder_ / kOrder, order);
}

fs::path UnfinishedCorpus::folder_beside(const fs::path& corpus) {
    return corpus.parent_path() / format(".{}.making", corpus.filename().string());
}

UnfinishedCorpus::~UnfinishedCorpus() {
    std::error_code ignored;
    if (fs::is_empty(folder_ / kNotes, ignored)) fs::remove_all(folder_, ignored);
}

fs::path UnfinishedCorpus::note_path(std::size_t piece) const {
    return folder_ / kNotes / format("{:05}.json", piece);
}

std::optional<std::vector<CorpusEntry>> UnfinishedCorpus::made(std::size_t piece) const {
    const fs::path file = note_path(piece);
    if (!fs::exists(file)) return std::nullopt;
    const Json json = read_json(file);
    std::vector<CorpusEntry> entries;
    for (const JsonValue& record : JsonValue(json, file.string()).at("records").items(1))
        entries.push_back(entry_of(record));
    return entries;
}

void UnfinishedCorpus::note(std::size_t piece, const std::vector<CorpusEntry>& entries) const {
    Json json;
    for (const CorpusEntry& entry : entries) json["records"].push_back(json_of(entry));
    write_json(note_path(piece), json);
}

void UnfinishedCorpus::finish(const fs::path& place) {
    std::error_code problem;
    fs::remove_all(folder_ / kNotes, problem);
    fs::remove(folder_ / kOrder, problem);
    fs::rename(folder_, place, problem);
    if (problem) throw Error(format("{}: cannot be put in place ({})", folder_.string(), problem.message()));
}

}  // namespace chironomia
