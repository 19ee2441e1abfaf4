#include "study/measure/distributions.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace chironomia::study {

namespace bm = boost::math;

double student_t_two_sided(double t, double df) {
    return 2 * bm::cdf(bm::complement(bm::students_t(df), std::abs(t)));
}

double normal_two_sided(double z) {
    return 2 * bm::cdf(bm::complement(bm::normal(), std::abs(z)));
}

double student_t_quantile(double p, double df) {
    return bm::quantile(bm::students_t(df), p);
}

double chi_squared_upper_tail(double chi_squared, double df) {
    return bm::cdf(bm::complement(bm::chi_squared(df), chi_squared));
}

double f_upper_tail(double f, double df_between, double df_within) {
    return bm::cdf(bm::complement(bm::fisher_f(df_between, df_within), f));
}

double f_quantile(double p, double df_between, double df_within) {
    return bm::quantile(bm::fisher_f(df_between, df_within), p);
}

double beta_quantile(double p, double a, double b) {
    return bm::quantile(bm::beta_distribution<>(a, b), p);
}

double binomial_at_most(std::size_t k, std::size_t n, double p) {
    return bm::cdf(bm::binomial(static_cast<double>(n), p), static_cast<double>(k));
}

}  // namespace chironomia::study
