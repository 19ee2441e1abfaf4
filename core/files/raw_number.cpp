#include "core/files/raw_number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace chironomia {
namespace {

float from_half(uint16_t half) {
    const int exponent = (half >> 10) & 31;
    const float fraction = static_cast<float>(half & 1023) / 1024;
    float size = 0;
    if (exponent == 31)
        size = (half & 1023) ? std::nanf("") : INFINITY;
    else if (exponent == 0)
        size = std::ldexp(fraction, -14);
    else
        size = std::ldexp(1 + fraction, exponent - 15);
    return half & 0x8000 ? -size : size;
}

template <typename Number>
double number_at(const std::byte* bytes, bool swapped) {
    std::array<std::byte, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes, sizeof(Number));
    if (swapped) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<Number>(raw));
}

double half_at(const std::byte* bytes, bool swapped) {
    std::array<std::byte, 2> raw = {bytes[0], bytes[1]};
    if (swapped) std::swap(raw[0], raw[1]);
    return static_cast<double>(from_half(std::bit_cast<uint16_t>(raw)));
}

}  // namespace

ReadRawNumber raw_number_reader(std::string_view kind) {
    if (kind == "f2") return half_at;
    if (kind == "f4") return number_at<float>;
    if (kind == "f8") return number_at<double>;
    if (kind == "i1") return number_at<int8_t>;
    if (kind == "i2") return number_at<int16_t>;
    if (kind == "i4") return number_at<int32_t>;
    if (kind == "i8") return number_at<int64_t>;
    if (kind == "u1" || kind == "b1") return number_at<uint8_t>;
    if (kind == "u2") return number_at<uint16_t>;
    if (kind == "u4") return number_at<uint32_t>;
    if (kind == "u8") return number_at<uint64_t>;
    return nullptr;
}

}  // namespace chironomia
