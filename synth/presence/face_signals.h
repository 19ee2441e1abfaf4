// Which action units the signals of a face move.
#pragma once

#include <cstdint>
#include <vector>

#include "core/body/face.h"
#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"
#include "synth/presence/style.h"

namespace chironomia {

// Of the units 1, 2, 4, 5, 6, 7, 9, 10, 12, 15, 17, 20, 23, 26 and 45, in this order.
const std::vector<FaceChannel>& presence_channels();

// The place of one of them.
std::size_t channel_of(int unit);

// A curve for each of presence_channels(), before any limit: what the signals ask for, and brows that rise a
// little with the accents; no blinks and no smiles.
std::vector<Curve> move_face(const Behaviours& behaviours, const PresenceStyle& style,
                             const FrameTimes& times, std::uint64_t seed);

// A person's own smile, without the partner's influence; 1 is a usual smile. It has the smiles that the signals
// ask for, and faint spontaneous ones of 0.07 to 0.28 every few seconds.
Curve own_smile(const std::vector<Signal>& signals, const FrameTimes& times, std::uint64_t seed);

// Intensities of AU 6 and 12 in a smile of 1. Ours, by eye.
inline constexpr double kSmilingCheeks = 2.2, kSmilingLips = 3.2;

}  // namespace chironomia
