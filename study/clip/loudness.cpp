#include "study/clip/loudness.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ebur128.h>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/sound.h"

namespace chironomia::study {
namespace {

struct EndMeasuring {
    void operator()(ebur128_state* state) const { ebur128_destroy(&state); }
};
using Meter = std::unique_ptr<ebur128_state, EndMeasuring>;

Meter make_meter(const Audio& sound) {
    Meter meter(ebur128_init(static_cast<unsigned>(sound.channels), static_cast<unsigned long>(sound.rate),
                             EBUR128_MODE_I | EBUR128_MODE_TRUE_PEAK));
    if (!meter) {
        throw Error(format("loudness: a sound at {} Hz cannot be measured; use one at 48000 Hz", sound.rate));
    }
    if (sound.channels == 1) ebur128_set_channel(meter.get(), 0, EBUR128_DUAL_MONO);
    return meter;
}

double decibels(double amplitude) {
    return 20 * std::log10(amplitude);
}

}  // namespace

Loudness measure_loudness(const Audio& given) {
    const Audio sound = resample(given, given.rate);  // more channels are mixed down, as the encoder does
    const Meter meter = make_meter(sound);
    ebur128_add_frames_float(meter.get(), sound.samples.data(), sound.length());
    Loudness loudness;
    double integrated = 0, highest = 0;
    ebur128_loudness_global(meter.get(), &integrated);
    if (std::isfinite(integrated)) loudness.integrated = integrated;
    for (int channel = 0; channel < sound.channels; ++channel) {
        double peak = 0;
        ebur128_true_peak(meter.get(), static_cast<unsigned>(channel), &peak);
        highest = std::max(highest, peak);
    }
    loudness.true_peak = decibels(highest);
    return loudness;
}

LoudSound normalize_loudness(const Audio& sound, double target) {
    const Loudness loudness = measure_loudness(sound);
    LoudSound result{.sound = sound, .warning = {}};
    if (!loudness.integrated) {
        result.warning = format(
            "the sound is never louder than -70 LUFS, or shorter than 0.4 s; it cannot be brought to {:.1f} LUFS",
            target);
        return result;
    }
    const double wanted = target - *loudness.integrated;
    const double most = kLoudestPeak - loudness.true_peak;
    const double gain = std::min(wanted, most);
    const auto factor = static_cast<float>(std::pow(10, gain / 20));
    for (float& sample : result.sound.samples) sample *= factor;
    if (wanted > most + 0.05) {
        result.warning = format(
            "the sound has {:.1f} LUFS instead of {:.1f}, because its peaks would be above {:.1f} dBTP; "
            "choose a lower loudness for all clips",
            *loudness.integrated + gain, target, kLoudestPeak);
    }
    return result;
}

std::optional<Loudness> loudness_of_file(const std::filesystem::path& file) {
    if (!read_clip_info(file).sound) return std::nullopt;
    return measure_loudness(read_audio(file));
}

}  // namespace chironomia::study
