// Spectra of real signals.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace chironomia {

enum class Taper { hann, hamming };  // of the period `window`: the last sample is not the first one again

// How a frame is cut out of a sound.
struct FrameShape {
    std::size_t window = 400;  // samples that are weighted, in the middle of the `length`
    std::size_t length = 512;  // of the transform, a power of two, at least `window`
    Taper taper = Taper::hann;
};

// The discrete Fourier transform of one frame after the other.
class FrameSpectrum {
  public:
    explicit FrameSpectrum(const FrameShape& shape);
    ~FrameSpectrum();
    FrameSpectrum(FrameSpectrum&&) noexcept;
    FrameSpectrum& operator=(FrameSpectrum&&) noexcept;

    const FrameShape& shape() const { return shape_; }

    // (length / 2 + 1) powers |X|^2 of a frame (length) that is weighted here. The view lasts until the next
    // call.
    std::span<const double> powers(std::span<const double> frame);
    // Of the `length` samples from `begin` on, which may lie outside: the sound is silent there.
    std::span<const double> powers_at(std::span<const float> samples, std::ptrdiff_t begin);

  private:
    struct Plan;

    FrameShape shape_;
    std::vector<double> weights_, weighted_, frame_, powers_;
    std::unique_ptr<Plan> plan_;
};

}  // namespace chironomia
