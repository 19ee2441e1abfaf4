// What a pose detector would find in a picture of an agent: the joints of PATS and the landmarks of the face.
#pragma once

#include <vector>

#include "core/motion.h"
#include "core/random.h"
#include "synth/corpus/make/camera.h"

namespace chironomia {

// x of all points, then y of all points, in each frame; relative to the neck, y down.
struct PicturePoints {
    std::vector<float> places;  // (T, 2 N) [px]
    std::vector<float>
        normalized;  // alike, as if the shoulders were 100 px apart in the middle one of the frames
    std::vector<float> confidence;  // (T, 2 N) in [0, 1]; 0: the point was lost, and its place is 0
};

struct PicturedPerson {
    PicturePoints pose;  // of the 52 joints of PATS
    PicturePoints face;  // of 70 points (face_points.h)
};

// The motion has joints and a face of the engine's agent (synth/body/agent_body.h). The neck is the middle
// between the shoulders. With noise every place has a standard deviation of 0.4 px, and one point in a
// hundred of each frame but the neck is lost.
PicturedPerson picture_person(const Motion& motion, const FarCamera& camera, bool noise, Random random);

}  // namespace chironomia
