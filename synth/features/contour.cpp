#include "synth/features/contour.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace chironomia {
namespace {

constexpr double kLowestPitch = 50, kHighestPitch = 550;  // [Hz]
constexpr int kFirstPitch = 2;                            // the token of the lowest pitch

double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

struct KnownSample {
    std::size_t index = 0;
    double value = 0;
};

// On the line through two samples.
double on_line(std::size_t index, const KnownSample& a, const KnownSample& b) {
    const auto x = static_cast<double>(index);
    const auto xa = static_cast<double>(a.index), xb = static_cast<double>(b.index);
    return a.value + (b.value - a.value) * (x - xa) / (xb - xa);
}

float pitch_in_range(double f0) {
    return static_cast<float>(std::clamp(f0, kLowestPitch, kHighestPitch));
}

// Fills `f0` from the first to the last of its samples `known`, ascending, and goes on with the lines at both
// ends through `range`.
void fill_within(std::vector<float>& f0, const std::vector<std::size_t>& known, const SampleRange& range) {
    if (known.size() == 1) {
        std::fill(f0.begin() + static_cast<std::ptrdiff_t>(range.first),
                  f0.begin() + static_cast<std::ptrdiff_t>(range.last), f0[known.front()]);
        return;
    }
    std::size_t right = 1;  // of the two known samples whose line is read
    const std::vector<float> source = f0;
    for (std::size_t i = range.first; i < range.last; ++i) {
        while (right + 1 < known.size() && known[right] < i) ++right;
        const std::size_t a = known[right - 1], b = known[right];
        f0[i] = pitch_in_range(on_line(i, {a, source[a]}, {b, source[b]}));
    }
}

}  // namespace

std::vector<float> median_filter(const Measured& measured, std::size_t window) {
    assert(window % 2 == 1 && measured.values.size() == measured.frames() * measured.width);
    const auto reach = static_cast<std::ptrdiff_t>(window / 2);
    const auto last = static_cast<std::ptrdiff_t>(measured.frames()) - 1;
    std::vector<float> filtered(measured.values.begin(), measured.values.end());
    std::vector<double> near;
    for (std::ptrdiff_t t = 0; t <= last; ++t) {
        if (!measured.success[static_cast<std::size_t>(t)]) continue;
        for (std::size_t column = 0; column < measured.width; ++column) {
            near.clear();
            for (std::ptrdiff_t i = t - reach; i <= t + reach; ++i) {
                const auto frame = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last));
                if (measured.success[frame]) near.push_back(measured.values[frame * measured.width + column]);
            }
            filtered[static_cast<std::size_t>(t) * measured.width + column] =
                static_cast<float>(median_of(near));
        }
    }
    return filtered;
}

std::optional<std::vector<float>> bridge_gaps(const Measured& measured) {
    assert(measured.values.size() == measured.frames() * measured.width);
    std::vector<float> bridged(measured.values.begin(), measured.values.end());
    std::optional<std::size_t> before;  // the last frame that was seen
    const auto fill = [&](std::size_t from, std::size_t to, std::size_t left, std::size_t right) {
        for (std::size_t t = from; t < to; ++t)
            for (std::size_t column = 0; column < measured.width; ++column) {
                const float a = measured.values[left * measured.width + column];
                const float b = measured.values[right * measured.width + column];
                bridged[t * measured.width + column] =
                    left == right ? a : static_cast<float>(on_line(t, {left, a}, {right, b}));
            }
    };
    for (std::size_t t = 0; t < measured.frames(); ++t) {
        if (!measured.success[t]) continue;
        fill(before ? *before + 1 : 0, t, before.value_or(t), t);
        before = t;
    }
    if (!before) return std::nullopt;
    fill(*before + 1, measured.frames(), *before, *before);
    return bridged;
}

std::optional<std::vector<float>> smooth_and_bridge(const Measured& measured, std::size_t window) {
    const std::vector<float> smooth = median_filter(measured, window);
    return bridge_gaps({.values = smooth, .width = measured.width, .success = measured.success});
}

SampleRange samples_in(double start, double end, double rate) {
    // A time that is a sample's own but for its last digits is that sample's.
    constexpr double kSlack = 1e-6;
    const auto sample_from = [&](double time) {
        return static_cast<std::size_t>(std::max(0.0, std::ceil(time * rate - kSlack)));
    };
    return {sample_from(start), std::max(sample_from(start), sample_from(end))};
}

std::optional<std::vector<float>> fill_pitch(std::span<const float> f0, double rate,
                                             std::span<const CorpusWord> words) {
    std::vector<float> filled(f0.begin(), f0.end());
    std::vector<std::uint8_t> success(f0.size(), 0);
    for (const CorpusWord& word : words) {
        SampleRange range = samples_in(word.start, word.end, rate);
        range.last = std::min(range.last, f0.size());
        std::vector<std::size_t> voiced;
        for (std::size_t i = range.first; i < range.last; ++i)
            if (f0[i] > 0) voiced.push_back(i);
        if (voiced.empty()) continue;
        fill_within(filled, voiced, range);
        for (std::size_t i = range.first; i < range.last; ++i) success[i] = 1;
    }
    return bridge_gaps({.values = filled, .success = success});
}

int token_of_pitch(double f0) {
    if (f0 <= 0) return kPitchUnvoiced;
    return kFirstPitch +
           static_cast<int>(std::lround(std::clamp(f0, kLowestPitch, kHighestPitch) - kLowestPitch));
}

double normalized_pitch(double f0) {
    return (std::clamp(f0, kLowestPitch, kHighestPitch) - kLowestPitch) / (kHighestPitch - kLowestPitch);
}

}  // namespace chironomia
