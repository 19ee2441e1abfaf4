// A corpus on disk: a folder with an index and one HDF5 file for each record.
//
//   DIR/corpus.json                       what it is, its speakers, its splits, how it was made
//   DIR/statistics.json                   of the training records alone (synth/corpus/statistics.h)
//   DIR/records/<speaker>/<id>.h5         of dyads DIR/records/<id>.h5
// A corpus of intervals is PATS's own tree instead (data/cmu_intervals_df.csv,
// data/processed/<speaker>/<id>.h5), with corpus.json beside it where we made it; PATS itself is read as it
// is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"
#include "synth/corpus/records.h"

namespace chironomia {

enum class CorpusKind {
    talks,      // IpuRecord, as TEDx
    dyads,      // DyadRecord, as NoXi
    intervals,  // IntervalRecord, as PATS
};

// "talks"
std::string_view name_of(CorpusKind kind);
std::optional<CorpusKind> corpus_kind_named(std::string_view name);

// Which part of a corpus a record belongs to. Models learn from `train` alone, stop by `validation`, and are
// judged on `test`, other utterances of the same speakers, and on `unseen`, speakers who are in no other
// part.
enum class Split { train, validation, test, unseen };

// "train"
std::string_view name_of(Split split);
std::optional<Split> split_named(std::string_view name);

struct CorpusEntry {
    std::string id;
    std::string speaker;  // of a dyad: both participants, joined by "+"
    Split split = Split::train;
    double seconds = 0;
    std::string recording{};  // of intervals: what it was cut from; empty: it is whole
    double start = 0;         // [s] in the recording
};

struct CorpusIndex {
    std::filesystem::path folder;
    CorpusKind kind = CorpusKind::talks;
    std::string text_encoder = "hashbert";  // what made the words' vectors: "hashbert", "bert-base-uncased"
    std::vector<CorpusEntry> entries;       // ascending by id
    Json origin;  // how it was made: command, seed, version, noise; of a synthetic one the speakers' styles

    std::vector<CorpusEntry> of(Split split) const;
};

// Throws Error if the folder holds no corpus, an id comes twice, a speaker of `unseen` is in another split, a
// participant of a dyad is in another split, too, or `train` is empty. PATS's own tree has its
// `dataset` column for splits; its speakers of the thesis's UNSEEN set have their test intervals in `unseen`
// and no others, and what is left out is counted in `origin`.
CorpusIndex read_corpus_index(const std::filesystem::path& folder);
// Throws Error as reading it would. Of intervals also the table of PATS.
void write_corpus_index(const CorpusIndex& index);

// Each throws Error with the file and the array for what is missing, of another shape or rate, of unequal
// lengths, not finite, or out of its range.
IpuRecord read_ipu(const CorpusIndex& corpus, const CorpusEntry& entry);
DyadRecord read_dyad(const CorpusIndex& corpus, const CorpusEntry& entry);
IntervalRecord read_interval(const CorpusIndex& corpus, const CorpusEntry& entry);

// What made the vectors of words in the file of an interval, as in CorpusIndex: by the corpus or the tree of PATS in which
// it lies, or by the file itself, for what is not of ours is of PATS. Nothing of a file of ours that lies elsewhere.
std::optional<std::string> text_encoder_of_interval(const std::filesystem::path& file);

// SHA-256 of all that models may learn from: ids, speakers, splits and files of the records that are not in `test`.
std::string hash_of_learned(const CorpusIndex& corpus);
// SHA-256 of which records are in `train` and `validation`, by ids and speakers; reads no files.
std::string hash_of_split(const CorpusIndex& corpus);

// Under `folder` of a corpus that is being made; the same record gives the same bytes. Spectra and vectors of
// words are kept as 16-bit floats. Throw Error as reading them would; from any number of threads at once.
void write_ipu(const std::filesystem::path& folder, const IpuRecord& record);
void write_dyad(const std::filesystem::path& folder, const DyadRecord& record);
void write_interval(const std::filesystem::path& folder, const IntervalRecord& record);

}  // namespace chironomia
