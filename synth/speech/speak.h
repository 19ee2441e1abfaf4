// Text spoken by a synthetic voice (espeak-ng).
#pragma once

#include <string>

#include "core/audio.h"

namespace chironomia {

// Mono, at the synthesizer's own rate (22050 Hz); the same samples every time. `language` is a name of
// espeak-ng's: "en", "en-gb", "fr", "de". Throws Error if there is nothing to say, if no voice speaks the
// language, or if the voices are not installed. May be called from several threads.
Audio speak(const std::string& text, const std::string& language);

}  // namespace chironomia
