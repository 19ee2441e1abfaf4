#include "study/measure/agreement.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "core/random.h"
#include "study/measure/bootstrap.h"
#include "study/measure/distributions.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kResamples = 1000;
constexpr std::size_t kFewestRaters = 3;  // two are the same two in every resample

// The ratings of one unit.
struct UnitRating {
    std::size_t rater = 0;
    std::size_t value = 0;  // index
};
using Unit = std::vector<UnitRating>;

// The pairs of values within one unit, as Krippendorff's coincidences.
struct Coincidence {
    std::size_t first = 0;  // index of a value
    std::size_t second = 0;
    double weight = 0;
};

// `times`: how often each rater counts. Each rating has a weight of 1 among the pairs with those of others.
std::vector<Coincidence> coincidences_of(const Unit& unit, const std::vector<double>& times) {
    struct Count {
        double ratings = 0;
        double of_one_rater = 0;  // pairs of a rater with themselves
    };
    std::map<std::size_t, Count> counts;
    double ratings = 0, of_one_rater = 0;
    for (const UnitRating& rating : unit) {
        const double count = times[rating.rater];
        if (count == 0) continue;
        counts[rating.value].ratings += count;
        counts[rating.value].of_one_rater += count * count;
        ratings += count;
        of_one_rater += count * count;
    }
    std::vector<Coincidence> found;
    const double partners = (ratings * ratings - of_one_rater) / ratings;
    for (const auto& [a, of_a] : counts) {
        for (const auto& [b, of_b] : counts) {
            const double pairs = of_a.ratings * of_b.ratings - (a == b ? of_a.of_one_rater : 0);
            if (pairs > 0) found.push_back({a, b, pairs / partners});
        }
    }
    return found;
}

// The values that raters gave.
struct Values {
    std::vector<double> numbers;  // (V) ascending
    ValueScale scale;
};

// (V, V) squared distances, which on an ordinal scale depend on how often each value was given.
std::vector<double> distances_of(const Values& values, const std::vector<double>& times) {
    const auto& [numbers, scale] = values;
    const std::size_t n = numbers.size();
    std::vector<double> distances(n * n, 0);
    for (std::size_t a = 0; a < n; ++a) {
        double between = times[a] / 2;
        for (std::size_t b = a + 1; b < n; ++b) {
            const double ranks = between + times[b] / 2;
            between += times[b];
            const double distance = scale == ValueScale::nominal   ? 1
                                    : scale == ValueScale::ordinal ? ranks
                                                                   : numbers[b] - numbers[a];
            distances[a * n + b] = distances[b * n + a] = distance * distance;
        }
    }
    return distances;
}

std::optional<double> alpha_of(const std::vector<std::vector<Coincidence>>& units, const Values& values) {
    const std::size_t n = values.numbers.size();
    std::vector<double> times(n, 0);
    double all = 0;
    for (const auto& unit : units) {
        for (const Coincidence& pair : unit) {
            times[pair.first] += pair.weight;
            all += pair.weight;
        }
    }
    const std::vector<double> distances = distances_of(values, times);
    double observed = 0, expected = 0;
    for (const auto& unit : units) {
        for (const Coincidence& pair : unit)
            observed += pair.weight * distances[pair.first * n + pair.second];
    }
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) expected += times[a] * times[b] * distances[a * n + b];
    }
    if (!(expected > 0)) return std::nullopt;
    return 1 - (all - 1) * observed / expected;
}

std::optional<Interval> resampled(const std::vector<Unit>& units, std::size_t raters, const Values& values,
                                  std::uint64_t seed) {
    if (units.size() < 2 || raters < kFewestRaters) return std::nullopt;
    std::vector<double> drawn;
    Random random(seed);
    for (std::size_t sample = 0; sample < kResamples; ++sample) {
        const std::vector<double> of_units = draw_items(units.size(), random),
                                  of_raters = draw_items(raters, random);
        std::vector<std::vector<Coincidence>> chosen;
        for (std::size_t i = 0; i < units.size(); ++i) {
            if (of_units[i] == 0) continue;
            chosen.push_back(coincidences_of(units[i], of_raters));
            for (Coincidence& pair : chosen.back()) pair.weight *= of_units[i];
        }
        if (const auto alpha = alpha_of(chosen, values)) drawn.push_back(*alpha);
    }
    if (drawn.empty()) return std::nullopt;
    return interval_95(std::move(drawn));
}

// The mean squares of a table with one value for each target and rater.
struct MeanSquares {
    double targets = 0;
    double raters = 0;
    double rest = 0;
};

MeanSquares mean_squares_of(const std::vector<std::vector<double>>& ratings) {
    const auto n = static_cast<double>(ratings.size()), k = static_cast<double>(ratings.front().size());
    std::vector<double> means_of_raters(ratings.front().size(), 0);
    double mean = 0, all = 0, between_targets = 0, between_raters = 0;
    for (const std::vector<double>& target : ratings) {
        for (std::size_t rater = 0; rater < target.size(); ++rater) {
            means_of_raters[rater] += target[rater] / n;
            mean += target[rater] / (n * k);
        }
    }
    for (const std::vector<double>& target : ratings) {
        double sum = 0;
        for (const double value : target) {
            sum += value;
            all += (value - mean) * (value - mean);
        }
        between_targets += k * (sum / k - mean) * (sum / k - mean);
    }
    for (const double of_rater : means_of_raters) between_raters += n * (of_rater - mean) * (of_rater - mean);
    // Rounding may leave a little where the numbers cancel; it counts as 0.
    const double rest = all - between_targets - between_raters;
    return {.targets = between_targets / (n - 1),
            .raters = between_raters / (k - 1),
            .rest = rest > 1e-12 * all ? rest / ((n - 1) * (k - 1)) : 0};
}

// Shrout and Fleiss, page 424: the interval of ICC(2,1). The degrees of freedom vanish where all targets have
// one mean; so few have no quantile that a number could hold.
std::optional<Interval> interval_of_one_rater(const MeanSquares& squares, double icc, double n, double k) {
    const double f = squares.raters / squares.rest;
    const double part = n * (1 + (k - 1) * icc) - k * icc;
    const double df = (k - 1) * (n - 1) * (k * icc * f + part) * (k * icc * f + part) /
                      ((n - 1) * k * k * icc * icc * f * f + part * part);
    constexpr double kFewestDegrees = 0.05;
    if (!(df >= kFewestDegrees)) return std::nullopt;
    const double upper = f_quantile(0.975, n - 1, df), lower = f_quantile(0.975, df, n - 1);
    const double others = k * squares.raters + (k * n - k - n) * squares.rest;
    return Interval{n * (squares.targets - upper * squares.rest) / (upper * others + n * squares.targets),
                    n * (lower * squares.targets - squares.rest) / (others + n * lower * squares.targets)};
}

}  // namespace

std::optional<Alpha> krippendorff_alpha(std::span<const Rating> ratings, ValueScale scale,
                                        std::uint64_t seed) {
    std::map<std::size_t, std::vector<Rating>> of_unit;
    for (const Rating& rating : ratings) of_unit[rating.unit].push_back(rating);
    std::erase_if(of_unit, [](const auto& entry) { return entry.second.size() < 2; });
    std::map<double, std::size_t> index;
    std::map<std::size_t, std::size_t> raters;  // numbered anew
    for (const auto& [unit, given] : of_unit) {
        for (const Rating& rating : given) {
            index[rating.value] = 0;
            raters.emplace(rating.rater, raters.size());
        }
    }
    Values values{.scale = scale};
    for (auto& [value, place] : index) {
        place = values.numbers.size();
        values.numbers.push_back(value);
    }
    Alpha result{.units = of_unit.size()};
    std::vector<Unit> units;
    std::vector<std::vector<Coincidence>> all;
    const std::vector<double> once(raters.size(), 1);
    for (const auto& [unit, given] : of_unit) {
        Unit& of_raters = units.emplace_back();
        for (const Rating& rating : given)
            of_raters.push_back({raters.at(rating.rater), index.at(rating.value)});
        all.push_back(coincidences_of(of_raters, once));
        result.ratings += given.size();
    }
    const auto alpha = alpha_of(all, values);
    if (!alpha) return std::nullopt;
    result.alpha = *alpha;
    result.alpha_95 = resampled(units, raters.size(), values, seed);
    return result;
}

std::optional<IntraclassCorrelations> intraclass_correlations(
    const std::vector<std::vector<double>>& ratings) {
    if (ratings.size() < 2 || ratings.front().size() < 2) return std::nullopt;
    for (const std::vector<double>& target : ratings) assert(target.size() == ratings.front().size());
    const auto n = static_cast<double>(ratings.size()), k = static_cast<double>(ratings.front().size());
    const MeanSquares squares = mean_squares_of(ratings);
    const double signal = squares.targets - squares.rest;
    const double drawn = squares.targets + (k - 1) * squares.rest + k * (squares.raters - squares.rest) / n;
    const double fixed = squares.targets + (k - 1) * squares.rest;
    const double mean = squares.targets + (squares.raters - squares.rest) / n;
    if (!(drawn > 0) || !(fixed > 0) || !(mean > 0)) return std::nullopt;
    IntraclassCorrelations result{.targets = ratings.size(), .raters = ratings.front().size()};
    result.one_rater.value = signal / drawn;
    result.mean_rating.value = signal / mean;
    result.fixed_rater.value = signal / fixed;
    if (squares.rest > 0) {
        const auto one = interval_of_one_rater(squares, result.one_rater.value, n, k);
        const auto stepped_up = [&](double icc) { return k * icc / (1 + (k - 1) * icc); };
        result.one_rater.value_95 = one;
        if (one) result.mean_rating.value_95 = Interval{stepped_up(one->low), stepped_up(one->high)};
        const double f = squares.targets / squares.rest, df = (n - 1) * (k - 1);
        const double low = f / f_quantile(0.975, n - 1, df), high = f * f_quantile(0.975, df, n - 1);
        result.fixed_rater.value_95 = Interval{(low - 1) / (low + k - 1), (high - 1) / (high + k - 1)};
    }
    return result;
}

std::optional<double> cronbach_alpha(std::span<const std::vector<double>> answers) {
    if (answers.size() < 2) return std::nullopt;
    const std::size_t items = answers.front().size();
    assert(items > 1);
    const auto variance = [&](const auto& value_of) {
        std::vector<double> values;
        for (const std::vector<double>& answer : answers) values.push_back(value_of(answer));
        const double sd = *summarize(values).sd;
        return sd * sd;
    };
    double of_items = 0;
    for (std::size_t i = 0; i < items; ++i)
        of_items += variance([&](const std::vector<double>& answer) { return answer[i]; });
    const double of_sum = variance(
        [](const std::vector<double>& answer) { return std::accumulate(answer.begin(), answer.end(), 0.0); });
    if (!(of_sum > 0)) return std::nullopt;
    const auto k = static_cast<double>(items);
    return k / (k - 1) * (1 - of_items / of_sum);
}

}  // namespace chironomia::study
