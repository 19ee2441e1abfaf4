// Which channel of a recording holds the speech of a person.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/audio.h"

namespace chironomia {

enum class SpeechChannel { mean, left, right };  // mean: of all channels

// That channel alone. Throws Error that names `file` if left or right is asked of a sound that is not stereo.
Audio take_channel(const Audio& sound, SpeechChannel channel, const std::filesystem::path& file);

// What to say of a stereo sound whose channels are heard in turn, as of two people who each have a microphone: each is
// louder by 6 dB than the other one in at least a tenth of the time in which anything is heard (both ours). It
// ends with the advice for two people. None otherwise.
std::optional<std::string> note_of_two_voices(const Audio& sound, const std::filesystem::path& file,
                                              std::string_view advice);

}  // namespace chironomia
