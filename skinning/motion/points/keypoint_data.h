// Keypoints as a file holds them, before its points get the names of the program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"

namespace chironomia {

// How far from 1 the length of a quaternion with few digits may be; ours.
inline constexpr double kQuaternionTolerance = 0.01;

inline constexpr double kMostConfidence = 1.2;  // some detectors go a little beyond 1

// How files call how sure a point is, in lower case, a number. Where a point has several, the first in a table or an
// archive counts, and the first of these in JSON.
inline const std::initializer_list<std::string_view> kConfidenceNames = {"confidence",
                                                                         "visibility",
                                                                         "score",
                                                                         "c",
                                                                         "confidences",
                                                                         "conf",
                                                                         "scores",
                                                                         "vis",
                                                                         "v",
                                                                         "p",
                                                                         "likelihood",
                                                                         "prob",
                                                                         "probability",
                                                                         "presence",
                                                                         "keypoint_scores",
                                                                         "keypoint_score",
                                                                         "keypoints_scores",
                                                                         "keypoints_score"};

struct KeypointData {
    std::string where;                                // the file's name
    std::vector<std::filesystem::path> companions{};  // as in Motion
    std::vector<std::string> names;                   // (K) as in the file; empty: the file names none
    size_t frames = 0;                                // T
    size_t points = 0;                                // K
    std::vector<std::string> ours;  // (K) names here, "" to drop a point; empty: from `names`
    bool picture = false;           // x right and y down in a picture, z is 0
    bool in_space = false;          // the format says that the points are places in space, and which
    bool known_order = false;       // the format says which points there are, as those of detectors do
    bool unnamed_third = false;  // a point has three numbers of which the file does not say what the last is
    Vec2 size{0};                // of the picture; 0: not known
    std::vector<double> places;  // (T, K, 3) in the file's axes and unit
    std::vector<double> confidence;  // (T, K); empty: the file has none
    std::optional<double> fps;       // as in the file
    double first_time = 0;           // as in Motion
    double first_number = 0;         // of the first frame, where the file numbers them from 2 on or later
    std::vector<std::string> notes;
};

// Names the points as in skinning/body/keypoint_layout.h: by the name map, by the names of the file, or by the number
// of points and by whether they make a body: its bones, and in a picture also where it has them (body_proportions.h).
// Points that are not known are dropped, and a note says so. A point is missing where its confidence is 0 or no number,
// or where its place is 0 0 0 in a format that means it so, or in some frames but not in those before and after; in a
// picture also at its corner, and at -1 -1.
//   fps        instead of the rate in the file
//   name_map   JSON {"their name": "our name"}, null or "-" to drop a point; files without names count from "0"
// Where the third number of a point has no name it is a confidence, and the points are those of a picture, if it lies
// between 0 and 1 everywhere, or hardly changes, while the points spread over many units: no body is that flat; or if
// it is a score above 0 that does not make up for the lengths that bones of a picture lack (residual_changes). Scores
// above 1, also those that the file names, are divided by the usual one. Throws Error if the points are not known,
// third numbers may be either, the rate is missing, or a place is no number although it is not missing.
Motion name_keypoints(KeypointData data, std::optional<double> fps, const std::filesystem::path& name_map);

}  // namespace chironomia
