// The folders and the table of PATS: Ahuja et al., "Style Transfer for Co-Speech Gesture Animation", 2020.
//
//   data/cmu_intervals_df.csv                    dataset (train, dev, test), delta_time [s], end_time,
//                                                interval_id, speaker, start_time, video_fn, video_link
//   data/missing_intervals.h5                    /intervals, ids that are not there; may lack
//   data/processed/<speaker>/<interval_id>.h5
#pragma once

#include "synth/corpus/corpus.h"

namespace chironomia {

inline constexpr const char* kPatsEncoder = "bert-base-uncased";  // of its words

// Whether the folder, or the folder data in it, has the table.
bool holds_pats_tree(const std::filesystem::path& folder);

// The intervals that are there: PATS may be had speaker by speaker, and some intervals were never published.
// Splits as read_corpus_index() says; speakers of neither set of the thesis are left out.
CorpusIndex read_pats_tree(const std::filesystem::path& folder);

std::filesystem::path pats_file(const std::filesystem::path& folder, const std::string& speaker,
                                const std::string& id);

// The table alone.
void write_pats_table(const CorpusIndex& index);

}  // namespace chironomia
