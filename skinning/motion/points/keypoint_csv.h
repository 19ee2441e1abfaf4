// Keypoints from tables of comma-, semicolon- or tab-separated values, with one line of column names.
//
// Wide: a row per frame, columns NAME_x, NAME_y, NAME_z and, if known, NAME_confidence (or _c, _score, _visibility),
//       the separator before x being any of _ . : or a space, or x_NAME and so on; optionally `time` or `frame`.
// Long: a row per frame and point, columns `frame`, `name` (or `point`, `keypoint`, `joint`, `landmark`), `x`, `y`,
//       `z` and, if known, `confidence` (or `c`, `score`, `visibility`); optionally `time`.
// Times may be named by their unit, too, as `time_ms` or `Time (Seconds)`; their usual step shows which it is
// (even_frames.h).
// Without any z they are points of a picture, x to the right and y down. Points may have numbers in place of
// names ("x1", "y1", ... or "x_0", "y_0", ...), which count up; their layout is then found by their number.
// Of several people, whom a column `person`, `subject`, `body`, `track` (each also with _id) or `id` names, the one who
// comes first is taken.
// Empty cells mean that the point is missing. Lines that begin with # are skipped.
#pragma once

#include <string>
#include <string_view>

#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {

// The rate comes from the `time` column, which must advance evenly. Throws Error with the line for anything
// else.
KeypointData keypoints_of_csv(std::string_view text, const std::string& where);

}  // namespace chironomia
