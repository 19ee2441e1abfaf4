// Faults of a motion that the places of its joints do not show: turns that jump, a twisted trunk, feet that slide or
// hover.
#pragma once

#include <vector>

#include "skinning/body/posture.h"
#include "skinning/body/soles.h"
#include "skinning/quality/motion_checks.h"

namespace chironomia {

// Ours, chosen on the tuning half of `build/release/bin/fit_table` (15 good and 15 broken clips: one person of CMU,
// five speakers of the expressive engine). On the held-out half (four other people, five other speakers), looked at
// once, all 15 broken ones were found and none of the 15 good ones suspected by these limits. The faults there are
// transforms of our own.
struct PostureLimits {
    double jump_deg = 35;        // a part turns by more against its neighbour between two frames [degrees]
    double jump_ratio = 4;       // and by so many times what it does in the frames around
    double flip_deg = 120;       // of a hand; the same whatever the frames around do [degrees]
    double twist_deg = 80;       // shoulders against hips [degrees]
    double twist_seconds = 0.2;  // shorter twists are passed through
    double slide_speed = 0.35;   // of a foot on the floor [m/s]
    double slide_seconds = 0.25;
    double hover_height = 0.06;  // of the lower foot above the floor [m]
    double hover_seconds = 0.8;  // nobody jumps for longer
};

// Jumps and flips between two frames, in the order of the body, then the trunk against the shoulders.
//   postures  (T) of joint turns, or of the avatar that points move, which take their roll from what is not seen
std::vector<Finding> check_turns(const std::vector<Posture>& postures, double fps,
                                 const PostureLimits& limits = {});

// Jumps and flips of one part: `turns` (T) against what carries it.
Finding check_jumps(const std::vector<Quat>& turns, const std::string& part,
                    const PostureLimits& limits = {});

// Flips of the hands alone, as an avatar shows them: `turns` (T) of a hand against its forearm.
Finding check_hand(const std::vector<Quat>& turns, const std::string& part, const PostureLimits& limits = {});

// Feet that slide while they stand, and feet that hover.
//   soles  (T) [m, world, floor at y = 0]; none: no feet
std::vector<Finding> check_feet(const std::vector<Soles>& soles, double fps,
                                const PostureLimits& limits = {});

}  // namespace chironomia
