#include "synth/presence/breathing.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr double kPeriod = 60.0 / 14;    // of quiet breathing [s]
constexpr double kInhaling = 0.42;       // share of a quiet breath
constexpr double kLongestInhale = 0.65;  // before speaking [s]
constexpr double kDeepest = 1.7;

class Breaths {
  public:
    explicit Breaths(Random random) : random_(random) {
        // In the middle of some breath when the clock begins.
        empty_at(-kPeriod - kPeriod * random_.uniform());
    }

    double end() const { return knots_.back().time; }
    const std::vector<Knot>& knots() const { return knots_; }

    void quiet(double seconds) {
        const double start = end();
        knots_.push_back({start + kInhaling * seconds, draw_between(random_, 0.8, 1.1)});
        empty_at(start + seconds);
    }

    // As many whole breaths as fit.
    void quiet_until(double time) {
        const double gap = time - end();
        const double count = std::floor(gap / kPeriod + 0.5);
        for (int i = 0; i < static_cast<int>(count); ++i) quiet(gap / count);
    }

    void quiet_beyond(double time) {
        while (end() < time) quiet(kPeriod * draw_between(random_, 0.85, 1.15));
    }

    // The longer the phrase, the deeper the breath before it; it is used up at the end.
    void speak(const Phrase& phrase) {
        const double start = std::max(end(), phrase.start - kLongestInhale);
        if (start > end()) empty_at(start);
        const double depth = std::clamp(0.95 + 0.12 * (phrase.end - phrase.start), 1.0, kDeepest);
        const double enough = std::clamp((phrase.start - start) / 0.3, 0.0, 1.0);
        if (enough > 0) knots_.push_back({phrase.start, depth * enough});
        if (phrase.end > end()) empty_at(phrase.end);
    }

  private:
    void empty_at(double time) { knots_.push_back({time, 0}); }

    Random random_;
    std::vector<Knot> knots_;
};

}  // namespace

Curve breathe(const std::vector<Phrase>& phrases, const FrameTimes& times, Random random) {
    Breaths breaths(random);
    for (const Phrase& phrase : phrases) {
        breaths.quiet_until(phrase.start - kLongestInhale);
        breaths.speak(phrase);
    }
    breaths.quiet_beyond(times.last());
    Curve curve(times);
    curve.add(breaths.knots());
    return curve;
}

}  // namespace chironomia
