#include "synth/presence/voice_activity.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

// All numbers are ours, by eye.
constexpr double kShortestPause = 0.25;  // [s]
constexpr double kSteps = 100;           // of the loudness in a second
constexpr double kSmoothing = 0.08;      // time constant of a pass of the filter of the loudness [s]
constexpr double kQuietest = 1e-4;       // root mean square that counts as sound, of a full scale of 1

std::vector<double> levels_of_sound(const Audio& sound) {
    const auto step = static_cast<std::size_t>(sound.rate / kSteps);
    std::vector<double> levels;
    for (std::size_t begin = 0; step > 0 && begin + step <= sound.samples.size(); begin += step) {
        double sum = 0;
        for (std::size_t i = begin; i < begin + step; ++i)
            sum += static_cast<double>(sound.samples[i]) * sound.samples[i];
        levels.push_back(std::sqrt(sum / static_cast<double>(step)));
    }
    return levels;
}

std::vector<double> levels_of_words(const std::vector<SpokenWord>& words) {
    std::vector<double> levels;
    for (const SpokenWord& word : words) {
        levels.resize(std::max(levels.size(), static_cast<std::size_t>(word.start * kSteps)), 0.0);
        levels.resize(std::max(levels.size(), static_cast<std::size_t>(word.end * kSteps)), 1.0);
    }
    return levels;
}

// Scales the 95th percentile of the levels above silence to 1, so that long silences change nothing.
void normalise(std::vector<double>& levels) {
    std::vector<double> heard;
    std::copy_if(levels.begin(), levels.end(), std::back_inserter(heard),
                 [](double v) { return v > kQuietest; });
    if (heard.empty()) return;
    const auto loud = heard.begin() + static_cast<std::ptrdiff_t>(heard.size() * 19 / 20);
    std::nth_element(heard.begin(), loud, heard.end());
    for (double& level : levels) level = std::min(1.0, level / *loud);
}

// Filters forwards and backwards, so that nothing is delayed.
void smooth(std::vector<double>& levels) {
    const double keep = std::exp(-1 / (kSmoothing * kSteps));
    const auto pass = [&](auto begin, auto end) {
        double state = 0;
        for (auto level = begin; level != end; ++level) *level = state = keep * state + (1 - keep) * *level;
    };
    for (int i = 0; i < 2; ++i) {
        pass(levels.begin(), levels.end());
        pass(levels.rbegin(), levels.rend());
    }
}

}  // namespace

std::vector<Phrase> phrases_of(const Speech& speech) {
    std::vector<Phrase> phrases;
    for (const SpokenWord& word : speech.words) {
        if (phrases.empty() || word.start - phrases.back().end >= kShortestPause)
            phrases.push_back({word.start, word.end});
        else
            phrases.back().end = std::max(phrases.back().end, word.end);
    }
    return phrases;
}

bool speaks_at(const std::vector<Phrase>& phrases, double time) {
    const auto after = std::upper_bound(phrases.begin(), phrases.end(), time,
                                        [](double t, const Phrase& phrase) { return t < phrase.start; });
    return after != phrases.begin() && time < std::prev(after)->end;
}

VoiceLevel::VoiceLevel(const Speech& speech)
    : levels_(speech.audio.samples.empty() ? levels_of_words(speech.words) : levels_of_sound(speech.audio)) {
    normalise(levels_);
    // The filter needs room to fade at the end.
    levels_.insert(levels_.end(), static_cast<std::size_t>(kSteps), 0.0);
    smooth(levels_);
}

double VoiceLevel::at(double time) const {
    const double place = time * kSteps;
    if (place < 0 || place >= static_cast<double>(levels_.size() - 1)) return 0;
    const auto before = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(before);
    return levels_[before] + share * (levels_[before + 1] - levels_[before]);
}

}  // namespace chironomia
