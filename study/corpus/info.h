// What a corpus holds, and what its speakers are like.
#pragma once

#include <string>

#include "core/files/json.h"
#include "synth/corpus/corpus.h"

namespace chironomia::study {

// {kind, folder, text_encoder, records, speakers, minutes,
//  splits: {train: {records, minutes, speakers}, ...},
//  people: [{speaker, splits: [...], records, minutes, ...}], left_out?}
// A mean and its standard deviation are {mean, sd}. Of each person besides
//   talks      words_per_minute, lexical (study/corpus/words.h), f0_hz where it is voiced, bridged (part of
//              the frames), units {AU1: ...} in 0..5, head_rad {pose_Rx: ...}
//   dyads      roles, partners, face {gaze_angle_x: ..., AU12: ...} as in the records
//   intervals  words_per_minute, lexical, box_perimeter and wrist_speed (a second) in shoulder widths, of the
//              11 joints that models learn (study/measure/movement.h), where they were seen
// Reads every record. Throws Error as reading them does.
Json describe_corpus(const CorpusIndex& corpus);

// The same for a terminal: means with their standard deviations in brackets.
std::string corpus_text(const Json& description);

}  // namespace chironomia::study
