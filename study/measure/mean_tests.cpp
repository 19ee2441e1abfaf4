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

}  // namespace chironomia::study
