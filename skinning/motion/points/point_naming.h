// What the points of a file are called here: by a map, by their names, or by their number and where they lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {

struct PointNaming {
    std::vector<std::string> names;  // (K) as in skinning/body/keypoint_layout.h; "": dropped
    bool zero_is_missing = false;    // a point at 0 0 0
    std::string how;                 // for a note
};

// As name_keypoints says. Names that say no more than the order, or a prefix that all have, are taken from `data`; where
// a map counts points from "0", it gets these names. Shares of width and height that MediaPipe writes become points of a
// picture. Throws Error if no layout is known or plausible, two points mean the same, or less than three are known.
PointNaming find_naming(KeypointData& data, const std::filesystem::path& name_map);

// The points that are not dropped. Throws Error, naming frame and point, if a place or a confidence is none, or if every
// point of every frame is missing.
KeypointTrack track_of(const KeypointData& data, const PointNaming& naming);

}  // namespace chironomia
