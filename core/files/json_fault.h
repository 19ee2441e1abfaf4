// What is wrong with a JSON value, in the words of its library but without the library's name and numbers.
#pragma once

#include <string_view>

#include "core/files/json.h"

namespace chironomia {

// "type must be number, but is string". The text lives as long as `fault`.
inline std::string_view fault_of(const Json::exception& fault) {
    const std::string_view text = fault.what();
    const std::size_t end = text.find("] ");
    return end == std::string_view::npos ? text : text.substr(end + 2);
}

}  // namespace chironomia
