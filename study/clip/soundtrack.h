// What a clip sounds like.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/audio.h"
#include "study/clip/clip.h"

namespace chironomia::study {

struct Soundtrack {
    std::optional<Audio> sound;
    std::vector<Audio> voices{};          // of the performers, or none
    std::vector<std::string> warnings{};  // what had to be done to it; each one sentence
};

// The parts of the files that the job asks for; two voices are mixed. Throws Error if a file cannot be read
// or a part lies outside it.
Soundtrack read_soundtrack(const ClipJob& job);

// Whether the picture alone sets the length of the clip: the sound is then padded or cut to it.
bool picture_sets_length(const ClipJob& job);

// The sound of `range` of a clip of so many frames, exactly as long as they are, with the spoken notice and
// as loud as the job asks for; none if the job is silent. Adds to the warnings what is missing or too much.
// Throws Error if a notice cannot be spoken.
void finish(Soundtrack& track, const ClipJob& job, std::size_t frames, const FrameRange& range);

}  // namespace chironomia::study
