// What programs for Windows write before a text in UTF-8.
#pragma once

#include <string_view>

namespace chironomia {

inline std::string_view without_byte_order_mark(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return text;
}

}  // namespace chironomia
