// Our own motion file, .h5: everything that core/body/motion.h holds, in HDF5.
//
//   /                       attributes: format "chironomia motion", version 1, units "m, unit quaternions x y z w"
//   /fps                    float64
//   /frames                 uint64, T
//   /first_time             float64, what the source calls the time of the first frame [s]; missing: 0
//   /notes                  (N) text
//   /joints/names           (J) text
//   /joints/parents         (J) int32, -1 for a root, always smaller than the joint's own index
//   /joints/rest            (J, 10) float32: translation [m], rotation x y z w, scale
//   /joints/turns           (T, J, 4) float32, x y z w, parent_from_joint
//   /joints/translations    (T, J, 3) float32, parent_from_joint [m]
//   /keypoints3d/names      (K) text, of skinning/body/keypoint_layout.h
//   /keypoints3d/points     (T, K, 3) float32, world [m]
//   /keypoints3d/confidence (T, K) float32 in [0, 1], 0: missing
//   /keypoints2d/names      (K) text, of the same names, and "face_0" to "face_69" of OpenPose's faces
//   /keypoints2d/points     (T, K, 2) float32, x right, y down, in the picture [px, or the source's own unit]
//   /keypoints2d/confidence (T, K) float32 in [0, 1], 0: missing
//   /keypoints2d/size       (2) float32, of the picture; 0 0: not known
//   /keypoints2d/focal      float64, of its camera, in the unit of the points; missing: not known
//   /face/channels          (C) text: "AU12", "AU45_L"; _L and _R are the person's own sides
//   /face/intensities       (T, C) float32 in [0, 5]
//   /face/head              (T, 4) float32, x y z w: turns a head that faces +z, +y up, in the world
//   /face/gaze              (T, 4) float32 [rad]: left eye to the person's left, up; right eye alike
//   /face/confidence        (T) float32 in [0, 1], 0: bridged from the frames beside it
//   /labels/names           (L) text: "phase", "gesture"
//   /labels/<0 to L-1>/values (N) text; /labels/<0 to L-1>/frames (T) int32, which of the values holds
// At least one of /joints, /keypoints3d, /keypoints2d and /face is there; of a face, what is not known is
// missing. Texts are UTF-8 of fixed length. In Python:
//     import h5py
//     with h5py.File("wave.h5") as f:
//         fps = f["fps"][()]
//         names = f["joints/names"].asstr()[:]
//         turns = f["joints/turns"][:]  # (T, J, 4)
//         units = f["face/channels"].asstr()[:]
//         intensities = f["face/intensities"][:]  # (T, C)
// Written with h5py, any layout of core/hdf5/file.h is read again, compressed or not.
#pragma once

#include <filesystem>

#include "core/body/motion.h"
#include "core/hdf5/file.h"

namespace chironomia {

// The same motion gives the same bytes. Throws Error if the file cannot be written.
void write_motion_hdf5(const std::filesystem::path& file, const Motion& motion);

// Throws Error if the file is no HDF5, holds no motion of ours, or an array is missing or has another shape.
Motion motion_of_hdf5(const Hdf5File& file);

}  // namespace chironomia
