// Keypoints from JSON.
//
// Our own form; "names" may be left out for a known layout, and a place may have the confidence as fourth
// number:
//     {"fps": 30, "names": ["nose", "left_wrist"], "frames": [[[0, 1.6, 0.1], [0.4, 1.0, 0.2]], ...]}
// Also read: a frame as an object {"nose": [0, 1.6, 0.1], ...} or {"nose": {"x": 0, "y": 1.6, "z": 0.1},
// ...}, or as a list of {"name": "nose", "x": 0, "y": 1.6, "z": 0.1, "visibility": 0.9}, which may stand
// under "keypoints", "landmarks" or "landmark"; a list of such frames without anything around it; `null` for a missing
// point. Points without z are those of a picture, x to the right and y down. Keys with the same meaning:
// "frames", "keypoints", "poses", "data"; "names", "joints", "keypoint_names", "joint_names"; "fps",
// "frame_rate"; "confidence", "visibility", "score".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {

// Throws Error with the frame if the JSON has another form, or its times or numbers cannot be (even_frames.h).
KeypointData keypoints_of_json(const Json& json, const std::string& where);

// The time of a frame under one of the usual keys, such as "time", "timestamp" or "timestamp_ms", in its own unit; in
// seconds where it is that of a clock.
std::optional<double> time_in(const Json& frame);

// Lays the frames of a list out by their times, or else by the numbers ("frame", "frame_id", "frame_index"), that all
// of them give; where the rate is known already, by the numbers. Throws Error as even_frames.h says.
void take_frame_times(KeypointData& data, const Json& frames);

// Whether the JSON only describes an array that lies beside it: it has names or a rate, but no frames.
bool describes_array(const Json& json);

// Width and height of the picture; 0 if the JSON does not give them.
Vec2 picture_size_in(const Json& json);

// The rate and the names in a JSON. Throws Error if they have the wrong type.
std::optional<double> rate_in(const Json& json, const std::string& where);
std::vector<std::string> names_in(const Json& json, const std::string& where);

}  // namespace chironomia
