// One of the equal parts that a list of work is divided into, so that several processes or machines share it.
#pragma once

#include <cstddef>
#include <vector>

namespace chironomia {

struct Shard {
    std::size_t number = 1;  // from 1 to `count`
    std::size_t count = 1;

    // Pieces are dealt in turn, so that neighbours, which cost alike, fall to different parts.
    bool has(std::size_t piece) const { return piece % count == number - 1; }

    bool operator==(const Shard&) const = default;
};

// The pieces of one part, in their order.
template <typename Piece>
std::vector<Piece> part_of(const std::vector<Piece>& pieces, const Shard& shard) {
    std::vector<Piece> part;
    for (std::size_t i = shard.number - 1; i < pieces.size(); i += shard.count) part.push_back(pieces[i]);
    return part;
}

}  // namespace chironomia
