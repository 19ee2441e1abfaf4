// The pitch of voices: synthetic ones whose pitch does not change, and recorded ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/files/files.h"
#include "synth/features/pitch.h"
#include "synth/features/sound_rate.h"
#include "synth/features/speech_features.h"
#include "synth/speech/speak.h"
#include "tests/support/support.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

constexpr double kLowest = 60, kHighest = 400;  // of the autocorrelation [Hz]

// Of the samples about `middle`, for each lag up to the longest: the autocorrelation, against that at no lag,
// each mean over the samples that there are.
std::vector<double> autocorrelation(const std::vector<float>& samples, std::size_t middle,
                                    std::size_t window) {
    const auto longest = static_cast<std::size_t>(kFeatureRate / kLowest);
    std::vector<double> correlations(longest + 1, 0.0);
    if (middle < window / 2 || middle + window / 2 + longest > samples.size()) return correlations;
    const float* begin = &samples[middle - window / 2];
    for (std::size_t lag = 0; lag <= longest; ++lag) {
        double product = 0, energy = 0, later = 0;
        for (std::size_t i = 0; i < window; ++i) {
            product += static_cast<double>(begin[i]) * begin[i + lag];
            energy += static_cast<double>(begin[i]) * begin[i];
            later += static_cast<double>(begin[i + lag]) * begin[i + lag];
        }
        correlations[lag] = energy > 1e-6 && later > 1e-6 ? product / std::sqrt(energy * later) : 0;
    }
    return correlations;
}

// The first lag that is nearly as good as the best, between samples.
double pitch_of_peak(const std::vector<double>& correlations) {
    const auto shortest = static_cast<std::size_t>(kFeatureRate / kHighest);
    const double best =
        *std::max_element(correlations.begin() + static_cast<std::ptrdiff_t>(shortest), correlations.end());
    for (std::size_t lag = shortest; lag + 1 < correlations.size(); ++lag) {
        const double left = correlations[lag - 1], here = correlations[lag], right = correlations[lag + 1];
        if (here < 0.95 * best || here < left || here < right) continue;
        const double bend = left - 2 * here + right;
        return kFeatureRate / (static_cast<double>(lag) + (bend < 0 ? (left - right) / (2 * bend) : 0));
    }
    return 0;
}

// Of a voice that keeps its pitch: the autocorrelations of all moments together, which know nothing of
// spectra or candidates.
double constant_pitch(const std::vector<float>& samples) {
    std::vector<double> sum(static_cast<std::size_t>(kFeatureRate / kLowest) + 1, 0.0);
    for (std::size_t middle = 0; middle < samples.size(); middle += 800) {
        const std::vector<double> one = autocorrelation(samples, middle, 640);
        for (std::size_t lag = 0; lag < sum.size(); ++lag) sum[lag] += one[lag];
    }
    return pitch_of_peak(sum);
}

struct Agreement {
    std::size_t voiced = 0;
    std::size_t octaves = 0;  // frames that are nearer to another octave
    double median = 0;        // [Hz]
};

Agreement agreement_with(double truth, const PitchTrack& track) {
    Agreement agreement;
    std::vector<float> voiced;
    for (const float f0 : track.f0) {
        if (f0 == 0) continue;
        voiced.push_back(f0);
        if (std::abs(std::log2(f0 / truth)) > 0.5) ++agreement.octaves;
    }
    agreement.voiced = voiced.size();
    std::sort(voiced.begin(), voiced.end());
    agreement.median = voiced.empty() ? 0 : voiced[voiced.size() / 2];
    return agreement;
}

TEST(SpokenPitch, IsThatOfVoicesThatKeepTheirs) {
    const MarkedText text = testing::script(
        "The morning sun was warm, and we were all alone near the old yellow wall. You know, more than nine women may "
        "one day remember him, and nobody will ever say a word about it.");
    Agreement all;
    for (const char* variant : {"", "m3", "f2"}) {
        for (const int pitch : {30, 50, 75}) {
            const Voice voice{
                .language = "en-us", .variant = variant, .pitch = pitch, .rate = 150, .range = 0};
            const Audio sound = bring_to_rate(speak(text, voice).audio, kFeatureRate);
            const double truth = constant_pitch(sound.samples);
            const Agreement one = agreement_with(truth, find_pitch(sound));
            EXPECT_NEAR(one.median, truth, 0.01 * truth) << variant << " " << pitch;
            EXPECT_GT(one.voiced, 300u);
            all.voiced += one.voiced;
            all.octaves += one.octaves;
        }
    }
    EXPECT_LT(static_cast<double>(all.octaves), 0.01 * static_cast<double>(all.voiced));
}

// 16-bit, mono, with a header of 44 bytes, as the files of the test data are; at the rate of the features.
Audio recording(const std::string& file) {
    const std::vector<std::byte> bytes = read_bytes(testing::test_file(file));
    int rate = 0;
    std::memcpy(&rate, bytes.data() + 24, sizeof rate);
    Audio sound{.rate = kFeatureRate, .channels = 1, .samples = {}};
    std::vector<float> samples;
    for (std::size_t i = 44; i + 1 < bytes.size(); i += 2) {
        const auto bits = static_cast<std::uint16_t>(std::to_integer<int>(bytes[i]) |
                                                     std::to_integer<int>(bytes[i + 1]) << 8);
        samples.push_back(static_cast<float>(std::bit_cast<std::int16_t>(bits)) / 32768);
    }
    const double step = static_cast<double>(rate) / kFeatureRate;
    for (double at = 0; at + 1 < static_cast<double>(samples.size()); at += step) {
        const auto i = static_cast<std::size_t>(at);
        const auto share = static_cast<float>(at - static_cast<double>(i));
        sound.samples.push_back(samples[i] + share * (samples[i + 1] - samples[i]));
    }
    return sound;
}

// The share of the frames that both call clearly voiced in which they are within 5 % of each other.
void expect_agreement(const std::string& name, double least_hertz, double most_hertz) {
    const Audio sound = recording(name);
    const PitchTrack track = find_pitch(sound);
    std::size_t both = 0, alike = 0, voiced = 0, in_range = 0;
    for (std::size_t t = 0; t < track.f0.size(); ++t) {
        if (track.f0[t] == 0) continue;
        ++voiced;
        if (track.f0[t] >= least_hertz && track.f0[t] <= most_hertz) ++in_range;
        const std::vector<double> correlations = autocorrelation(sound.samples, t * 160, 640);
        const double best = *std::max_element(correlations.begin() + 40, correlations.end());
        if (best < 0.85 || track.strength[t] < 0.4f) continue;
        ++both;
        if (std::abs(pitch_of_peak(correlations) / track.f0[t] - 1) < 0.05) ++alike;
    }
    EXPECT_GT(static_cast<double>(voiced), 0.2 * static_cast<double>(track.f0.size())) << name;
    EXPECT_GT(static_cast<double>(in_range), 0.99 * static_cast<double>(voiced)) << name;
    EXPECT_GT(both, 50u) << name;
    EXPECT_GT(static_cast<double>(alike), 0.95 * static_cast<double>(both)) << name;
}

TEST(RealSpeech, HasThePitchThatItsAutocorrelationHas) {
    struct Recording {
        std::string file;
        double least_hertz = 0, most_hertz = 0;
    };
    for (const auto& [file, least, most] :
         testing::present<Recording>({{"assets/samples/speech/two-ways.wav", 60, 300},
                                      {"assets/samples/speech/simple-idea.wav", 60, 300},
                                      {"../shared/data/speech/jfk.wav", 80, 330},
                                      {"../shared/data/speech/arctic_a0009.wav", 80, 300},
                                      {"../shared/data/speech/acoustic_corpus.wav", 60, 300}}))
        expect_agreement(file, least, most);
}

}  // namespace
}  // namespace chironomia
