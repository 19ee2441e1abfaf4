#include "core/clock_time.h"

#include <chrono>
#include <string>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::string_view kDate = "0000-00-00";

// "2026-05-01" as seconds since 1970.
std::optional<double> seconds_of_date(std::string_view date) {
    for (std::size_t i = 0; i < kDate.size(); ++i) {
        const bool is_digit = date[i] >= '0' && date[i] <= '9';
        if (kDate[i] == '0' ? !is_digit : date[i] != kDate[i]) return std::nullopt;
    }
    const auto number = [&](std::size_t begin, std::size_t length) {
        return static_cast<int>(*parse_integer(date.substr(begin, length)));
    };
    const std::chrono::year_month_day day{std::chrono::year(number(0, 4)),
                                          std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                          std::chrono::day(static_cast<unsigned>(number(8, 2)))};
    if (!day.ok()) return std::nullopt;
    return 86400.0 * std::chrono::sys_days(day).time_since_epoch().count();
}

}  // namespace

std::optional<double> seconds_of_clock(std::string_view text) {
    text = trim(text);
    double days = 0;
    const bool has_date =
        text.size() > kDate.size() && (text[kDate.size()] == ' ' || text[kDate.size()] == 'T');
    if (has_date) {
        const auto date = seconds_of_date(text.substr(0, kDate.size()));
        if (!date) return std::nullopt;
        days = *date;
        text.remove_prefix(kDate.size() + 1);
        text = text.substr(0, text.find_first_of("Z+-"));
    }
    std::string clock(text);
    for (char& letter : clock)
        if (letter == ',') letter = '.';
    const std::vector<std::string_view> parts = split(clock, ':');
    if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
    double seconds = 0;
    for (const std::string_view part : parts) {
        const std::optional<double> number = parse_number(part);
        if (!number || part.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
        seconds = seconds * 60 + *number;
    }
    return days + seconds;
}

}  // namespace chironomia
