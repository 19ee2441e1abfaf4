// Signals of listening and of taking turns in a dialog, beside those of a person's own words.
#pragma once

#include <cstdint>
#include <vector>

#include "synth/planner/behaviour.h"
#include "synth/presence/turns.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

// One of two people, as the other sees and hears them.
struct HeardPartner {
    const std::vector<Phrase>& phrases;
    const std::vector<double>& accents;  // [s]
};

struct AttendInputs {
    std::size_t person = 0;  // whose signals these are; FloorTime (turns.h) says who speaks when
    const std::vector<FloorTime>& floors;
    HeardPartner partner;
    const Speaker& speaker;
    std::uint64_t seed = 0;
};

// The signals of a person, and with them, ascending:
//     - while the partner has the floor: nods in most pauses and on some accents, single or double, never
//       closer than 1.2 s, and sometimes raised brows; both more often the higher the overall activation;
//     - where the person takes the turn, a look away, unless the signals already say where to look;
//     - where the person's turn ends, a look at the partner.
std::vector<Signal> attend(std::vector<Signal> signals, const AttendInputs& inputs);

}  // namespace chironomia
