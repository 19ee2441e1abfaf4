// The probability distributions that tests and intervals need.
#pragma once

#include <cstddef>

namespace chironomia::study {

// Chances of being at least as far from 0 on either side; df > 0.
double student_t_two_sided(double t, double df);
double normal_two_sided(double z);

// The value that t stays below with chance p, 0 < p < 1.
double student_t_quantile(double p, double df);

// The chance that chi squared is at least `chi_squared`.
double chi_squared_upper_tail(double chi_squared, double df);

// The chance that F is at least `f`, and the value that it stays below with chance p.
double f_upper_tail(double f, double df_between, double df_within);
double f_quantile(double p, double df_between, double df_within);

// The value that a Beta(a, b) stays below with chance p; a, b > 0.
double beta_quantile(double p, double a, double b);

// The chance of at most `k` successes in `n` trials that each succeed with chance p.
double binomial_at_most(std::size_t k, std::size_t n, double p);

}  // namespace chironomia::study
