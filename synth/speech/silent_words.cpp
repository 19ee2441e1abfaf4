#include "synth/speech/silent_words.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/quantile.h"
#include "core/text.h"

namespace chironomia {
namespace {

// Mean squares against the square of the highest peak. Ours: unstressed words lie some 35 dB below it, pauses in a
// quiet room 60 dB.
constexpr double kSilent = 1e-5, kMany = 0.25;

// Ours: no pause in speech is so long and so loud, against the median of the words (10 dB below it).
constexpr double kLongestWordless = 2, kHeardStep = 0.1, kAsLoud = 0.1;  // [s], [s]

double energy_of(const Audio& sound, double start, double end) {
    const auto sample = [&](double time) {
        const auto frame = std::min(sound.length(), static_cast<std::size_t>(std::lround(time * sound.rate)));
        return sound.samples.begin() +
               static_cast<std::ptrdiff_t>(frame * static_cast<std::size_t>(sound.channels));
    };
    const auto from = sample(start), to = sample(end);
    return std::inner_product(from, to, from, 0.0) / std::max<double>(1, double(to - from));
}

std::optional<std::string> doubt_of_silent_words(const WordsOfSound& beside) {
    const auto [words, times, sound, heard] = beside;
    double loudest = 0;
    for (const float value : sound.samples) loudest = std::max(loudest, double(value) * value);
    const auto is_silent = [&](const SpokenWord& word) {
        return energy_of(beside.sound, word.start, word.end) <= kSilent * loudest;
    };
    const auto silent = std::ranges::count_if(words, is_silent);
    if (static_cast<double>(silent) <= kMany * static_cast<double>(words.size())) return std::nullopt;
    const SpokenWord& first = *std::ranges::find_if(words, is_silent);
    return format(
        "{}: {} of {} words lie where {} is silent, the first is \"{}\" at {:.2f} s; are its times those of "
        "this sound?",
        times.string(), silent, words.size(), heard.string(), first.text, first.start);
}

std::optional<std::string> doubt_of_wordless_speech(const WordsOfSound& beside) {
    const auto [words, times, sound, heard] = beside;
    if (words.empty()) return std::nullopt;
    std::vector<double> energies;
    for (const SpokenWord& word : words) energies.push_back(energy_of(sound, word.start, word.end));
    const double as_loud = kAsLoud * median(std::move(energies));
    for (std::size_t next = 0; next <= words.size(); ++next) {
        const double start = next == 0 ? 0 : words[next - 1].end;
        const double end = next == words.size() ? sound.duration() : words[next].start;
        double loud = 0;  // [s]
        for (double time = start; time + kHeardStep <= end; time += kHeardStep)
            if (energy_of(sound, time, time + kHeardStep) > as_loud) loud += kHeardStep;
        if (loud < kLongestWordless) continue;
        return format(
            "{}: no word lies from {:.1f} to {:.1f} s, where {} is as loud as in its words; are all of them "
            "there, at their times?",
            times.string(), start, end, heard.string());
    }
    return std::nullopt;
}

}  // namespace

std::vector<std::string> doubts_of_word_times(const WordsOfSound& beside) {
    std::vector<std::string> doubts;
    for (const auto& doubt : {doubt_of_silent_words(beside), doubt_of_wordless_speech(beside)})
        if (doubt) doubts.push_back(*doubt);
    return doubts;
}

}  // namespace chironomia
