#include "core/shard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Shard, DealsThePiecesInTurn) {
    const std::vector<int> pieces = {10, 11, 12, 13, 14};
    EXPECT_THAT(part_of(pieces, {.number = 1, .count = 2}), ElementsAre(10, 12, 14));
    EXPECT_THAT(part_of(pieces, {.number = 2, .count = 2}), ElementsAre(11, 13));
    EXPECT_THAT(part_of(pieces, {}), ElementsAre(10, 11, 12, 13, 14));
    EXPECT_THAT(part_of(pieces, {.number = 7, .count = 7}), IsEmpty());
}

TEST(Shard, GivesEachPieceToOnePart) {
    for (std::size_t piece = 0; piece < 20; ++piece) {
        std::size_t holders = 0;
        for (std::size_t number = 1; number <= 6; ++number)
            holders += Shard{.number = number, .count = 6}.has(piece);
        EXPECT_EQ(holders, 1u) << piece;
    }
}

}  // namespace
}  // namespace chironomia
