// Numbers that describe a sound, or a face, at an even rate.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

// T frames of C columns. Frame t, column c lies at t * C + c; frame t is at t / rate seconds.
struct FeatureTrack {
    double rate = 100;                 // [Hz]
    std::vector<std::string> columns;  // (C) "f0", "mfcc_3"
    std::vector<float> values;         // (T, C)

    std::size_t width() const { return columns.size(); }                                  // C
    std::size_t frames() const { return columns.empty() ? 0 : values.size() / width(); }  // T
    std::span<const float> at(std::size_t frame) const { return {&values[frame * width()], width()}; }
    std::span<float> at(std::size_t frame) { return {&values[frame * width()], width()}; }
};

}  // namespace chironomia
