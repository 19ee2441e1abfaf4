// Pictures' points in HDF5 files of PATS, a corpus of speakers filmed from in front, and of the models that
// learn from it.
//
//   /pose/data        (T, 104) x of 52 points, then y of 52 points, against the neck, y down [px]
//   /pose/normalize   (T, 104) the same with shoulders of one width; taken where there is no /pose/data
//   /pose/confidence  (T, 104) in [0, 1], the same for x and y; may lack, then all points are seen
//   /face/data        (T, 140) 70 points of OpenPose's face alike, or /face/normalize; may lack
//   /face/confidence  (T, 140)
// A pose may also be (T, 22), the 11 points that models of such gestures put out, and a face (T, 30), their
// 15 points (skinning/body/keypoint_layout.h).
// Ahuja, Lee, Nakano, Morency, "Style Transfer for Co-Speech Gesture Animation", ECCV 2020.
#pragma once

#include <optional>

#include "core/body/motion.h"
#include "core/hdf5/file.h"

namespace chironomia {

inline constexpr double kPatsFps = 15;

// Whether there is a pose of that form.
bool holds_pats(const Hdf5File& file);

// The rate is the attribute "fps" of the file, of /meta or of /pose, else 15.
//   fps   instead of that rate
// Throws Error if an array has another shape, or a place is no number although it is not missing.
Motion read_pats(const Hdf5File& file, std::optional<double> fps);

}  // namespace chironomia
