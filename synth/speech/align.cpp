#include "synth/speech/align.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "synth/speech/timed_words.h"
#include "synth/speech/word_text.h"

namespace chironomia {
namespace {

// The letters of words, one after the other, and how many there are after each word.
struct Letters {
    explicit Letters(const std::vector<std::string>& words) {
        for (const std::string& word : words) {
            all += folded(word);
            ends.push_back(all.size());
        }
    }

    // The word in which a letter lies; the number of words after the last one.
    std::size_t word_of(std::size_t letter) const {
        return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), letter) - ends.begin());
    }

    std::string all;
    std::vector<std::size_t> ends;
};

template <typename Words>
std::vector<std::string> texts_of(const Words& words) {
    std::vector<std::string> texts;
    for (const auto& word : words) texts.push_back(word.text);
    return texts;
}

std::string describe_word(const std::vector<std::string>& words, std::size_t number, const char* which) {
    if (number == words.size()) return format("the {} ends", which);
    return format("the {} says \"{}\" (word {})", which, words[number], number + 1);
}

void refuse_other_words(const std::vector<std::string>& script, const Letters& script_letters,
                        const Speech& recorded, const Letters& sound_letters) {
    const auto [in_script, in_sound] = std::mismatch(script_letters.all.begin(), script_letters.all.end(),
                                                     sound_letters.all.begin(), sound_letters.all.end());
    const bool is_same = in_script == script_letters.all.end() && in_sound == sound_letters.all.end();
    if (is_same && script.empty() == recorded.words.empty()) return;
    // A text without letters differs from silence in its first word.
    const auto letter = static_cast<std::size_t>(in_script - script_letters.all.begin());
    const std::size_t read = is_same ? 0 : script_letters.word_of(letter);
    const std::size_t heard = is_same ? 0 : sound_letters.word_of(letter);
    const double time =
        heard < recorded.words.size() ? recorded.words[heard].start : recorded.audio.duration();
    throw Error(format("text and recording: at {:.2f} s {} and {}; write the text as it is said", time,
                       describe_word(script, read, "text"),
                       describe_word(texts_of(recorded.words), heard, "recording")));
}

// Words [first, end) of a text.
struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
};

// Goes on to the end of the shortest stretches after these that have the same letters.
void go_on(Stretch& script, const Letters& script_letters, Stretch& sound, const Letters& sound_letters) {
    script.first = script.end++;
    sound.first = sound.end++;
    for (;;) {
        const std::size_t read = script_letters.ends[script.end - 1],
                          heard = sound_letters.ends[sound.end - 1];
        const bool is_next_empty =
            script.end < script_letters.ends.size() && script_letters.ends[script.end] == read;
        if (read == heard && !is_next_empty) return;
        ++(read <= heard ? script.end : sound.end);
    }
}

// Gives the words of a stretch of the script the time of that of the recording.
void share(const Stretch& script, const Stretch& sound, const std::vector<SpokenWord>& recorded,
           std::vector<SpokenWord>& words) {
    const double start = recorded[sound.first].start, end = recorded[sound.end - 1].end;
    const std::span stretch(words.begin() + static_cast<std::ptrdiff_t>(script.first),
                            script.end - script.first);
    const std::vector<double> shares = shares_of_letters(texts_of(stretch));
    for (std::size_t i = 0; i < stretch.size(); ++i) {
        stretch[i].start = start + shares[i] * (end - start);
        stretch[i].end = i + 1 == stretch.size() ? end : start + shares[i + 1] * (end - start);
    }
}

}  // namespace

Speech align(const MarkedText& text, Speech recorded) {
    std::erase_if(recorded.words, [](const SpokenWord& word) { return folded(word.text).empty(); });
    const std::vector<std::string> texts = texts_of(text.words);
    const Letters script_letters(texts), sound_letters(texts_of(recorded.words));
    refuse_other_words(texts, script_letters, recorded, sound_letters);
    std::vector<SpokenWord> words;
    for (const std::string& word : texts) words.push_back({.text = word});
    Stretch script, sound;
    while (script.end < words.size()) {
        go_on(script, script_letters, sound, sound_letters);
        share(script, sound, recorded.words, words);
    }
    recorded.words = with_phonemes(std::move(words), recorded.phonemes);
    recorded.marks = text.marks;
    return recorded;
}

}  // namespace chironomia
