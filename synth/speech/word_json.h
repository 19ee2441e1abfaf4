// Words in JSON, as speech recognisers write them.
#pragma once

#include <filesystem>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Reads a list of objects with a "word" or "text", a "start" and an "end" in seconds; such a list under
// "words"; Whisper's "segments", each with its "words" or, without them, its "text"; words of a segment
// without any time, as WhisperX leaves them, share what their neighbours leave; and the "transcription"
// of whisper.cpp, in milliseconds. Throws Error with the place ("segments[0].words[2]") if something is
// missing or of another kind.
TimedLabels read_word_json(const std::filesystem::path& file);

}  // namespace chironomia
