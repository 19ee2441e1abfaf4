// One person of a clip: an avatar that follows its motion.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/face_region.h"
#include "core/body/rest.h"
#include "skinning/face/face_fit.h"
#include "study/clip/clip.h"

namespace chironomia::study {

// What is to be blurred in the finished picture.
struct BlurredFace {
    FacePart part = FacePart::face;
    FaceRegion face;
};

struct Performance {
    Avatar avatar;
    Fit fit;
    std::filesystem::path motion_file;  // that of the face for a body without a motion
    std::optional<FaceReport> face;
    std::filesystem::path face_file;
    // held poses and faces, what the avatar cannot show; each one sentence
    std::vector<std::string> warnings;
    std::vector<std::string> notes;  // what was detected in the motion
    std::vector<std::string> modes;  // how face and hands are shown, where it is not as driven
    std::optional<BlurredFace> blurred;
    CompanionFiles companions{};
    // (T) where the picture's middle has gone over the floor [m, level]: along with the figure, or to hold it in
    // place; empty: it stays
    std::vector<Vec3> travelled{};
    std::vector<Bounds> boxes{};  // (T) around what plays its own animation; empty: a person with a motion

    // The posture at a frame of the clip, as seen from where the picture's middle has gone; after its end a motion
    // holds its last pose.
    Pose pose_at(std::size_t frame) const;
    // The same between two frames.
    Pose pose_at(double frame) const;
};

// Reads motion and avatar, and fits one to the other; or what the avatar's file does by itself
// (own_animation.h).
Performance perform(const Performer& performer, const ClipJob& job);

}  // namespace chironomia::study
