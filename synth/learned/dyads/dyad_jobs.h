// The jobs of chironomia_learn for the models of two people.
//
// The inputs of `animate`, an HDF5 file, at 25 frames per second, in the units of DyadPerson:
//   /speech       (T, 16) of the agent
//   /user/face    (T, 10) of the user, as known by the time of each frame
//   /user/speech  (T, 16)
// and what it makes:
//   /fps          25
//   /features     (10) text, the columns
//   /face         (T, 10) of the agent [rad], [0, 5]
// Frame t follows from the frames before it alone. Before the first one both people are taken to have been as
// in it for four seconds, the agent with a face at rest.
//
// `predict` has the option "horizon" [s]: after so long, the agent's past becomes what was recorded again;
// without it, after the first four seconds the agent has none but its own.
#pragma once

#include "synth/learned/training/learned_model.h"

namespace chironomia {

// "amii", "il-lstm" or "sym-il-lstm".
LearnedModel dyad_learned_model(const std::string& name);

// "hold": nobody's face moves; only predicts, without a checkpoint.
LearnedModel hold_model();

}  // namespace chironomia
