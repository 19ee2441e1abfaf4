// How loud a sound is, as EBU R 128 measures it, and how to make sounds equally loud.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/audio.h"

namespace chironomia::study {

inline constexpr double kBroadcastLoudness = -23;  // [LUFS] EBU R 128 s. (e)
inline constexpr double kLoudestPeak = -1;         // [dBTP]

struct Loudness {
    // Gated, of the whole sound [LUFS]. None: it is silent, or lasts less than the 0.4 s of one block, or is
    // quieter than -70 LUFS throughout.
    std::optional<double> integrated;
    double true_peak = 0;  // of the loudest channel [dBTP]; minus infinity for silence
};

// ITU-R BS.1770-4 with the gates of EBU Tech 3341. A sound of one channel is heard from two loudspeakers, as
// browsers play it, and measured as that: 3 LU more than from one. More than two channels are measured as
// they are mixed down in a clip. Throws Error if its rate is one that nobody uses.
Loudness measure_loudness(const Audio& sound);

struct LoudSound {
    Audio sound;
    std::string warning;  // empty: it is as loud as asked for
};

// The sound with one gain from beginning to end, so that it is as loud as `target` [LUFS] unless its true
// peak would be above kLoudestPeak. What has no loudness stays as it is.
LoudSound normalize_loudness(const Audio& sound, double target);

// Of a sound, or of the sound of a finished clip; nothing if it has none. Throws Error if the file cannot be
// read.
std::optional<Loudness> loudness_of_file(const std::filesystem::path& file);

}  // namespace chironomia::study
