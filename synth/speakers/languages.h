// Languages as texts and recognisers name them, and what the voices of espeak-ng read.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

// As espeak-ng names it: "es" of "Spanish", "en-us" of "en_US", and of "zh-CN" and "cmn" the voice of Mandarin that
// reads all characters. The names are those of Whisper, in words/languages.json. What is not among them comes in lower
// case alone; a region that has no voice is left out where the voice is chosen.
std::string language_named(std::string_view name);

// Whether the voice of a language, as espeak-ng names it, spells `letter` by its name in that language. Voices that
// spell in English say so ("(en)"), and so do those that leave a letter to another voice.
bool is_spelt_by(std::string_view language, char32_t letter);

}  // namespace chironomia
