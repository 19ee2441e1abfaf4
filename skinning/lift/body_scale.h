// The scale of a picture: a pinhole camera, and the lengths of the person's bones in metres.
#pragma once

#include "core/math.h"
#include "skinning/body/body_proportions.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

// A pinhole camera `distance` in front of the person.
struct PinholeCamera {
    double unit = 1;      // of the picture, per metre at the person's own distance
    double distance = 4;  // [m]
    Vec2 middle{0};       // the point of the picture that the camera looks at [the picture's unit]

    // The place of a point of the picture that is `depth` [m] nearer to the camera than the person: x to the
    // person's left, y up, z towards the camera [m].
    glm::dvec3 place(const Vec2& point, double depth) const {
        const double share = (distance - depth) / (distance * unit);
        return {(point.x - middle.x) * share, (middle.y - point.y) * share, depth};
    }
    Vec2 point(const glm::dvec3& place) const {
        const double share = distance * unit / (distance - place.z);
        return {middle.x + static_cast<float>(place.x * share),
                middle.y - static_cast<float>(place.y * share)};
    }
};

struct BodyScale {
    PinholeCamera camera;
    BodyLengths lengths;  // of this person, scaled so that the shoulders are as wide as an adult's
};

// Estimates one scale and one set of lengths for the whole clip: the scale from trunk, shoulders and arms
// together, each length from the longest that the bone looks, because foreshortened bones only look shorter.
// Lengths stay within the range of human proportions. A bone that is never seen has its length of BodyLengths.
//   distance   of the camera [m]
//   middle     the point of the picture that the camera looks at
BodyScale find_body_scale(const PictureBody& body, double distance, const Vec2& middle);

// The centre of a picture of this size. If the size is 0, which means not known, the mean place of the thorax.
Vec2 centre_of(const PictureBody& body, const Vec2& size);

}  // namespace chironomia
