// A low-pass filter that does not delay what it smooths.
#pragma once

#include <span>
#include <vector>

namespace chironomia {

// Butterworth of second order, run forwards and backwards, so that the phase is zero and the fall-off is that
// of the fourth order, 6 dB at `cutoff`. The ends are continued by point reflection.
//   samples  (T)
//   cutoff   [Hz]; nothing is filtered from half the rate on, nor where T is below 3
//   fps      of the samples [1/s], above 0
// Winter, "Biomechanics and Motor Control of Human Movement", 4th ed., 2009, section 3.4.4.2.
std::vector<double> zero_phase_low_pass(std::span<const double> samples, double cutoff, double fps);

// Gain at `frequency`, in [0, 1]; 1 for every frequency if the cutoff is half the rate or above.
double zero_phase_gain(double frequency, double cutoff, double fps);

}  // namespace chironomia
