#include "skinning/face/face_gains.h"

#include <algorithm>

#include "core/body/face.h"
#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr double kLargest = 10;

std::string known_units() {
    std::vector<std::string> numbers;
    for (const int unit : known_action_units()) numbers.push_back(std::to_string(unit));
    return join(numbers);
}

}  // namespace

double gain_of(const FaceGains& gains, int unit) {
    for (const FaceGain& each : gains) {
        if (each.unit == unit) return each.gain;
    }
    return 1;
}

FaceGains parse_face_gains(std::string_view text) {
    FaceGains gains;
    for (const std::string_view part : split(text, ',')) {
        const std::vector<std::string_view> sides = split(part, '=');
        const auto unit = parse_integer(sides[0]);
        const auto gain = sides.size() == 2 ? parse_number(sides[1]) : std::nullopt;
        if (!unit || !gain) {
            throw Error(format(
                "face gain: \"{}\" is no gain of an action unit; write unit=gain, such as 12=1.3,1=1.5",
                part));
        }
        if (*unit < 0 || *unit > 99 || name_of_unit(static_cast<int>(*unit)).empty())
            throw Error(format("face gain: AU{} is not known; the known units are {}", *unit, known_units()));
        if (!(*gain >= 0 && *gain <= kLargest)) {
            throw Error(format("face gain: the gain of AU{} is {}; use a number from 0 to {}", *unit, *gain,
                               kLargest));
        }
        const auto same = [&](const FaceGain& each) { return each.unit == *unit; };
        if (std::any_of(gains.begin(), gains.end(), same))
            throw Error(format("face gain: AU{} has two gains; give it one", *unit));
        gains.push_back({.unit = static_cast<int>(*unit), .gain = *gain});
    }
    std::sort(gains.begin(), gains.end(),
              [](const FaceGain& a, const FaceGain& b) { return a.unit < b.unit; });
    return gains;
}

std::string to_text(const FaceGains& gains) {
    std::vector<std::string> parts;
    for (const auto& [unit, gain] : gains) parts.push_back(format("{}={}", unit, gain));
    return join(parts, ",");
}

}  // namespace chironomia
