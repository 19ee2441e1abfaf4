// Words in JSON, as speech recognisers write them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "synth/speech/label_tiers.h"
#include "synth/speech/timed_label.h"

namespace chironomia {

// Reads a list of objects with a "word" or "text", a "start" and an "end" in seconds; such a list under "words", or
// Vosk's "result", of one stretch of sound or of a list of them; Whisper's "segments", each with its "words" or,
// without them and without words beside the segments, its "text", or the list of them that faster-whisper gives; the
// "transcription" of whisper.cpp, in milliseconds, by its "tokens" where they are there; and Google's "results", or a
// list of them, with times like "1.300s". Where most words begin with a space, as Whisper writes them, one without goes
// on with the one before it in its list. The language is as voices name it (language_named). Words without any time, as
// WhisperX and Gentle leave them, share what their neighbours leave, which is noted; before the first and behind the
// last word that has times, up to 0.3 s each within `duration`, that of the sound [s]. Throws Error with the place
// ("segments[0].words[2]") if something is missing or of another kind.
TimedLabels read_word_json(const std::filesystem::path& file, double duration);

// The tiers of the Montreal Forced Aligner's own JSON, {"tiers": {"words": {"entries": [[start, end, "word"]]}}};
// nothing if it is another file. Throws Error with the place if an entry is of another kind.
std::optional<std::vector<LabelTier>> find_tiers(std::string_view text, const std::string& file);

}  // namespace chironomia
