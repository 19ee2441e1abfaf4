// The words of an interval of PATS.
#pragma once

#include <filesystem>
#include <vector>

#include "synth/corpus/record_file.h"

namespace chironomia {

// From the first of these that is there:
// - /text/words and /text/word_times of our own files;
// - /text/meta, a table of pandas with the columns Word, start_frame, end_frame;
// - <id>.words.csv beside the file, with the columns word, start_frame, end_frame;
// - where /text/tokens changes: then a word is called by its token, "#2054".
//   path    of the file
//   tokens  (T)
// Throws Error if what is there is broken.
std::vector<CorpusWord> pats_words(const RecordFile& file, const std::filesystem::path& path,
                                   const std::vector<int>& tokens);

}  // namespace chironomia
