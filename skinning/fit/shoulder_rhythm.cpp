#include "skinning/fit/shoulder_rhythm.h"

#include <algorithm>

namespace chironomia {

float clavicle_elevation(float elevation, const ShoulderRhythm& rhythm) {
    return rhythm.slope * std::max(0.0f, elevation - rhythm.setting);
}

}  // namespace chironomia
