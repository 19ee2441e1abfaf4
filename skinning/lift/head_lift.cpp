#include "skinning/lift/head_lift.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"

namespace chironomia {
namespace {

constexpr double kSureness = 0.012;  // how far a point lies from the model's [m]
constexpr double kUsualYaw = 1.2;    // standard deviations [rad]
constexpr double kUsualHeadTurn = 0.5;
constexpr int kRefinements = 12;

struct Sighting {
    Vec3 model;
    Vec2 seen;  // y up [m, for a head of average size]
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
    for (const Vec2& each : off) {
        residuals.push_back((each.x - middle.x) / kSureness);
        residuals.push_back((each.y - middle.y) / kSureness);
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

// From where the head was before, and from its four sides, so that no false valley holds it.
Angles best_angles(const std::vector<Sighting>& sightings, const Angles& before) {
    Angles best = fit_angles(sightings, before);
    for (const double yaw : {0.0, 1.5, -1.5, 3.0}) {
        const Angles other = fit_angles(sightings, {yaw, 0, 0});
        if (sum_of_squares(misfit(sightings, other)) < 0.9 * sum_of_squares(misfit(sightings, best)))
            best = other;
    }
    return best;
}

std::vector<Sighting> sightings_at(const PictureBody& body, size_t frame, double unit) {
    std::vector<Sighting> sightings;
    for (const HeadPoint& point : head_points()) {
        if (!body.sees(frame, point.landmark)) continue;
        const Vec2 place = body.at(frame, point.landmark);
        sightings.push_back({point.place, Vec2(place.x, -place.y) / static_cast<float>(unit)});
    }
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

}  // namespace

const std::vector<HeadPoint>& head_points() {
    static const std::vector<HeadPoint> points = {
        {Landmark::nose, {0, 0.0f, 0.125f}},
        {Landmark::left_eye, {0.032f, 0.034f, 0.095f}},
        {Landmark::right_eye, {-0.032f, 0.034f, 0.095f}},
        {Landmark::left_ear, {0.074f, 0, 0}},
        {Landmark::right_ear, {-0.074f, 0, 0}},
    };
    return points;
}

Quat to_turn(const HeadAngles& head) {
    return turn_of({head.yaw, head.pitch, head.roll});
}

std::vector<HeadAngles> lift_head(const PictureBody& body, double unit) {
    const double size = head_size(body, unit);
    std::vector<HeadAngles> turns(body.frames());
    std::vector<double> pitches;
    Angles angles = {0, 0, 0};
    for (size_t t = 0; t < body.frames(); ++t) {
        const std::vector<Sighting> sightings = sightings_at(body, t, unit * size);
        if (sightings.size() < 3) continue;
        angles = best_angles(sightings, angles);
        turns[t] = {.known = true, .yaw = angles[0], .pitch = angles[1], .roll = angles[2]};
        pitches.push_back(angles[1]);
    }
    if (pitches.empty()) return turns;
    const double level = median(std::move(pitches));
    for (HeadAngles& turn : turns) turn.pitch = turn.known ? turn.pitch - level : 0;
    return turns;
}

}  // namespace chironomia
