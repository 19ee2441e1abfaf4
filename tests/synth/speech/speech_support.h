// Scripts without markup of their own, and what must hold for all speech.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "core/text.h"
#include "synth/markup/marked_text.h"

namespace chironomia::testing {

// Words between white space, and between tags if it is SSML, without the punctuation around them.
inline MarkedText script(const std::string& text, bool is_ssml = false) {
    MarkedText marked{.script = text, .is_ssml = is_ssml};
    constexpr std::string_view kSpace = " \t\n", kPunctuation = ".,;:!?\"()[]";
    for (std::size_t place = 0; (place = text.find_first_not_of(kSpace, place)) != std::string::npos;) {
        const bool is_tag = is_ssml && text[place] == '<';
        std::size_t end = is_tag ? text.find('>', place) + 1
                                 : text.find_first_of(std::string(kSpace) + (is_ssml ? "<" : ""), place);
        end = std::min(end, text.size());
        const std::size_t first = text.find_first_not_of(kPunctuation, place);
        const std::size_t last = text.find_last_not_of(kPunctuation, end - 1);
        if (!is_tag && first < end && first <= last)
            marked.words.push_back({text.substr(first, last + 1 - first), first, last + 1});
        place = end;
    }
    return marked;
}

inline double rms(std::span<const float> samples) {
    double sum = 0;
    for (const float sample : samples) sum += static_cast<double>(sample) * sample;
    return samples.empty() ? 0 : std::sqrt(sum / static_cast<double>(samples.size()));
}

inline std::span<const float> part_of(const Audio& sound, double start, double end) {
    const auto first = static_cast<std::size_t>(std::lround(start * sound.rate));
    const auto last = static_cast<std::size_t>(std::lround(end * sound.rate));
    return std::span(sound.samples).subspan(first, last - first);
}

// "h ə l 'oʊ"
inline std::string phonemes_of(const Speech& speech, std::size_t word) {
    std::vector<std::string> symbols;
    for (std::size_t i = speech.words[word].first_phoneme; i < speech.words[word].end_phoneme; ++i) {
        const SpokenPhoneme& phoneme = speech.phonemes[i];
        const char* stress = phoneme.stress == Stress::primary     ? "'"
                             : phoneme.stress == Stress::secondary ? ","
                                                                   : "";
        symbols.push_back(stress + phoneme.symbol);
    }
    return join(symbols, " ");
}

inline std::vector<std::string> texts_of(const Speech& speech) {
    std::vector<std::string> texts;
    for (const SpokenWord& word : speech.words) texts.push_back(word.text);
    return texts;
}

// Phonemes follow one another without gaps, and words lie in them and in the sound, in order.
inline void expect_in_order(const Speech& speech) {
    double time = speech.phonemes.empty() ? 0 : speech.phonemes.front().start;
    for (const SpokenPhoneme& phoneme : speech.phonemes) {
        EXPECT_EQ(phoneme.start, time) << phoneme.symbol;
        EXPECT_GT(phoneme.end, phoneme.start) << phoneme.symbol;
        EXPECT_FALSE(phoneme.symbol.empty());
        time = phoneme.end;
    }
    EXPECT_LE(time, speech.audio.duration());
    double word_end = 0;
    std::size_t phoneme_end = 0;
    for (const SpokenWord& word : speech.words) {
        EXPECT_GE(word.start, word_end) << word.text;
        EXPECT_GT(word.end, word.start) << word.text;
        EXPECT_GE(word.first_phoneme, phoneme_end) << word.text;
        EXPECT_GE(word.end_phoneme, word.first_phoneme) << word.text;
        word_end = word.end;
        phoneme_end = word.end_phoneme;
    }
    EXPECT_LE(word_end, speech.audio.duration());
    EXPECT_LE(phoneme_end, speech.phonemes.size());
}

// An environment variable for as long as the object lives.
class Environment {
  public:
    Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
    ~Environment() { unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    const char* name_;
};

}  // namespace chironomia::testing
