#include "synth/speech/channels.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

using Energies = std::array<double, 2>;  // of the left and of the right channel

// Of each 50 ms.
std::vector<Energies> energies_of(const Audio& sound) {
    const auto frame = static_cast<std::size_t>(std::max(1, sound.rate / 20));
    std::vector<Energies> energies(sound.length() / frame);
    for (std::size_t i = 0; i < energies.size() * frame; ++i) {
        for (std::size_t c = 0; c < 2; ++c) {
            const double sample = sound.samples[2 * i + c];
            energies[i / frame][c] += sample * sample;
        }
    }
    return energies;
}

}  // namespace

Audio take_channel(const Audio& sound, SpeechChannel channel, const std::filesystem::path& file) {
    if (channel != SpeechChannel::mean && sound.channels != 2) {
        throw Error(
            format("{}: it has {} channel{}, but one side of 2 was asked for; leave --speech-channel out",
                   file.string(), sound.channels, sound.channels == 1 ? "" : "s"));
    }
    if (sound.channels == 1) return sound;
    Audio one{.rate = sound.rate, .channels = 1, .samples = std::vector<float>(sound.length())};
    const auto channels = static_cast<std::size_t>(sound.channels);
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
        const float* samples = &sound.samples[i * channels];
        if (channel != SpeechChannel::mean) {
            one.samples[i] = samples[channel == SpeechChannel::left ? 0 : 1];
            continue;
        }
        for (std::size_t c = 0; c < channels; ++c)
            one.samples[i] += samples[c] / static_cast<float>(sound.channels);
    }
    return one;
}

std::optional<std::string> note_of_two_voices(const Audio& sound, const std::filesystem::path& file,
                                              std::string_view advice) {
    constexpr double kHeard = 1e-4;  // of the loudest 50 ms: 40 dB below it
    constexpr double kLouder = 4;    // 6 dB
    constexpr double kShare = 0.1;
    if (sound.channels != 2) return std::nullopt;
    const std::vector<Energies> energies = energies_of(sound);
    double loudest = 0;
    for (const Energies& energy : energies) loudest = std::max({loudest, energy[0], energy[1]});
    double heard = 0, left = 0, right = 0;
    for (const Energies& energy : energies) {
        if (std::max(energy[0], energy[1]) <= kHeard * loudest) continue;
        ++heard;
        left += energy[0] > kLouder * energy[1];
        right += energy[1] > kLouder * energy[0];
    }
    if (heard == 0 || std::min(left, right) < kShare * heard) return std::nullopt;
    return format(
        "{}: its channels are heard in turn, the left one alone in {:.0f} % of the time, the right one in {:.0f} "
        "%; if they are two people, {}",
        file.string(), 100 * left / heard, 100 * right / heard, advice);
}

}  // namespace chironomia
