#include "synth/features/fourier.h"

#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

namespace chironomia {

struct FrameSpectrum::Plan {
    Eigen::FFT<double> transform;
    std::vector<std::complex<double>> bins;  // (length / 2 + 1)
};

FrameSpectrum::FrameSpectrum(const FrameShape& shape)
    : shape_(shape),
      weights_(shape.window),
      weighted_(shape.length),
      frame_(shape.length),
      powers_(shape.length / 2 + 1),
      plan_(std::make_unique<Plan>()) {
    assert(shape.window > 0 && shape.window <= shape.length && shape.length % 4 == 0);
    const double floor = shape.taper == Taper::hann ? 0.5 : 0.54;
    for (std::size_t i = 0; i < shape.window; ++i) {
        const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(shape.window);
        weights_[i] = floor - (1 - floor) * std::cos(turn);
    }
    plan_->transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    plan_->bins.resize(powers_.size());
}

FrameSpectrum::~FrameSpectrum() = default;
FrameSpectrum::FrameSpectrum(FrameSpectrum&&) noexcept = default;
FrameSpectrum& FrameSpectrum::operator=(FrameSpectrum&&) noexcept = default;

std::span<const double> FrameSpectrum::powers(std::span<const double> frame) {
    assert(frame.size() == shape_.length);
    const std::size_t margin = (shape_.length - shape_.window) / 2;
    for (std::size_t i = 0; i < shape_.window; ++i) weighted_[margin + i] = weights_[i] * frame[margin + i];
    plan_->transform.fwd(plan_->bins.data(), weighted_.data(), static_cast<Eigen::Index>(shape_.length));
    for (std::size_t i = 0; i < powers_.size(); ++i) powers_[i] = std::norm(plan_->bins[i]);
    return powers_;
}

std::span<const double> FrameSpectrum::powers_at(std::span<const float> samples, std::ptrdiff_t begin) {
    const auto length = static_cast<std::ptrdiff_t>(samples.size());
    for (std::size_t i = 0; i < frame_.size(); ++i) {
        const std::ptrdiff_t place = begin + static_cast<std::ptrdiff_t>(i);
        frame_[i] = place >= 0 && place < length ? samples[static_cast<std::size_t>(place)] : 0.0;
    }
    return powers(frame_);
}

}  // namespace chironomia
