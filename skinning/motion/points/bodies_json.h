// Joints in space of bodies that a program numbered, a list of bodies a frame.
//
// Azure Kinect, as its offline_processor writes them [mm]:
//     {"joint_names": ["PELVIS", ...], "frames": [{"timestamp_usec": 50000, "bodies": [
//         {"body_id": 1, "joint_positions": [[-12.5, 80.1, 2100.2], ...]}]}, ...]}
// CMU Panoptic, a file body3DScene_NUMBER.json a frame, x, y, z [cm] and confidence of 19 joints in a row:
//     {"univTime": 53541.542, "bodies": [{"id": 0, "joints19": [17.3, -143.9, -49.0, 0.6, ...]}]}
// Of several bodies the one that comes first is taken, which a note says; it is missing where its number is.
#pragma once

#include <filesystem>
#include <string>

#include "core/files/json.h"
#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {

bool holds_bodies(const Json& json);

// Of Azure Kinect. Throws Error with the frame if a body has another form or number of joints than the names.
KeypointData bodies_of_json(const Json& json, const std::string& where);

bool is_panoptic_folder(const std::filesystem::path& folder);

// Throws Error as above.
KeypointData read_panoptic(const std::filesystem::path& folder);

}  // namespace chironomia
