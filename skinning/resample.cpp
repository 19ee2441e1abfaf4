#include "skinning/resample.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

// A moment between two frames of the source.
struct Moment {
    size_t before;
    size_t after;
    float share;  // of `after`
};

Moment moment_at(const Motion& motion, double seconds) {
    const double place = std::clamp(seconds * motion.fps, 0.0, double(motion.frames - 1));
    const size_t before = size_t(place + 1e-9);
    return {before, std::min(before + 1, motion.frames - 1), float(std::max(0.0, place - double(before)))};
}

void add_frame(JointTrack& to, const JointTrack& from, const Moment& at) {
    const size_t joints = from.skeleton.joints.size();
    for (size_t j = 0; j < joints; ++j) {
        const size_t a = at.before * joints + j;
        const size_t b = at.after * joints + j;
        to.turns.push_back(normalize(slerp(from.turns[a], from.turns[b], at.share)));
        to.translations.push_back(glm::mix(from.translations[a], from.translations[b], at.share));
    }
}

void add_frame(KeypointTrack& to, const KeypointTrack& from, const Moment& at) {
    const size_t points = from.names.size();
    for (size_t k = 0; k < points; ++k) {
        const size_t a = at.before * points + k;
        const size_t b = at.share > 0 ? at.after * points + k : a;
        to.points.push_back(glm::mix(from.points[a], from.points[b], at.share));
        to.confidence.push_back(std::min(from.confidence[a], from.confidence[b]));
    }
}

}  // namespace

Motion resample(const Motion& motion, double fps) {
    Motion result;
    result.source = motion.source;
    result.fps = fps;
    result.notes = motion.notes;
    result.frames = size_t(std::max(1.0, std::round(duration(motion) * fps)));
    if (motion.joints) result.joints = {.skeleton = motion.joints->skeleton, .turns = {}, .translations = {}};
    if (motion.keypoints)
        result.keypoints = {.names = motion.keypoints->names, .points = {}, .confidence = {}};
    for (size_t t = 0; t < result.frames; ++t) {
        const Moment at = moment_at(motion, double(t) / fps);
        if (motion.joints) add_frame(*result.joints, *motion.joints, at);
        if (motion.keypoints) add_frame(*result.keypoints, *motion.keypoints, at);
    }
    return result;
}

}  // namespace chironomia
