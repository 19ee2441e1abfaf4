#include "raster/ffmpeg/sound.h"

#include <algorithm>
#include <cassert>
#include <cmath>

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
}

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/handles.h"

namespace chironomia {
namespace {

Owned<SwrContext> make_resampler(const Audio& from, const Audio& to) {
    AVChannelLayout from_layout, to_layout;
    av_channel_layout_default(&from_layout, from.channels);
    av_channel_layout_default(&to_layout, to.channels);
    SwrContext* made = nullptr;
    int problem = swr_alloc_set_opts2(&made, &to_layout, AV_SAMPLE_FMT_FLT, to.rate, &from_layout,
                                      AV_SAMPLE_FMT_FLT, from.rate, 0, nullptr);
    Owned<SwrContext> resampler(made);
    if (problem >= 0) problem = swr_init(resampler.get());
    if (problem < 0) {
        throw Error(
            format("sound: {} channels at {} Hz cannot become {} at {} Hz ({}); mix it down to stereo first",
                   from.channels, from.rate, to.channels, to.rate, ffmpeg_message(problem)));
    }
    return resampler;
}

size_t length_at(const Audio& sound, int rate) {
    return static_cast<size_t>(std::llround(static_cast<double>(sound.length()) * rate / sound.rate));
}

}  // namespace

Audio resample(const Audio& sound, int rate) {
    assert(rate > 0 && sound.rate > 0 && sound.channels > 0);
    if (sound.rate == rate && sound.channels <= 2) return sound;
    silence_ffmpeg();
    Audio result{.rate = rate, .channels = std::min(sound.channels, 2), .samples = {}};
    const Owned<SwrContext> resampler = make_resampler(sound, result);
    const size_t channels = static_cast<size_t>(result.channels);
    const size_t wanted = length_at(sound, rate);
    result.samples.resize(wanted * channels);

    // In pieces, because the library counts samples in int.
    constexpr size_t kPiece = 1 << 16;
    size_t read = 0, written = 0;
    while (written < wanted) {
        const size_t piece = std::min(kPiece, sound.length() - read);
        auto* out = reinterpret_cast<std::uint8_t*>(result.samples.data() + written * channels);
        const auto* in = reinterpret_cast<const std::uint8_t*>(sound.samples.data() +
                                                               read * static_cast<size_t>(sound.channels));
        const int room = static_cast<int>(std::min<size_t>(wanted - written, 1 << 24));
        const int made =
            swr_convert(resampler.get(), &out, room, piece > 0 ? &in : nullptr, static_cast<int>(piece));
        if (made < 0) throw Error(format("sound: resampling failed ({})", ffmpeg_message(made)));
        if (made == 0 && piece == 0) break;  // rounding: the last sample stays silent
        read += piece;
        written += static_cast<size_t>(made);
    }
    return result;
}

}  // namespace chironomia
