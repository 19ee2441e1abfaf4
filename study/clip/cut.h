// Part of a motion or of a sound, in seconds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "core/audio.h"
#include "core/body/motion.h"
#include "core/render/rate.h"

namespace chironomia::study {

// What lies in [begin, end).
struct Cut {
    double begin = 0;             // at least 0 [s]
    std::optional<double> end{};  // above `begin` [s]; none: to the end
};

// Frames [first, first + count) of a clip.
struct CutFrames {
    std::size_t first = 0;
    std::size_t count = 0;
};

// The frames that are nearest to the ends of a cut of something that lasts `seconds`. Throws Error, naming
// `file`, if the cut reaches beyond the end by half a frame or more, or if it holds no frame.
CutFrames cut_frames(const Cut& cut, double seconds, const Rate& fps, const std::filesystem::path& file);

// What the frames show of a motion, at its own rate. Throws Error if it ends before they begin.
Motion cut_motion(const Motion& motion, const CutFrames& frames, const Rate& fps);

// What lies in the cut, with a fade of 10 ms where something was cut off; shorter than asked for if the sound
// ends before. Throws Error as read_audio_part, and if nothing is left.
Audio read_cut(const std::filesystem::path& file, const Cut& cut);

// The sound with a duration of `seconds`, rounded to the nearest sample: silence is added at the end, or the rest is
// cut off with a fade of 10 ms.
Audio set_duration(const Audio& sound, double seconds);

}  // namespace chironomia::study
