// How much smoothing the noise of a track asks for.
#pragma once

#include <span>
#include <vector>

namespace chironomia {

struct Smoothed {
    std::vector<double> samples;  // (T)
    double cutoff = 0;            // the highest that was chosen [Hz]; 0: the track is as it was
};

// Chooses among zero-phase low-passes the one that its track needs.
class NoiseFilter {
  public:
    // fps  of the tracks [1/s]
    static NoiseFilter fixed(double cutoff, double fps);
    // highest  [Hz] of the cutoffs; what a track has above it is taken for noise
    static NoiseFilter judging(double highest, double fps);

    // Filtered at the lowest cutoff that costs the track hardly more error than the best one does. Error is
    // what noise stays and what motion goes, as estimated from the track itself: noise is even over the
    // frequencies, and what is above `highest` tells how much of it there is. A track without noise, or one
    // too short to judge, is filtered at `highest`. After Winter, "Biomechanics and Motor Control of Human
    // Movement", 4th ed., 2009, section 3.4.4.3, residual analysis, with Mallows's criterion in place of the
    // line drawn by eye. Where half a second before and after a sample lets it be smoother it is: a hand that
    // waves in one half of a clip does not tremble in the other.
    Smoothed smooth(std::span<const double> samples) const;

  private:
    struct Cutoff {
        double hertz = 0;
        double kept = 0;   // of even noise, the share that stays in step with itself
        double taken = 0;  // of even noise, the share of its mean square in what the filter takes
    };

    explicit NoiseFilter(double fps) : fps_(fps) {}
    void add(double cutoff);

    double fps_;
    std::vector<Cutoff> cutoffs_;  // from low to high
};

}  // namespace chironomia
