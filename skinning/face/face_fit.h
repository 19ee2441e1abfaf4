// A body motion and a face of their own rates and lengths, both onto one avatar.
#pragma once

#include <cstddef>
#include <optional>

#include "core/motion.h"
#include "skinning/face/face_drive.h"
#include "skinning/fit/fit.h"

namespace chironomia {

// Whether a motion moves the body at all, or tells a face alone.
bool moves_body(const Motion& motion);

struct FaceFit {
    Fit fit;                         // as long as the longer of the two
    std::optional<FaceReport> face;  // nothing: no face is told
    std::size_t body_frames = 0;     // at the rate of the fit; 0: the body stands relaxed
    std::size_t face_frames = 0;
};

// The face of `face`, else that of `motion`, at the rate of the result by its own times. Where one ends
// before the other, its last values are held. Without a motion that moves the body it stands relaxed.
// At least one of the two must be there; `face` must tell a face. Throws Error as fit_motion.
FaceFit fit_motion_and_face(const std::optional<Motion>& motion, const std::optional<Motion>& face,
                            const Avatar& avatar, const FitOptions& options, const FaceOptions& face_options);

}  // namespace chironomia
