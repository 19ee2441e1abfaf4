// The mouth of a speaking face.
#pragma once

#include <cstddef>

#include "core/body/face.h"
#include "core/speech.h"

namespace chironomia {

// Jaw, lips and tongue while the speech is heard, as action units: T frames, frame t at t / fps seconds.
// - Each phoneme (IPA: English, French, German; of any other letter the jaw opens a little) has a target
//   shape of the mouth. Shapes blend by dominance functions: the weight of a target is highest within its phoneme
//   and falls off exponentially around it, faster for the jaw than for rounded lips, which come early and last.
//   Cohen, Massaro, "Modeling coarticulation in synthetic visual speech", 1993, gave the idea; ours stay at
//   their full value over the middle of a phoneme, and the parts of a diphthong or an affricate are shapes of
//   their own.
// - The lips are shut (AU25 and AU26 at 0, AU24) for as long as p, b and m are heard to stop the breath, and in one
//   frame at least.
// - Louder phonemes open the jaw up to a quarter wider than the middle one does, softer ones less.
// - In a pause all is 0, but for 0.12 s at its edges.
// Without phonemes the jaw and the lips follow the loudness.
FaceTrack shape_mouth(const Speech& speech, std::size_t frames, double fps);

}  // namespace chironomia
