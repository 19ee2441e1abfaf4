// A body motion and a face of their own rates and lengths, both onto one avatar.
#pragma once

#include <cstddef>
#include <optional>

#include "core/body/motion.h"
#include "skinning/face/face_drive.h"
#include "skinning/fit/fit.h"

namespace chironomia {

// Whether a motion moves the body; false if it has a face alone.
bool moves_body(const Motion& motion);

struct FaceFit {
    Fit fit;                         // as long as the longer of the two
    std::optional<FaceReport> face;  // nothing: no face is given
    std::size_t body_frames = 0;     // at the rate of the fit; 0: the body stands relaxed
    std::size_t face_frames = 0;
};

// Fits the body of `motion` and the face of `face`, or of `motion` if `face` is not given. The face is resampled to the
// rate of the result. The shorter of both is held at its last values. Without a motion of the body it stands relaxed.
// At least one of the two must be there; `face` must have a face. Throws Error as fit_motion.
FaceFit fit_motion_and_face(const std::optional<Motion>& motion, const std::optional<Motion>& face,
                            const Avatar& avatar, const FitOptions& options, const FaceOptions& face_options);

}  // namespace chironomia
