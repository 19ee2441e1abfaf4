#include "synth/speech/word_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.h"
#include "core/text.h"
#include "synth/speech/utf8.h"
#include "synth/speech/word_text.h"

namespace chironomia {
namespace {

constexpr double kShortestWord = 0.01;  // [s]

// A phoneme, and the character of the text at which the synthesizer began what it is a part of.
struct Sound {
    std::size_t start = 0;  // [samples]
    std::size_t end = 0;    // [samples]
    std::size_t position = 0;
    Stress stress = Stress::none;
    std::string symbol;

    bool is_pause() const { return symbol == "_"; }
};

// Lengths, tones and the like, which the synthesizer tells as phonemes of their own.
bool is_modifier(std::string_view symbol) {
    static constexpr std::array<std::string_view, 6> kModifiers = {"ː", "ˑ", "ʲ", "ʰ", "ʷ", "\u0303"};
    return std::any_of(kModifiers.begin(), kModifiers.end(),
                       [&](std::string_view modifier) { return symbol.starts_with(modifier); });
}

// As it stands in a chart of the IPA: whole characters, without what the synthesizer adds for itself.
std::string clean(std::string symbol) {
    if (symbol.empty()) return "_";
    if (const auto fault = fault_in_utf8(symbol)) symbol.resize(*fault);
    if (symbol.ends_with(":")) symbol.replace(symbol.size() - 1, 1, "ː");
    std::erase_if(symbol, [](char letter) { return letter == '-' || (letter >= '0' && letter <= '9'); });
    return symbol;
}

// Where the silence that ends at `sample` begins, at the earliest at `earliest`.
std::size_t start_of_silence(const std::vector<std::int16_t>& samples, std::size_t sample,
                             std::size_t earliest) {
    while (sample > earliest && samples[sample - 1] == 0) --sample;
    return sample;
}

// Puts a sound behind the others, unless it only prolongs or colours the last one.
void add(std::vector<Sound>& sounds, Sound sound) {
    if (sound.symbol.empty()) return;
    if (!sounds.empty()) {
        Sound& last = sounds.back();
        if (last.is_pause() && sound.is_pause()) return;
        if (!last.is_pause() && is_modifier(sound.symbol)) {
            last.symbol += sound.symbol;
            return;
        }
        last.end = sound.start;
        if (last.start == last.end) sounds.pop_back();
    }
    sounds.push_back(std::move(sound));
}

std::vector<Sound> sounds_of(const SpeakReply& reply) {
    std::vector<Sound> sounds;
    std::size_t position = 0, before = 0;
    bool begins_word = false;
    for (const SpeakEvent& event : reply.events) {
        if (event.symbol.starts_with("(")) continue;  // "(fr)" before a word of another language
        const std::size_t sample = std::clamp(event.sample, before, reply.samples.size());
        const bool is_word = event.kind == SpeakEvent::Kind::word;
        if (is_word) {
            position = event.position;
        } else {
            add(sounds, {.start = begins_word ? before : start_of_silence(reply.samples, sample, before),
                         .end = reply.samples.size(),
                         .position = position,
                         .stress = event.stress,
                         .symbol = clean(event.symbol)});
        }
        begins_word = is_word;
        before = sample;
    }
    if (!sounds.empty() && sounds.back().start == sounds.back().end) sounds.pop_back();
    return sounds;
}

SpokenPhoneme phoneme_of(const Sound& sound, double rate) {
    return {.symbol = sound.symbol,
            .start = static_cast<double>(sound.start) / rate,
            .end = static_cast<double>(sound.end) / rate,
            .stress = sound.stress};
}

// The word in which, or beside which, a byte of the script lies.
std::size_t word_at(const MarkedText& text, std::size_t byte) {
    const auto next = std::find_if(text.words.begin(), text.words.end(),
                                   [&](const ScriptWord& word) { return word.end > byte; });
    const auto number = static_cast<std::size_t>(next - text.words.begin());
    if (next == text.words.end()) return number - 1;
    if (number == 0 || next->begin <= byte) return number;
    const std::string_view between = std::string_view(text.script).substr(byte, next->begin - byte);
    return between.find_first_of(" \t\r\n") == std::string_view::npos ? number : number - 1;
}

// The phonemes [first, end) of a word, without pauses around them.
struct Span {
    std::size_t first = 0;
    std::size_t end = 0;

    bool empty() const { return first == end; }
};

std::vector<Span> spans_of(const MarkedText& text, const std::vector<Sound>& sounds) {
    const std::vector<std::size_t> starts = starts_of_characters(text.script);
    std::vector<Span> spans(text.words.size());
    std::size_t word = 0;
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        // The synthesizer may point back into an abbreviation, but it never speaks backwards.
        word = std::max(word, word_at(text, starts[std::min(sounds[i].position, starts.size() - 1)]));
        if (sounds[i].is_pause()) continue;
        if (spans[word].empty()) spans[word].first = i;
        spans[word].end = i + 1;
    }
    return spans;
}

// Words [first, end) that are spoken as one.
struct Group {
    std::size_t first = 0;
    std::size_t end = 0;
};

// Each begins with a word that has phonemes, but for words before the first of those.
std::vector<Group> groups_of(const std::vector<Span>& spans) {
    std::vector<Group> groups;
    bool has_phonemes = false;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        if (groups.empty() || (!spans[i].empty() && has_phonemes)) groups.push_back({i, i});
        has_phonemes = has_phonemes || !spans[i].empty();
        groups.back().end = i + 1;
    }
    return groups;
}

std::vector<double> shares_of(const MarkedText& text, const Group& group) {
    std::vector<std::string> words;
    for (std::size_t i = group.first; i < group.end; ++i) words.push_back(text.words[i].text);
    return shares_of_letters(words);
}

// Gives each word of a group its part of the phonemes, at least one.
void share_phonemes(const std::vector<double>& shares, const Span& all, std::span<SpokenWord> words,
                    const std::vector<SpokenPhoneme>& phonemes) {
    const std::size_t count = all.end - all.first;
    std::size_t first = all.first;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto wanted =
            all.first + static_cast<std::size_t>(std::lround(shares[i + 1] * static_cast<double>(count)));
        const std::size_t still_to_come = words.size() - 1 - i;
        words[i].first_phoneme = first;
        words[i].end_phoneme = std::clamp(wanted, first + 1, all.end - still_to_come);
        first = words[i].end_phoneme;
        words[i].start = phonemes[words[i].first_phoneme].start;
        words[i].end = phonemes[words[i].end_phoneme - 1].end;
    }
}

// Gives each word of a group its part of the time, and the first one the phonemes.
void share_time(const std::vector<double>& shares, const Span& all, std::span<SpokenWord> words,
                const std::vector<SpokenPhoneme>& phonemes) {
    const double start = phonemes[all.first].start;
    const double duration = phonemes[all.end - 1].end - start;
    for (std::size_t i = 0; i < words.size(); ++i) {
        words[i].start = start + shares[i] * duration;
        words[i].end = start + shares[i + 1] * duration;
        words[i].first_phoneme = i == 0 ? all.first : all.end;
        words[i].end_phoneme = all.end;
    }
}

void refuse_words_without_time(const Speech& speech) {
    for (std::size_t i = 0; i < speech.words.size(); ++i) {
        const SpokenWord& word = speech.words[i];
        if (word.end - word.start >= kShortestWord) continue;
        throw Error(
            format("espeak-ng: \"{}\" (word {} of {}) gets {:.0f} ms of the sound in \"{}\", and a word "
                   "needs {:.0f}; write it as it is spoken, or leave it out",
                   word.text, i + 1, speech.words.size(), (word.end - word.start) * 1000, speech.language,
                   kShortestWord * 1000));
    }
}

}  // namespace

Audio sound_of(const SpeakReply& reply) {
    Audio sound{.rate = reply.rate, .channels = 1, .samples = {}};
    sound.samples.reserve(reply.samples.size());
    for (const std::int16_t sample : reply.samples)
        sound.samples.push_back(static_cast<float>(sample) / 32768);
    return sound;
}

Speech time_words(const MarkedText& text, const SpeakReply& reply, const std::string& language) {
    const std::vector<Sound> sounds = sounds_of(reply);
    Speech speech{.audio = sound_of(reply), .language = language, .marks = text.marks};
    for (const Sound& sound : sounds) speech.phonemes.push_back(phoneme_of(sound, reply.rate));
    for (const ScriptWord& word : text.words) speech.words.push_back({.text = word.text});
    const std::vector<Span> spans = spans_of(text, sounds);
    for (const Group& group : groups_of(spans)) {
        const auto spoken = std::find_if(spans.begin() + group.first, spans.begin() + group.end,
                                         [](const Span& span) { return !span.empty(); });
        const std::span words(speech.words.begin() + group.first, group.end - group.first);
        const bool has_enough = spoken->end - spoken->first >= words.size();
        (has_enough ? share_phonemes : share_time)(shares_of(text, group), *spoken, words, speech.phonemes);
    }
    refuse_words_without_time(speech);
    return speech;
}

}  // namespace chironomia
