// Folders of OpenPose: a JSON file for each frame, with all people that it saw.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"

namespace chironomia {

// The names of a hand's 21 points and of a face's 70, as in PictureTrack; a hand's root, which repeats the
// wrist, is "".
std::vector<std::string> openpose_hand_names(std::string_view side);
std::vector<std::string> openpose_face_names();

// A folder that holds files "..._keypoints.json".
bool is_openpose_folder(const std::filesystem::path& folder);

// One person's points in the picture, in the order of the numbers in the files' names
// ("clip_000000000012_keypoints.json"); a number that is left out is a frame in which every point is missing.
// BODY_25 or COCO-18 bodies, hands of 21 points and faces of 70. Of several people in a frame the one is
// taken that is nearest to where the person was before, and in the beginning the one that is seen most
// surely; `notes` say in how many frames there were others, and in how many two were nearly as near. The
// roots of the hands are dropped: they repeat the wrists. `companions` are the files.
//   fps   OpenPose does not write it
// Throws Error if no rate is given, a file is broken or has another number of points, a number is none, more
// than half of the frames are left out, or nobody is seen in any frame.
Motion read_openpose(const std::filesystem::path& folder, std::optional<double> fps);

}  // namespace chironomia
