// Exponentials of many numbers at once, in a form that compilers turn into vector instructions.
#pragma once

#include <bit>
#include <cstdint>

namespace chironomia {

// e^x within 3e-7 of itself; x is held in [-87, 87]. 2^n e^r with n the nearest whole number of x / ln 2, and
// e^r by its series about 0 to the sixth power, |r| <= ln 2 / 2.
inline float fast_exp(float x) {
    constexpr float kLog2E = 1.44269504f, kLn2High = 0.693359375f, kLn2Low = -2.12194440e-4f;
    constexpr float kRound = 12582912.0f;  // 1.5 * 2^23: what is added to it loses its fraction
    x = x < -87.0f ? -87.0f : x;
    x = x > 87.0f ? 87.0f : x;
    const float n = (x * kLog2E + kRound) - kRound;
    const float r = (x - n * kLn2High) - n * kLn2Low;
    const float series =
        1 + r * (1 + r * (1.0f / 2 + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
    return series * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

inline float fast_sigmoid(float x) {
    return 1 / (1 + fast_exp(-x));
}

inline float fast_tanh(float x) {
    return 2 / (1 + fast_exp(-2 * x)) - 1;
}

}  // namespace chironomia
