#include "study/measure/mean_tests.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "study/measure/distributions.h"

namespace chironomia::study {
namespace {

Interval around(double middle, double error, double df) {
    const double half = student_t_quantile(0.975, df) * error;
    return {middle - half, middle + half};
}

// Of errors (N, K) whose rows and columns have a mean of 0.
double greenhouse_geisser(const std::vector<std::vector<double>>& errors) {
    const std::size_t columns = errors.front().size();
    double trace = 0, squares = 0;
    for (std::size_t a = 0; a < columns; ++a) {
        for (std::size_t b = 0; b < columns; ++b) {
            double product = 0;
            for (const std::vector<double>& row : errors) product += row[a] * row[b];
            squares += product * product;
            trace += a == b ? product : 0;
        }
    }
    return std::min(1.0, trace * trace / (static_cast<double>(columns - 1) * squares));
}

}  // namespace

std::optional<MeanTest> paired_t(std::span<const double> first, std::span<const double> second) {
    assert(first.size() == second.size());
    if (first.size() < 2) return std::nullopt;
    std::vector<double> differences;
    double largest = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        differences.push_back(first[i] - second[i]);
        largest = std::max({largest, std::abs(first[i]), std::abs(second[i])});
    }
    const Summary summary = summarize(differences);
    if (!(*summary.sd > kRounding * largest)) return std::nullopt;
    const auto n = static_cast<double>(summary.n);
    const double t = summary.mean / (*summary.sd / std::sqrt(n));
    return MeanTest{.n_first = summary.n,
                    .n_second = summary.n,
                    .difference = summary.mean,
                    .difference_95 = *summary.mean_95,
                    .t = t,
                    .df = n - 1,
                    .p = student_t_two_sided(t, n - 1),
                    .effect = summary.mean / *summary.sd};
}

std::optional<MeanTest> welch_t(std::span<const double> first, std::span<const double> second) {
    if (first.size() < 2 || second.size() < 2) return std::nullopt;
    const Summary a = summarize(first), b = summarize(second);
    const double variance_a = *a.sd * *a.sd / static_cast<double>(a.n),
                 variance_b = *b.sd * *b.sd / static_cast<double>(b.n), variance = variance_a + variance_b;
    if (!(variance > 0)) return std::nullopt;
    // Welch and Satterthwaite's degrees of freedom.
    const double df = variance * variance /
                      (variance_a * variance_a / static_cast<double>(a.n - 1) +
                       variance_b * variance_b / static_cast<double>(b.n - 1));
    const double difference = a.mean - b.mean, t = difference / std::sqrt(variance);
    return MeanTest{.n_first = a.n,
                    .n_second = b.n,
                    .difference = difference,
                    .difference_95 = around(difference, std::sqrt(variance), df),
                    .t = t,
                    .df = df,
                    .p = student_t_two_sided(t, df),
                    .effect = difference / std::sqrt((*a.sd * *a.sd + *b.sd * *b.sd) / 2)};
}

std::optional<Anova> one_way_anova(std::span<const std::vector<double>> groups) {
    std::vector<Summary> summaries;
    std::size_t n = 0;
    double sum = 0;
    for (const std::vector<double>& group : groups) {
        if (group.empty()) return std::nullopt;
        summaries.push_back(summarize(group));
        n += group.size();
        sum += summaries.back().mean * static_cast<double>(group.size());
    }
    if (groups.size() < 2 || n <= groups.size()) return std::nullopt;
    const double grand_mean = sum / static_cast<double>(n);
    double between = 0, within = 0;
    for (const Summary& group : summaries) {
        const auto size = static_cast<double>(group.n);
        between += size * (group.mean - grand_mean) * (group.mean - grand_mean);
        within += (size - 1) * group.sd.value_or(0) * group.sd.value_or(0);
    }
    if (!(within > 0)) return std::nullopt;
    Anova anova{.n = n,
                .df_between = static_cast<double>(groups.size() - 1),
                .df_within = static_cast<double>(n - groups.size())};
    anova.mean_square_within = within / anova.df_within;
    anova.eta_squared = between / (between + within);
    anova.f = between / anova.df_between / anova.mean_square_within;
    anova.p = f_upper_tail(anova.f, anova.df_between, anova.df_within);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        for (std::size_t j = i + 1; j < groups.size(); ++j) {
            const double difference = summaries[i].mean - summaries[j].mean;
            const double error =
                std::sqrt(anova.mean_square_within * (1 / static_cast<double>(summaries[i].n) +
                                                      1 / static_cast<double>(summaries[j].n)));
            anova.pairs.push_back({.first = i,
                                   .second = j,
                                   .difference = difference,
                                   .difference_95 = around(difference, error, anova.df_within),
                                   .t = difference / error,
                                   .p = student_t_two_sided(difference / error, anova.df_within)});
        }
    }
    return anova;
}

std::optional<RepeatedAnova> repeated_anova(std::span<const std::vector<double>> rows) {
    if (rows.size() < 2) return std::nullopt;
    const std::size_t columns = rows.front().size();
    assert(columns > 1);
    const auto n = static_cast<double>(rows.size()), k = static_cast<double>(columns);
    std::vector<double> column_means(columns, 0), row_means;
    double largest = 0;
    for (const std::vector<double>& row : rows) {
        assert(row.size() == columns);
        row_means.push_back(mean_of(row));
        for (std::size_t j = 0; j < columns; ++j) {
            column_means[j] += row[j] / n;
            largest = std::max(largest, std::abs(row[j]));
        }
    }
    const double mean = mean_of(row_means);
    double of_columns = 0, of_rows = 0, of_errors = 0;
    for (const double each : column_means) of_columns += n * (each - mean) * (each - mean);
    for (const double each : row_means) of_rows += k * (each - mean) * (each - mean);
    std::vector<std::vector<double>> errors(rows.begin(), rows.end());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            errors[i][j] += mean - row_means[i] - column_means[j];
            of_errors += errors[i][j] * errors[i][j];
        }
    }
    if (!(std::sqrt(of_errors / (n * k)) > kRounding * largest)) return std::nullopt;
    RepeatedAnova anova{.n = rows.size(), .df = k - 1, .df_error = (n - 1) * (k - 1)};
    anova.f = of_columns / anova.df / (of_errors / anova.df_error);
    anova.epsilon = greenhouse_geisser(errors);
    anova.p = f_upper_tail(anova.f, anova.epsilon * anova.df, anova.epsilon * anova.df_error);
    anova.partial_eta_squared = of_columns / (of_columns + of_errors);
    anova.generalized_eta_squared = of_columns / (of_columns + of_rows + of_errors);
    return anova;
}

}  // namespace chironomia::study
