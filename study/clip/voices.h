// Two people heard from where they stand.
#pragma once

#include "core/audio.h"

namespace chironomia::study {

struct PanGains {
    double left = 0;
    double right = 0;
};

// Constant power: a voice is as loud wherever it stands, because the squares of the gains sum to 1. The angle
// [rad] goes from -pi/4, all left, to pi/4, all right; each gain is the cosine of the angle to its own side.
PanGains pan_gains(double angle);

// 30 degrees to a side: voices are easy to distinguish, and both ears hear both [rad].
inline constexpr double kVoiceAngle = 0.52359877559829887;

struct VoiceMix {
    Audio sound;      // stereo, as long as the longer voice, at the higher of the two rates
    double gain = 1;  // both voices were made quieter by this so that nothing clips
};

// Each voice, mixed down to mono, placed at its own side. While only one speaks it is as loud as its file is
// as mono: its power is parted between the channels, none is lost.
VoiceMix mix_voices(const Audio& left, const Audio& right);

}  // namespace chironomia::study
