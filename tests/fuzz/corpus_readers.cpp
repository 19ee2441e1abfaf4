// Corpora: their records, indexes and statistics, the tables of PATS, and the pieces of words that BERT knows.
#include "core/files/files.h"
#include "synth/corpus/corpus.h"
#include "synth/corpus/pats_words.h"
#include "synth/corpus/record_files.h"
#include "synth/corpus/statistics.h"
#include "synth/text/word_pieces.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

// Files of PATS, of which only their being there matters, and a table for the list of missing ones.
void make_companions() {
    static const bool made = [] {
        for (const char* file : {"pats/processed/oliver/a.h5", "missing/processed/oliver/a.h5"})
            write_text(fuzz_folder() / file, "");
        write_text(fuzz_folder() / "missing/cmu_intervals_df.csv",
                   "dataset,delta_time,interval_id,speaker\ntrain,2,a,oliver\n");
        return true;
    }();
    (void)made;
}

void read_index(const FuzzInput& input) {
    make_companions();
    read_corpus_index(input.file().parent_path());
}

void read_scales(const FuzzInput& input) {
    read_statistics({.folder = input.file().parent_path(), .kind = CorpusKind::talks});
}

// Beside a record that names no words itself.
void read_table_of_words(const FuzzInput& input) {
    static const RecordFile record(source_dir() / "tests/fixtures/motion/chunked.h5");
    input.file();
    pats_words(record, fuzz_folder() / "x.h5", {});
}

void read_vocabulary(const FuzzInput& input) {
    static const std::vector<std::string> words = {"Walking", "d\u00e9j\u00e0", "\u6771\u4eac", "...", ""};
    pieces_of(WordPieces(input.text(), "vocab.txt"), words);
}

const AddFuzzReader kIpu({"ipu", "x.h5", [](const FuzzInput& input) { read_ipu_file(input.file()); }});
const AddFuzzReader kDyad({"dyad", "x.h5", [](const FuzzInput& input) { read_dyad_file(input.file()); }});
const AddFuzzReader kCorpus({"corpus", "corpus/corpus.json", read_index});
const AddFuzzReader kStatistics({"statistics", "statistics/statistics.json", read_scales});
const AddFuzzReader kPatsTable({"pats_table", "pats/cmu_intervals_df.csv", read_index});
const AddFuzzReader kPatsMissing({"pats_missing", "missing/missing_intervals.h5", read_index});
const AddFuzzReader kPatsWords({"pats_words", "x.words.csv", read_table_of_words});
const AddFuzzReader kVocabulary({"vocabulary", "vocab.txt", read_vocabulary});

}  // namespace
}  // namespace chironomia::testing
