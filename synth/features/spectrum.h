// Spectra of a sound over time: mel bands as the corpora have them, and cepstra.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/audio.h"
#include "synth/features/feature_track.h"

namespace chironomia {

enum class MelScale {
    htk,  // 1127 ln(1 + f / 700), triangles straight in mel (Young et al., "The HTK Book", 3.4, section 5.4)
    slaney,  // linear up to 1 kHz, then logarithmic, triangles straight in Hz (Slaney, "Auditory Toolbox",
             // 1998)
};

struct MelOptions {
    MelScale scale = MelScale::slaney;
    std::size_t bands = 128;
    double lowest = 0;       // where the first triangle begins [Hz]
    double highest = 22050;  // where the last one ends [Hz], at most half the rate
    bool even_area = true;   // each triangle has the area 1 Hz, not the height 1
};

// Triangles over the bins of a spectrum of `length` / 2 + 1 bins at `rate` [Hz].
class MelBank {
  public:
    MelBank(const MelOptions& options, double rate, std::size_t length);

    std::size_t bands() const { return first_.size(); }
    // (bands) of a spectrum (length / 2 + 1), of magnitudes or powers.
    std::vector<double> energies(std::span<const double> spectrum) const;
    // (bins) of one band.
    std::vector<double> weights(std::size_t band) const;

  private:
    std::size_t bins_;
    std::vector<std::size_t> first_;            // (bands) the first bin of each
    std::vector<std::vector<double>> weights_;  // (bands) from there on
};

// The three features of PATS and of openSMILE below are those of the models' corpora. All are mono: the mean
// of all channels.

// PATS's audio/log_mel_400: (Ta, 64) at 100 Hz. 16 kHz, 400 samples of Hann in 512, hop 160, not centred,
// magnitudes, 64 Slaney bands from 125 to 7500 Hz of height 1, natural logarithm; an exact 0 counts as 1e-6.
// Ta = 1 + (N - 512) / 160 for N samples at 16 kHz. Throws Error if the sound is shorter than 512 of them.
FeatureTrack log_mel_400(const Audio& sound);

// PATS's audio/log_mel_512: (Tb, 128) at sound.rate / 512. The sound's own rate, 2048 samples of Hann, hop
// 512, centred with the sound mirrored at both ends, powers, 128 Slaney bands of even area up to half the
// rate, natural logarithm; an exact 0 counts as 1e-10. Tb = 1 + N / 512. Throws Error for under 2 samples.
FeatureTrack log_mel_512(const Audio& sound);

// Both of a sound of any rate, as intervals have them: log_mel_512 is that of the sound at 44.1 kHz.
struct IntervalSpectra {
    std::vector<float> mel_400;  // (Ta, 64)
    std::vector<float> mel_512;  // (Tb, 128)
};
IntervalSpectra interval_spectra(const Audio& sound);

enum class MelResampling {
    stride,   // each 6th row of log_mel_512 and each 7th of log_mel_400, as PATS's loader takes them
    average,  // the mean of the rows that begin within each frame
};

// (frames, C) at 15 Hz of either of both; the last row goes on if there are too few. The strides are those
// of the loader whatever the rate: they come from the constants 89 and 103 Hz in it, not from the sound, so
// that they run ahead of the pose or fall behind it; `average` does not.
FeatureTrack mel_at_15_fps(const FeatureTrack& mel, std::size_t frames, MelResampling way);

// (S, 13) "mfcc_0" to "mfcc_12" at 100 Hz. 16 kHz, scaled to 16-bit integers as HTK has them, pre-emphasis
// 0.97 in each frame, 400 samples of Hamming in 512 about the frame's time, powers, 26 HTK bands from 20 to
// 8000 Hz, natural logarithm of at least 1, DCT-II times sqrt(2 / 26), lifter 22 (Young et al., sections 5.4
// to 5.6). Digital silence gives 0.
FeatureTrack mel_cepstra(const Audio& sound);

// (S) at 100 Hz: the sum of the energies of 26 mel bands to the power 0.3, so that a tone of 1 kHz at full
// scale has 1; with the frames and bands of mel_cepstra, without pre-emphasis. Zwicker's law of loudness.
std::vector<float> loudness_of(const Audio& sound);

}  // namespace chironomia
