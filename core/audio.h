// Sound.
#pragma once

#include <cstddef>
#include <vector>

namespace chironomia {

struct Audio {
    int rate = 48000;  // [Hz]
    int channels = 1;
    std::vector<float> samples;  // (N, channels) in [-1, 1]

    size_t length() const { return samples.size() / static_cast<size_t>(channels); }  // N
    double duration() const { return static_cast<double>(length()) / rate; }          // [s]
};

}  // namespace chironomia
