#include "skinning/fit/fit_source.h"

#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/fit/constant_leg_lengths.h"
#include "skinning/fit/landmark_track.h"

namespace chironomia {
namespace {

LandmarkTrack read_landmarks(const Motion& motion) {
    const LandmarkTrack landmarks = bridge_gaps(*motion.keypoints, motion.frames);
    std::vector<std::string> lacking;
    for (const Landmark shoulder : {Landmark::left_shoulder, Landmark::right_shoulder}) {
        if (!landmarks.has(shoulder)) lacking.emplace_back(name_of(shoulder));
    }
    if (!lacking.empty()) {
        throw Error(
            format("{}: of its {} keypoints none is seen as {}; both shoulders are needed, rename the "
                   "keypoints or give a name map",
                   motion.source, motion.keypoints->names.size(), join(lacking, " and ")));
    }
    return landmarks;
}

std::vector<std::string> bridged_gaps(const LandmarkTrack& landmarks) {
    std::vector<std::string> gaps;
    for (int i = 0; i < kLandmarks; ++i) {
        const size_t frames = landmarks.bridged[size_t(i)];
        if (frames == 0) continue;
        gaps.push_back(format("{}: {} frames", name_of(static_cast<Landmark>(i)), frames));
    }
    return gaps;
}

}  // namespace

MotionSource read_source(const Motion& motion, const PostureRig& rig) {
    if (motion.joints) {
        return {.body = retarget(*motion.joints, motion.frames, read_skeleton(motion).parts),
                .solved = {},
                .bridged = {}};
    }
    if (!motion.keypoints && motion.face) {
        throw Error(format("{}: has a face, but no body; give the motion of a body, and this as its --face",
                           motion.source));
    }
    if (!motion.keypoints) {
        throw Error(
            format("{}: has neither joint turns nor 3D keypoints; give a motion file that has one of "
                   "them",
                   motion.source));
    }
    const LandmarkTrack landmarks = read_landmarks(motion);
    MotionSource source{.body = {.postures = {}, .track = body_track(landmarks)},
                        .solved = solve_keypoints(constant_leg_lengths(landmarks), rig, motion.fps),
                        .bridged = bridged_gaps(landmarks)};
    for (SolvedFrame& frame : source.solved) source.body.postures.push_back(std::move(frame.posture));
    return source;
}

}  // namespace chironomia
