#include "synth/motor/move_arms.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/progress.h"
#include "core/random.h"
#include "synth/body/agent_body.h"
#include "synth/gestures/hand_shape.h"
#include "synth/motor/arm_path.h"
#include "synth/motor/clearance.h"

namespace chironomia {
namespace {

constexpr double kCornerSigma = 1.0 / 60;  // of the rounding of corners at power 0 [s]
constexpr double kMargin = 0.25;           // of the grid beyond both ends [s]
constexpr double kSway = 0.0005;           // of each of three waves [m]

// Of the smoothing at fluidity 1: a Gaussian whose spectrum falls to a half of the power at 2.5 Hz, which is
// sqrt(ln 2) / (2 pi 2.5 Hz). Ours, as the paper has no number. [s]
constexpr double kFluidSigma = 0.053;

TcbShape shape_of(const Manner& manner, FluidityMap map) {
    const double power = manner[Expressivity::power], fluidity = manner[Expressivity::fluidity];
    return {.tension = power,
            .continuity = map == FluidityMap::printed ? fluidity : std::min(fluidity, 0.0),
            .bias = power};
}

double sigma_of(const Manner& manner, FluidityMap map) {
    const double corner = kCornerSigma * std::exp2(-manner[Expressivity::power]);
    const double fluidity = manner[Expressivity::fluidity];
    if (map == FluidityMap::printed || fluidity <= 0) return corner;
    return std::lerp(corner, kFluidSigma, fluidity);
}

ArmPath path_of(const Schedule& plan, const ScheduleInputs& inputs, ArmSide side) {
    std::vector<ArmKey> keys = plan.keys[index_of(side)];
    if (keys.empty())
        keys.push_back({.time = 0, .state = inputs.resting[index_of(side)], .placed = plan.placed.size()});
    std::vector<TcbShape> shapes;
    for (const ArmKey& key : keys) {
        if (key.placed == plan.placed.size()) {
            shapes.push_back({});  // at rest
            continue;
        }
        const Manner& manner = inputs.planned_gestures[plan.placed[key.placed].planned].manner;
        shapes.push_back(shape_of(manner, inputs.variants.fluidity_map));
    }
    return {std::move(keys), shapes, side};
}

// Between straight and a fist, by the first joint of the middle finger.
double closed_hand(const std::array<Quat, 15>& fingers) {
    return std::clamp(double(angle_between(kNoTurn, fingers[6])) / (double(kPi) / 2), 0.0, 1.0);
}

// How much an arm's way is smoothed at a moment: as the manner asks for of what it does or has done.
double sigma_at(const ArmPath& path, const std::vector<double>& sigmas, double time) {
    const std::size_t segment = std::min(path.segment_at(time), path.keys().size() - 1);
    return sigmas[path.keys()[segment].placed];
}

// `sigmas` are those of the placed gestures, and that of rest.
ArmGrid grid_of(const std::array<ArmPath, 2>& paths, const std::vector<double>& sigmas, double duration) {
    ArmGrid grid;
    const auto count = static_cast<std::size_t>(std::ceil((duration + 2 * kMargin) * grid.rate)) + 1;
    for (std::size_t arm = 0; arm < 2; ++arm) {
        std::vector<ArmPoint> points;
        std::vector<double> widths;
        for (std::size_t n = 0; n < count; ++n) {
            const double time = static_cast<double>(n) / grid.rate - kMargin;
            points.push_back(paths[arm].at(time));
            widths.push_back(sigma_at(paths[arm], sigmas, time));
            grid.closed[arm].push_back(closed_hand(paths[arm].fingers_at(time)));
        }
        grid.arms[arm] = smoothed(points, widths, grid.rate);
    }
    clear(grid);
    return grid;
}

// Catmull and Rom's cubic through the points of the grid.
ArmPoint point_at(const std::vector<ArmPoint>& points, double rate, double time) {
    const double place = std::clamp((time + kMargin) * rate, 1.0, static_cast<double>(points.size()) - 3);
    const auto n = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(n), s2 = s * s, s3 = s2 * s;
    return points[n - 1] * (-0.5 * s + s2 - 0.5 * s3) + points[n] * (1 - 2.5 * s2 + 1.5 * s3) +
           points[n + 1] * (0.5 * s + 2 * s2 - 1.5 * s3) + points[n + 2] * (-0.5 * s2 + 0.5 * s3);
}

// Slow waves that nobody intends: three along each axis of each wrist, and two in each finger, of which one moves all
// fingers of the hand.
class Sway {
  public:
    explicit Sway(std::uint64_t seed) {
        Random random(seed, 0x5a7);
        for (Wave& wave : wrists_) wave = slow_wave(random);
        for (Wave& wave : fingers_) wave = slow_wave(random);
    }

    glm::dvec3 of_wrist(double time, ArmSide side) const {
        glm::dvec3 sum(0);
        for (std::size_t w = 0; w < 9; ++w)
            sum[static_cast<int>(w % 3)] += kSway * wrists_[9 * index_of(side) + w].at(time);
        return sum;
    }

    // In [-2, 2].
    std::array<double, 5> of_fingers(double time, ArmSide side) const {
        const Wave* waves = &fingers_[6 * index_of(side)];
        std::array<double, 5> sums{};
        for (std::size_t f = 0; f < sums.size(); ++f) sums[f] = waves[0].at(time) + waves[1 + f].at(time);
        return sums;
    }

  private:
    struct Wave {
        double hertz = 0, phase = 0;

        double at(double time) const { return std::sin(2 * double(kPi) * (hertz * time + phase)); }
    };
    static Wave slow_wave(Random& random) {
        const double hertz = 0.15 + 0.3 * random.uniform();
        return {hertz, random.uniform()};
    }

    std::array<Wave, 18> wrists_;
    std::array<Wave, 12> fingers_;
};

void put(std::vector<Quat>& turns, std::size_t frame, const ArmTurns& arm, ArmSide side) {
    const auto set = [&](HumanJoint left, const Quat& turn) {
        turns[frame * kAgentJoints + joint_of(side == ArmSide::left ? left : mirrored(left))] = turn;
    };
    set(HumanJoint::left_shoulder, arm.shoulder);
    set(HumanJoint::left_upper_arm, arm.upper_arm);
    set(HumanJoint::left_lower_arm, arm.lower_arm);
    set(HumanJoint::left_hand, arm.hand);
    for (std::size_t f = 0; f < arm.fingers.size(); ++f)
        turns[frame * kAgentJoints + joint_of(finger_joint(f, side))] = arm.fingers[f];
}

class Labels {
  public:
    Labels(std::string name, std::string first) {
        track_.name = std::move(name);
        track_.values.push_back(std::move(first));
    }

    void add(std::string_view value) {
        const auto found = std::find(track_.values.begin(), track_.values.end(), value);
        track_.frames.push_back(static_cast<int>(found - track_.values.begin()));
        if (found == track_.values.end()) track_.values.emplace_back(value);
    }

    LabelTrack track() && { return std::move(track_); }

  private:
    LabelTrack track_;
};

// The key that an arm is on its way to; none at rest.
const ArmKey* underway(const ArmPath& path, double time) {
    const std::size_t segment = path.segment_at(time);
    if (segment == 0 || segment == path.keys().size()) return nullptr;
    return &path.keys()[segment];
}

// What a hand rests on while it stays there.
Touch touch_at(const ArmPath& path, double time) {
    const std::size_t segment = path.segment_at(time);
    if (segment == 0 || segment == path.keys().size()) return Touch::nothing;
    const Touch before = path.keys()[segment - 1].state.touches;
    return before == path.keys()[segment].state.touches ? before : Touch::nothing;
}

// A track for each hand, or none where nothing is touched.
std::vector<LabelTrack> touches_of(const std::array<ArmPath, 2>& paths, const Clock& clock) {
    std::vector<LabelTrack> tracks;
    bool touches = false;
    for (const ArmSide side : kArmSides) {
        Labels labels(std::string(kTouchLabels[index_of(side)]), std::string(name_of(Touch::nothing)));
        for (std::size_t t = 0; t < clock.frames; ++t) {
            stop_if_interrupted();
            const Touch touch = touch_at(paths[index_of(side)], static_cast<double>(t) / clock.fps);
            labels.add(name_of(touch));
            touches = touches || touch != Touch::nothing;
        }
        tracks.push_back(std::move(labels).track());
    }
    return touches ? tracks : std::vector<LabelTrack>{};
}

std::vector<LabelTrack> labels_of(const std::array<ArmPath, 2>& paths, const Schedule& plan,
                                  const Lexicon& lexicon, const Clock& clock) {
    Labels left("left phase", "rest"), right("right phase", "rest"), gesture("gesture", "-"),
        function("function", "-");
    for (std::size_t t = 0; t < clock.frames; ++t) {
        stop_if_interrupted();
        const double time = static_cast<double>(t) / clock.fps;
        std::size_t shown = 0;  // one above the latest gesture of both arms
        for (const ArmSide side : kArmSides) {
            const ArmKey* key = underway(paths[index_of(side)], time);
            (side == ArmSide::left ? left : right).add(name_of(key ? key->phase : GesturePhase::rest));
            if (key && key->placed < plan.placed.size()) shown = std::max(shown, key->placed + 1);
        }
        gesture.add(shown ? lexicon.gestures[plan.placed[shown - 1].gesture].id : "-");
        function.add(shown ? plan.placed[shown - 1].function : "-");
    }
    std::vector<LabelTrack> tracks = {std::move(right).track(), std::move(left).track(),
                                      std::move(gesture).track(), std::move(function).track()};
    for (LabelTrack& track : touches_of(paths, clock)) tracks.push_back(std::move(track));
    return tracks;
}

}  // namespace

ArmMotion move_arms(const std::vector<PlannedGesture>& planned_gestures, const GestureStyle& style,
                    const Clock& clock, std::uint64_t seed) {
    assert(clock.frames > 0 && clock.fps > 0);
    const auto& [lexicon, speaker, variants] = style;
    const auto& relaxed = lexicon.shapes.front().turns;
    const std::array<ArmState, 2> resting = {resting_arm(ArmSide::left, relaxed),
                                             resting_arm(ArmSide::right, relaxed)};
    std::vector<PerformableGesture> performable_gestures;
    for (const PlannedGesture& planned : planned_gestures)
        performable_gestures.push_back(
            make_performable(lexicon.gestures[planned.gesture], planned.left_hand, planned.manner, style));
    const double duration = static_cast<double>(clock.frames) / clock.fps;
    const ScheduleInputs inputs{.planned_gestures = planned_gestures,
                                .performable_gestures = performable_gestures,
                                .lexicon = lexicon,
                                .resting = resting,
                                .variants = variants,
                                .duration = duration};
    Schedule plan = schedule(inputs);

    const std::array<ArmPath, 2> paths = {path_of(plan, inputs, ArmSide::left),
                                          path_of(plan, inputs, ArmSide::right)};
    std::vector<double> sigmas;
    for (const PlacedGesture& placed : plan.placed)
        sigmas.push_back(sigma_of(planned_gestures[placed.planned].manner, variants.fluidity_map));
    sigmas.push_back(kCornerSigma);
    const ArmGrid grid = grid_of(paths, sigmas, duration);

    ArmMotion motion{.turns = std::vector<Quat>(clock.frames * kAgentJoints, kNoTurn),
                     .labels = labels_of(paths, plan, lexicon, clock),
                     .placed = std::move(plan.placed),
                     .notes = std::move(plan.notes)};
    const Sway sway(seed);
    for (std::size_t t = 0; t < clock.frames; ++t) {
        stop_if_interrupted();
        const double time = static_cast<double>(t) / clock.fps;
        for (const ArmSide side : kArmSides) {
            const ArmPoint point = point_at(grid.arms[index_of(side)], grid.rate, time);
            std::array<double, 5> flexion = sway.of_fingers(time, side);
            for (double& degrees : flexion) degrees *= variants.finger_sway;
            const ArmState state{.wrist = Vec3(point.wrist + sway.of_wrist(time, side)),
                                 .swivel = static_cast<float>(point.swivel),
                                 .twist = static_cast<float>(point.bends.x),
                                 .flexion = static_cast<float>(point.bends.y),
                                 .deviation = static_cast<float>(point.bends.z),
                                 .fingers = flexed(paths[index_of(side)].fingers_at(time), flexion)};
            put(motion.turns, t, turns_of(state, side), side);
        }
    }
    return motion;
}

}  // namespace chironomia
