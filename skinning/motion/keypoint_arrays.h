// Keypoints from NumPy arrays: .npz archives, and .npy with a JSON beside it that tells rate and names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.h"
#include "skinning/motion/keypoint_data.h"
#include "skinning/motion/npy.h"

namespace chironomia {

// The array of shape (T, K, 3), (T, K, 4) with confidence, or (T, K * 3) or (T, K * 4) with K known from the
// names or the layout; further leading sides of 1 do not count. Beside it the .npz may hold `fps` or
// `frame_rate`, `names`, and `confidence` of shape (T, K). Among several arrays of that shape the one under a
// usual name is taken. Throws Error if no array or more than one fits, naming all of them with their shapes.
KeypointData keypoints_of_arrays(const std::vector<NumpyArray>& arrays, const std::string& where);

// A .npy takes rate and names from the JSON of the same name, or whose name begins its own
// ("walk.json" for "walk_xyz_25fps.npy"), with the keys of skinning/motion/keypoint_json.h.
// Throws Error as above, or if several JSON files fit.
KeypointData read_npy_keypoints(const std::filesystem::path& file);

// The same from the side of the JSON, which names the array under "file" or lies beside it.
KeypointData read_described_keypoints(const std::filesystem::path& json_file, const Json& json);

}  // namespace chironomia
