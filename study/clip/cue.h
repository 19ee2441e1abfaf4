// A cue for who speaks: a soft bar in the picture under the person whose voice is heard.
#pragma once

#include <cstddef>
#include <vector>

#include "core/audio.h"
#include "core/math.h"
#include "core/render/frame.h"
#include "core/render/rate.h"

namespace chironomia::study {

enum class SpeakingCue { none, light };

// How strongly a voice shows at each frame, (frames) in [0, 1].
// The level is the power of all channels in blocks of 10 ms. Speech begins where three blocks in a row lie
// within 25 dB of the voice's own loud parts (the 95th percentile of its blocks), and ends when it has been
// more than 35 dB below them for 0.3 s; a block under -60 dB of full scale is never speech. What is shown
// rises to 1 within 0.12 s of speech and falls to 0 within 0.25 s after it. A frame shows what holds when it
// begins; after the end of the sound nobody speaks.
std::vector<float> cue_strengths(const Audio& voice, const Rate& fps, std::size_t frames);

// Draws the bar with its middle at `place` [px], as opaque as `strength` in [0, 1] says. Its size follows the
// height of the frame.
void draw_cue(Frame& frame, const Vec2& place, float strength);

}  // namespace chironomia::study
