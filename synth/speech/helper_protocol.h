// What the program and its helper chironomia_speak say to each other: a head of lines of text, and bytes.
//
//   chironomia_speak 3             chironomia_speak 3
//   voice 50 165 50                spoken 22050
//   text 5 2 12 12                 alone h ə l oʊ
//   en-usf2Hello there.            alone ð ɛɹ
//   Hello                          word 0 0
//   there                          phoneme 264 0 h
//                                  phoneme 1384 0 ə
//                                  sound 43210
//                                  (samples of 16 bits in the machine's byte order)
//
// A voice is its pitch, rate and range; "text" or "ssml" gives the number of bytes of the language, the variant, the
// text and the words that follow, each word ending in a line break. A refusal is "no-voices", "failed",
// or "no-language" or "no-variant" and the names that there are, one a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct SpeakRequest {
    std::string text;  // UTF-8 without zero bytes
    bool is_ssml = false;
    Voice voice;
    std::vector<std::string> words;  // of which it is asked how they sound alone; without line breaks
};

// An event that the synthesizer reports while it speaks.
struct SpeakEvent {
    enum class Kind { word, phoneme };

    Kind kind = Kind::word;
    std::size_t sample = 0;        // when it begins
    std::size_t position = 0;      // of a word: the character of the text at which it begins
    Stress stress = Stress::none;  // of a phoneme
    std::string symbol;            // of a phoneme, in IPA; "" for a pause
};

struct SpeakReply {
    enum class Outcome { spoken, no_voices, no_language, no_variant, failed };

    Outcome outcome = Outcome::failed;
    std::vector<std::string> names;  // what there is instead of the language or variant
    int rate = 0;                    // [Hz]
    std::vector<std::vector<std::string>>
        alone;                       // the phonemes of each word of the request said alone, in IPA
    std::vector<SpeakEvent> events;  // ascending by sample
    std::vector<std::int16_t> samples;
};

// The reading functions give nothing for bytes that are no message of this version.
std::string to_bytes(const SpeakRequest& request);
std::string to_bytes(const SpeakReply& reply);
std::optional<SpeakRequest> read_request(std::string_view bytes);
std::optional<SpeakReply> read_reply(std::string_view bytes);

}  // namespace chironomia
