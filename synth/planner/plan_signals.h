// The signals of the planner (plan_behaviours.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth/planner/behaviour.h"
#include "synth/planner/planned_act.h"

namespace chironomia {

struct SignalPlan {
    const Speech& speech;
    const Accents& accents;
    std::span<const PlannedAct> acts;
    const Manner& speaker;
    std::uint64_t seed = 0;
};

// Ascending by start; signals of one kind do not overlap, nor do looks at and away.
std::vector<Signal> plan_signals(const SignalPlan& plan);

}  // namespace chironomia
