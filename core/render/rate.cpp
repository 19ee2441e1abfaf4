#include "core/render/rate.h"

#include <cmath>
#include <numeric>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr long long kHighest = 1000;             // [frames/s]
constexpr long long kLargestTerm = 100'000'000;  // room for the products below

std::optional<Rate> make_rate(long long numerator, long long denominator) {
    if (numerator <= 0 || denominator <= 0) return std::nullopt;
    if (numerator > kLargestTerm || denominator > kLargestTerm) return std::nullopt;
    if (numerator > kHighest * denominator) return std::nullopt;
    const long long divisor = std::gcd(numerator, denominator);
    return Rate{static_cast<int>(numerator / divisor), static_cast<int>(denominator / divisor)};
}

// 29.97 -> 30000/1001: the short decimal of a rate of colour television, whose base is a multiple of 12
// or 15.
std::optional<Rate> television_rate(double value, double half_unit) {
    const long long base = std::llround(value * 1.001);
    if (base <= 0 || (base % 12 != 0 && base % 15 != 0)) return std::nullopt;
    if (std::abs(static_cast<double>(base) * 1000 / 1001 - value) > half_unit) return std::nullopt;
    return make_rate(base * 1000, 1001);
}

std::optional<Rate> parse_decimal(std::string_view text) {
    if (text.find_first_not_of("0123456789.+") != std::string_view::npos) return std::nullopt;
    const std::optional<double> value = parse_number(text);
    if (!value || *value > kHighest) return std::nullopt;
    const size_t point = text.find('.');
    const size_t decimals = point == std::string_view::npos ? 0 : text.size() - point - 1;
    if (decimals > 6) return std::nullopt;
    const double unit = std::pow(10.0, static_cast<double>(decimals));
    if (decimals >= 2) {
        if (const std::optional<Rate> rate = television_rate(*value, 0.5000001 / unit)) return rate;
    }
    return make_rate(std::llround(*value * unit), std::llround(unit));
}

}  // namespace

std::optional<Rate> parse_rate(std::string_view text) {
    text = trim(text);
    const size_t slash = text.find('/');
    if (slash == std::string_view::npos) return parse_decimal(text);
    const std::optional<long long> numerator = parse_integer(text.substr(0, slash));
    const std::optional<long long> denominator = parse_integer(text.substr(slash + 1));
    if (!numerator || !denominator) return std::nullopt;
    return make_rate(*numerator, *denominator);
}

std::string to_text(const Rate& rate) {
    const std::string decimal = format("{}", rate.per_second());
    return parse_rate(decimal) == rate ? decimal : format("{}/{}", rate.numerator, rate.denominator);
}

}  // namespace chironomia
