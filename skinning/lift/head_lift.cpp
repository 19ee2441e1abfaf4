#include "skinning/lift/head_lift.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "skinning/lift/viterbi.h"

namespace chironomia {
namespace {

// How far a point lies from the model's [m]. The corners of the mouth move.
constexpr double kSureness = 0.012;
constexpr double kMouthSureness = 0.018;
constexpr double kUsualYaw = 1.2;  // standard deviations [rad]
constexpr double kUsualHeadTurn = 0.5;
constexpr int kRefinements = 12;
constexpr size_t kSides = 4;
// Ours: heads turn by up to some 350 degrees a second; a step that costs more is a turn that was found wrongly.
constexpr double kUsualHeadStep = 12 * kDegree;  // from frame to frame at 30 frames/s
constexpr double kMostHeadStep = 20;             // that a step costs

// Against the middle of the ears [m].
const std::array<HeadPoint, 2> kMouthPoints = {
    {{Landmark::left_mouth, {0.025f, -0.055f, 0.088f}}, {Landmark::right_mouth, {-0.025f, -0.055f, 0.088f}}}};

struct Sighting {
    Vec3 model;
    Vec2 seen;                    // y up [m, for a head of average size]
    double sureness = kSureness;  // [m]
};

using Angles = std::array<double, 3>;  // yaw, pitch, roll

Quat turn_of(const Angles& angles) {
    const auto yaw = static_cast<float>(angles[0]), pitch = static_cast<float>(angles[1]),
               roll = static_cast<float>(angles[2]);
    return glm::angleAxis(yaw, Vec3(0, 1, 0)) * glm::angleAxis(pitch, Vec3(1, 0, 0)) *
           glm::angleAxis(-roll, Vec3(0, 0, 1));
}

// Where the model's points lie against the picture's, both about their middle; the usual turns pull gently.
std::vector<double> misfit(const std::vector<Sighting>& sightings, const Angles& angles) {
    const Quat turn = turn_of(angles);
    Vec2 middle(0);
    std::vector<Vec2> off;
    for (const Sighting& sighting : sightings) {
        off.push_back(Vec2(turn * sighting.model) - sighting.seen);
        middle += off.back() / static_cast<float>(sightings.size());
    }
    std::vector<double> residuals;
    for (size_t i = 0; i < off.size(); ++i) {
        residuals.push_back((off[i].x - middle.x) / sightings[i].sureness);
        residuals.push_back((off[i].y - middle.y) / sightings[i].sureness);
    }
    residuals.push_back(std::sin(angles[0] / 2) * 2 / kUsualYaw);
    residuals.push_back(angles[1] / kUsualHeadTurn);
    residuals.push_back(angles[2] / kUsualHeadTurn);
    return residuals;
}

double sum_of_squares(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum;
}

// Gauss-Newton with a step that never makes it worse.
Angles fit_angles(const std::vector<Sighting>& sightings, Angles angles) {
    for (int round = 0; round < kRefinements; ++round) {
        const std::vector<double> here = misfit(sightings, angles);
        glm::dmat3 normal(0);
        glm::dvec3 gradient(0);
        std::array<std::vector<double>, 3> slopes;
        for (size_t a = 0; a < 3; ++a) {
            Angles moved = angles;
            moved[a] += 1e-3;
            slopes[a] = misfit(sightings, moved);
            for (size_t i = 0; i < here.size(); ++i) slopes[a][i] = (slopes[a][i] - here[i]) / 1e-3;
        }
        for (int a = 0; a < 3; ++a) {
            for (size_t i = 0; i < here.size(); ++i) gradient[a] += slopes[size_t(a)][i] * here[i];
            for (int b = 0; b < 3; ++b) {
                for (size_t i = 0; i < here.size(); ++i)
                    normal[a][b] += slopes[size_t(a)][i] * slopes[size_t(b)][i];
            }
        }
        const glm::dvec3 step = glm::inverse(normal) * gradient;
        Angles next = angles;
        double share = 1;
        for (int tries = 0; tries < 6; ++tries, share /= 2) {
            for (size_t a = 0; a < 3; ++a) next[a] = angles[a] - share * step[static_cast<int>(a)];
            if (sum_of_squares(misfit(sightings, next)) <= sum_of_squares(here)) break;
        }
        if (sum_of_squares(misfit(sightings, next)) > sum_of_squares(here)) break;
        angles = next;
    }
    return angles;
}

// The turns of one frame that fit best, from each of the head's four sides.
struct HeadCandidates {
    std::array<Angles, kSides> angles{};
    std::array<double, kSides> costs{};
};

HeadCandidates candidates_of(const std::vector<Sighting>& sightings) {
    HeadCandidates candidates;
    constexpr std::array<double, kSides> kYaws = {0.0, 1.5, -1.5, 3.0};
    for (size_t side = 0; side < kSides; ++side) {
        candidates.angles[side] = fit_angles(sightings, {kYaws[side], 0, 0});
        candidates.costs[side] = 0.5 * sum_of_squares(misfit(sightings, candidates.angles[side]));
    }
    return candidates;
}

std::vector<Sighting> sightings_at(const PictureBody& body, size_t frame, double unit) {
    std::vector<Sighting> sightings;
    const auto add = [&](const HeadPoint& point, double sureness) {
        if (!body.sees(frame, point.landmark)) return;
        const Vec2 place = body.at(frame, point.landmark);
        sightings.push_back({point.place, Vec2(place.x, -place.y) / static_cast<float>(unit), sureness});
    };
    for (const HeadPoint& point : head_points()) add(point, kSureness);
    for (const HeadPoint& point : kMouthPoints) add(point, kMouthSureness);
    return sightings;
}

// How large the clip's head is against the model's: the spread of seen points over that of the turned
// model's.
double head_size(const PictureBody& body, double unit) {
    std::vector<double> sizes;
    for (size_t t = 0; t < body.frames(); ++t) {
        const std::vector<Sighting> sightings = sightings_at(body, t, unit);
        if (sightings.size() < 4) continue;
        const Quat turn = turn_of(fit_angles(sightings, {0, 0, 0}));
        Vec2 seen_middle(0), model_middle(0);
        for (const Sighting& each : sightings) {
            seen_middle += each.seen / static_cast<float>(sightings.size());
            model_middle += Vec2(turn * each.model) / static_cast<float>(sightings.size());
        }
        double seen = 0, model = 0;
        for (const Sighting& each : sightings) {
            seen += glm::length(each.seen - seen_middle);
            model += glm::length(Vec2(turn * each.model) - model_middle);
        }
        sizes.push_back(seen / model);
    }
    return sizes.empty() ? 1 : std::clamp(median(std::move(sizes)), 0.7, 1.4);
}

// Turns +z to the ray from the middle of the head's seen points to the camera.
Quat ray_turn(const PictureBody& body, size_t frame, const PinholeCamera& camera) {
    Vec2 middle(0);
    float seen = 0;
    for (const HeadPoint& point : head_points()) {
        if (!body.sees(frame, point.landmark)) continue;
        middle += body.at(frame, point.landmark);
        ++seen;
    }
    if (seen == 0) return kNoTurn;
    const glm::dvec3 place = camera.place(middle / seen, 0);
    return turn_between({0, 0, 1}, Vec3(glm::dvec3(0, 0, camera.distance) - place));
}

// The inverse of turn_of().
HeadAngles angles_of(const Quat& turn) {
    const Vec3 facing = turn * Vec3(0, 0, 1);
    const float yaw = std::atan2(facing.x, facing.z), pitch = std::asin(std::clamp(-facing.y, -1.0f, 1.0f));
    const Quat level = glm::angleAxis(yaw, Vec3(0, 1, 0)) * glm::angleAxis(pitch, Vec3(1, 0, 0));
    const Vec3 across = conjugate(level) * (turn * Vec3(1, 0, 0));
    return {.known = true, .yaw = yaw, .pitch = pitch, .roll = -std::atan2(across.y, across.x)};
}

std::vector<int> head_path(const std::vector<HeadCandidates>& candidates, double fps) {
    const double usual = kUsualHeadStep * std::sqrt(30 / fps);
    std::vector<std::vector<int>> before(kSides);
    for (std::vector<int>& sides : before) {
        for (size_t side = 0; side < kSides; ++side) sides.push_back(static_cast<int>(side));
    }
    const auto angles = [&](size_t t, int side) { return candidates[t].angles[static_cast<size_t>(side)]; };
    return viterbi_path(
        {.frames = candidates.size(),
         .predecessors = std::move(before),
         .state_cost = [&](size_t t, int side) { return candidates[t].costs[static_cast<size_t>(side)]; },
         .transition_cost =
             [&](size_t t, int from, int to) {
                 const float step = angle_between(turn_of(angles(t - 1, from)), turn_of(angles(t, to)));
                 return std::min(0.5 * square(static_cast<double>(step) / usual), kMostHeadStep);
             }});
}

}  // namespace

const std::vector<HeadPoint>& head_points() {
    static const std::vector<HeadPoint> points = {
        {Landmark::nose, {0, -0.022f, 0.120f}},           {Landmark::left_eye, {0.029f, 0.013f, 0.089f}},
        {Landmark::right_eye, {-0.029f, 0.013f, 0.089f}}, {Landmark::left_ear, {0.079f, 0, 0}},
        {Landmark::right_ear, {-0.079f, 0, 0}},
    };
    return points;
}

Quat to_turn(const HeadAngles& head) {
    return turn_of({head.yaw, head.pitch, head.roll});
}

std::vector<HeadAngles> lift_head(const PictureBody& body, const PinholeCamera& camera, double fps) {
    const double unit = camera.unit * head_size(body, camera.unit);
    std::vector<HeadAngles> turns(body.frames());
    std::vector<size_t> seen;  // frames
    std::vector<HeadCandidates> candidates;
    for (size_t t = 0; t < body.frames(); ++t) {
        const std::vector<Sighting> sightings = sightings_at(body, t, unit);
        if (sightings.size() < 3) continue;
        seen.push_back(t);
        candidates.push_back(candidates_of(sightings));
    }
    if (seen.empty()) return turns;
    const std::vector<int> path = head_path(candidates, fps);
    for (size_t i = 0; i < seen.size(); ++i) {
        const Quat against_ray = turn_of(candidates[i].angles[static_cast<size_t>(path[i])]);
        turns[seen[i]] = angles_of(ray_turn(body, seen[i], camera) * against_ray);
    }
    return turns;
}

}  // namespace chironomia
