// Words in time beside the sound that they should be heard in.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/audio.h"
#include "core/speech.h"

namespace chironomia {

// A sentence that asks whether `words`, from the file `times`, are those of `sound`, from the file `heard`: where more
// than a quarter of them lie in silence, as words do whose times begin elsewhere than the sound. None otherwise.
std::optional<std::string> note_of_silent_words(std::span<const SpokenWord> words,
                                                const std::filesystem::path& times, const Audio& sound,
                                                const std::filesystem::path& heard);

}  // namespace chironomia
