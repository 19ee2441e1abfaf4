// Seeded randomness that is the same on every machine: std's distributions are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace chironomia {

// PCG32 (O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random
// Number Generation", 2014), XSH-RR output of a 64-bit linear congruential state.
class Random {
  public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0);  // streams of one seed are independent

    std::uint32_t next();                    // all 32 bits uniform
    std::uint32_t below(std::uint32_t end);  // uniform in [0, end), end > 0, without modulo bias
    double uniform();                        // uniform in [0, 1), 53 bits
    double normal();                         // mean 0, standard deviation 1 (Box-Muller)

    // Fisher-Yates.
    template <typename T>
    void shuffle(std::vector<T>& items) {
        for (std::size_t i = items.size(); i > 1; --i) {
            std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
        }
    }

  private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

}  // namespace chironomia
