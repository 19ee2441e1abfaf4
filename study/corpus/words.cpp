#include "study/corpus/words.h"

#include <algorithm>

#include "core/utf8.h"
#include "study/measure/lexical.h"
#include "synth/markup/letters.h"

namespace chironomia::study {

void SaidWords::add(const CorpusWord& word, const std::vector<float>& vectors, std::size_t row) {
    if (word.text == ",") return;
    texts_.push_back(to_utf8(bare_letters(word.text)));
    for (std::size_t i = 0; i < kWordVector; ++i) sum_[i] += vectors[row * kWordVector + i];
}

void SaidWords::add(const IpuRecord& record) {
    for (std::size_t w = 0; w < record.words.size(); ++w) add(record.words[w], record.vectors, w);
}

void SaidWords::add(const IntervalRecord& record) {
    for (const CorpusWord& word : record.words) {
        const double middle = (word.start + word.end) / 2 * IntervalRecord::kFps;
        const auto last = static_cast<double>(record.frames() - 1);
        add(word, record.vectors, static_cast<std::size_t>(std::min(middle, last)));
    }
}

std::vector<float> SaidWords::mean_vector() const {
    std::vector<float> mean;
    for (const double each : sum_)
        mean.push_back(static_cast<float>(each / static_cast<double>(texts_.size())));
    return mean;
}

std::map<std::string, Json> lexical_of(const std::map<std::string, SaidWords>& people) {
    constexpr std::size_t kClusters = 3;
    std::map<std::string, Json> lexical;
    std::vector<float> vectors;
    for (const auto& [name, said] : people) {
        if (said.texts().empty()) continue;
        const LexicalDiversity diversity = lexical_diversity(said.texts());
        lexical[name] = {{"words", said.texts().size()},
                         {"diversity", diversity.all},
                         {"diversity_per_1000", diversity.windowed ? Json(*diversity.windowed) : Json()},
                         {"cluster", nullptr}};
        const std::vector<float> mean = said.mean_vector();
        vectors.insert(vectors.end(), mean.begin(), mean.end());
    }
    if (lexical.size() < kClusters) return lexical;
    const Clusters clusters = k_means(vectors, kWordVector, {.clusters = kClusters});
    auto cluster = clusters.of.begin();
    for (auto& [name, about] : lexical) about["cluster"] = *cluster++ + 1;
    return lexical;
}

}  // namespace chironomia::study
