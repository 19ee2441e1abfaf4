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
constexpr std::size_t kFewestRaters = 3;  // resampling two raters gives no variation

// The ratings of one unit.
struct UnitRating {
    std::size_t rater = 0;
    std::size_t value = 0;  // index
};
using Unit = std::vector<UnitRating>;  // by value

// The values that raters gave.
struct Values {
    std::vector<double> numbers;  // (V) ascending
    ValueScale scale;
};

// How often each rater and each unit counts.
struct Draw {
    std::vector<double> units;
    std::vector<double> raters;
};

// How often a value was given.
struct Count {
    std::size_t value = 0;
    double times = 0;
};

// Where values lie, so that their distance is the difference of their places. On an ordinal scale the middle of their
// ranks; none on a nominal one, where all are 1 apart.
std::vector<double> places_of(const Values& values, const std::vector<double>& times) {
    if (values.scale == ValueScale::nominal) return {};
    if (values.scale == ValueScale::interval) return values.numbers;
    std::vector<double> places;
    double below = 0;
    for (const double count : times) {
        places.push_back(below + count / 2);
        below += count;
    }
    return places;
}

// The squared distances of all ordered pairs of what was given.
double sum_of_distances(const std::vector<Count>& counts, const std::vector<double>& places) {
    double all = 0, sum = 0, same = 0, squares = 0;
    for (const Count& count : counts) {
        all += count.times;
        same += count.times * count.times;
        if (!places.empty()) sum += count.times * places[count.value];
    }
    if (places.empty()) return all * all - same;
    for (const Count& count : counts) {
        const double off = places[count.value] - sum / all;
        squares += count.times * off * off;
    }
    return 2 * all * squares;
}

// The values of one unit, and how many others each rating meets there: two of one rater are no pair.
struct UnitCounts {
    std::vector<Count> counts;
    double partners = 0;
};

UnitCounts counts_of(const Unit& unit, const std::vector<double>& times_of_raters) {
    UnitCounts result;
    double ratings = 0, of_one_rater = 0;
    for (const UnitRating& rating : unit) {
        const double count = times_of_raters[rating.rater];
        if (count == 0) continue;
        if (result.counts.empty() || result.counts.back().value != rating.value)
            result.counts.push_back({rating.value, 0});
        result.counts.back().times += count;
        ratings += count;
        of_one_rater += count * count;
    }
    result.partners = ratings > 0 ? (ratings * ratings - of_one_rater) / ratings : 0;
    return result;
}

// In sums of each unit instead of Krippendorff's matrix of coincidences, so that many values and raters take no longer.
std::optional<double> alpha_of(const std::vector<Unit>& units, const Values& values, const Draw& draw) {
    std::vector<double> times(values.numbers.size(), 0);
    std::vector<UnitCounts> counts;
    double all = 0;
    for (std::size_t u = 0; u < units.size(); ++u) {
        counts.push_back(counts_of(units[u], draw.raters));
        if (draw.units[u] == 0 || !(counts.back().partners > 0)) continue;
        double ratings = 0;
        for (const Count& count : counts.back().counts) ratings += count.times;
        for (const UnitRating& rating : units[u]) {
            const double count = draw.raters[rating.rater];
            const double pairs = draw.units[u] * count * (ratings - count) / counts.back().partners;
            times[rating.value] += pairs;
            all += pairs;
        }
    }
    const std::vector<double> places = places_of(values, times);
    double observed = 0;
    for (std::size_t u = 0; u < units.size(); ++u) {
        if (draw.units[u] > 0 && counts[u].partners > 0)
            observed += draw.units[u] * sum_of_distances(counts[u].counts, places) / counts[u].partners;
    }
    std::vector<Count> given;
    for (std::size_t value = 0; value < times.size(); ++value) {
        if (times[value] > 0) given.push_back({value, times[value]});
    }
    if (given.size() < 2) return std::nullopt;
    return 1 - (all - 1) * observed / sum_of_distances(given, places);
}

std::optional<Interval> resampled(const std::vector<Unit>& units, std::size_t raters, const Values& values,
                                  std::uint64_t seed) {
    if (units.size() < 2 || raters < kFewestRaters) return std::nullopt;
    std::vector<double> drawn;
    Random random(seed);
    for (std::size_t sample = 0; sample < kResamples; ++sample) {
        std::vector<double> of_units = draw_items(units.size(), random);
        std::vector<double> of_raters = draw_items(raters, random);
        const Draw draw{.units = std::move(of_units), .raters = std::move(of_raters)};
        if (const auto alpha = alpha_of(units, values, draw)) drawn.push_back(*alpha);
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
// one mean; for so few of them the quantile overflows.
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
    for (const auto& [unit, given] : of_unit) {
        Unit& of_raters = units.emplace_back();
        for (const Rating& rating : given)
            of_raters.push_back({raters.at(rating.rater), index.at(rating.value)});
        std::ranges::stable_sort(of_raters, {}, &UnitRating::value);
        result.ratings += given.size();
    }
    const Draw once{.units = std::vector<double>(units.size(), 1),
                    .raters = std::vector<double>(raters.size(), 1)};
    const auto alpha = alpha_of(units, values, once);
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
