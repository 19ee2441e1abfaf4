#include "study/cli/model_options.h"

#include <algorithm>

#include "core/text.h"

namespace chironomia {

Json option_value(const std::string& text) {
    if (text == "true" || text == "false") return text == "true";
    if (const auto whole = parse_integer(text)) return *whole;
    if (const auto number = parse_number(text)) return *number;
    return text;
}

std::optional<std::pair<std::string, Json>> model_option(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) return std::nullopt;
    return std::pair(text.substr(0, equals), option_value(text.substr(equals + 1)));
}

bool is_reading(std::string_view option) {
    if (!option.starts_with("--A") || option.size() < 4) return false;
    return std::all_of(option.begin() + 3, option.end(),
                       [](char c) { return (c >= '0' && c <= '9') || c == '-' || (c >= 'a' && c <= 'z'); });
}

}  // namespace chironomia
