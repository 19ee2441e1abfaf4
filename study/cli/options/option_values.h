// Values of options that are more than a number or a path.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "core/shard.h"
#include "study/clip/clip.h"

namespace chironomia::study {

// "1280x720": width and height, each 16..8192. Throws Error if the text says anything else.
RenderSize parse_size(std::string_view text);

// "30", "29.97", "30000/1001": frames per second of a clip. Throws Error if the text says anything else.
Rate parse_clip_rate(std::string_view text);

// "15": frames per second of a motion. Throws Error if the text is no number above 0.
double parse_motion_rate(std::string_view text);

// "A:B": frames A to B - 1 of the clip, counted from 0; either side may be left out. Throws Error if B is not
// after A.
FrameRange parse_frame_range(std::string_view text);

// "A:B": what lies from A to B seconds; either side may be left out. Throws Error if B is not after A.
Cut parse_cut(std::string_view text);

// "2/8": the second of eight parts; both numbers from 1 to 100000. Throws Error if the text says anything else.
Shard parse_shard(std::string_view text);

// A whole number of 64 bits, without a sign. Throws Error.
std::uint64_t parse_seed(std::string_view text);

// "ours=1,baseline=-0.5": a number for each name; a name may hold commas. Throws Error if a part is no
// NAME=NUMBER or a name comes twice.
std::map<std::string, double> parse_strengths(std::string_view text);

}  // namespace chironomia::study
