#include "skinning/lift/trunk_lift.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/quantile.h"
#include "skinning/lift/viterbi.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

constexpr double kStateStep = 3 * kDegree;  // between states
constexpr int kStates = 120;                // all round

// Ours.
struct TrunkTuning {
    static constexpr double kFastest = 4.0;     // a trunk turns hardly faster [rad/s]
    static constexpr double kUsualSpeed = 0.8;  // [rad/s]
    // Of the head's mean turn as that of the shoulders: at best, and as a share of its distance from the learned turn.
    static constexpr double kHeadSureness = 5.6 * kDegree;
    static constexpr double kDisagreement = 0.48;
    static constexpr double kLearned = 0.55;                   // weight of the learned turn
    static constexpr double kLearnedSureness = 9.4 * kDegree;  // at best
    static constexpr double kWidthSureness = 0.045;            // of a seen width, as a share of itself
    static constexpr double kTrunkSureness = 0.08;  // of the trunk's length: shoulders rise and sink
    static constexpr double kHipsShare = 0.3;  // turn of hips that are not seen, over that of the shoulders
};

double angle_of(int state) {
    return (state - kStates / 2) * kStateStep;
}

// In [-pi, pi).
double wrapped(double angle) {
    return angle - 2 * kPi * std::floor(angle / (2 * kPi) + 0.5);
}

// The angles from which each can be reached in one frame.
std::vector<std::vector<int>> neighbours(double fps) {
    // At few frames a second a trunk comes all round, and no further.
    const int reach = std::max(
        1, static_cast<int>(std::min(kStates / 2.0, std::ceil(TrunkTuning::kFastest / fps / kStateStep))));
    std::vector<std::vector<int>> before(kStates);
    for (int to = 0; to < kStates; ++to) {
        for (int way = -reach; way <= reach; ++way)
            before[static_cast<size_t>(to)].push_back((to + way + kStates) % kStates);
    }
    return before;
}

struct AnglePath {
    std::vector<double> angles;  // (T) [rad]
    double cost = 0;
};

// The cheapest angles, smoothed, because states lie 3 degrees apart.
AnglePath angle_path(size_t frames, double fps, const std::function<double(size_t, double)>& price) {
    const double usual = std::max(TrunkTuning::kUsualSpeed / fps, 0.5 * kStateStep);  // [rad]
    const auto step_price = [&](size_t, int from, int to) {
        const double turned = wrapped((to - from) * kStateStep) / usual;
        return 0.5 * turned * turned;
    };
    const std::vector<int> path =
        viterbi_path({.frames = frames,
                      .predecessors = neighbours(fps),
                      .state_cost = [&](size_t t, int s) { return price(t, angle_of(s)); },
                      .transition_cost = step_price});
    AnglePath result;
    for (size_t t = 0; t < frames; ++t) {
        result.angles.push_back(angle_of(path[t]));
        result.cost += price(t, result.angles.back());
    }
    for (size_t t = 1; t < frames; ++t) {
        result.angles[t] = result.angles[t - 1] + wrapped(result.angles[t] - result.angles[t - 1]);
    }
    result.angles = zero_phase_low_pass(result.angles, 2.0, fps);
    return result;
}

// The cost of a seen length if the true one is turned out of the picture by `angle`.
double price_of_length(double seen, double whole, double angle,
                       double sureness = TrunkTuning::kWidthSureness) {
    const double off = (seen - whole * std::cos(angle)) / (sureness * whole);
    return std::min(0.5 * off * off, 30.0);
}

// The turns of the head; where it is not seen, the last one.
std::vector<double> head_yaws(std::span<const HeadAngles> heads, double fps) {
    std::vector<double> yaws;
    double last = 0;
    for (const HeadAngles& head : heads) {
        if (head.known) last += wrapped(head.yaw - last);
        yaws.push_back(last);
    }
    return zero_phase_low_pass(yaws, 0.5, fps);
}

// In the unit of the picture.
double flat_distance(const PictureBody& body, size_t t, Landmark a, Landmark b) {
    return static_cast<double>(glm::distance(body.at(t, a), body.at(t, b)));
}

// How sure it is that the shoulders are turned as the head is.
double head_sureness(std::span<const double> heads, std::span<const LearnedPosture> postures) {
    double sum = 0;
    for (size_t t = 0; t < heads.size(); ++t) {
        const double off = wrapped(heads[t] - postures[t].yaw);
        sum += off * off;
    }
    const double disagreement = std::sqrt(sum / static_cast<double>(std::max<size_t>(1, heads.size())));
    return std::max(TrunkTuning::kHeadSureness, TrunkTuning::kDisagreement * disagreement);
}

double price_of_learned(double yaw, const LearnedPosture& posture) {
    return TrunkTuning::kLearned * std::abs(wrapped(yaw - posture.yaw)) /
           std::max(TrunkTuning::kLearnedSureness, posture.spread);
}

// From right to left [m] (T), below 0 if the person is seen from behind; none where one is not seen.
std::vector<std::optional<double>> flat_widths(const PictureBody& body, Landmark left, double unit) {
    const Landmark right = mirrored(left);
    std::vector<std::optional<double>> widths(body.frames());
    for (size_t t = 0; t < body.frames(); ++t) {
        if (!body.sees(t, left) || !body.sees(t, right)) continue;
        const double width = flat_distance(body, t, left, right) / unit;
        widths[t] = body.at(t, left).x < body.at(t, right).x ? -width : width;
    }
    return widths;
}

// The width of the shoulders is not known beforehand. The width with the cheapest path is taken; unusual widths
// cost more.
struct ShoulderTurn {
    std::vector<double> yaws;
    double width = 0;  // [m]
};

ShoulderTurn turn_shoulders(const PictureBody& body, double unit, const TurnCues& cues, double fps) {
    ShoulderTurn best;
    double least = 0;
    const double usual = BodyLengths().shoulders;
    const std::vector<double> heads = head_yaws(cues.heads, fps);
    const double sureness = head_sureness(heads, cues.postures);
    const std::vector<std::optional<double>> seen = flat_widths(body, Landmark::left_shoulder, unit);
    for (double width = 0.8 * usual; width < 1.25 * usual; width += 0.03 * usual) {
        const auto price = [&](size_t t, double yaw) {
            const double from_head = wrapped(yaw - heads[t]) / sureness;
            const double cost = 0.5 * from_head * from_head + price_of_learned(yaw, cues.postures[t]);
            return seen[t] ? cost + price_of_length(*seen[t], width, yaw) : cost;
        };
        AnglePath path = angle_path(body.frames(), fps, price);
        const double unusual = std::log(width / usual) / 0.17;
        const double cost = path.cost / static_cast<double>(body.frames()) + 0.075 * unusual * unusual;
        if (!best.yaws.empty() && cost >= least) continue;
        least = cost;
        best = {.yaws = std::move(path.angles), .width = width};
    }
    return best;
}

std::vector<double> turn_hips(const PictureBody& body, double unit, const std::vector<double>& shoulders,
                              double fps) {
    const std::vector<std::optional<double>> seen = flat_widths(body, Landmark::left_hip, unit);
    std::vector<double> widths;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (seen[t]) widths.push_back(std::abs(*seen[t]) / std::max(0.5, std::abs(std::cos(shoulders[t]))));
    }
    std::vector<double> yaws(body.frames());
    if (widths.size() * 10 < body.frames()) {
        for (size_t t = 0; t < body.frames(); ++t) yaws[t] = TrunkTuning::kHipsShare * shoulders[t];
        return yaws;
    }
    const double width = median(std::move(widths));
    const auto price = [&](size_t t, double yaw) {
        const double twist = wrapped(yaw - shoulders[t]) / (12 * kDegree);
        const double cost = 0.5 * twist * twist;
        return seen[t] ? cost + 0.5 * price_of_length(*seen[t], width, yaw) : cost;
    };
    return angle_path(body.frames(), fps, price).angles;
}

// Forward lean of the trunk.
std::vector<double> lean(const PictureBody& body, const BodyScale& scale, double fps) {
    const auto sees = [&](size_t t) {
        return body.sees(t, Landmark::thorax) && body.sees(t, Landmark::pelvis);
    };
    const auto price = [&](size_t t, double angle) {
        const double unusual = angle / ((angle > 0 ? 14 : 8) * kDegree);
        double cost = 0.5 * unusual * unusual;
        if (!sees(t)) return 4 * cost;
        const double seen = flat_distance(body, t, Landmark::thorax, Landmark::pelvis) / scale.camera.unit;
        return cost + price_of_length(seen, scale.lengths.trunk, angle, TrunkTuning::kTrunkSureness);
    };
    return angle_path(body.frames(), fps, price).angles;
}

}  // namespace

std::vector<Trunk> lift_trunk(const PictureBody& body, const BodyScale& scale, const TurnCues& cues,
                              double fps) {
    const PinholeCamera& camera = scale.camera;
    const ShoulderTurn shoulders = turn_shoulders(body, camera.unit, cues, fps);
    const std::vector<double> hips = turn_hips(body, camera.unit, shoulders.yaws, fps);
    const std::vector<double> leans = lean(body, scale, fps);
    std::vector<Trunk> lifted(body.frames());
    std::optional<size_t> first;  // that shows both shoulders
    for (size_t t = 0; t < body.frames(); ++t) {
        Trunk& trunk = lifted[t];
        if (!body.sees_shoulders(t)) {
            if (first) trunk = lifted[t - 1];
            continue;
        }
        if (!first) first = t;
        trunk.yaw = shoulders.yaws[t];
        trunk.hips_yaw = hips[t];
        trunk.thorax = camera.place(body.at(t, Landmark::thorax), scale.lengths.trunk * std::sin(leans[t]));
        const double half = shoulders.width / 2 * std::sin(trunk.yaw);
        trunk.left_shoulder = camera.place(body.at(t, Landmark::left_shoulder), trunk.thorax.z - half);
        trunk.right_shoulder = camera.place(body.at(t, Landmark::right_shoulder), trunk.thorax.z + half);
        trunk.pelvis = body.sees(t, Landmark::pelvis)
                           ? camera.place(body.at(t, Landmark::pelvis), 0)
                           : trunk.thorax - glm::dvec3(0, scale.lengths.trunk, trunk.thorax.z);
        const glm::dvec3 across(std::cos(trunk.hips_yaw), 0, -std::sin(trunk.hips_yaw));
        const double half_hips = scale.lengths.hips / 2;
        trunk.left_hip = trunk.pelvis + across * half_hips;
        trunk.right_hip = trunk.pelvis - across * half_hips;
        if (body.sees_hips(t)) {
            trunk.left_hip = camera.place(body.at(t, Landmark::left_hip), trunk.left_hip.z);
            trunk.right_hip = camera.place(body.at(t, Landmark::right_hip), trunk.right_hip.z);
        }
    }
    std::fill_n(lifted.begin(), first.value_or(0), lifted[first.value_or(0)]);
    return lifted;
}

}  // namespace chironomia
