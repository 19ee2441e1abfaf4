// What a sentence does in a conversation: the dialog acts of the Switchboard corpus.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "synth/corpus/records.h"

namespace chironomia {

// In the order of DialogTag's label map: "Other", "Thanking", ... "Rhetorical-Questions" (A32).
extern const std::array<std::string_view, IntervalRecord::kDialogActs> kDialogActNames;

// The act of one English sentence by rules: words that greet, thank, apologise, agree or answer, questions by
// their mark and their first words, orders by a leading imperative, opinions by "I think"; what is left
// is a statement. No model: an act is recognized only by its words.
//   words  in order, punctuation as words of its own or at their ends
std::size_t dialog_act_of(std::span<const std::string> words);

// (N) the act of each word's sentence. A sentence ends behind a word that ends with . ? ! or an ellipsis, quotes
// and brackets aside; where no word does, at every silence of more than `longest_pause` [s].
//   words  ascending, each with the punctuation around it
std::vector<std::size_t> dialog_acts_of(std::span<const CorpusWord> words, double longest_pause);

}  // namespace chironomia
