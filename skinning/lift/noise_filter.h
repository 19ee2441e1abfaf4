// A low-pass whose cutoff is chosen by the noise of each track.
#pragma once

#include <span>
#include <vector>

namespace chironomia {

struct Smoothed {
    std::vector<double> samples;  // (T)
    double cutoff = 0;            // the highest that was chosen [Hz]; 0: the track is as it was
};

// Chooses one of several zero-phase low-passes for each track.
class NoiseFilter {
  public:
    // fps  of the tracks [1/s]
    static NoiseFilter fixed(double cutoff, double fps);
    // highest  of the cutoffs [Hz]; everything above it counts as noise
    static NoiseFilter adaptive(double highest, double fps);

    // Filters at the lowest cutoff whose error is hardly above the least one. The error is the noise that stays plus
    // the motion that is lost, both estimated from the track: noise is white, and the power above `highest` gives its
    // level. A track without noise, or one too short to judge, is filtered at `highest`. After Winter, "Biomechanics
    // and Motor Control of Human Movement", 4th ed., 2009, section 3.4.4.3, residual analysis, with Mallows's
    // criterion in place of the line drawn by eye. Where the half second before and after a sample allows a lower
    // cutoff, the sample gets it: a hand that waves in one half of a clip does not tremble in the other.
    Smoothed smooth(std::span<const double> samples) const;

  private:
    struct Cutoff {
        double hertz = 0;
        double signal_gain = 0;  // mean gain over the spectrum
        // Mean square of (1 - gain): the share of white noise's power that the filter removes.
        double removed_noise = 0;
    };

    explicit NoiseFilter(double fps) : fps_(fps) {}
    void add(double cutoff);

    double fps_;
    std::vector<Cutoff> cutoffs_;  // from low to high
};

}  // namespace chironomia
