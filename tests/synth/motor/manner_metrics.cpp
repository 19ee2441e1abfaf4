#include "tests/synth/motor/manner_metrics.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "synth/body/agent_body.h"
#include "synth/motor/arm_state.h"
#include "synth/motor/reach_time.h"

namespace chironomia {
namespace {

using Place = glm::dvec3;

constexpr double kShortest = 0.03;  // way of a stroke that is measured [m]
constexpr double kStop = 0.1;       // after the end of a stroke, in which the hand comes to rest [s]

struct TrackedArm {
    std::vector<ArmChain> chains;  // (T)
    double outward = 1;
};

HumanJoint on_side(HumanJoint left, ArmSide side) {
    return side == ArmSide::left ? left : mirrored(left);
}

TrackedArm track_of(const ArmMotion& motion, ArmSide side, std::size_t frames) {
    TrackedArm arm{.chains = {}, .outward = side == ArmSide::left ? 1.0 : -1.0};
    for (std::size_t t = 0; t < frames; ++t) {
        const auto turn = [&](HumanJoint left) {
            return motion.turns[t * kAgentJoints + joint_of(on_side(left, side))];
        };
        ArmTurns turns;
        turns.shoulder = turn(HumanJoint::left_shoulder);
        turns.upper_arm = turn(HumanJoint::left_upper_arm);
        turns.lower_arm = turn(HumanJoint::left_lower_arm);
        turns.hand = turn(HumanJoint::left_hand);
        arm.chains.push_back(chain_of(turns, side));
    }
    return arm;
}

// Frames from the first at or after `start` to the last at or before `end`.
struct Frames {
    std::size_t first = 0;
    std::size_t last = 0;
};

Frames frames_of(double start, double end, const Clock& clock) {
    const double last = static_cast<double>(clock.frames) - 1;
    const auto frame = [&](double f) { return static_cast<std::size_t>(std::clamp(f, 0.0, last)); };
    return {frame(std::ceil(start * clock.fps - 1e-9)), frame(std::floor(end * clock.fps + 1e-9))};
}

Place wrist(const TrackedArm& arm, std::size_t frame) {
    return Place(arm.chains[frame].wrist);
}

double way_of(const TrackedArm& arm, const Frames& frames) {
    double way = 0;
    for (std::size_t t = frames.first; t < frames.last; ++t)
        way += distance(wrist(arm, t), wrist(arm, t + 1));
    return way;
}

double swivel_of(const ArmChain& chain, double outward) {
    const Quat carried = turn_between({0, 0, 1}, chain.wrist - chain.shoulder);
    const Vec3 elbow = chain.elbow - chain.shoulder;
    return std::atan2(dot(elbow, carried * Vec3(static_cast<float>(outward), 0, 0)),
                      dot(elbow, carried * Vec3(0, -1, 0)));
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double median_of(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double box_of(const std::array<TrackedArm, 2>& arms, std::size_t frame) {
    Vec3 low(1e9f), high(-1e9f);
    for (const TrackedArm& arm : arms) {
        for (const Vec3& point :
             {arm.chains[frame].shoulder, arm.chains[frame].elbow, arm.chains[frame].wrist}) {
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
    }
    return 2.0 * (high.x - low.x + high.y - low.y);
}

// All that is measured once a stroke, or once a frame of strokes.
struct Samples {
    std::vector<double> box, swivel, speed, pace, jerk, peak_jerk, acceleration, fist;
};

// How quickly the speed of the wrist changes at most in the second half of a way, when it stops.
double sharpest_stop(const TrackedArm& arm, const Frames& frames, double fps) {
    double sharpest = 0;
    for (std::size_t t = std::max<std::size_t>(1, (frames.first + frames.last) / 2);
         t <= frames.last && t + 1 < arm.chains.size(); ++t) {
        const double before = distance(wrist(arm, t), wrist(arm, t - 1));
        const double behind = distance(wrist(arm, t + 1), wrist(arm, t));
        sharpest = std::max(sharpest, (before - behind) * fps * fps);
    }
    return sharpest;
}

double fastest(const TrackedArm& arm, const Frames& frames, double fps) {
    double most = 0;
    for (std::size_t t = frames.first; t < frames.last; ++t)
        most = std::max(most, distance(wrist(arm, t), wrist(arm, t + 1)) * fps);
    return most;
}

// The third difference of the wrist's place about a moment, by time [m/s^3].
Place jerk_at(const TrackedArm& arm, std::size_t frame, double fps) {
    const Place third =
        wrist(arm, frame + 3) - 3.0 * wrist(arm, frame + 2) + 3.0 * wrist(arm, frame + 1) - wrist(arm, frame);
    return third * std::pow(fps, 3);
}

double highest_jerk(const TrackedArm& arm, const Frames& frames, double fps) {
    double highest = 0;
    for (std::size_t t = frames.first; t + 3 <= frames.last; ++t)
        highest = std::max(highest, glm::length(jerk_at(arm, t, fps)));
    return highest;
}

void measure_stroke(Samples& samples, const TrackedArm& arm, const PlacedStroke& stroke, const Clock& clock) {
    const Frames frames = frames_of(stroke.start, stroke.end, clock);
    const Frames last = frames_of(stroke.last_way, stroke.end, clock);
    const double way = way_of(arm, frames), last_way = way_of(arm, last);
    if (way < kShortest) return;
    samples.speed.push_back(way / (stroke.end - stroke.start));
    const Frames with_stop = frames_of(stroke.start, stroke.end + kStop, clock);
    samples.peak_jerk.push_back(highest_jerk(arm, with_stop, clock.fps));
    samples.pace.push_back(reach_time({.metres = way}, 0, {}) / (stroke.end - stroke.start));
    if (last_way < kShortest) return;
    samples.acceleration.push_back(sharpest_stop(arm, last, clock.fps) * (stroke.end - stroke.last_way) /
                                   fastest(arm, last, clock.fps));
}

void measure_jerk(Samples& samples, const TrackedArm& arm, const Frames& frames, double fps) {
    const double way = way_of(arm, frames);
    if (way < kShortest || frames.last < frames.first + 4) return;
    double sum = 0;
    for (std::size_t t = frames.first; t + 3 <= frames.last; ++t) {
        const Place jerk = jerk_at(arm, t, fps);
        sum += dot(jerk, jerk) / fps;
    }
    const double time = static_cast<double>(frames.last - frames.first) / fps;
    samples.jerk.push_back(std::log(std::pow(time, 5) / (way * way) * sum));
}

// Mean bend of the fingers, the thumb left out.
double fist_of(std::span<const Quat> frame, ArmSide side, const HandShape& relaxed, const HandShape& fist) {
    std::vector<double> shares;
    for (std::size_t f = 3; f < fist.turns.size(); ++f) {
        const double from = angle_between(kNoTurn, relaxed.turns[f]),
                     to = angle_between(kNoTurn, fist.turns[f]);
        if (to - from < 0.1) continue;
        const double bend = angle_between(kNoTurn, frame[joint_of(finger_joint(f, side))]);
        shares.push_back(std::clamp((bend - from) / (to - from), 0.0, 1.0));
    }
    return mean_of(shares);
}

void measure_frames(Samples& samples, const ArmMotion& motion, const std::array<TrackedArm, 2>& arms,
                    ArmSide side, const Frames& frames, const Lexicon& lexicon) {
    const TrackedArm& arm = arms[index_of(side)];
    const auto fist = find_shape(lexicon, "fist");
    for (std::size_t t = frames.first; t <= frames.last; ++t) {
        samples.box.push_back(box_of(arms, t));
        samples.swivel.push_back(swivel_of(arm.chains[t], arm.outward));
        const std::span<const Quat> turns(motion.turns.data() + t * kAgentJoints, kAgentJoints);
        if (fist) samples.fist.push_back(fist_of(turns, side, lexicon.shapes.front(), lexicon.shapes[*fist]));
    }
}

void measure_gesture(Samples& samples, const ArmMotion& motion, const PlacedGesture& gesture,
                     const std::array<TrackedArm, 2>& arms, const Lexicon& lexicon, const Clock& clock) {
    for (const ArmSide side : kArmSides) {
        const ArmTimes& times = gesture.arms[index_of(side)];
        if (!times.moves) continue;
        const TrackedArm& arm = arms[index_of(side)];
        measure_jerk(samples, arm, frames_of(times.begin, gesture.strokes.front().end, clock), clock.fps);
        const PlacedStroke& stroke = gesture.strokes.front();
        measure_stroke(samples, arm, stroke, clock);
        measure_frames(samples, motion, arms, side, frames_of(stroke.start, stroke.end, clock), lexicon);
    }
}

}  // namespace

MannerMetrics measure_manner(const ArmMotion& motion, const Lexicon& lexicon, const Clock& clock) {
    const std::array<TrackedArm, 2> arms = {track_of(motion, ArmSide::left, clock.frames),
                                            track_of(motion, ArmSide::right, clock.frames)};
    Samples samples;
    double strokes = 0, retractions = 0;
    for (const PlacedGesture& gesture : motion.placed) {
        measure_gesture(samples, motion, gesture, arms, lexicon, clock);
        strokes += static_cast<double>(gesture.strokes.size());
        for (const ArmTimes& times : gesture.arms) retractions += times.retracted ? 1 : 0;
    }
    const double minutes = static_cast<double>(clock.frames) / clock.fps / 60;
    const auto gestures = static_cast<double>(motion.placed.size());
    return {.box = mean_of(samples.box),
            .swivel = mean_of(samples.swivel),
            .stroke_speed = mean_of(samples.speed),
            .pace = mean_of(samples.pace),
            .jerk = median_of(samples.jerk),
            .peak_jerk = median_of(samples.peak_jerk),
            .retractions_per_minute = retractions / minutes,
            .peak_acceleration = median_of(samples.acceleration),
            .fist = mean_of(samples.fist),
            .strokes_per_rheme = gestures > 0 ? strokes / gestures : 0,
            .gestures_per_minute = gestures / minutes};
}

}  // namespace chironomia
