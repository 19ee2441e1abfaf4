#include "synth/corpus/corpus.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"
#include "synth/corpus/corpus_entries.h"
#include "synth/corpus/pats_tree.h"
#include "synth/corpus/record_checks.h"
#include "synth/corpus/record_file.h"
#include "synth/corpus/record_files.h"

namespace chironomia {
namespace {

constexpr std::array<std::string_view, 3> kKinds = {"talks", "dyads", "intervals"};
constexpr std::array<std::string_view, 4> kSplits = {"train", "validation", "test", "unseen"};
constexpr const char* kIndex = "corpus.json";
constexpr const char* kFormat = "chironomia corpus";
constexpr double kLongest = 1e6;  // [s] of one record

std::vector<std::string> texts(std::span<const std::string_view> names) {
    return {names.begin(), names.end()};
}

template <std::size_t N>
std::size_t place_of(const std::array<std::string_view, N>& names, std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

CorpusIndex index_of(const Json& json, const std::filesystem::path& folder) {
    const JsonValue value(json, (folder / kIndex).string());
    value.at("format").choice({kFormat});
    value.at("version").integer(kRecordVersion, kRecordVersion);
    value.allow_only({"format", "version", "kind", "text_encoder", "records", "origin"});
    CorpusIndex index;
    index.folder = folder;
    index.kind = *corpus_kind_named(value.at("kind").choice(texts(kKinds)));
    index.text_encoder = value.at("text_encoder").text();
    for (const JsonValue& record : value.at("records").items(1)) index.entries.push_back(entry_of(record));
    if (const auto origin = value.find("origin")) index.origin = origin->json();
    return index;
}

// In which splits each person is, with a record of it.
using Appearances = std::map<std::string, std::map<Split, std::string>>;

Appearances appearances(const CorpusIndex& index) {
    Appearances people;
    for (const CorpusEntry& entry : index.entries) {
        for (const std::string_view person : split(entry.speaker, '+'))
            people[std::string(person)].emplace(entry.split, entry.id);
    }
    return people;
}

// A model that was trained on a person, or stopped by one, cannot be tested on that person for generalization to others.
void check_people(const CorpusIndex& index, const std::string& where) {
    for (const auto& [person, splits] : appearances(index)) {
        const auto refuse = [&, &person = person, &splits = splits](Split alone, Split other) {
            throw Error(format(
                "{}: speaker \"{}\" is in the split {} (record \"{}\") and in {} (record \"{}\"); keep {} to "
                "one of them",
                where, person, name_of(alone), splits.at(alone), name_of(other), splits.at(other),
                index.kind == CorpusKind::dyads ? "each participant" : "each unseen speaker"));
        };
        for (const auto& [other, id] : splits) {
            if (splits.contains(Split::unseen) && other != Split::unseen) refuse(Split::unseen, other);
        }
        if (index.kind == CorpusKind::dyads && splits.size() > 1)
            refuse(splits.rbegin()->first, splits.begin()->first);
    }
}

void check_index(const CorpusIndex& index, const std::string& where) {
    std::set<std::string> ids;
    for (const CorpusEntry& entry : index.entries) {
        if (!ids.insert(entry.id).second)
            throw Error(format("{}: the id \"{}\" comes twice; give each record its own", where, entry.id));
    }
    check_people(index, where);
    if (index.of(Split::train).empty()) {
        throw Error(format("{}: the split train is empty, of {} records; models learn from it alone", where,
                           index.entries.size()));
    }
}

std::filesystem::path record_path(const std::filesystem::path& folder, CorpusKind kind,
                                  const std::string& speaker, const std::string& id) {
    for (const std::string& name : {speaker, id}) {
        if (!is_plain_name(name))
            throw Error(format("{}: \"{}\" cannot name a file; use letters, digits and . _ - +",
                               folder.string(), name));
    }
    const std::filesystem::path records = folder / "records";
    switch (kind) {
        case CorpusKind::talks:
            return records / speaker / (id + ".h5");
        case CorpusKind::dyads:
            return records / (id + ".h5");
        case CorpusKind::intervals:
            return folder / "data" / "processed" / speaker / (id + ".h5");
    }
    return {};
}

void check_identity(const std::string& path, std::string_view what, const std::string& found,
                    const std::string& expected) {
    if (found == expected) return;
    throw Error(format("{}: its {} is \"{}\", the index says \"{}\"; put the file back in its place", path,
                       what, found, expected));
}

}  // namespace

CorpusEntry entry_of(const JsonValue& value) {
    value.allow_only({"id", "speaker", "split", "seconds", "recording", "start"});
    CorpusEntry entry{.id = value.at("id").text(),
                      .speaker = value.at("speaker").text(),
                      .split = *split_named(value.at("split").choice(texts(kSplits))),
                      .seconds = value.at("seconds").number(0, kLongest)};
    if (const auto recording = value.find("recording")) {
        entry.recording = recording->text();
        entry.start = value.at("start").number(0, kLongest);
    }
    for (const std::string& name : {entry.id, entry.speaker}) {
        if (!is_plain_name(name))
            value.refuse(format("\"{}\" cannot name a file; use letters, digits and . _ - +", name));
    }
    return entry;
}

Json json_of(const CorpusEntry& entry) {
    Json json = {{"id", entry.id},
                 {"speaker", entry.speaker},
                 {"split", name_of(entry.split)},
                 {"seconds", entry.seconds}};
    if (!entry.recording.empty()) json.update({{"recording", entry.recording}, {"start", entry.start}});
    return json;
}

std::string_view name_of(CorpusKind kind) {
    return kKinds[static_cast<std::size_t>(kind)];
}

std::optional<CorpusKind> corpus_kind_named(std::string_view name) {
    const std::size_t place = place_of(kKinds, name);
    if (place == kKinds.size()) return std::nullopt;
    return static_cast<CorpusKind>(place);
}

std::string_view name_of(Split split) {
    return kSplits[static_cast<std::size_t>(split)];
}

std::optional<Split> split_named(std::string_view name) {
    const std::size_t place = place_of(kSplits, name);
    if (place == kSplits.size()) return std::nullopt;
    return static_cast<Split>(place);
}

std::vector<CorpusEntry> CorpusIndex::of(Split split) const {
    std::vector<CorpusEntry> found;
    for (const CorpusEntry& entry : entries) {
        if (entry.split == split) found.push_back(entry);
    }
    return found;
}

CorpusIndex read_corpus_index(const std::filesystem::path& folder) {
    CorpusIndex index;
    if (std::filesystem::exists(folder / kIndex)) {
        index = index_of(read_json(folder / kIndex), folder);
    } else if (holds_pats_tree(folder)) {
        index = read_pats_tree(folder);
    } else {
        throw Error(
            format("{}: holds no corpus: there is neither {} nor data/cmu_intervals_df.csv; make one "
                   "with `chironomia corpus make` or `corpus import`",
                   folder.string(), kIndex));
    }
    std::sort(index.entries.begin(), index.entries.end(),
              [](const CorpusEntry& a, const CorpusEntry& b) { return a.id < b.id; });
    check_index(index, folder.string());
    return index;
}

void write_corpus_index(const CorpusIndex& index) {
    const std::filesystem::path file = index.folder / kIndex;
    check_index(index, file.string());
    Json json = {{"format", kFormat},
                 {"version", kRecordVersion},
                 {"kind", name_of(index.kind)},
                 {"text_encoder", index.text_encoder}};
    std::vector<CorpusEntry> entries = index.entries;
    std::sort(entries.begin(), entries.end(),
              [](const CorpusEntry& a, const CorpusEntry& b) { return a.id < b.id; });
    for (const CorpusEntry& entry : entries) json["records"].push_back(json_of(entry));
    if (!index.origin.is_null()) json["origin"] = index.origin;
    if (index.kind == CorpusKind::intervals) write_pats_table(index);
    write_json(file, json);
}

IpuRecord read_ipu(const CorpusIndex& corpus, const CorpusEntry& entry) {
    const auto path = record_path(corpus.folder, CorpusKind::talks, entry.speaker, entry.id);
    IpuRecord record = read_ipu_file(path);
    check_identity(path.string(), "id", record.id, entry.id);
    check_identity(path.string(), "speaker", record.speaker, entry.speaker);
    return record;
}

DyadRecord read_dyad(const CorpusIndex& corpus, const CorpusEntry& entry) {
    const auto path = record_path(corpus.folder, CorpusKind::dyads, entry.speaker, entry.id);
    DyadRecord record = read_dyad_file(path);
    check_identity(path.string(), "id", record.id, entry.id);
    check_identity(path.string(), "participants",
                   record.people[0].participant + "+" + record.people[1].participant, entry.speaker);
    return record;
}

IntervalRecord read_interval(const CorpusIndex& corpus, const CorpusEntry& entry) {
    return read_interval_file(pats_file(corpus.folder, entry.speaker, entry.id), entry.id, entry.speaker);
}

std::optional<std::string> text_encoder_of_interval(const std::filesystem::path& file) {
    // data/processed/SPEAKER/ID.h5
    const std::filesystem::path data =
        std::filesystem::absolute(file).lexically_normal().parent_path().parent_path().parent_path();
    if (const auto index = data.parent_path() / kIndex; std::filesystem::exists(index))
        return index_of(read_json(index), data.parent_path()).text_encoder;
    if (holds_pats_tree(data) || !RecordFile(file).has("meta")) return kPatsEncoder;
    return std::nullopt;
}

std::string hash_of_learned(const CorpusIndex& corpus) {
    std::string all;
    for (const CorpusEntry& entry : corpus.entries) {
        if (entry.split == Split::test) continue;
        all += format("{} {} {} {}\n", entry.id, entry.speaker, name_of(entry.split),
                      sha256_of_file(record_path(corpus.folder, corpus.kind, entry.speaker, entry.id)));
    }
    return sha256(all);
}

std::string hash_of_split(const CorpusIndex& corpus) {
    std::string all;
    for (const CorpusEntry& entry : corpus.entries) {
        if (entry.split != Split::train && entry.split != Split::validation) continue;
        all += format("{} {} {}\n", entry.id, entry.speaker, name_of(entry.split));
    }
    return sha256(all);
}

void write_ipu(const std::filesystem::path& folder, const IpuRecord& record) {
    write_ipu_file(record_path(folder, CorpusKind::talks, record.speaker, record.id), record);
}

void write_dyad(const std::filesystem::path& folder, const DyadRecord& record) {
    write_dyad_file(record_path(folder, CorpusKind::dyads, "dyad", record.id), record);
}

void write_interval(const std::filesystem::path& folder, const IntervalRecord& record) {
    write_interval_file(record_path(folder, CorpusKind::intervals, record.speaker, record.id), record);
}

}  // namespace chironomia
