#include "synth/features/speech_features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "synth/features/contour.h"
#include "synth/features/pitch.h"
#include "synth/features/sound_rate.h"
#include "synth/features/spectrum.h"

namespace chironomia {
namespace {

std::vector<float> column_of(const FeatureTrack& track, std::size_t column) {
    std::vector<float> values;
    for (std::size_t t = 0; t < track.frames(); ++t) values.push_back(track.at(t)[column]);
    return values;
}

// Where a frame lies between two samples.
struct Between {
    std::size_t left = 0, right = 0;
    float share = 0;  // of the right one
};

Between between(double place, std::size_t samples) {
    const double held = std::clamp(place, 0.0, static_cast<double>(samples - 1));
    const auto left = static_cast<std::size_t>(held);
    return {left, std::min(left + 1, samples - 1), static_cast<float>(held - static_cast<double>(left))};
}

float voiced_between(const std::vector<float>& f0, const Between& place) {
    const float left = f0[place.left], right = f0[place.right];
    if (left > 0 && right > 0) return left + place.share * (right - left);
    return place.share <= 0.5f ? left : right;
}

}  // namespace

std::vector<std::string> speech_columns() {
    std::vector<std::string> columns{"f0", "loudness", "voicing"};
    for (int i = 0; i < 13; ++i) columns.push_back("mfcc_" + std::to_string(i));
    return columns;
}

FeatureTrack speech_features(const Audio& sound) {
    const Audio speech = bring_to_rate(sound, kFeatureRate);
    const PitchTrack pitch = find_pitch(speech);
    const std::vector<float> loudness = loudness_of(speech);
    const FeatureTrack cepstra = mel_cepstra(speech);
    FeatureTrack track{.rate = pitch.rate, .columns = speech_columns(), .values = {}};
    for (std::size_t t = 0; t < loudness.size(); ++t) {
        track.values.insert(track.values.end(), {pitch.f0[t], loudness[t], pitch.strength[t]});
        const std::span<const float> row = cepstra.at(t);
        track.values.insert(track.values.end(), row.begin(), row.end());
    }
    return track;
}

FeatureTrack speech_at(const FeatureTrack& speech, double fps, std::size_t frames) {
    const std::size_t samples = speech.frames(), width = speech.width();
    assert(samples > 0 && fps > 0);
    FeatureTrack track{.rate = fps, .columns = speech.columns, .values = std::vector<float>(frames * width)};
    for (std::size_t column = 0; column < width; ++column) {
        const std::vector<float> raw = column_of(speech, column);
        const bool is_pitch = speech.columns[column] == "f0";
        std::vector<std::uint8_t> success(samples, 1);
        if (is_pitch)
            std::transform(raw.begin(), raw.end(), success.begin(), [](float f0) { return f0 > 0; });
        const std::vector<float> smooth = median_filter({.values = raw, .success = success});
        for (std::size_t t = 0; t < frames; ++t) {
            const Between place = between(static_cast<double>(t) / fps * speech.rate, samples);
            track.at(t)[column] = is_pitch ? voiced_between(smooth, place)
                                           : std::lerp(smooth[place.left], smooth[place.right], place.share);
        }
    }
    return track;
}

}  // namespace chironomia
