#include "skinning/lift/body_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/quantile.h"

namespace chironomia {
namespace {

std::vector<double> lengths_of(const PictureBody& body, Landmark a, Landmark b) {
    std::vector<double> lengths;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (body.sees(t, a) && body.sees(t, b))
            lengths.push_back(glm::distance(body.at(t, a), body.at(t, b)));
    }
    return lengths;
}

// The longest that a bone looks, without outliers; nothing if fewer than a tenth of the frames show it.
std::optional<double> longest(const PictureBody& body, Landmark a, Landmark b, double share = 0.88) {
    std::vector<double> lengths = lengths_of(body, a, b);
    if (lengths.empty() || lengths.size() * 10 < body.frames()) return std::nullopt;
    return quantile(std::move(lengths), share);
}

std::optional<double> longest_of_both(const PictureBody& body, Landmark a, Landmark b) {
    const auto left = longest(body, a, b), right = longest(body, mirrored(a), mirrored(b));
    if (!left || !right) return left ? left : right;
    return std::max(*left, *right);
}

double find_unit(const PictureBody& body) {
    const BodyLengths usual;
    const auto shoulders = longest(body, Landmark::left_shoulder, Landmark::right_shoulder);
    const auto trunk = longest(body, Landmark::thorax, Landmark::pelvis);
    const auto upper_arm = longest_of_both(body, Landmark::left_shoulder, Landmark::left_elbow);
    const auto forearm = longest_of_both(body, Landmark::left_elbow, Landmark::left_wrist);
    double sum = 0, weights = 0;
    const auto count = [&](const std::optional<double>& seen, double usual_length, double weight) {
        if (!(seen > 0.0)) return;
        sum += weight * std::log(*seen / usual_length);
        weights += weight;
    };
    count(shoulders, usual.shoulders, 1);
    count(trunk, usual.trunk, 1.5);
    if (upper_arm && forearm) count(*upper_arm + *forearm, usual.upper_arm + usual.forearm, 1);
    return weights > 0 ? std::exp(sum / weights) : 1;
}

double length_within(const std::optional<double>& seen, double unit, double usual) {
    if (!seen) return usual;
    const double length = *seen / unit;
    return length < 0.8 * usual ? usual : std::min(length, 1.35 * usual);
}

}  // namespace

BodyScale find_body_scale(const PictureBody& body, double distance, const Vec2& middle) {
    BodyScale scale;
    PinholeCamera& camera = scale.camera;
    camera.unit = find_unit(body);
    camera.distance = distance;
    camera.middle = middle;
    const double unit = camera.unit;
    BodyLengths& lengths = scale.lengths;
    lengths.trunk =
        length_within(longest(body, Landmark::thorax, Landmark::pelvis, 0.5), unit, lengths.trunk);
    lengths.upper_arm = length_within(longest_of_both(body, Landmark::left_shoulder, Landmark::left_elbow),
                                      unit, lengths.upper_arm);
    lengths.forearm = length_within(longest_of_both(body, Landmark::left_elbow, Landmark::left_wrist), unit,
                                    lengths.forearm);
    lengths.thigh =
        length_within(longest_of_both(body, Landmark::left_hip, Landmark::left_knee), unit, lengths.thigh);
    lengths.shin =
        length_within(longest_of_both(body, Landmark::left_knee, Landmark::left_ankle), unit, lengths.shin);
    return scale;
}

Vec2 centre_of(const PictureBody& body, const Vec2& size) {
    if (size.x > 0) return size * 0.5f;
    Vec2 sum(0);
    size_t seen = 0;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (!body.sees(t, Landmark::thorax)) continue;
        sum += body.at(t, Landmark::thorax);
        ++seen;
    }
    return seen > 0 ? sum / static_cast<float>(seen) : Vec2(0);
}

}  // namespace chironomia
