#include "synth/presence/breathing.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

// All numbers are ours, by eye. A depth of 1 is that of a usual quiet breath.
struct BreathParameters {
    double period = 60.0 / 14;  // of quiet breathing [s]
    double inhaling = 0.42;     // share of a quiet breath
    DrawRange quiet_depth{0.8, 1.1};
    DrawRange period_variation{0.85, 1.15};        // factor
    double longest_inhale = 0.65;                  // before speaking [s]
    double full_inhale = 0.3;                      // time for a breath of full depth before speaking [s]
    double shallowest = 1.0, deepest = 1.7;        // before speaking
    double depth = 0.95, depth_per_second = 0.12;  // before a phrase, and for each second of it
};
constexpr BreathParameters kBreath;

class Breaths {
  public:
    explicit Breaths(Random random) : random_(random) {
        // At 0 s the person is somewhere within a breath.
        empty_at(-kBreath.period - kBreath.period * random_.uniform());
    }

    double end() const { return knots_.back().time; }
    const std::vector<Knot>& knots() const { return knots_; }

    void quiet(double seconds) {
        const double start = end();
        knots_.push_back({start + kBreath.inhaling * seconds, draw_between(random_, kBreath.quiet_depth)});
        empty_at(start + seconds);
    }

    // As many whole breaths as fit.
    void quiet_until(double time) {
        const double gap = time - end();
        const double count = std::floor(gap / kBreath.period + 0.5);
        for (int i = 0; i < static_cast<int>(count); ++i) quiet(gap / count);
    }

    void quiet_beyond(double time) {
        while (end() < time) quiet(kBreath.period * draw_between(random_, kBreath.period_variation));
    }

    // The longer the phrase, the deeper the breath before it; it is used up at the end.
    void speak(const Phrase& phrase) {
        const double start = std::max(end(), phrase.start - kBreath.longest_inhale);
        if (start > end()) empty_at(start);
        const double depth =
            std::clamp(kBreath.depth + kBreath.depth_per_second * (phrase.end - phrase.start),
                       kBreath.shallowest, kBreath.deepest);
        const double enough = std::clamp((phrase.start - start) / kBreath.full_inhale, 0.0, 1.0);
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
        breaths.quiet_until(phrase.start - kBreath.longest_inhale);
        breaths.speak(phrase);
    }
    breaths.quiet_beyond(times.last());
    Curve curve(times);
    curve.add(breaths.knots());
    return curve;
}

}  // namespace chironomia
