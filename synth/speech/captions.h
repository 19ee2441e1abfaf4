// Captions: WebVTT and SubRip.
#pragma once

#include <string>
#include <string_view>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Whether a text is of captions: "WEBVTT" first, or a timing line among its first lines.
bool are_captions(std::string_view text);

// One label for each cue, or for each part of a cue after a time of its own (<00:00:01.500>); tags and
// entities are resolved, notes, styles and regions passed over. W3C, "WebVTT: The Web Video Text Tracks
// Format". `file` is named in messages. Throws Error with the line if a timing line cannot be read.
TimedLabels read_captions(std::string_view text, const std::string& file);

}  // namespace chironomia
