#include "skinning/lift/network_inputs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/quantile.h"

namespace chironomia {
namespace {

constexpr double kContext = 3;     // [s]
constexpr double kLongest = 1.15;  // what a bone looks like against its own length, at most
constexpr double kShare = 0.9;     // of the frames that do not pass a length
constexpr std::array kUsual = {0.36, 0.50, 0.285, 0.255, 0.21, 0.148};  // [m]

enum Part { shoulders, trunk, upper_arms, forearms, hips, ears };

using Ends = std::pair<Landmark, Landmark>;
constexpr std::array<Ends, kRatios> kRatioEnds = {{{Landmark::left_shoulder, Landmark::left_elbow},
                                                   {Landmark::right_shoulder, Landmark::right_elbow},
                                                   {Landmark::left_elbow, Landmark::left_wrist},
                                                   {Landmark::right_elbow, Landmark::right_wrist},
                                                   {Landmark::left_shoulder, Landmark::right_shoulder},
                                                   {Landmark::thorax, Landmark::pelvis}}};
constexpr std::array<Part, kRatios> kRatioParts = {upper_arms, upper_arms, forearms,
                                                   forearms,   shoulders,  trunk};
constexpr std::array kFlagged = {Landmark::nose,       Landmark::left_ear,    Landmark::right_ear,
                                 Landmark::left_elbow, Landmark::right_elbow, Landmark::left_wrist,
                                 Landmark::right_wrist};

bool sees(const PictureBody& body, size_t t, const Ends& ends) {
    return body.sees(t, ends.first) && body.sees(t, ends.second);
}

double seen_length(const PictureBody& body, size_t t, const Ends& ends) {
    const Vec2 way = body.at(t, ends.first) - body.at(t, ends.second);
    return std::hypot(static_cast<double>(way.x), static_cast<double>(way.y));
}

// The length that nine tenths of the frames do not pass; 0 where it is never seen.
double longest(const PictureBody& body, const Ends& ends) {
    std::vector<double> lengths;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (body.sees_shoulders(t) && sees(body, t, ends)) lengths.push_back(seen_length(body, t, ends));
    }
    return lengths.empty() ? 0 : quantile(std::move(lengths), kShare);
}

using PartLengths = std::array<double, kParts>;  // [the picture's unit]

PartLengths part_lengths(const PictureBody& body) {
    PartLengths lengths{};
    for (size_t i = 0; i < kRatios; ++i) {
        double& length = lengths[kRatioParts[i]];
        length = std::max(length, longest(body, kRatioEnds[i]));
    }
    lengths[hips] = longest(body, {Landmark::left_hip, Landmark::right_hip});
    lengths[ears] = longest(body, {Landmark::left_ear, Landmark::right_ear});
    return lengths;
}

// Of the picture, per metre, as if the person were of average size.
double unit_of(const PartLengths& lengths) {
    double sum = 0, weights = 0;
    if (lengths[shoulders] > 0) {
        sum += std::log(lengths[shoulders] / kUsual[shoulders]);
        weights += 1;
    }
    if (lengths[trunk] > 0) {
        sum += 1.5 * std::log(lengths[trunk] / kUsual[trunk]);
        weights += 1.5;
    }
    if (lengths[upper_arms] > 0 && lengths[forearms] > 0) {
        sum += std::log((lengths[upper_arms] + lengths[forearms]) / (kUsual[upper_arms] + kUsual[forearms]));
        weights += 1;
    }
    return weights > 0 ? std::exp(sum / weights) : 1;
}

NetworkInput row_at(const PictureBody& body, size_t t, const PartLengths& lengths, double unit) {
    NetworkInput row{};
    float* next = row.data();
    const bool hips_seen = body.sees_hips(t);
    const Vec2 middle = (body.at(t, Landmark::left_shoulder) + body.at(t, Landmark::right_shoulder)) * 0.5f;
    for (const Landmark point : kReadPoints) {
        const bool hip = point == Landmark::left_hip || point == Landmark::right_hip;
        const bool seen = hip ? hips_seen : body.sees(t, point);
        const Vec2 off = (body.at(t, point) - middle) * static_cast<float>(2 / unit);
        *next++ = seen ? off.x : 0;
        *next++ = seen ? -off.y : 0;
    }
    for (size_t i = 0; i < kRatios; ++i) {
        const double ratio = seen_length(body, t, kRatioEnds[i]) / std::max(1e-9, lengths[kRatioParts[i]]);
        *next++ = sees(body, t, kRatioEnds[i]) ? static_cast<float>(2 * std::min(kLongest, ratio) - 1) : 0;
    }
    for (const Landmark point : kFlagged) *next++ = body.sees(t, point) ? 1 : 0;
    *next = hips_seen ? 1 : 0;
    return row;
}

// Sums of each number over the rows before, (T + 1).
using RowSums = std::vector<std::array<double, kRow>>;

RowSums sums_of(std::span<const NetworkInput> rows, bool squared) {
    RowSums sums(rows.size() + 1);
    for (size_t t = 0; t < rows.size(); ++t) {
        for (size_t i = 0; i < kRow; ++i) {
            const double value = static_cast<double>(rows[t][i]);
            sums[t + 1][i] = sums[t][i] + (squared ? value * value : value);
        }
    }
    return sums;
}

void add_context(NetworkInputs& inputs, double fps) {
    const size_t frames = inputs.rows.size();
    const auto reach = static_cast<size_t>(std::lround(kContext * fps));
    const RowSums sums = sums_of(inputs.rows, false), squares = sums_of(inputs.rows, true);
    inputs.means.resize(frames);
    inputs.spreads.resize(frames);
    for (size_t t = 0; t < frames; ++t) {
        const size_t begin = t - std::min(t, reach), end = std::min(frames, t + reach + 1);
        const auto count = static_cast<double>(end - begin);
        for (size_t i = 0; i < kRow; ++i) {
            const double mean = (sums[end][i] - sums[begin][i]) / count;
            const double square = (squares[end][i] - squares[begin][i]) / count;
            inputs.means[t][i] = static_cast<float>(mean);
            inputs.spreads[t][i] = static_cast<float>(std::sqrt(std::max(0.0, square - mean * mean)));
        }
    }
}

}  // namespace

NetworkInputs network_inputs_of(const PictureBody& body, double fps) {
    const PartLengths lengths = part_lengths(body);
    const double unit = unit_of(lengths);
    NetworkInputs inputs;
    for (size_t part = 0; part < kParts; ++part) {
        if (lengths[part] > 0)
            inputs.lengths[part] = static_cast<float>(4 * std::log(lengths[part] / unit / kUsual[part]));
    }
    size_t shown = 0;
    while (!body.sees_shoulders(shown)) ++shown;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (body.sees_shoulders(t)) shown = t;
        inputs.rows.push_back(row_at(body, shown, lengths, unit));
    }
    add_context(inputs, fps);
    return inputs;
}

PictureBody mirror_picture(const PictureBody& body) {
    std::array<size_t, kLandmarks> from{};
    for (size_t l = 0; l < kLandmarks; ++l) from[l] = static_cast<size_t>(mirrored(static_cast<Landmark>(l)));
    PictureBody mirror = body;
    for (size_t l = 0; l < kLandmarks; ++l) {
        mirror.known[l] = body.known[from[l]];
        for (size_t t = 0; t < body.frames(); ++t) {
            mirror.places[t][l] = body.places[t][from[l]] * Vec2(-1, 1);
            mirror.there[t][l] = body.there[t][from[l]];
        }
    }
    return mirror;
}

}  // namespace chironomia
