// Band-limited noise on the joints' turns.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/random.h"
#include "skinning/degrade/degradations.h"
#include "skinning/degrade/point_tree.h"

namespace chironomia {
namespace {

constexpr double kLowest = 2, kHighest = 8;  // [Hz]
constexpr double kShareOfRate = 0.4;  // the highest frequency over the frame rate; above 0.5 it would alias
constexpr float kUnitsPerDegree = 0.1f;  // intensity of an action unit, in 0..5

// Noise in a band: 16 sine waves of equal power with random frequencies and phases. Its variance is 1. It depends
// on time alone, not on the rate or the length of a clip.
class Noise {
  public:
    // Sources with different `stream` are independent.
    Noise(std::uint64_t seed, std::uint64_t stream, double fps) {
        Random random(seed, stream);
        const double highest = std::min(kHighest, kShareOfRate * fps);
        const double lowest = std::min(kLowest, highest / 2);
        for (Wave& wave : waves_) {
            wave.turns_per_second = lowest + (highest - lowest) * random.uniform();
            wave.phase = random.uniform();
        }
    }

    float at(double seconds) const {
        double sum = 0;
        for (const Wave& wave : waves_)
            sum += std::sin(2 * std::numbers::pi * (wave.turns_per_second * seconds + wave.phase));
        return static_cast<float>(sum * std::sqrt(2.0 / static_cast<double>(waves_.size())));
    }

  private:
    struct Wave {
        double turns_per_second = 0;
        double phase = 0;  // [turns]
    };
    std::array<Wave, 16> waves_;
};

class Trembling {
  public:
    Trembling(const Motion& motion, double degrees, std::uint64_t seed)
        : fps_(motion.fps), angle_(static_cast<float>(degrees * std::numbers::pi / 180)), seed_(seed) {}

    // Rotation vectors (T) [rad]; each component has the standard deviation `angle_`.
    std::vector<Vec3> vectors(std::size_t frames, std::uint64_t source) const {
        const Noise x(seed_, 3 * source, fps_), y(seed_, 3 * source + 1, fps_),
            z(seed_, 3 * source + 2, fps_);
        std::vector<Vec3> result;
        for (std::size_t t = 0; t < frames; ++t) {
            const double seconds = static_cast<double>(t) / fps_;
            result.push_back(angle_ * Vec3(x.at(seconds), y.at(seconds), z.at(seconds)));
        }
        return result;
    }

  private:
    double fps_;
    float angle_;  // [rad]
    std::uint64_t seed_;
};

Quat turn_about(const Vec3& vector) {
    const float angle = length(vector);
    return angle < 1e-9f ? kNoTurn : glm::angleAxis(angle, vector / angle);
}

// First source of noise of each track, so that no two channels share one.
constexpr std::uint64_t kOfJoints = 0, kOfPoints = 1 << 20, kOfFace = 1 << 21;

void shake_joints(JointTrack& track, std::size_t frames, const Trembling& trembling) {
    const std::size_t count = track.skeleton.joints.size();
    for (std::size_t j = 0; j < count; ++j) {
        if (track.skeleton.joints[j].parent < 0) continue;
        const std::vector<Vec3> noise = trembling.vectors(frames, kOfJoints + j);
        for (std::size_t t = 0; t < frames; ++t) {
            Quat& turn = track.turns[t * count + j];
            turn = normalize(turn * turn_about(noise[t]));
        }
    }
}

// Turns each bone about its parent point, together with all of its descendants. In a picture (Vec2) bones turn in
// the picture's plane alone.
template <typename Track>
void shake_points(Track& track, const Trembling& trembling) {
    using Point = typename decltype(track.points)::value_type;
    const std::size_t count = track.names.size();
    const std::size_t frames = track.points.size() / std::max<std::size_t>(1, count);
    const auto ancestors = ancestors_of(track.names);
    const auto order = ancestors_first(ancestors);
    std::vector<std::vector<Vec3>> noise;
    for (std::size_t k = 0; k < count; ++k) noise.push_back(trembling.vectors(frames, kOfPoints + k));
    const Track still = track;
    std::vector<Quat> turned(count);
    for (std::size_t t = 0; t < frames; ++t) {
        const std::size_t first = t * count;
        for (const std::size_t k : order) {
            const auto parent =
                seen_ancestor(ancestors[k], std::span(still.confidence).subspan(first, count));
            turned[k] = parent ? turned[*parent] : kNoTurn;
            if (!parent || still.confidence[first + k] <= 0) continue;
            Vec3 vector = noise[k][t];
            if constexpr (std::is_same_v<Point, Vec2>) vector.x = vector.y = 0;
            turned[k] = turned[k] * turn_about(vector);
            const Point bone = still.points[first + k] - still.points[first + *parent];
            Vec3 in_space(bone.x, bone.y, 0);
            if constexpr (std::is_same_v<Point, Vec3>) in_space = bone;
            track.points[first + k] = track.points[first + *parent] + Point(turned[k] * in_space);
        }
    }
}

void shake_face(FaceTrack& face, std::size_t frames, const Trembling& trembling) {
    const std::vector<Vec3> head = trembling.vectors(frames, kOfFace);
    const std::vector<Vec3> eyes = trembling.vectors(frames, kOfFace + 1);
    for (std::size_t t = 0; t < face.head.size(); ++t)
        face.head[t] = normalize(face.head[t] * turn_about(head[t]));
    for (std::size_t t = 0; t < face.gaze.size(); ++t) {
        face.gaze[t].left += Vec2(eyes[t]);
        face.gaze[t].right += Vec2(eyes[t]);
    }
    const std::size_t count = face.channels.size();
    const float units = kUnitsPerDegree * 180 / kPi;  // for a radian
    for (std::size_t c = 0; c < count; ++c) {
        const std::vector<Vec3> noise = trembling.vectors(frames, kOfFace + 2 + c);
        for (std::size_t t = 0; t < frames; ++t) {
            float& intensity = face.intensities[t * count + c];
            intensity = std::clamp(intensity + units * noise[t].x, 0.0f, 5.0f);
        }
    }
}

}  // namespace

Motion jittered(Motion motion, double degrees, std::uint64_t seed) {
    const Trembling trembling(motion, degrees, seed);
    if (motion.joints) shake_joints(*motion.joints, motion.frames, trembling);
    if (motion.keypoints) shake_points(*motion.keypoints, trembling);
    if (motion.picture) shake_points(*motion.picture, trembling);
    if (motion.face) shake_face(*motion.face, motion.frames, trembling);
    return motion;
}

}  // namespace chironomia
