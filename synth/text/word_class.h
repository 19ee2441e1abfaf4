// What is known of an English word without a model: its kind, and how common it is.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace chironomia {

// 16 answers: function word, auxiliary, conjunction, imperative, question word, hesitation, intensifier,
// article, pronoun, preposition, number, negation, and by its ending: "-ing", "-ed", "-ly", noun.
inline constexpr std::size_t kWordAnswers = 16;

// (kWordAnswers) of a word in plain letters.
std::vector<bool> answers_about(std::string_view word);

// Its place in a list of words by how often they are said, from 1; longer words than those in the list pass
// for rarer.
double rank_of(std::string_view word);

}  // namespace chironomia
