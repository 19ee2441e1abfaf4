// Brings postures nearer to their mean.
#include <algorithm>
#include <cmath>
#include <span>

#include "skinning/degrade/degradations.h"
#include "skinning/degrade/point_tree.h"

namespace chironomia {
namespace {

// Half the rotation vector of a turn, on the shorter way.
Vec3 logarithm(Quat turn) {
    if (turn.w < 0) turn = -turn;
    const Vec3 axis(turn.x, turn.y, turn.z);
    const float sine = length(axis);
    return sine < 1e-9f ? axis : axis * (std::atan2(sine, turn.w) / sine);
}

Quat exponential(const Vec3& half) {
    const float angle = length(half);
    const Vec3 axis = angle < 1e-9f ? half : half * (std::sin(angle) / angle);
    return normalize(Quat(std::cos(angle), axis.x, axis.y, axis.z));
}

// Scales the deviation of each joint, point or channel from its mean. Its values are `stride` apart.
template <typename Value>
void damp_lines(std::vector<Value>& values, std::size_t stride, float factor) {
    for (std::size_t k = 0; k < stride; ++k) {
        Value mean(0);
        for (std::size_t i = k; i < values.size(); i += stride) mean += values[i];
        mean /= static_cast<float>(values.size() / stride);
        for (std::size_t i = k; i < values.size(); i += stride)
            values[i] = mean + (values[i] - mean) * factor;
    }
}

void damp_turns(std::vector<Quat>& turns, std::size_t stride, float factor) {
    for (std::size_t k = 0; k < stride; ++k) {
        std::vector<Quat> own;
        for (std::size_t i = k; i < turns.size(); i += stride) own.push_back(turns[i]);
        const Quat mean = mean_turn(own);
        for (std::size_t i = k; i < turns.size(); i += stride)
            turns[i] = normalize(mean * exponential(logarithm(conjugate(mean) * turns[i]) * factor));
    }
}

// Part of the way from one direction to another.
Vec3 between(const Vec3& from, const Vec3& to, float share) {
    return normalize(slerp(kNoTurn, turn_between(from, to), share)) * normalize(from);
}

class PointDamper {
  public:
    PointDamper(const KeypointTrack& track, float factor)
        : track_(track), factor_(factor), count_(track.names.size()), ancestors_(ancestors_of(track.names)) {
        find_means();
    }

    std::vector<Vec3> damped() const {
        std::vector<Vec3> points = track_.points;
        const std::vector<std::size_t> order = ancestors_first(ancestors_);
        for (std::size_t first = 0; first < points.size(); first += count_) {
            for (const std::size_t k : order) {
                if (track_.confidence[first + k] <= 0) continue;
                const auto parent = parent_at(first, k);
                const Vec3& place = track_.points[first + k];
                if (!parent) {
                    points[first + k] = places_[k] + (place - places_[k]) * factor_;
                    continue;
                }
                const Vec3 bone = place - track_.points[first + *parent];
                const bool known = length(bone) > 1e-6f && length(directions_[k]) > 1e-6f;
                points[first + k] = points[first + *parent] +
                                    (known ? between(directions_[k], bone, factor_) * length(bone) : bone);
            }
        }
        return points;
    }

  private:
    std::optional<std::size_t> parent_at(std::size_t first, std::size_t k) const {
        return seen_ancestor(ancestors_[k], std::span(track_.confidence).subspan(first, count_));
    }

    void find_means() {
        places_.assign(count_, Vec3(0));
        directions_.assign(count_, Vec3(0));
        std::vector<float> seen(count_, 0);
        for (std::size_t first = 0; first < track_.points.size(); first += count_) {
            for (std::size_t k = 0; k < count_; ++k) {
                if (track_.confidence[first + k] <= 0) continue;
                const auto parent = parent_at(first, k);
                const Vec3& place = track_.points[first + k];
                const Vec3 bone = parent ? place - track_.points[first + *parent] : Vec3(0);
                if (length(bone) > 1e-6f) directions_[k] += normalize(bone);
                places_[k] += place;
                ++seen[k];
            }
        }
        for (std::size_t k = 0; k < count_; ++k) places_[k] /= std::max(1.0f, seen[k]);
    }

    const KeypointTrack& track_;
    float factor_;
    std::size_t count_;
    std::vector<std::vector<std::size_t>> ancestors_;
    std::vector<Vec3> places_;      // the mean of each point
    std::vector<Vec3> directions_;  // of each bone, the sum over the frames
};

}  // namespace

Quat mean_turn(const std::vector<Quat>& turns) {
    Quat mean = turns.front();
    for (int step = 0; step < 50; ++step) {
        Vec3 sum(0);
        for (const Quat& turn : turns) sum += logarithm(conjugate(mean) * turn);
        const Vec3 way = sum / static_cast<float>(turns.size());
        mean = normalize(mean * exponential(way));
        if (length(way) < 1e-6f) break;
    }
    return mean;
}

Motion damped(Motion motion, double factor) {
    const auto share = static_cast<float>(factor);
    if (motion.joints) {
        const std::size_t count = motion.joints->skeleton.joints.size();
        damp_turns(motion.joints->turns, count, share);
        damp_lines(motion.joints->translations, count, share);
    }
    if (motion.keypoints) motion.keypoints->points = PointDamper(*motion.keypoints, share).damped();
    if (motion.face) {
        FaceTrack& face = *motion.face;
        if (!face.channels.empty()) damp_lines(face.intensities, face.channels.size(), share);
        if (!face.head.empty()) damp_turns(face.head, 1, share);
        std::vector<Vec2> eyes;
        for (const Gaze& gaze : face.gaze) eyes.insert(eyes.end(), {gaze.left, gaze.right});
        if (!eyes.empty()) damp_lines(eyes, 2, share);
        for (std::size_t t = 0; t < face.gaze.size(); ++t) face.gaze[t] = {eyes[2 * t], eyes[2 * t + 1]};
    }
    return motion;
}

}  // namespace chironomia
