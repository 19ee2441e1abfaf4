// Where the face of an avatar is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math.h"

namespace chironomia {

// What a vertex belongs to, as far as a face needs to know. The mouth is a part of the face, the face of the
// head; `arm` is all from the shoulder joint to the fingertips.
enum class FacePart : std::uint8_t { other, arm, head, face, mouth };

// Places are those of the rest pose in the world: +x to the person's left, +y up, +z forward.
struct FaceRegion {
    int head = -1;     // the joint that carries it, an index into the skeleton
    Vec3 eyes{0};      // between the eyes [m]
    Vec3 mouth{0};     // between the lips [m]
    Vec3 chin{0};      // its lowest point in front [m]
    Vec3 middle{0};    // inside the head, behind the nose, at half the head's depth [m]
    float height = 0;  // of the face, from the chin to the hairline [m]
    std::vector<std::vector<FacePart>> parts;  // (S)(V) in the order of Avatar::surfaces
    std::vector<std::string> notes;            // how the eyes and the mouth were found
};

}  // namespace chironomia
