// Landmarks of MediaPipe as JSON, a frame an object, as its results are usually dumped.
//
//     {"fps": 25, "width": 1280, "height": 720, "frames": [
//         {"pose_landmarks": [{"x": 0.5, "y": 0.2, "z": -0.3, "visibility": 0.99}, ...33],
//          "pose_world_landmarks": [...33], "left_hand_landmarks": [...21], "right_hand_landmarks": [...21],
//          "left_hand_world_landmarks": [...21], "right_hand_world_landmarks": [...21]}, ...]}
// Keys may be in camel case, and all but one of the two of the pose may lack; a list of frames alone, a point
// as [x, y, z, visibility], and landmarks in a list of people or under "landmark" are understood, too, and the
// keys "landmarks" and "worldLandmarks" of the Tasks of JavaScript with a list of people. null or an empty list
// is a frame that shows nothing. Landmarks are shares of the picture's width and height, y
// down; world landmarks are metres around the hips, those of a hand around its own middle.
#pragma once

#include <optional>
#include <string>

#include "core/body/motion.h"
#include "core/files/json.h"

namespace chironomia {

bool holds_mediapipe(const Json& json);

// World landmarks become keypoints in space in the axes of MediaPipe, with hands set to their wrists;
// landmarks become a picture, in shares as they are (picture_hints.h makes pixels of them). Of several people
// the first is taken, which a note counts.
//   fps   instead of the rate of the file
// Throws Error if a frame has another form or number of points, if nothing is seen, or if no rate is known.
Motion motion_of_mediapipe(const Json& json, const std::string& where, std::optional<double> fps);

}  // namespace chironomia
