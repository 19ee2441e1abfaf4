#include "synth/speech/silent_words.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/text.h"

namespace chironomia {

std::optional<std::string> note_of_silent_words(std::span<const SpokenWord> words,
                                                const std::filesystem::path& times, const Audio& sound,
                                                const std::filesystem::path& heard) {
    // Mean squares against the square of the highest peak. Ours: unstressed words lie some 35 dB below it, pauses in a
    // quiet room 60 dB.
    constexpr double kSilent = 1e-5, kMany = 0.25;
    std::vector<double> energies;
    for (const SpokenWord& word : words) {
        const auto sample = [&](double time) {
            const auto frame =
                std::min(sound.length(), static_cast<std::size_t>(std::lround(time * sound.rate)));
            return sound.samples.begin() +
                   static_cast<std::ptrdiff_t>(frame * static_cast<std::size_t>(sound.channels));
        };
        const auto from = sample(word.start), to = sample(word.end);
        energies.push_back(std::inner_product(from, to, from, 0.0) / std::max<double>(1, double(to - from)));
    }
    double loudest = 0;
    for (const float value : sound.samples) loudest = std::max(loudest, double(value) * value);
    const auto is_silent = [&](double energy) { return energy <= kSilent * loudest; };
    const auto silent = std::count_if(energies.begin(), energies.end(), is_silent);
    if (static_cast<double>(silent) <= kMany * static_cast<double>(words.size())) return std::nullopt;
    const auto first = std::find_if(energies.begin(), energies.end(), is_silent) - energies.begin();
    const SpokenWord& word = words[static_cast<std::size_t>(first)];
    return format(
        "{}: {} of {} words lie where {} is silent, the first is \"{}\" at {:.2f} s; are its times those of "
        "this sound?",
        times.string(), silent, words.size(), heard.string(), word.text, word.start);
}

}  // namespace chironomia
