#include "skinning/lift/walking_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "core/quantile.h"
#include "skinning/lift/body_scale.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

constexpr double kCutoff = 0.5;    // of the low-pass [Hz]
constexpr double kSame = 1.25;     // farthest over nearest distance, up to which a person counts as staying
constexpr double kClosest = 0.05;  // least distance over the usual one
constexpr double kNearest = 1.5;   // least distance if the lens is assumed [m]
constexpr double kNearestKnown = 0.8;  // least distance if the lens is known; hands are before the person [m]
constexpr int kRounds = 4;  // longest lengths are found again with the distances of the round before

constexpr std::array<Vec2, 8> kUsualSizes = {{{640, 480},
                                              {480, 640},
                                              {1280, 720},
                                              {720, 1280},
                                              {1920, 1080},
                                              {1080, 1920},
                                              {3840, 2160},
                                              {2160, 3840}}};  // [px]

struct Segment {
    Landmark from, to;
};
constexpr std::array kTrunk = {Segment{Landmark::thorax, Landmark::pelvis},
                               Segment{Landmark::left_shoulder, Landmark::right_shoulder},
                               Segment{Landmark::left_hip, Landmark::right_hip}};
constexpr std::array kLegs = {
    Segment{Landmark::left_hip, Landmark::left_knee}, Segment{Landmark::right_hip, Landmark::right_knee},
    Segment{Landmark::left_knee, Landmark::left_ankle}, Segment{Landmark::right_knee, Landmark::right_ankle}};

using Lengths = std::vector<std::optional<double>>;  // (T)

Lengths lengths_of(const PictureBody& body, const Segment& part) {
    Lengths lengths(body.frames());
    for (size_t t = 0; t < body.frames(); ++t) {
        if (!body.sees(t, part.from) || !body.sees(t, part.to)) continue;
        const auto length = static_cast<double>(glm::distance(body.at(t, part.from), body.at(t, part.to)));
        if (length > 0) lengths[t] = length;
    }
    return lengths;
}

// The longest that a part looks, corrected for distance; without outliers.
double longest(const Lengths& lengths, std::span<const double> far) {
    std::vector<double> seen;
    for (size_t t = 0; t < lengths.size(); ++t) {
        if (lengths[t]) seen.push_back(*lengths[t] * far[t]);
    }
    return seen.empty() ? 1 : quantile(std::move(seen), 0.95);
}

// Whether a frame shows two bones of the legs. They come first in `parts`.
bool sees_legs(size_t t, std::span<const Lengths> parts) {
    const auto legs = parts.first(kLegs.size());
    return std::count_if(legs.begin(), legs.end(), [&](const Lengths& leg) { return leg[t].has_value(); }) >
           1;
}

// The second smallest ratio of longest to seen length; nothing where legs are not seen.
std::optional<double> distance_at(size_t t, std::span<const Lengths> parts,
                                  std::span<const double> longests) {
    if (!sees_legs(t, parts)) return std::nullopt;
    std::vector<double> ratios;
    for (size_t p = 0; p < parts.size(); ++p) {
        if (parts[p][t]) ratios.push_back(longests[p] / *parts[p][t]);
    }
    std::nth_element(ratios.begin(), ratios.begin() + 1, ratios.end());
    return ratios[1];
}

// Fills gaps linearly, those at the ends with the next value.
std::vector<double> without_gaps(const std::vector<std::optional<double>>& values) {
    std::vector<double> closed(values.size(), 1);
    std::optional<size_t> last;
    for (size_t t = 0; t < values.size(); ++t) {
        if (!values[t]) continue;
        for (size_t gap = last ? *last + 1 : 0; gap < t; ++gap) {
            const double from = last ? *values[*last] : *values[t];
            const double share = last ? static_cast<double>(gap - *last) / static_cast<double>(t - *last) : 0;
            closed[gap] = std::lerp(from, *values[t], share);
        }
        closed[t] = *values[t];
        last = t;
    }
    for (size_t t = last ? *last + 1 : values.size(); t < values.size(); ++t) closed[t] = *values[*last];
    return closed;
}

// The centres of the trunk in the picture (T).
std::vector<glm::dvec2> centres(const PictureBody& body, double fps) {
    std::array<std::vector<std::optional<double>>, 2> seen{};
    for (size_t t = 0; t < body.frames(); ++t) {
        const bool sees = body.sees(t, Landmark::thorax) && body.sees(t, Landmark::pelvis);
        const Vec2 centre = (body.at(t, Landmark::thorax) + body.at(t, Landmark::pelvis)) * 0.5f;
        seen[0].push_back(sees ? std::optional(static_cast<double>(centre.x)) : std::nullopt);
        seen[1].push_back(sees ? std::optional(static_cast<double>(centre.y)) : std::nullopt);
    }
    const std::vector<double> x = zero_phase_low_pass(without_gaps(seen[0]), kCutoff, fps),
                              y = zero_phase_low_pass(without_gaps(seen[1]), kCutoff, fps);
    std::vector<glm::dvec2> result;
    for (size_t t = 0; t < x.size(); ++t) result.emplace_back(x[t], y[t]);
    return result;
}

// Scales the picture so that the person keeps its usual size.
PictureBody of_one_size(PictureBody body, std::span<const double> far) {
    for (size_t t = 0; t < far.size(); ++t) {
        for (Vec2& place : body.places[t]) place *= static_cast<float>(far[t]);
    }
    return body;
}

// The smallest usual size of a picture that holds all points; 0 if they are too small to be pixels.
Vec2 usual_size(const PictureBody& body) {
    Vec2 most(0);
    for (size_t t = 0; t < body.frames(); ++t) {
        for (size_t l = 0; l < kLandmarks; ++l) {
            if (body.there[t][l]) most = glm::max(most, body.places[t][l]);
        }
    }
    if (std::max(most.x, most.y) < 240) return Vec2(0);
    for (const Vec2& size : kUsualSizes) {
        if (most.x <= size.x && most.y <= size.y) return size;
    }
    return Vec2(0);
}

}  // namespace

std::vector<double> find_distances(const PictureBody& body, double fps) {
    std::vector<Lengths> parts;
    for (const Segment& part : kLegs) parts.push_back(lengths_of(body, part));
    for (const Segment& part : kTrunk) parts.push_back(lengths_of(body, part));
    size_t with_legs = 0;
    for (size_t t = 0; t < body.frames(); ++t) with_legs += sees_legs(t, parts);
    if (2 * with_legs < body.frames()) return {};
    std::vector<double> far(body.frames(), 1);
    for (int round = 0; round < kRounds; ++round) {
        std::vector<double> longests;
        for (const Lengths& part : parts) longests.push_back(longest(part, far));
        std::vector<std::optional<double>> found(body.frames());
        for (size_t t = 0; t < found.size(); ++t) found[t] = distance_at(t, parts, longests);
        far = zero_phase_low_pass(without_gaps(found), kCutoff, fps);
        const double usual = quantile(far, 0.5);
        for (double& each : far) each = std::max(each / usual, kClosest);
    }
    const auto [nearest, farthest] = std::minmax_element(far.begin(), far.end());
    if (*farthest < kSame * *nearest) return {};
    return far;
}

WalkingCamera::WalkingCamera(const PictureBody& body, const RealCamera& camera, double fps)
    : distance_(camera.distance), focal_(camera.focal), far_(find_distances(body, fps)) {
    const bool stays = far_.empty();
    const Vec2 size = camera.size.x > 0 || stays ? camera.size : usual_size(body);
    middle_ = centre_of(body, size);
    const double unit = find_body_scale(of_one_size(body, far_), distance_, middle_).camera.unit;
    if (focal_ == 0 && !stays) focal_ = std::max(size.x, size.y);
    if (focal_ > 0) distance_ = focal_ / unit;
    const double closest = stays ? 1 : *std::min_element(far_.begin(), far_.end());
    const double nearest = camera.focal > 0 ? kNearestKnown : stays ? 0 : kNearest;
    distance_ = std::max(distance_, nearest / closest);
    focal_ = distance_ * unit;
    if (!stays) track(centres(body, fps));
}

void WalkingCamera::track(std::span<const glm::dvec2> centres) {
    for (const glm::dvec2& centre : centres) {
        const glm::dvec2 off = centre - glm::dvec2(middle_);
        const double yaw = -std::atan2(off.x, focal_), pitch = -std::atan2(off.y, std::hypot(off.x, focal_));
        // The size of the person gives its depth along the axis of the real camera; its distance is longer.
        far_[turns_.size()] *= std::hypot(off.x, off.y, focal_) / focal_;
        turns_.push_back(glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) *
                         glm::angleAxis(pitch, glm::dvec3(1, 0, 0)));
    }
}

double WalkingCamera::nearest() const {
    return far_.empty() ? distance_ : distance_ * *std::min_element(far_.begin(), far_.end());
}

double WalkingCamera::farthest() const {
    return far_.empty() ? distance_ : distance_ * *std::max_element(far_.begin(), far_.end());
}

PictureBody WalkingCamera::seen(PictureBody body) const {
    for (size_t t = 0; t < far_.size(); ++t) {
        const glm::dquat back = glm::inverse(turns_[t]);
        for (Vec2& place : body.places[t]) {
            const glm::dvec2 off = place - middle_;
            const glm::dvec3 ray = back * glm::dvec3(off.x, -off.y, -focal_);
            const double share = focal_ * far_[t] / std::max(-ray.z, 0.1 * focal_);
            place = middle_ + Vec2(ray.x * share, -ray.y * share);
        }
    }
    return body;
}

Vec3 WalkingCamera::place(size_t frame, const Vec3& place) const {
    if (far_.empty()) return place;
    const glm::dvec3 there = place;
    const double away = std::max(distance_ * far_[frame] - there.z, 0.1);
    // The lifted place assumed the usual distance; correct it for the real one.
    const double share = away / (far_[frame] * (distance_ - there.z));
    const glm::dvec3 turned = turns_[frame] * glm::dvec3(there.x * share, there.y * share, -away);
    return Vec3(turned + glm::dvec3(0, 0, distance_));
}

}  // namespace chironomia
