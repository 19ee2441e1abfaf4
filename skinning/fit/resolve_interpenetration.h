// Moves arms so that hands and forearms touch the body but do not enter it.
#pragma once

#include <vector>

#include "skinning/body/posture.h"
#include "skinning/shape/body_shape.h"

namespace chironomia {

// What was moved.
struct InterpenetrationMoves {
    // In which a wrist is more than a millimetre, or an elbow's swivel more than 0.1 degrees, from where it was.
    std::size_t frames = 0;
    double most_wrist = 0;   // how far a wrist was moved [m]
    double most_swivel = 0;  // how far an elbow was turned about the line from shoulder to wrist [rad]
};

struct ResolvedPostures {
    std::vector<Posture> postures;  // (T)
    InterpenetrationMoves report;
};

// Where a hand or a forearm is deeper than a touch in the body or in the other arm (skinning/shape/contacts.h), first
// the elbow turns about the line from shoulder to wrist, then the wrist moves out along the shortest way; the elbow
// follows by two-bone inverse kinematics, and the hand keeps its turn in the world. Both arms make way for each other
// by halves. Moves are Gaussian in time, of a standard deviation of 0.1 s, so that nothing jumps; they are found in
// rounds, of which the later ones move what is left. What is stuck between parts may stay inside. Postures without
// contact stay as they are, bit by bit.
//   postures   (T) at `fps` > 0
ResolvedPostures resolve_interpenetration(std::vector<Posture> postures, double fps, const ShapedRig& body);

}  // namespace chironomia
