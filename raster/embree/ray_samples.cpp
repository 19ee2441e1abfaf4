#include "raster/embree/ray_samples.h"

#include <bit>

namespace chironomia {
namespace {

std::uint32_t reversed(std::uint32_t bits) {
    bits = (bits >> 16) | (bits << 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits >> 8) & 0x00ff00ffu);
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
    return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
}

// The order within the pattern: the lowest bits of an index decide the first digits of its point, so they are flipped
// by the higher ones.
std::uint32_t shuffled(std::uint32_t index, std::uint32_t seed) {
    return reversed(flipped(reversed(index), seed));
}

float scrambled(std::uint32_t digits, std::uint32_t seed) {
    return unit(reversed(flipped(digits, seed)));
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
    const Reversed& point = sobol_[shuffled(index, seed) & mask_];
    return {scrambled(point.x, mixed(seed, 1)), scrambled(point.y, mixed(seed, 2))};
}

LanePlaces SamplePattern::points(const Lanes<std::uint32_t>& indices,
                                 const Lanes<std::uint32_t>& seeds) const {
    Lanes<std::uint32_t> order, x, y;
    for (size_t i = 0; i < kLanes; ++i) order[i] = shuffled(indices[i], seeds[i]) & mask_;
    for (size_t i = 0; i < kLanes; ++i) {
        x[i] = sobol_[order[i]].x;
        y[i] = sobol_[order[i]].y;
    }
    LanePlaces places;
    for (size_t i = 0; i < kLanes; ++i) places.x[i] = scrambled(x[i], mixed(seeds[i], 1));
    for (size_t i = 0; i < kLanes; ++i) places.y[i] = scrambled(y[i], mixed(seeds[i], 2));
    return places;
}

}  // namespace chironomia
