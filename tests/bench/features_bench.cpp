// What the features of a voice cost: items are seconds of sound, so that their rate is how many times faster
// than real time one core is.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "synth/features/pitch.h"
#include "synth/features/spectrum.h"
#include "synth/features/speech_features.h"
#include "synth/text/word_vectors.h"
#include "tests/synth/features/sounds.h"

namespace chironomia {
namespace {

constexpr double kSeconds = 10;

// A voice and a little noise, at espeak-ng's rate.
const Audio& voice() {
    static const Audio mixed = [] {
        Audio sound = testing::voice_like(140, 22050, kSeconds);
        const Audio noise = testing::white_noise(0.02, kSeconds, 22050);
        for (std::size_t i = 0; i < sound.samples.size(); ++i) sound.samples[i] += noise.samples[i];
        return sound;
    }();
    return mixed;
}

template <typename Feature>
void measure(benchmark::State& state, Feature feature) {
    for (auto _ : state) benchmark::DoNotOptimize(feature(voice()));
    state.SetItemsProcessed(static_cast<std::int64_t>(kSeconds * static_cast<double>(state.iterations())));
}

BENCHMARK_CAPTURE(measure, pitch, [](const Audio& sound) { return find_pitch(sound); });
BENCHMARK_CAPTURE(measure, log_mel_400, log_mel_400);
BENCHMARK_CAPTURE(measure, log_mel_512, log_mel_512);
BENCHMARK_CAPTURE(measure, mel_cepstra, mel_cepstra);
BENCHMARK_CAPTURE(measure, speech_features, speech_features);
BENCHMARK_CAPTURE(measure, voice_quality, voice_quality);

void hash_words(benchmark::State& state) {
    std::vector<std::string> words;
    for (int i = 0; i < 30; ++i) words.push_back("word" + std::to_string(i * 7919 % 1000));
    for (auto _ : state) benchmark::DoNotOptimize(hashbert(words));
    state.SetItemsProcessed(state.iterations() * 30);
}
BENCHMARK(hash_words);

}  // namespace
}  // namespace chironomia
