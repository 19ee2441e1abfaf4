// Two people who take turns: who speaks when.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/speech.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

struct SpokenTurn {
    std::size_t person = 0;  // 0 or 1
    Speech speech;
};

struct Pauses {
    double between = 0;   // of two turns [s]
    double at_edges = 0;  // before the first turn and after the last [s]
};

// What each of the two says, on a common timeline: turn after turn; silence while the other speaks. Both sounds are
// equally long. All turns have the same rate of sound.
std::array<Speech, 2> place_turns(std::span<const SpokenTurn> turns, const Pauses& pauses);

// A time in which one of the two has the floor: from their first word until the other begins.
struct FloorTime {
    std::size_t person = 0;
    double start = 0;   // of the first phrase [s]
    double silent = 0;  // end of the last phrase [s]
    double end = 0;     // when the other begins, or as `silent` [s]
};

// Ascending, alternating.
std::vector<FloorTime> floor_times(const std::array<std::vector<Phrase>, 2>& phrases);

}  // namespace chironomia
