// What each letter of the International Phonetic Alphabet looks like at the mouth.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace chironomia {

// The parts of a mouth that move with speech, and the action unit of each.
enum class MouthPart { lips, jaw, pucker, funnel, stretch, bite, upper_lip, tongue };

inline constexpr std::size_t kMouthParts = 8;
inline constexpr std::array<int, kMouthParts> kMouthUnits = {25, 26, 18, 22, 20, 28, 10, 19};

struct MouthShape {
    std::array<double, kMouthParts> wanted{};  // intensities in [0, 5], in the order of MouthPart
    double opening = 1;                        // dominance over lips, jaw, bite and tongue
    double rounding = 1;                       // dominance over pucker, funnel and stretch
    double shut = 0;                           // share of its time in which the lips stop the breath

    double& operator[](MouthPart part) { return wanted[static_cast<std::size_t>(part)]; }
};

// The shapes of a phoneme's letters, one after the other: two for "aʊ" and for "pf", one for "ɑː".
std::vector<MouthShape> shapes_of(std::string_view symbol);

}  // namespace chironomia
