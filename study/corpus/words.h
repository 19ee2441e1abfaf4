// Lexical diversity and mean word vector of each person in a corpus. Fares 2023, section 4.3.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "synth/corpus/records.h"

namespace chironomia::study {

// One person's words over all records, and what they are to a model.
class SaidWords {
  public:
    // Silences are no words. Of an interval a word's vector is that of the frame in its middle.
    void add(const IpuRecord& record);
    void add(const IntervalRecord& record);

    const std::vector<std::string>& texts() const { return texts_; }  // in small bare letters, in order
    std::vector<float> mean_vector() const;                           // (kWordVector)

  private:
    void add(const CorpusWord& word, const std::vector<float>& vectors, std::size_t row);

    std::vector<std::string> texts_;
    std::vector<double> sum_ = std::vector<double>(kWordVector);
};

// Of each person who said something, by name: {words, diversity, diversity_per_1000, cluster}. The diversity
// is distinct words by words; longer texts have less of it, so that its mean over whole stretches of 1,000
// words stands beside it, null of fewer words. People of one of three clusters, counted from 1, have mean
// vectors of words that are alike; null of fewer than three people.
std::map<std::string, Json> lexical_of(const std::map<std::string, SaidWords>& people);

}  // namespace chironomia::study
