// A small network that estimates the turn of the shoulders and the depth of the arms from a picture's points.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "skinning/lift/picture_body.h"

namespace chironomia {

// The way of a limb: which of its bones point to the camera, the others away from it, as a sum of these bits.
// The outputs of the network are in the order of ways.
inline constexpr int kLowerToCamera = 1;  // forearm or lower leg
inline constexpr int kUpperToCamera = 2;  // upper arm or thigh
inline constexpr int kLimbWays = 4;

// An estimate of where an arm points.
struct LearnedArm {
    double upper = 0;  // the sine of its bone's angle out of the picture's plane, to the camera, in [-1, 1]
    double lower = 0;
    std::array<double, kLimbWays> unlikely{};  // the negative log likelihood of each way
};

struct LearnedPosture {
    double yaw = 0;     // of the shoulders, to the person's left [rad]
    double spread = 0;  // how unsure that is: the scale of a Laplace distribution [rad]
    LearnedArm left, right;
};

// The same, with depths low-passed at 1.2 Hz: the seen lengths of bones show faster movements better.
std::vector<LearnedPosture> steadied(std::vector<LearnedPosture> postures, double fps);

// A temporal convolutional network. The first layer reads each frame, the clip's lengths, and means and spreads of
// the seconds around. Five residual layers with growing dilation see two seconds before and after. Two layers give
// the result. The network runs on the picture and on its mirror image, and the results are averaged.
// assets/models/make/lift.py trains it on synthetic bodies. After Bai, Kolter and Koltun, "An empirical evaluation of
// generic convolutional and recurrent networks for sequence modeling", 2018, whose layers look only back.
class LearnedDepth {
  public:
    static constexpr size_t kWidth = 128;  // numbers that a frame has between the layers

    // Throws Error if the file is missing, is no HDF5 file, or holds other arrays than the network's.
    explicit LearnedDepth(const std::filesystem::path& file);

    // (T) Some frame must show both shoulders; everything else may be missing. A frame that lacks a shoulder gets
    // the input of the frame before.
    std::vector<LearnedPosture> postures(const PictureBody& body, double fps) const;

    // A linear layer.
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
