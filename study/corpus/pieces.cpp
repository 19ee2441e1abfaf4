#include "study/corpus/pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace chironomia::study {
namespace {

constexpr double kTimeSlack = 1e-6;  // of decimal fractions [s]

// Words [first, last).
struct WordRun {
    std::size_t first = 0;
    std::size_t last = 0;
};

class SpeechCutter {
  public:
    SpeechCutter(std::span<const CorpusWord> words, const IntervalLimits& limits)
        : words_(words), limits_(limits) {}

    std::vector<WordRun> run(const WordRun& all) {
        for (std::size_t w = all.first; w < all.last; ++w) {
            if (w == all.first || silence_before(w) > limits_.most_pause_seconds + kTimeSlack)
                stretches_.push_back({w, w});
            stretches_.back().last = w + 1;
        }
        for (const WordRun& stretch : stretches_) shorten(stretch);
        return std::move(runs_);
    }

  private:
    double silence_before(std::size_t word) const { return words_[word].start - words_[word - 1].end; }

    double seconds(const WordRun& run) const { return words_[run.last - 1].end - words_[run.first].start; }

    void shorten(const WordRun& run) {
        const auto cut = seconds(run) > limits_.most_seconds + kTimeSlack ? place_to_cut(run) : std::nullopt;
        if (!cut) return runs_.push_back(run);
        shorten({run.first, *cut});
        shorten({*cut, run.last});
    }

    // The first word of the second part.
    std::optional<std::size_t> place_to_cut(const WordRun& run) const {
        std::optional<std::size_t> best;
        for (std::size_t w = run.first + 1; w < run.last; ++w) {
            const double shorter = std::min(seconds({run.first, w}), seconds({w, run.last}));
            if (shorter >= limits_.least_seconds - kTimeSlack && (!best || is_better(run, w, *best)))
                best = w;
        }
        return best;
    }

    bool is_better(const WordRun& run, std::size_t word, std::size_t than) const {
        const double longer = silence_before(word) - silence_before(than);
        if (std::abs(longer) > kTimeSlack) return longer > 0;
        const double middle = (words_[run.first].start + words_[run.last - 1].end) / 2;
        const auto distance_of = [&](std::size_t w) { return std::abs(words_[w].start - middle); };
        return distance_of(word) < distance_of(than);
    }

    std::span<const CorpusWord> words_;
    const IntervalLimits& limits_;
    std::vector<WordRun> stretches_, runs_;
};

// A word may end a frame behind the range, which is cut to whole frames.
WordRun words_in(std::span<const CorpusWord> words, const TimeRange& range) {
    WordRun run;
    while (run.first < words.size() && words[run.first].start < range.start - kTimeSlack) ++run.first;
    run.last = run.first;
    while (run.last < words.size() && words[run.last].start < range.end - kTimeSlack &&
           words[run.last].end < range.end + 1 / IntervalRecord::kFps)
        ++run.last;
    return run;
}

}  // namespace

std::vector<SpeechPiece> speech_pieces(std::span<const CorpusWord> words, const TimeRange& range,
                                       const IntervalLimits& limits) {
    std::vector<SpeechPiece> pieces;
    for (const WordRun& run : SpeechCutter(words, limits).run(words_in(words, range))) {
        const TimeRange spoken{.start = words[run.first].start, .end = words[run.last - 1].end};
        double before = limits.most_edge_seconds, behind = limits.most_edge_seconds;
        if (run.first > 0) before = std::min(before, (spoken.start - words[run.first - 1].end) / 2);
        if (run.last < words.size()) behind = std::min(behind, (words[run.last].start - spoken.end) / 2);
        pieces.push_back({.first = run.first,
                          .last = run.last,
                          .spoken = spoken,
                          .time = {.start = std::max(range.start, spoken.start - before),
                                   .end = std::min(range.end, spoken.end + behind)}});
    }
    return pieces;
}

}  // namespace chironomia::study
