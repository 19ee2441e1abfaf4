// The 70 points that OpenPose finds on a face, on a face of ours.
#pragma once

#include <array>
#include <cstddef>

#include "core/body/face.h"
#include "core/math.h"
#include "synth/corpus/records.h"

namespace chironomia {

// In metres from the middle between the eyes, of a head that looks along +z with +y up; +x is the person's
// left. Points 0 to 16 go along the jaw from the person's right ear to the left one, 17 to 26 are the brows,
// 27 to 35 the nose, 36 to 47 the lids, 48 to 59 the outer and 60 to 67 the inner edge of the lips, 68 and 69
// the pupils; of both sides the person's right comes first (Cao et al., "OpenPose", TPAMI 43(1), 2021).
// The template is that of an adult whose pupils are 64 mm apart; action units of the frame move its points.
using FacePoints = std::array<Vec3, IntervalRecord::kFacePoints>;
FacePoints place_face_points(const FaceTrack& face, std::size_t frame);

inline constexpr std::size_t kNoseTip = 30, kRightPupil = 68, kLeftPupil = 69;  // of FacePoints

}  // namespace chironomia
