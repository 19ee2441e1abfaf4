// What a small network has learned to tell of a picture: how shoulders are turned, and where arms point.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "skinning/lift/picture_body.h"

namespace chironomia {

// Where a bone points, as far as the picture tells.
struct LearnedBone {
    double towards = 0;  // the sine of its angle out of the picture's plane, to the camera, in [-1, 1]
    double odds = 0;     // the logarithm of the odds that it points to the camera and not away
};

struct LearnedArm {
    LearnedBone upper, lower;
};

struct LearnedPosture {
    double yaw = 0;     // of the shoulders, to the person's left [rad]
    double spread = 0;  // how unsure that is: the scale of a Laplace distribution [rad]
    LearnedArm left, right;
};

// The same, with depths low-passed at 1.2 Hz: each frame was judged by itself, and what is faster is told
// better by how long bones look.
std::vector<LearnedPosture> steadied(std::vector<LearnedPosture> postures, double fps);

// Each of nine frames about the one that is judged goes through the same two layers; what they come to, the
// means and spreads of the seconds around, and the clip's lengths go through three more. It is asked twice,
// the second time about the picture's mirror image. assets/models/make/lift.py trains it on bodies that it
// makes up.
class LearnedDepth {
  public:
    // Throws Error if the file is missing, is no HDF5 file, or holds other arrays than the network's.
    explicit LearnedDepth(const std::filesystem::path& file);

    // (T) Some frame must show both shoulders; everything else may be missing. A frame that lacks a shoulder
    // is taken for the one before.
    std::vector<LearnedPosture> postures(const PictureBody& body, double fps) const;

    // Of `inputs` numbers, to as many as there are offsets.
    struct Layer {
        size_t inputs = 0;
        std::vector<float> weights;  // (outputs, inputs)
        std::vector<float> offsets;  // (outputs)
    };

  private:
    std::vector<Layer> frame_;  // of a row by itself
    std::vector<Layer> all_;    // of all together
};

}  // namespace chironomia
