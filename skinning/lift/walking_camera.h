// A virtual camera that keeps a walking person in its middle and at one size.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

// The person's distance from the camera in each frame over its median distance (T). Empty if the distances stay
// within a quarter of each other, or if less than half of the frames show legs. Frames without legs do not count,
// because a trunk that turns or bends looks as small as one that is far away. The distance is estimated from
// trunk, shoulders, hips and leg bones: each gives its longest length over its length in the frame. The second
// smallest of these ratios counts, because most parts may be foreshortened but hardly all at once. Low-passed
// at 0.5 Hz.
std::vector<double> find_distances(const PictureBody& body, double fps);

// What is known of the camera that filmed.
struct RealCamera {
    double distance = 4;  // of the person's usual place, if it cannot be computed from the lens [m]
    Vec2 size{0};         // of its picture; 0: not known
    double focal = 0;     // [the picture's unit]; 0: not known
};

// Stays at one place, turns towards the person, and zooms so that the person keeps its usual size. For a person
// who stays at one distance it is the real camera.
class WalkingCamera {
  public:
    // A known focal length and the person's size give the distance. For a person who walks, an unknown focal length
    // is set to the longer side of the picture (a field of view of 53 degrees, common for cameras and phones). An
    // unknown picture size is set to the smallest usual one that holds all points, if they can be pixels. The least
    // distance is 0.8 m with a known lens, 1.5 m with an assumed one.
    WalkingCamera(const PictureBody& body, const RealCamera& camera, double fps);

    Vec2 middle() const { return middle_; }        // the point of the picture that the camera looks at
    double distance() const { return distance_; }  // [m]
    double nearest() const;                        // of the person from the camera, over all frames [m]
    double farthest() const;

    // The picture of this camera, from the picture of the real camera.
    PictureBody seen(PictureBody body) const;

    // Converts a place from the axes of this camera to those of the real camera: x right, y up, z towards the
    // camera, from the point that is `distance` before it [m]. The real camera sees it at the same point.
    Vec3 place(size_t frame, const Vec3& place) const;

  private:
    void track(std::span<const glm::dvec2> centres);

    double distance_;
    Vec2 middle_;
    double focal_;                   // [the picture's unit]
    std::vector<double> far_;        // (T) or empty: the distance of the person over distance_
    std::vector<glm::dquat> turns_;  // (T) or empty: of the camera
};

}  // namespace chironomia
