// Words as texts: what is around them, how long they are, and when two are the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// Without marks and symbols around it ("“Well…" is "Well"); "" if nothing else is there.
std::string_view without_punctuation(std::string_view word);

// Lower case and without any punctuation ("Don’t" and "dont" are the same). Case is folded in Latin, Greek
// and Cyrillic letters.
std::string folded(std::string_view word);

// The share of the letters of a text that lie before each of its words, and 1 after them. Each word counts
// at least one letter.
std::vector<double> shares_of_letters(const std::vector<std::string>& words);

}  // namespace chironomia
