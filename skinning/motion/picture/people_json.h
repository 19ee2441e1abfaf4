// People whom a detector saw in the frames of a clip, all in one JSON file.
//
// A list of results, as COCO defines them and AlphaPose writes them, one for each person and frame, with x, y and
// confidence of all points in a row:
//     [{"image_id": "0.jpg", "category_id": 1, "keypoints": [366.7, 239.6, 0.89, ...], "score": 2.9}, ...]
// The frames of MMPose, alone in a list or under "instance_info":
//     [{"frame_id": 1, "instances": [{"keypoints": [[366.7, 239.6], ...], "keypoint_scores": [0.89, ...]}]}, ...]
// whose points may have three numbers in space. Frames are put in the order of their numbers, which are those at the
// end of names such as "clip_000012.jpg"; a number that is left out is a frame in which nobody was seen. Where names
// have none the order of the file stands. A "timestamp" of each frame gives the rate. One person is followed, as in
// person_tracker.h.
#pragma once

#include <string>

#include "core/files/json.h"
#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {

bool holds_people(const Json& json);

// `where` is the file's name. Throws Error with the frame if a person has another form or number of points than those
// before, a number is none, or more than half of the frames are left out.
KeypointData people_of_json(const Json& json, const std::string& where);

}  // namespace chironomia
