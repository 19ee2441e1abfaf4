#include "raster/ffmpeg/clip_length.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/text.h"

namespace chironomia {
namespace {

// The fewest frames that last as long as the sound, without rounding on the way.
size_t frames_to_cover(const Audio& sound, const Rate& fps) {
    __extension__ using Wide = unsigned __int128;
    const Wide ticks = Wide{sound.length()} * static_cast<unsigned>(fps.numerator);
    const Wide ticks_per_frame =
        Wide{static_cast<unsigned>(sound.rate)} * static_cast<unsigned>(fps.denominator);
    return static_cast<size_t>((ticks + ticks_per_frame - 1) / ticks_per_frame);
}

}  // namespace

ClipLength match_lengths(size_t motion_frames, const Rate& fps, const Audio* sound) {
    assert(motion_frames > 0);
    ClipLength length{.frames = motion_frames};
    if (!sound) return length;
    const size_t sound_frames = frames_to_cover(*sound, fps);
    if (sound_frames > motion_frames + 1) {
        length.frames = sound_frames;
        length.held_frames = sound_frames - motion_frames;
        length.warnings.push_back(
            format("the motion lasts {:.3f} s and the sound {:.3f} s; the last pose is held for {:.3f} s",
                   fps.seconds(motion_frames), sound->duration(), fps.seconds(length.held_frames)));
    }
    length.silence_s = std::max(0.0, fps.seconds(length.frames) - sound->duration());
    if (length.held_frames == 0 && length.silence_s > fps.seconds(1)) {
        length.warnings.push_back(
            format("the sound lasts {:.3f} s and the motion {:.3f} s; {:.3f} s of silence are added",
                   sound->duration(), fps.seconds(motion_frames), length.silence_s));
    }
    return length;
}

Audio pad_with_silence(const Audio& sound, double seconds) {
    const auto wanted = static_cast<size_t>(std::max(0LL, std::llround(seconds * sound.rate)));
    Audio fitted = sound;
    fitted.samples.resize(std::max(wanted, sound.length()) * static_cast<size_t>(sound.channels));
    return fitted;
}

}  // namespace chironomia
