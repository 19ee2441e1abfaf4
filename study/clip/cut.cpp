#include "study/clip/cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/signal/resample.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

constexpr double kFade = 0.01;  // [s]

std::size_t nearest_frame(double seconds, const Rate& fps) {
    return static_cast<std::size_t>(std::llround(seconds * fps.per_second()));
}

std::string shown(const Cut& cut) {
    return cut.end ? format("{:.3f} s to {:.3f} s", cut.begin, *cut.end)
                   : format("{:.3f} s to the end", cut.begin);
}

// Half a cosine, from silence at the very end of the sound (or at its beginning) to its full strength.
void fade(Audio& sound, bool at_end) {
    const std::size_t length = sound.length();
    const auto channels = static_cast<std::size_t>(sound.channels);
    const std::size_t faded = std::min(length, static_cast<std::size_t>(std::llround(kFade * sound.rate)));
    for (std::size_t i = 0; i < faded; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(faded);
        const auto gain = static_cast<float>(0.5 - 0.5 * std::cos(std::numbers::pi * share));
        const std::size_t place = at_end ? length - 1 - i : i;
        for (std::size_t c = 0; c < channels; ++c) sound.samples[place * channels + c] *= gain;
    }
}

}  // namespace

CutFrames cut_frames(const Cut& cut, double seconds, const Rate& fps, const fs::path& file) {
    const double half_a_frame = fps.seconds(1) / 2;
    if (cut.begin >= seconds || cut.end.value_or(seconds) >= seconds + half_a_frame) {
        throw Error(format("{}: {} is to be shown, but the motion lasts {:.3f} s; choose a cut within it",
                           file.string(), shown(cut), seconds));
    }
    const std::size_t first = nearest_frame(cut.begin, fps);
    const std::size_t last = nearest_frame(cut.end.value_or(seconds), fps);
    if (first >= last) {
        throw Error(
            format("{}: {} holds no frame at {} frames/s, which last {:.3f} s each; choose a longer cut",
                   file.string(), shown(cut), to_text(fps), fps.seconds(1)));
    }
    return {.first = first, .count = last - first};
}

Motion cut_motion(const Motion& motion, const CutFrames& frames, const Rate& fps) {
    const double begin = fps.seconds(frames.first);
    if (begin >= duration(motion)) {
        throw Error(format("{}: lasts {:.3f} s, but is to be shown from {:.3f} s; choose a cut within it",
                           motion.source, duration(motion), begin));
    }
    return cut_motion(motion, begin, fps.seconds(frames.first + frames.count));
}

Audio read_cut(const fs::path& file, const Cut& cut) {
    AudioPart part = read_audio_part(file, cut.begin, cut.end);
    if (part.sound.samples.empty()) {
        throw Error(format("{}: {} is to be heard, but the sound lasts {:.3f} s; choose a part within it",
                           file.string(), shown(cut), static_cast<double>(part.length) / part.sound.rate));
    }
    if (part.first > 0) fade(part.sound, false);
    if (part.first + part.sound.length() < part.length) fade(part.sound, true);
    return std::move(part.sound);
}

Audio set_duration(const Audio& sound, double seconds) {
    const auto wanted = static_cast<std::size_t>(std::llround(seconds * sound.rate));
    const bool is_longer = sound.length() > wanted;
    Audio fitted = sound;
    fitted.samples.resize(wanted * static_cast<std::size_t>(sound.channels));
    if (is_longer) fade(fitted, true);
    return fitted;
}

}  // namespace chironomia::study
