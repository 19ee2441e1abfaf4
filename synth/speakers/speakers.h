// Speakers by name, and speakers from files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "synth/speakers/speaker.h"

namespace chironomia {

class JsonValue;

// The bundled speakers are neutral, three extremes of manner, and 22 of known, well-spread style on which
// models are trained and judged.
enum class SpeakerGroup {
    example,  // neutral, and abrupt, vigorous, sluggish: who differ from it in manner alone
    seen,     // 16, spread evenly over all styles
    inside,   // 4 mixtures of the seen: unseen, in the convex hull of their styles
    outside,  // 2 a fifth beyond that hull
};

const std::vector<std::string>& speaker_names(SpeakerGroup group);

// Of all groups, in their order.
std::vector<std::string> speaker_names();

// A JSON file as speaker.schema.json has it (docs/speakers.md); its name is the speaker's, and what it leaves
// out is as the neutral speaker has it. Throws Error naming file and key if it is missing, is no JSON, or
// holds an unknown key or a bad value.
Speaker read_speaker(const std::filesystem::path& file);

// A language as espeak-ng names it, by language_named. Throws Error if the text cannot be one.
std::string language_in(const JsonValue& value);

// One of speaker_names(), or a file with an ending. Throws Error with the nearest name if there is none such,
// and as read_speaker.
Speaker speaker_named(const std::string& name_or_file);

}  // namespace chironomia
