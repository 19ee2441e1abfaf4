// Keypoints from NumPy arrays: .npz archives, and .npy with a JSON beside it that has rate and names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "skinning/motion/points/keypoint_data.h"
#include "skinning/motion/points/npy.h"

namespace chironomia {

// The array of shape (T, K, 3), (T, K, 4) with confidence, or (T, K * 3) or (T, K * 4) with K known from the names or
// the layout; further leading sides of 1 do not count, nor the 1 of (T, 1, K, 3). In a picture (T, K, 2), or the rows
// that PATS and the models that learn from it use, x of all points before y of them: (T, 22) or (T, 2, 11) for a body
// of 11 points, (T, 104) of 52, (T, 30) and (T, 140) for a face of 15 or 70 (skinning/body/keypoint_layout.h), (T, 52)
// and (T, 244) for a body with the face behind it, which may also be two arrays `pose` and `face`; (T, 52) from 0 to 1
// are none, but weights of ARKit. Beside it the .npz
// may hold `fps` or `frame_rate`, `names`, and `confidence` of shape (T, K). Among several arrays of that shape the one
// under a usual name is taken. Throws Error if no array or more than one fits, naming all of them with their shapes.
KeypointData keypoints_of_arrays(const std::vector<NumpyArray>& arrays, const std::string& where);

// A .npy takes rate and names from the JSON of the same name, or whose name begins its own
// ("walk.json" for "walk_xyz_25fps.npy"), with the keys of skinning/motion/points/keypoint_json.h.
//   array   what the file holds
// Throws Error as above, or if several JSON files fit.
KeypointData read_npy_keypoints(const std::filesystem::path& file, const NumpyArray& array);

// The same from the side of the JSON, which names the array under "file" or lies beside it.
KeypointData read_described_keypoints(const std::filesystem::path& json_file, const Json& json);

}  // namespace chironomia
