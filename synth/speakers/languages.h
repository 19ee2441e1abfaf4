// Languages as texts and recognisers name them, and as espeak-ng does.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

// As espeak-ng names it: "es" of "Spanish", "en-us" of "en_US", and of "zh-CN" and "cmn" the voice of Mandarin that
// reads all characters. The names are those of Whisper, in words/languages.json. What is not among them comes in lower
// case alone; a region that has no voice is left out where the voice is chosen.
std::string language_named(std::string_view name);

}  // namespace chironomia
