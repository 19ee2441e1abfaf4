#include "skinning/face/face_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/signal/resample.h"

namespace chironomia {
namespace {

// The face alone: the body of the same motion is brought to the rate elsewhere.
FaceTrack face_at(const Motion& source, double fps, std::size_t frames) {
    const Motion alone{.source = source.source,
                       .fps = source.fps,
                       .frames = source.frames,
                       .joints = {},
                       .keypoints = {},
                       .face = source.face,
                       .notes = {}};
    Motion resampled = resample(alone, fps, frames);
    return std::move(*resampled.face);
}

// What a body that stands still gave up turns its own head no longer.
void turn_back(std::vector<Quat>& heads, const std::vector<Quat>& headings) {
    if (headings.empty()) return;
    for (std::size_t t = 0; t < heads.size(); ++t)
        heads[t] = conjugate(headings[std::min(t, headings.size() - 1)]) * heads[t];
}

}  // namespace

bool moves_body(const Motion& motion) {
    return !motion.face || motion.joints || motion.keypoints || motion.picture;
}

FaceFit fit_motion_and_face(const BodyAndFace& motions, const Avatar& avatar, const FitOptions& options,
                            const FaceOptions& face_options) {
    const auto& [body, face] = motions;
    assert(body || face);
    assert(!face || face->face);
    const Motion* with_face = face ? &*face : body->face ? &*body : nullptr;
    FaceFit result;
    if (with_face != nullptr) result.face_frames = frames_at(*with_face, options.fps);
    if (body && moves_body(*body)) {
        result.fit = fit_motion(*body, avatar, options);
        result.body_frames = result.fit.poses.size();
    } else {
        result.fit = stand_relaxed(avatar, {.fps = options.fps, .frames = result.face_frames});
    }
    if (with_face == nullptr) return result;

    PoseTrack& poses = result.fit.poses;
    if (poses.size() < result.face_frames) poses.hold_to(result.face_frames);
    FaceTrack track = face_at(*with_face, options.fps, poses.size());
    if (!face) turn_back(track.head, result.fit.headings);
    FacedPoses faced = drive_face(track, avatar, std::move(poses), face_options);
    result.fit.poses = std::move(faced.poses);
    result.face = std::move(faced.report);
    return result;
}

void refuse_options_of_faces(const FaceOptions& options, const std::filesystem::path& motion) {
    const char* option = !options.gains.empty()              ? "--face-gain"
                         : options.head != HeadTurn::replace ? "--face-head"
                                                             : nullptr;
    if (!option) return;
    throw Error(
        format("{}: {} was set, but no face comes with the motion; leave it out, or give one with --face",
               motion.string(), option));
}

}  // namespace chironomia
