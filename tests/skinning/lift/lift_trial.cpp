#include "tests/skinning/lift/lift_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/random.h"
#include "skinning/fit/retarget.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/lift/head_lift.h"
#include "tests/skinning/lift/trial_joints.h"

namespace chironomia::testing {
namespace {

using Points = std::map<Landmark, Vec3>;

Quat head_turn(const Posture& posture) {
    if (!posture.neck.empty()) return posture.neck.back();
    return posture.spine.empty() ? posture.hips : posture.spine.back();
}

Points points_at(const BodyMotion& body, size_t t) {
    Points points;
    for (const auto& [landmark, joint] : kTrialJoints) {
        if (body.track.has(joint)) points[landmark] = body.track.at(t, joint);
    }
    points[Landmark::thorax] = (points[Landmark::left_shoulder] + points[Landmark::right_shoulder]) * 0.5f;
    points[Landmark::pelvis] = (points[Landmark::left_hip] + points[Landmark::right_hip]) * 0.5f;
    const Quat turn = head_turn(body.postures[t]);
    const Vec3 head = body.track.has(HumanJoint::head) ? body.track.at(t, HumanJoint::head)
                                                       : points[Landmark::thorax] + Vec3(0, 0.15f, 0);
    for (const HeadPoint& point : head_points()) {
        points[point.landmark] = head + turn * (point.place + Vec3(0, 0.07f, 0.02f));
    }
    return points;
}

float mean_height(const BodyMotion& body) {
    float sum = 0;
    for (size_t t = 0; t < body.postures.size(); ++t) {
        const Points points = points_at(body, t);
        sum += (points.at(Landmark::thorax).y + points.at(Landmark::pelvis).y) / 2;
    }
    return sum / static_cast<float>(body.postures.size());
}

Vec3 at(const Motion& motion, size_t t, Landmark landmark) {
    const KeypointTrack& track = *motion.keypoints;
    const auto found = std::find(track.names.begin(), track.names.end(), name_of(landmark));
    return track.points[t * track.names.size() + static_cast<size_t>(found - track.names.begin())];
}

struct Chain {
    Landmark before, joint;
};

constexpr std::array<Chain, 4> kChains = {{{Landmark::left_shoulder, Landmark::left_elbow},
                                           {Landmark::left_elbow, Landmark::left_wrist},
                                           {Landmark::right_shoulder, Landmark::right_elbow},
                                           {Landmark::right_elbow, Landmark::right_wrist}}};

// A bone counts as pointing out of the picture's plane from 20 degrees on.
size_t longest_flip(const Trial& trial, const Motion& lifted, double scale) {
    size_t longest = 0;
    for (const Chain& chain : kChains) {
        size_t flipped = 0;
        for (size_t t = 0; t < trial.space.frames; ++t) {
            const Vec3 truth = at(trial.space, t, chain.joint) - at(trial.space, t, chain.before);
            const Vec3 found =
                (at(lifted, t, chain.joint) - at(lifted, t, chain.before)) * static_cast<float>(scale);
            const float limit = 0.34f * length(truth);
            const bool wrong =
                std::abs(truth.z) > limit && truth.z * found.z < 0 && std::abs(found.z - truth.z) > limit;
            flipped = wrong ? flipped + 1 : 0;
            longest = std::max(longest, flipped);
        }
    }
    return longest;
}

double mean_jerk(const Motion& motion, double scale) {
    double sum = 0;
    size_t count = 0;
    for (const Chain& chain : kChains) {
        for (size_t t = 3; t < motion.frames; ++t) {
            const auto relative = [&](size_t i) {
                return at(motion, i, chain.joint) - at(motion, i, Landmark::thorax);
            };
            const Vec3 third =
                relative(t) - 3.0f * relative(t - 1) + 3.0f * relative(t - 2) - relative(t - 3);
            sum += static_cast<double>(length(third)) * scale;
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

constexpr std::array<Landmark, 2> kWrists = {Landmark::left_wrist, Landmark::right_wrist};

// How far a wrist goes against the shoulders from one frame to another.
glm::dvec3 way(const Motion& motion, Landmark wrist, size_t from, size_t to) {
    const auto place = [&](size_t t) {
        return glm::dvec3(at(motion, t, wrist)) - glm::dvec3(at(motion, t, Landmark::thorax));
    };
    return place(to) - place(from);
}

// The shift at which the wrists' speeds go together best.
int find_lag(const Trial& trial, const Motion& lifted) {
    constexpr int kFurthest = 6;
    const auto frames = static_cast<int>(lifted.frames);
    const auto likeness = [&](int shift) {
        double sum = 0;
        for (const Landmark wrist : kWrists) {
            for (int t = kFurthest + 1; t + kFurthest < frames; ++t) {
                const auto now = static_cast<size_t>(t), then = static_cast<size_t>(t + shift);
                sum += glm::dot(way(trial.space, wrist, now - 1, now), way(lifted, wrist, then - 1, then));
            }
        }
        return sum;
    };
    int best = 0;
    for (int shift = -kFurthest; shift <= kFurthest; ++shift) {
        if (likeness(shift) > likeness(best)) best = shift;
    }
    return best;
}

// The slope of lifted ways over true ones: noise does not add to it, and what is smoothed away lacks.
double stroke_ratio(const Trial& trial, const Motion& lifted, double scale) {
    const auto third = static_cast<size_t>(std::lround(trial.space.fps / 3));
    double together = 0, alone = 0;
    for (const Landmark wrist : kWrists) {
        for (size_t t = third; t < lifted.frames; ++t) {
            const glm::dvec3 truth = way(trial.space, wrist, t - third, t);
            together += scale * glm::dot(truth, way(lifted, wrist, t - third, t));
            alone += glm::dot(truth, truth);
        }
    }
    return alone > 0 ? together / alone : 0;
}

}  // namespace

Trial film(const Motion& motion, const TrialCamera& camera) {
    const BodyMotion body =
        retarget(*motion.joints, motion.frames, find_humanoid(motion.joints->skeleton).map);
    const float height = mean_height(body);
    const Quat turn = glm::angleAxis(radians(static_cast<float>(camera.yaw_deg)), Vec3(0, 1, 0));
    Trial trial;
    for (Motion* side : {&trial.space, &trial.picture}) {
        side->source = motion.source;
        side->fps = motion.fps;
        side->frames = motion.frames;
    }
    KeypointTrack& space = trial.space.keypoints.emplace();
    PictureTrack& picture = trial.picture.picture.emplace();
    picture.size = {1280, 720};
    if (camera.known) picture.focal = camera.focal;
    Random random(camera.seed);
    std::vector<double> units;
    Vec3 middle(0);
    for (size_t t = 0; t < motion.frames; ++t) {
        const Points points = points_at(body, t);
        const Vec3 pelvis = points.at(Landmark::pelvis);
        if (t == 0 || !camera.stays) middle = {pelvis.x, height, pelvis.z};
        const double depth = (turn * (pelvis - middle)).z;
        units.push_back(camera.focal / (camera.distance - depth));
        for (const auto& [landmark, place] : points) {
            if (t == 0) space.names.emplace_back(name_of(landmark));
            const Vec3 seen = turn * (place - middle);
            space.points.push_back(seen);
            space.confidence.push_back(1);
            const double share = camera.focal / (camera.distance - seen.z);
            const double x = 640 + seen.x * share + camera.noise * random.normal();
            const double y = 360 - seen.y * share + camera.noise * random.normal();
            const bool missing = random.uniform() < camera.drop_outs;
            picture.points.emplace_back(missing ? Vec2(0) : Vec2(x, y));
            picture.confidence.push_back(missing ? 0.0f : 0.9f);
        }
    }
    picture.names = space.names;
    std::nth_element(units.begin(), units.begin() + static_cast<std::ptrdiff_t>(units.size() / 2),
                     units.end());
    trial.unit = units[units.size() / 2];
    return trial;
}

TrialResult judge(const Trial& trial, const Lift& lifted) {
    const double scale = lifted.scale.camera.unit / trial.unit;  // metres of the truth per lifted metre
    const Motion& truth = trial.space;
    double width = 0;
    std::array<double, 4> sums{};
    for (size_t t = 0; t < truth.frames; ++t) {
        width += distance(at(truth, t, Landmark::left_shoulder), at(truth, t, Landmark::right_shoulder));
        for (size_t c = 0; c < kChains.size(); ++c) {
            const Landmark joint = kChains[c].joint;
            const Vec3 wanted = at(truth, t, joint) - at(truth, t, Landmark::thorax);
            const Vec3 found = at(lifted.motion, t, joint) - at(lifted.motion, t, Landmark::thorax);
            sums[c] += distance(wanted, found * static_cast<float>(scale));
        }
    }
    TrialResult result;
    result.elbows = (sums[0] + sums[2]) / 2 / width;
    result.wrists = (sums[1] + sums[3]) / 2 / width;
    result.mean = (result.elbows + result.wrists) / 2;
    result.longest_flip = longest_flip(trial, lifted.motion, scale);
    const double jerk = mean_jerk(truth, 1);
    result.jerk_ratio = jerk > 0 ? mean_jerk(lifted.motion, scale) / jerk : 0;
    result.lag = find_lag(trial, lifted.motion);
    result.strokes = stroke_ratio(trial, lifted.motion, scale);
    return result;
}

}  // namespace chironomia::testing
