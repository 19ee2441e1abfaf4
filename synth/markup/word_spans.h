// From bytes of a script to its words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "synth/markup/marked_text.h"

namespace chironomia {

// The first word that ends after `byte`: the one that holds it, or the next.
inline std::size_t word_at(std::span<const ScriptWord> words, std::size_t byte) {
    const auto found = std::partition_point(words.begin(), words.end(),
                                            [&](const ScriptWord& word) { return word.end <= byte; });
    return static_cast<std::size_t>(found - words.begin());
}

// The first word that begins at `byte` or after it.
inline std::size_t word_from(std::span<const ScriptWord> words, std::size_t byte) {
    const auto found = std::partition_point(words.begin(), words.end(),
                                            [&](const ScriptWord& word) { return word.begin < byte; });
    return static_cast<std::size_t>(found - words.begin());
}

}  // namespace chironomia
