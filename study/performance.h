// Somebody in a clip, ready to be drawn: an avatar that follows its motion.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/renderer.h"
#include "skinning/face/face_fit.h"
#include "study/clip.h"

namespace chironomia {

struct Performance {
    Avatar avatar;
    Fit fit;
    std::filesystem::path motion_file;  // that of the face for a body without a motion
    std::optional<FaceReport> face;
    std::filesystem::path face_file;
    std::vector<std::string>
        warnings;                    // held poses and faces, what the avatar cannot show; each one sentence
    std::vector<std::string> notes;  // what was detected in the motion
    std::size_t frames_outside = 0;  // in which the head is not in the picture
    std::unique_ptr<Renderer> renderer;

    // The posture at a frame of the clip; after its end a motion holds its last pose.
    const Pose& pose_at(std::size_t frame) const;
    // The same between two frames.
    Pose pose_at(double frame) const;
};

// Reads motion and avatar, fits one to the other, and sets up the picture of `size` in which they are seen.
Performance perform(const Performer& performer, const ClipJob& job, RenderSize size);

}  // namespace chironomia
