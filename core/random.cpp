#include "core/random.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

namespace chironomia {

Random::Random(std::uint64_t seed, std::uint64_t stream) : increment_((stream << 1) | 1) {
    next();
    state_ += seed;
    next();
}

std::uint32_t Random::next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    return std::rotr(mixed, static_cast<int>(old >> 59));
}

std::uint32_t Random::below(std::uint32_t end) {
    assert(end > 0);
    // The lowest 2^32 mod end values would make small results likelier; draw again.
    const std::uint32_t threshold = (0u - end) % end;
    for (;;) {
        const std::uint32_t drawn = next();
        if (drawn >= threshold) return drawn % end;
    }
}

double Random::uniform() {
    const std::uint64_t high = next() >> 5;
    const std::uint64_t low = next() >> 6;
    return static_cast<double>((high << 26) | low) * 0x1p-53;
}

double Random::normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace chironomia
