#include "skinning/signal/smooth.h"

#include <cstddef>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

class Smoother {
  public:
    Smoother(double cutoff, double fps) : cutoff_(cutoff), fps_(fps) {}

    // Elements first, first + stride, ... of which there are `count`.
    template <typename Value>
    void run(std::vector<Value>& values, std::size_t first, std::size_t stride, std::size_t count) const {
        std::vector<double> samples(count);
        for (int axis = 0; axis < Value::length(); ++axis) {
            for (std::size_t t = 0; t < count; ++t) samples[t] = values[first + t * stride][axis];
            const std::vector<double> smooth = zero_phase_low_pass(samples, cutoff_, fps_);
            for (std::size_t t = 0; t < count; ++t)
                values[first + t * stride][axis] = static_cast<float>(smooth[t]);
        }
    }

  private:
    double cutoff_;  // [Hz]
    double fps_;
};

void smooth_joints(JointTrack& track, std::size_t frames, const Smoother& smoother) {
    const std::size_t count = track.skeleton.joints.size();
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t t = 1; t < frames; ++t) {
            Quat& turn = track.turns[t * count + j];
            if (dot(turn, track.turns[(t - 1) * count + j]) < 0) turn = -turn;
        }
        smoother.run(track.turns, j, count, frames);
        smoother.run(track.translations, j, count, frames);
        for (std::size_t t = 0; t < frames; ++t)
            track.turns[t * count + j] = normalize(track.turns[t * count + j]);
    }
}

void smooth_points(KeypointTrack& track, std::size_t frames, const Smoother& smoother) {
    const std::size_t count = track.names.size();
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t t = 0; t < frames;) {
            std::size_t end = t;
            while (end < frames && track.confidence[end * count + k] > 0) ++end;
            if (end > t) smoother.run(track.points, t * count + k, count, end - t);
            t = end + 1;
        }
    }
}

}  // namespace

double smoothing_named(std::string_view text) {
    const auto hertz = parse_number(trim(text));
    if (hertz && *hertz >= 0.1 && *hertz <= 100) return *hertz;
    throw Error(format("smoothing: \"{}\" is not known; use a cutoff of 0.1 to 100 Hz", text));
}

Motion smoothed(Motion motion, double cutoff) {
    if (!motion.joints && !motion.keypoints) {
        throw Error(format(
            "{}: smoothing at {} Hz is asked of a motion without joints or keypoints in space; points of "
            "a picture have their own filter (--lift-filter), a face is never smoothed",
            motion.source, cutoff));
    }
    if (cutoff >= motion.fps / 2) {
        throw Error(format(
            "{}: smoothing at {} Hz is asked of a motion of {} frames/s, which holds nothing that fast; "
            "choose a cutoff below {} Hz",
            motion.source, cutoff, motion.fps, motion.fps / 2));
    }
    const Smoother smoother(cutoff, motion.fps);
    if (motion.joints) smooth_joints(*motion.joints, motion.frames, smoother);
    if (motion.keypoints) smooth_points(*motion.keypoints, motion.frames, smoother);
    motion.notes.push_back(format("smoothed as asked: zero-phase low-pass at {} Hz", cutoff));
    return motion;
}

}  // namespace chironomia
