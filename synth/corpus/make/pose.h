// What a pose detector would find in a picture of an agent: the joints of PATS and the landmarks of the face.
#pragma once

#include "core/body/motion.h"
#include "core/random.h"
#include "synth/corpus/make/camera.h"
#include "synth/corpus/picture_points.h"

namespace chironomia {

// The place of a point that was lost is 0.
struct PicturedPerson {
    PicturePoints pose;  // of the 52 joints of PATS
    PicturePoints face;  // of 70 points (face_points.h)
};

// The motion has joints and a face of the engine's agent (synth/body/agent_body.h). The neck is the middle
// between the shoulders. With noise every place has a standard deviation of 0.4 px, and one point in a
// hundred of each frame but the neck is lost.
PicturedPerson picture_person(const Motion& motion, const FarCamera& camera, bool noise, Random random);

}  // namespace chironomia
