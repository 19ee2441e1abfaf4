#include "synth/corpus/frame_words.h"

#include <algorithm>
#include <cmath>

namespace chironomia {

std::vector<std::optional<std::size_t>> words_of_frames(const std::vector<CorpusWord>& words,
                                                        std::size_t frames) {
    std::vector<std::optional<std::size_t>> said(frames);
    for (std::size_t w = 0; w < words.size(); ++w) {
        const auto first = static_cast<std::size_t>(std::ceil(words[w].start * IntervalRecord::kFps));
        for (std::size_t t = first;
             t < frames && static_cast<double>(t) / IntervalRecord::kFps < words[w].end; ++t)
            said[t] = w;
    }
    return said;
}

std::vector<float> vectors_of_frames(const std::vector<CorpusWord>& words, std::span<const float> vectors,
                                     std::size_t frames) {
    const auto said = words_of_frames(words, frames);
    std::vector<float> rows(frames * kWordVector, 0.0F);
    for (std::size_t t = 0; t < frames; ++t) {
        if (!said[t]) continue;
        const auto of_word = vectors.subspan(*said[t] * kWordVector, kWordVector);
        std::ranges::copy(of_word, rows.begin() + static_cast<std::ptrdiff_t>(t * kWordVector));
    }
    return rows;
}

}  // namespace chironomia
