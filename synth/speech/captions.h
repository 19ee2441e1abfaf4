// Captions: WebVTT and SubRip.
#pragma once

#include <string>
#include <string_view>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Whether a text is of captions: "WEBVTT" first, or a timing line among its first lines.
bool are_captions(std::string_view text);

// One label for each cue, or for each part of a cue after a time of its own (<00:00:01.500>); tags and
// entities are resolved, notes, styles, regions and effects ({\an8}) passed over. W3C, "WebVTT: The Web Video Text
// Tracks Format". A cue ends at an empty line, not at one of spaces. `file` is named in messages.
// - Sounds in brackets ([music]) are no words, and noted.
// - Where cues have times inside, lines of the cue before that are shown again count once, and are noted.
// - Of successive cues with one text and an underlined word (<u>) in it, that word is said in that cue.
// Throws Error with the line if a timing line cannot be read, or if most cues repeat words of the one before.
TimedLabels read_captions(std::string_view text, const std::string& file);

}  // namespace chironomia
