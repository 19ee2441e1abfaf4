#include "raster/embree/ray_samples.h"

#include <bit>

namespace chironomia {
namespace {

std::uint32_t reversed(std::uint32_t bits) {
    bits = __builtin_bswap32(bits);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits >> 4) & 0x0f0f0f0fu);
    bits = ((bits & 0x33333333u) << 2) | ((bits >> 2) & 0x33333333u);
    return ((bits & 0x55555555u) << 1) | ((bits >> 1) & 0x55555555u);
}

// Each bit is flipped or not by a hash of the bits below it: Laine and Karras, "Stratified Sampling for
// Stochastic Transparency", EGSR 2011, with the constants of Vegdahl's improved hash.
std::uint32_t flipped(std::uint32_t bits, std::uint32_t seed) {
    bits ^= bits * 0x3d20adeau;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

// The second dimension of Sobol's sequence: its direction numbers are the rows of Pascal's triangle mod 2.
std::uint32_t second_dimension(std::uint32_t index) {
    std::uint32_t sum = 0;
    for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1) {
        if (index & 1u) sum ^= direction;
    }
    return sum;
}

float unit(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

std::uint32_t mixed(std::uint32_t a, std::uint32_t b) {
    std::uint32_t hash = a * 0x9e3779b9u + b;
    hash = (hash ^ (hash >> 16)) * 0x21f0aaadu;
    hash = (hash ^ (hash >> 15)) * 0x735a2d97u;
    return hash ^ (hash >> 15);
}

SamplePattern::SamplePattern(std::uint32_t count) : mask_(std::bit_ceil(count) - 1) {
    for (std::uint32_t i = 0; i <= mask_; ++i) sobol_.push_back({i, reversed(second_dimension(i))});
}

Vec2 SamplePattern::point(std::uint32_t index, std::uint32_t seed) const {
    // The order within the pattern: the lowest bits of an index decide the first digits of its point, so they
    // are flipped by the higher ones.
    const std::uint32_t shuffled = reversed(flipped(reversed(index), seed)) & mask_;
    const Reversed& point = sobol_[shuffled];
    return {unit(reversed(flipped(point.x, mixed(seed, 1)))),
            unit(reversed(flipped(point.y, mixed(seed, 2))))};
}

}  // namespace chironomia
