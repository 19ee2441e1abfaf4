// Where the accents of a speech lie, and the clauses that they belong to.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/speech.h"

namespace chironomia {

// The words [first, end) of a rheme; where a speech has no rhemes, of a stretch between pauses.
struct Clause {
    std::size_t first = 0;
    std::size_t end = 0;
};

struct Accent {
    std::size_t word = 0;
    double time = 0;          // [s]
    bool is_nuclear = false;  // the last one of its clause
};

class Accents {
  public:
    explicit Accents(const Speech& speech);

    const std::vector<Accent>& all() const { return accents_; }  // ascending

    // The accents of the words [first, end), as indices into all().
    struct Range {
        std::size_t first = 0;
        std::size_t end = 0;
        bool empty() const { return first == end; }
    };
    Range within(std::size_t first_word, std::size_t end_word) const;

    // The clause that holds a word, or to which it leads (of a theme), or else the word itself.
    Clause clause_of(std::size_t word) const;

    // The last accent of the first clause that the words [first, end) have a part of; if they end before it,
    // their own last one.
    std::optional<std::size_t> nuclear_word(std::size_t first_word, std::size_t end_word) const;

    // The last content word of [first, end), or else the last word.
    std::size_t last_content_word(std::size_t first_word, std::size_t end_word) const;

  private:
    const Speech& speech_;
    std::vector<Clause> clauses_;  // ascending, not in one another
    std::vector<bool> is_content_;
    std::vector<Accent> accents_;
};

// The beginning of the vowel under the primary stress [s]; of the secondary one where there is no other.
// Where neither is known (with_said_stress() of synth/speech looks for it), a third of the way through the word.
double stressed_moment(const Speech& speech, std::size_t word);

}  // namespace chironomia
