// How a clip shows people who walk: a camera that stays, a camera that goes along, or steps in place.
#pragma once

#include <map>
#include <string>

namespace chironomia::study {

enum class Travel {
    free,      // the camera stays, and people may leave the picture
    follow,    // the camera goes along with each person (study/clip/camera_path.h)
    in_place,  // the hips stay over the place where they begin; the legs move
};

// The words of plans: "free", "follow", "in-place".
const std::map<std::string, Travel>& travels();
std::string to_text(Travel travel);

}  // namespace chironomia::study
