// Tables of words (CSV, TSV) and label files of HTK.
#pragma once

#include <string>
#include <string_view>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Whether each line holds two whole numbers and a label, between spaces.
bool is_label_file(std::string_view text);

// One phoneme a line: start and end in units of 100 ns, and its name, or its name in context
// ("x^x-sil+hh=iy@..."). S. Young and others, "The HTK Book", 2006, section "HTK Label Files".
TimedLabels read_label_file(std::string_view text);

// Whether each line that is no comment (";;") holds a recording, a channel, two numbers and a word between spaces.
bool is_ctm(std::string_view text);

// One word a line: the recording, the channel, the start, how long it lasts [s], and the word; as NIST's sclite, Kaldi
// and NeMo write it. `file` is named in messages. Throws Error with the line if a second recording or channel begins.
TimedLabels read_ctm(std::string_view text, const std::string& file);

// One word a line, with its start and end in seconds, between commas, semicolons or tabs. The first line may name the
// columns: word, text, token or label; start, begin, onset, tmin or xmin; end, stop, offset, tmax or xmax. Under
// "start", "end" and "text", as Whisper names them, whole numbers are milliseconds if a stretch would last over a
// minute otherwise, which is noted. Under "type" rows of other things than words are left out, as the Montreal Forced
// Aligner names phones; "speaker" names who says it. Without names, the column that is no number is the word, and the numbers are its start and its
// end. ELAN's export, with or without names, is read by its seconds. `file` is named in messages. Throws Error with the
// line if a column is missing, a row is too long, a time is no number, or quotes do not match.
TimedLabels read_word_table(std::string_view text, const std::string& file);

// Whether a table that begins with this line is one of words: by the names of its columns, as ELAN exports it, or by
// two numbers and a word.
bool begins_word_table(std::string_view line);

}  // namespace chironomia
