#include "synth/text/interval_text.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace chironomia {
namespace {

// The word of each frame, (T): the one that is said there; nothing between words.
std::vector<std::optional<std::size_t>> words_at(const std::vector<CorpusWord>& words, std::size_t frames) {
    std::vector<std::optional<std::size_t>> at(frames);
    for (std::size_t w = 0; w < words.size(); ++w) {
        const auto first = static_cast<std::size_t>(std::ceil(words[w].start * IntervalRecord::kFps));
        for (std::size_t t = first;
             t < frames && static_cast<double>(t) / IntervalRecord::kFps < words[w].end; ++t)
            at[t] = w;
    }
    return at;
}

}  // namespace

std::vector<float> vectors_of_frames(const std::vector<CorpusWord>& words, std::span<const float> vectors,
                                     std::size_t frames) {
    const auto said = words_at(words, frames);
    std::vector<float> rows(frames * kWordVector, 0.0F);
    for (std::size_t t = 0; t < frames; ++t) {
        if (!said[t]) continue;
        const auto of_word = vectors.subspan(*said[t] * kWordVector, kWordVector);
        std::ranges::copy(of_word, rows.begin() + static_cast<std::ptrdiff_t>(t * kWordVector));
    }
    return rows;
}

IntervalRecord with_text(IntervalRecord interval, const TextEncoder& encoder, const WordsAsRead& read) {
    constexpr std::size_t kActs = IntervalRecord::kDialogActs;
    assert(read.vectors.size() == interval.words.size() * kWordVector);
    assert(read.acts.empty() || read.acts.size() == interval.words.size());
    const std::size_t frames = interval.frames();
    const auto at = words_at(interval.words, frames);
    interval.vectors = vectors_of_frames(interval.words, read.vectors, frames);
    interval.tokens.assign(frames, 0);
    interval.silence.assign(frames, 1);
    interval.dialog_acts.assign(read.acts.empty() ? 0 : frames * kActs, 0);
    std::size_t last = 0;  // word that was said
    for (std::size_t t = 0; t < frames; ++t) {
        last = at[t].value_or(last);
        if (!read.acts.empty()) interval.dialog_acts[t * kActs + read.acts[last]] = 1;
        if (!at[t]) continue;
        interval.tokens[t] = encoder.token(interval.words[last].text);
        interval.silence[t] = 0;
    }
    return interval;
}

}  // namespace chironomia
