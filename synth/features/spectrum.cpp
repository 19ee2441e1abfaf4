#include "synth/features/spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/text.h"
#include "synth/features/fourier.h"
#include "synth/features/sound_rate.h"

namespace chironomia {
namespace {

constexpr double kFrameRate = 15;  // of PATS [Hz]

// Slaney's scale: 3 mel for 200 Hz up to 1 kHz, then 27 for each factor of 6.4.
constexpr double kLinearMel = 15;
constexpr double kLinearHertz = 1000;
const double kLogStep = std::log(6.4) / 27;

double mel_of(double hertz, MelScale scale) {
    if (scale == MelScale::htk) return 1127 * std::log1p(hertz / 700);
    if (hertz < kLinearHertz) return hertz * kLinearMel / kLinearHertz;
    return kLinearMel + std::log(hertz / kLinearHertz) / kLogStep;
}

double hertz_of_mel(double mel, MelScale scale) {
    if (scale == MelScale::htk) return 700 * std::expm1(mel / 1127);
    if (mel < kLinearMel) return mel * kLinearHertz / kLinearMel;
    return kLinearHertz * std::exp((mel - kLinearMel) * kLogStep);
}

std::vector<std::string> numbered(const std::string& name, std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(format("{}_{}", name, i));
    return names;
}

void append_logarithms(const std::vector<double>& energies, double of_zero, std::vector<float>& values) {
    for (const double energy : energies)
        values.push_back(static_cast<float>(std::log(energy == 0 ? of_zero : energy)));
}

// `margin` samples more at both ends, mirrored about the first and the last sample, as often as it takes.
std::vector<float> mirrored(const std::vector<float>& samples, std::size_t margin) {
    const auto last = static_cast<std::ptrdiff_t>(samples.size()) - 1;
    std::vector<float> padded;
    for (auto i = -static_cast<std::ptrdiff_t>(margin); i <= last + static_cast<std::ptrdiff_t>(margin);
         ++i) {
        const std::ptrdiff_t place = std::abs(i) % (2 * last);
        padded.push_back(samples[static_cast<std::size_t>(std::min(place, 2 * last - place))]);
    }
    return padded;
}

// What cepstra and loudness have in common: 25 ms about each hundredth of a second, and 26 bands.
constexpr double kCepstrumRate = 100;
constexpr std::size_t kCepstra = 13;
constexpr FrameShape kCepstrumFrame{.window = 400, .length = 512, .taper = Taper::hamming};
constexpr MelOptions kCepstrumBands{
    .scale = MelScale::htk, .bands = 26, .lowest = 20, .highest = 8000, .even_area = false};
constexpr double kSixteenBit = 32768;

// `length` samples about sample `middle`; silence goes on at both ends.
std::vector<double> frame_about(const std::vector<float>& samples, std::size_t middle, std::size_t length) {
    std::vector<double> frame(length);
    for (std::size_t i = 0; i < length; ++i) {
        const std::size_t place = middle + i;
        if (place >= length / 2 && place - length / 2 < samples.size())
            frame[i] = samples[place - length / 2];
    }
    return frame;
}

// As HTK does it, within the window: its first sample stands for the one before it.
void emphasize(std::vector<double>& frame) {
    constexpr double kEmphasis = 0.97;
    const std::size_t first = (kCepstrumFrame.length - kCepstrumFrame.window) / 2;
    for (std::size_t i = first + kCepstrumFrame.window; i-- > first;)
        frame[i] = kSixteenBit * (frame[i] - kEmphasis * frame[i == first ? i : i - 1]);
}

void append_cepstra(const std::vector<double>& energies, std::vector<float>& values) {
    constexpr double kLifter = 22;
    const auto bands = static_cast<double>(energies.size());
    for (std::size_t c = 0; c < kCepstra; ++c) {
        double sum = 0;
        for (std::size_t b = 0; b < energies.size(); ++b) {
            const double angle =
                std::numbers::pi * static_cast<double>(c) * (static_cast<double>(b) + 0.5) / bands;
            sum += std::log(std::max(1.0, energies[b])) * std::cos(angle);
        }
        const double lift = 1 + kLifter / 2 * std::sin(std::numbers::pi * static_cast<double>(c) / kLifter);
        values.push_back(static_cast<float>(std::sqrt(2 / bands) * lift * sum));
    }
}

double sum_of_roots(const std::vector<double>& energies) {
    double sum = 0;
    for (const double energy : energies) sum += std::pow(energy, 0.3);
    return sum;
}

// Calls `visit` with the frame about each hundredth of a second.
template <typename Visit>
void each_cepstrum_frame(const Audio& sound, Visit visit) {
    const Audio speech = bring_to_rate(sound, kFeatureRate);
    for (std::size_t t = 0; t < frames_in(sound, kCepstrumRate); ++t)
        visit(frame_about(speech.samples, t * 160, kCepstrumFrame.length));
}

// Of a tone of 1 kHz at full scale.
double loudness_of_tone(FrameSpectrum& spectrum, const MelBank& bank) {
    std::vector<double> tone(kCepstrumFrame.length);
    for (std::size_t i = 0; i < tone.size(); ++i)
        tone[i] = std::sin(2 * std::numbers::pi * 1000 * static_cast<double>(i) / kFeatureRate);
    return sum_of_roots(bank.energies(spectrum.powers(tone)));
}

}  // namespace

MelBank::MelBank(const MelOptions& options, double rate, std::size_t length) : bins_(length / 2 + 1) {
    assert(options.bands > 0 && options.lowest < options.highest && options.highest <= rate / 2);
    // Corners of the triangles, evenly spaced in mel.
    const double low = mel_of(options.lowest, options.scale), high = mel_of(options.highest, options.scale);
    std::vector<double> corners;
    for (std::size_t i = 0; i < options.bands + 2; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(options.bands + 1);
        corners.push_back(low + share * (high - low));
    }
    const bool is_straight_in_mel = options.scale == MelScale::htk;
    std::vector<double> hertz;
    for (const double corner : corners) hertz.push_back(hertz_of_mel(corner, options.scale));
    const std::vector<double>& edges = is_straight_in_mel ? corners : hertz;

    for (std::size_t band = 0; band < options.bands; ++band) {
        const double area = options.even_area ? 2 / (hertz[band + 2] - hertz[band]) : 1;
        std::size_t first = bins_;
        std::vector<double> weights;
        for (std::size_t bin = 0; bin < bins_; ++bin) {
            const double frequency = static_cast<double>(bin) * rate / static_cast<double>(length);
            const double place = is_straight_in_mel ? mel_of(frequency, options.scale) : frequency;
            const double rise = (place - edges[band]) / (edges[band + 1] - edges[band]);
            const double fall = (edges[band + 2] - place) / (edges[band + 2] - edges[band + 1]);
            const double weight = std::min(rise, fall);
            if (weight <= 0) continue;
            first = std::min(first, bin);
            weights.push_back(weight * area);
        }
        first_.push_back(first);
        weights_.push_back(std::move(weights));
    }
}

std::vector<double> MelBank::energies(std::span<const double> spectrum) const {
    assert(spectrum.size() == bins_);
    std::vector<double> energies(bands(), 0.0);
    for (std::size_t band = 0; band < bands(); ++band)
        for (std::size_t i = 0; i < weights_[band].size(); ++i)
            energies[band] += weights_[band][i] * spectrum[first_[band] + i];
    return energies;
}

std::vector<double> MelBank::weights(std::size_t band) const {
    std::vector<double> all(bins_, 0.0);
    std::copy(weights_[band].begin(), weights_[band].end(),
              all.begin() + static_cast<std::ptrdiff_t>(first_[band]));
    return all;
}

FeatureTrack log_mel_400(const Audio& sound) {
    constexpr std::size_t kBands = 64, kHop = 160;
    const Audio speech = bring_to_rate(sound, kFeatureRate);
    FrameSpectrum spectrum({.window = 400, .length = 512});
    if (speech.length() < spectrum.shape().length) {
        throw Error(format("the sound lasts {:.3f} s, its spectrum takes 0.032 s or more; give a longer one",
                           sound.duration()));
    }
    const MelBank bank({.bands = kBands, .lowest = 125, .highest = 7500, .even_area = false}, kFeatureRate,
                       512);
    FeatureTrack track{
        .rate = static_cast<double>(kFeatureRate) / kHop, .columns = numbered("mel", kBands), .values = {}};
    std::vector<double> magnitudes;
    for (std::size_t begin = 0; begin + 512 <= speech.length(); begin += kHop) {
        const std::span<const double> powers =
            spectrum.powers_at(speech.samples, static_cast<std::ptrdiff_t>(begin));
        magnitudes.assign(powers.begin(), powers.end());
        for (double& magnitude : magnitudes) magnitude = std::sqrt(magnitude);
        append_logarithms(bank.energies(magnitudes), 1e-6, track.values);
    }
    return track;
}

FeatureTrack log_mel_512(const Audio& sound) {
    constexpr std::size_t kBands = 128, kHop = 512, kLength = 2048;
    const Audio speech = bring_to_rate(sound, sound.rate);
    if (speech.length() < 2)
        throw Error(format("the sound has {} samples, its spectrum takes 2 or more; give a longer one",
                           speech.length()));
    const std::vector<float> samples = mirrored(speech.samples, kLength / 2);
    FrameSpectrum spectrum({.window = kLength, .length = kLength});
    const MelBank bank({.bands = kBands, .highest = speech.rate / 2.0}, speech.rate, kLength);
    FeatureTrack track{
        .rate = static_cast<double>(speech.rate) / kHop, .columns = numbered("mel", kBands), .values = {}};
    for (std::size_t begin = 0; begin + kLength <= samples.size(); begin += kHop) {
        const auto powers = spectrum.powers_at(samples, static_cast<std::ptrdiff_t>(begin));
        append_logarithms(bank.energies(powers), 1e-10, track.values);
    }
    return track;
}

IntervalSpectra interval_spectra(const Audio& sound) {
    constexpr int kPatsRate = 44100;
    return {.mel_400 = log_mel_400(sound).values,
            .mel_512 = log_mel_512(bring_to_rate(sound, kPatsRate)).values};
}

FeatureTrack mel_at_15_fps(const FeatureTrack& mel, std::size_t frames, MelResampling way) {
    assert(mel.frames() > 0);
    constexpr std::size_t kStride512 = 6, kStride400 = 7;  // round(89 / 15), round(103 / 15)
    const std::size_t stride = mel.width() == 128 ? kStride512 : kStride400;
    FeatureTrack track{.rate = kFrameRate, .columns = mel.columns, .values = {}};
    const auto row_at = [&](std::size_t frame) {
        return static_cast<std::size_t>(std::ceil(static_cast<double>(frame) / kFrameRate * mel.rate - 1e-9));
    };
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const std::size_t first =
            std::min(way == MelResampling::stride ? frame * stride : row_at(frame), mel.frames() - 1);
        const std::size_t last =
            way == MelResampling::stride ? first + 1 : std::max(row_at(frame + 1), first + 1);
        const std::size_t end = std::min(last, mel.frames());
        for (std::size_t column = 0; column < mel.width(); ++column) {
            double sum = 0;
            for (std::size_t row = first; row < end; ++row) sum += mel.at(row)[column];
            track.values.push_back(static_cast<float>(sum / static_cast<double>(end - first)));
        }
    }
    return track;
}

FeatureTrack mel_cepstra(const Audio& sound) {
    FrameSpectrum spectrum(kCepstrumFrame);
    const MelBank bank(kCepstrumBands, kFeatureRate, kCepstrumFrame.length);
    FeatureTrack track{.rate = kCepstrumRate, .columns = numbered("mfcc", kCepstra), .values = {}};
    each_cepstrum_frame(sound, [&](std::vector<double> frame) {
        emphasize(frame);
        append_cepstra(bank.energies(spectrum.powers(frame)), track.values);
    });
    return track;
}

std::vector<float> loudness_of(const Audio& sound) {
    FrameSpectrum spectrum(kCepstrumFrame);
    const MelBank bank(kCepstrumBands, kFeatureRate, kCepstrumFrame.length);
    const double of_tone = loudness_of_tone(spectrum, bank);
    std::vector<float> loudness;
    each_cepstrum_frame(sound, [&](const std::vector<double>& frame) {
        loudness.push_back(static_cast<float>(sum_of_roots(bank.energies(spectrum.powers(frame))) / of_tone));
    });
    return loudness;
}

}  // namespace chironomia
