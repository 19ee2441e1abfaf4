// A camera that goes along with a person who walks towards the real one or away from it.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

// How far the person is in each frame against where it mostly is, (T), or nothing if it stays within a
// quarter of one distance, or if legs are seen in less than half of the frames: a trunk alone looks as small
// when it turns and bends, so frames without legs are passed over. Trunk, shoulders, hips and the bones of
// the legs are told against the longest that each is seen; the second largest of them counts, as all may be
// foreshortened but hardly all at once. Low-passed at 0.5 Hz, which leaves those as they are who walk at one
// speed.
std::vector<double> find_distances(const PictureBody& body, double fps);

// What is known of the camera that filmed.
struct RealCamera {
    double distance = 4;  // from where the person mostly is, where nothing tells it [m]
    Vec2 size{0};         // of its picture; 0: not known
    double focal = 0;     // [the picture's unit]; 0: not known
};

// The camera stays where it is, but turns after the person, and shows it as large as it mostly is. Who stays
// at one distance is not followed: all is as it was.
class Following {
  public:
    // How large the person looks by a known lens tells how far the camera is. For one who walks an unknown
    // lens is taken for one that shows as much as it is away, 53 degrees, as cameras and phones do more or
    // less, and an unknown size for the smallest usual one that holds all points, if they can be pixels. By a
    // known lens nobody comes nearer than 0.8 m, by a supposed one than 1.5 m.
    Following(const PictureBody& body, const RealCamera& camera, double fps);

    Vec2 middle() const { return middle_; }        // the point of the picture that the camera looks at
    double distance() const { return distance_; }  // [m]
    double nearest() const;                        // of the person from the camera, over all frames [m]
    double farthest() const;

    // What it sees of a body that the real one sees.
    PictureBody seen(PictureBody body) const;

    // From its axes to those of the real one; both are x right, y up, z towards the camera, from the point
    // that is `distance` before it [m]. Where the real camera sees the place stays.
    Vec3 place(size_t frame, const Vec3& place) const;

  private:
    void turn_after(std::span<const glm::dvec2> centres);

    double distance_;
    Vec2 middle_;
    double focal_;                   // [the picture's unit]
    std::vector<double> far_;        // (T) or nothing: the distance of the person against distance_
    std::vector<glm::dquat> turns_;  // (T) or nothing: of the camera
};

}  // namespace chironomia
