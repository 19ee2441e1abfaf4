// Aliases in SSML: <sub alias="revolutions per minute">rpm</sub>.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct SpokenScript {
    std::string text;
    // The character of the script that each character of `text` stands for, and one behind the last.
    std::vector<std::size_t> origins;
};

// The script with each alias in place of its element, whose first word it stands for: the synthesizer speaks
// aliases itself, but tells their words as parts of the word behind the element.
SpokenScript with_aliases(std::string_view ssml);

}  // namespace chironomia
