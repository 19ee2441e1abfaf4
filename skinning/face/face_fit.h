// A body motion and a face of their own rates and lengths, both onto one avatar.
#pragma once

#include <cstddef>
#include <filesystem>
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

// A motion of a body and one of a face, each of its own rate and length; at least one is there.
struct BodyAndFace {
    const std::optional<Motion>& body;  // its face is taken if `face` is not there
    const std::optional<Motion>& face;  // has a face
};

// The face is resampled to the rate of the result. The shorter of both is held at its last values. Without a motion of
// the body it stands relaxed. Throws Error as fit_motion.
FaceFit fit_motion_and_face(const BodyAndFace& motions, const Avatar& avatar, const FitOptions& options,
                            const FaceOptions& face_options);

// Throws Error if strengths or a head turn were chosen, for a motion that comes without a face.
void refuse_options_of_faces(const FaceOptions& options, const std::filesystem::path& motion);

}  // namespace chironomia
