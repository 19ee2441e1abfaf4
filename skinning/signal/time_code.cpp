#include "skinning/signal/time_code.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::array<double, 10> kRates = {24, 25, 30, 48, 50, 60, 100, 120, 240, 1000};
constexpr double kFarthest = 1.5;  // frames that a found rate may lie off the usual one
constexpr int kSecondsOfDay = 24 * 3600;

// A whole number of one or two digits below `end`.
std::optional<int> part(std::string_view text, int end) {
    const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (text.empty() || text.size() > 2 || !digits) return std::nullopt;
    const int value = static_cast<int>(*parse_integer(text));
    return value < end ? std::optional(value) : std::nullopt;
}

std::optional<double> frames_part(std::string_view text) {
    const bool plain =
        std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
    const auto frames = parse_number(text);
    if (!plain || !frames || *frames >= 1000) return std::nullopt;
    return frames;
}

int second_of(const TimeCode& code) {
    return (code.hours * 60 + code.minutes) * 60 + code.seconds;
}

// Without the numbers that drop-frame codes leave out.
double frames_since_midnight(const TimeCode& code, double rate) {
    const double frames = second_of(code) * rate + code.frames;
    if (!code.drops_frames) return frames;
    const int minutes = code.hours * 60 + code.minutes;
    return frames - std::round(rate / 15) * (minutes - minutes / 10);
}

}  // namespace

std::optional<TimeCode> parse_time_code(std::string_view text) {
    text = trim(text);
    const size_t last = text.find_last_of(":;");
    if (last == std::string_view::npos) return std::nullopt;
    const std::vector<std::string_view> parts = split(text.substr(0, last), ':');
    if (parts.size() != 3) return std::nullopt;
    const auto hours = part(parts[0], 24), minutes = part(parts[1], 60), seconds = part(parts[2], 60);
    const auto frames = frames_part(text.substr(last + 1));
    if (!hours || !minutes || !seconds || !frames) return std::nullopt;
    return TimeCode{*hours, *minutes, *seconds, *frames, text[last] == ';'};
}

std::optional<double> rate_of_time_codes(const std::vector<TimeCode>& codes) {
    double largest = 0;
    std::vector<double> steps, found;
    for (size_t n = 0; n < codes.size(); ++n) {
        largest = std::max(largest, std::floor(codes[n].frames));
        if (n > 0 && second_of(codes[n]) == second_of(codes[n - 1]))
            steps.push_back(codes[n].frames - codes[n - 1].frames);
    }
    if (steps.empty()) return std::nullopt;
    const double step = median(steps);
    for (size_t n = 1; n < codes.size(); ++n) {
        if (second_of(codes[n]) == (second_of(codes[n - 1]) + 1) % kSecondsOfDay)
            found.push_back(codes[n - 1].frames + step - codes[n].frames);
    }
    if (found.empty()) return std::nullopt;
    const double rate = median(found);
    const auto nearest = *std::min_element(kRates.begin(), kRates.end(), [&](double a, double b) {
        return std::abs(a - rate) < std::abs(b - rate);
    });
    const double farthest = nearest == 1000 ? 0.5 * step + kFarthest : kFarthest;
    if (largest >= nearest || std::abs(nearest - rate) > farthest) return std::nullopt;
    return nearest;
}

std::vector<double> seconds_of_time_codes(const std::vector<TimeCode>& codes, double rate) {
    std::vector<double> times;
    double days = 0;
    for (const TimeCode& code : codes) {
        const double real = code.drops_frames ? rate * 1000 / 1001 : rate;
        double time = frames_since_midnight(code, rate) / real;
        // A day back within one recording is midnight; anything else is out of order.
        if (!times.empty() && time + days < times.back() - kSecondsOfDay / 2) days += kSecondsOfDay;
        times.push_back(time + days);
    }
    return times;
}

}  // namespace chironomia
