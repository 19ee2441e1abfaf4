#include "skinning/signal/frame_rate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/text.h"

namespace chironomia {
namespace {

// Whole rates come first: "0.0333" is 30, not 29.97, although both round to it.
constexpr std::array<double, 28> kWholeRates = {8,   10,  12,  12.5, 15,  16,  18,  20, 24, 25,
                                                30,  40,  48,  50,   60,  72,  75,  80, 90, 96,
                                                100, 120, 125, 144,  150, 200, 240, 250};
constexpr double kFinest = 0.01;
constexpr std::array<double, 4> kVideoRates = {24000.0 / 1001, 30000.0 / 1001, 60000.0 / 1001,
                                               120000.0 / 1001};

// What one step of the last digit is worth: 1e-6 for "0.008342", 1e-8 for "3.33333e-3".
double last_digit(std::string_view text) {
    const size_t exponent_at = text.find_first_of("eE");
    const std::string_view digits = text.substr(0, exponent_at);
    const size_t point = digits.find('.');
    double exponent = point == std::string_view::npos ? 0 : -static_cast<double>(digits.size() - point - 1);
    if (exponent_at != std::string_view::npos) {
        exponent += parse_number(text.substr(exponent_at + 1)).value_or(0);
    }
    return std::pow(10, exponent);
}

template <typename Rates>
std::optional<double> nearest_rate(const Rates& rates, double seconds, double tolerance) {
    std::optional<double> nearest;
    double least = std::min(tolerance * (1 + 1e-6), 0.025 * seconds);
    for (const double rate : rates) {
        const double difference = std::abs(1 / rate - seconds);
        if (difference > least) continue;
        least = difference;
        nearest = rate;
    }
    return nearest;
}

}  // namespace

double rate_of_frame_time(std::string_view text) {
    text = trim(text);
    const double seconds = parse_number(text).value_or(0);
    if (!(seconds > 0)) return std::numeric_limits<double>::infinity();
    const double step = last_digit(text);
    // Rounded first, then cut: within half a step, then within a whole one.
    for (const double tolerance : {step / 2, step}) {
        if (const auto rate = nearest_rate(kWholeRates, seconds, tolerance)) return *rate;
        if (const auto rate = nearest_rate(kVideoRates, seconds, tolerance)) return *rate;
    }
    // Two digits fit too many whole rates: "0.03" is 29 to 40. One in a hundred of the time is ours.
    const double whole = std::round(1 / seconds);
    if (step > kFinest * seconds) return 1 / seconds;
    return nearest_rate(std::array{whole}, seconds, step / 2).value_or(1 / seconds);
}

double rate_of_step(double seconds) {
    const double rate = rate_of_frame_time(format("{:.6f}", seconds));
    return is_rate_of_motion(rate) ? rate : 1 / seconds;
}

std::string meant_by_frame_time(double seconds) {
    const bool is_usual = std::find(kWholeRates.begin(), kWholeRates.end(), seconds) != kWholeRates.end();
    if (is_usual) return format("; it is probably the rate: write {:.5g}", 1 / seconds);
    if (!is_rate_of_motion(1000 / seconds)) return "";
    return format("; it is probably in milliseconds: write {:.5g}", seconds / 1000);
}

}  // namespace chironomia
