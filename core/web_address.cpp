#include "core/web_address.h"

#include <algorithm>

namespace chironomia {

bool is_web_address(std::string_view text) {
    for (const std::string_view scheme : {"https://", "http://"}) {
        if (!text.starts_with(scheme)) continue;
        const std::string_view rest = text.substr(scheme.size());
        return !rest.empty() && rest.front() != '/' && std::ranges::none_of(rest, [](char c) {
            return static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
        });
    }
    return false;
}

}  // namespace chironomia
