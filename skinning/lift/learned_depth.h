// What a small network has learned to tell of a picture: how shoulders are turned, and where arms point.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "skinning/lift/picture_body.h"

namespace chironomia {

// Each bone of an arm points to the camera or away from it. Bit 0 of a way: the forearm points to the camera,
// bit 1: the upper arm.
inline constexpr int kArmWays = 4;

// Where an arm points, as far as the picture tells.
struct LearnedArm {
    double upper = 0;  // the sine of its bone's angle out of the picture's plane, to the camera, in [-1, 1]
    double lower = 0;
    std::array<double, kArmWays> unlikely{};  // the negative logarithm of how likely each way is
};

struct LearnedPosture {
    double yaw = 0;     // of the shoulders, to the person's left [rad]
    double spread = 0;  // how unsure that is: the scale of a Laplace distribution [rad]
    LearnedArm left, right;
};

// The same, with depths low-passed at 1.2 Hz: what is faster is told better by how long bones look.
std::vector<LearnedPosture> steadied(std::vector<LearnedPosture> postures, double fps);

// A layer reads each frame, with the clip's lengths and the means and spreads of the seconds around; five
// more look ever farther before and after, to two seconds together, and add what they find; two tell. It is
// asked twice, the second time about the picture's mirror image. assets/models/make/lift.py trains it on
// bodies that it makes up. After Bai, Kolter and Koltun, "An empirical evaluation of generic convolutional
// and recurrent networks for sequence modeling", 2018, whose layers look only back.
class LearnedDepth {
  public:
    static constexpr size_t kWidth = 128;  // numbers that a frame has between the layers

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
    Layer first_;
    std::vector<Layer> around_;
    Layer middle_, last_;
};

}  // namespace chironomia
