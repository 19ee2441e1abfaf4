// UTF-8, as the scripts and the files of words are written.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace chironomia {

// The place of the first byte that belongs to no character (RFC 3629: no overlong forms, no surrogates);
// nothing if the text is UTF-8.
std::optional<std::size_t> fault_in_utf8(std::string_view text);

// The byte at which each character begins, and the length of the text behind them.
std::vector<std::size_t> starts_of_characters(std::string_view text);

}  // namespace chironomia
