#include "study/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

namespace chironomia {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

std::size_t difference(std::size_t a, std::size_t b) {
    return a > b ? a - b : b - a;
}

// Shapes from the smallest study to several systems, with even and odd numbers of everything.
const std::vector<DesignShape> kShapes = {
    {.clips = 1, .conditions = 2}, {.clips = 2, .conditions = 2},  {.clips = 5, .conditions = 2},
    {.clips = 3, .conditions = 3}, {.clips = 4, .conditions = 4},  {.clips = 7, .conditions = 5},
    {.clips = 2, .conditions = 6}, {.clips = 60, .conditions = 2},
};

void for_each_draw(const std::function<void(const DesignShape&, const Design&)>& look) {
    for (const DesignShape& shape : kShapes) {
        for (std::uint64_t seed = 0; seed < 25; ++seed) look(shape, draw_design(shape, seed));
    }
}

TEST(DrawDesign, ComparesEveryPairOfConditionsOnEveryClipOnce) {
    for_each_draw([](const DesignShape& shape, const Design& design) {
        std::set<std::tuple<std::size_t, std::size_t, std::size_t>> seen;
        for (const Comparison& page : design.pages) {
            EXPECT_NE(page.left, page.right);
            seen.emplace(page.clip, std::min(page.left, page.right), std::max(page.left, page.right));
        }
        EXPECT_EQ(design.pages.size(), count_pages(shape));
        EXPECT_EQ(seen.size(), count_pages(shape));
    });
}

TEST(DrawDesign, PutsEitherConditionOfAPairOnTheLeftEquallyOftenToWithinOne) {
    for_each_draw([](const DesignShape& shape, const Design& design) {
        for (const SideBalance& pair : count_sides(design, shape.conditions)) {
            EXPECT_EQ(pair.first_left + pair.second_left, shape.clips);
            EXPECT_LE(difference(pair.first_left, pair.second_left), 1u);
        }
    });
}

TEST(DrawDesign, PutsEachConditionOfAClipOnTheLeftEquallyOftenToWithinOne) {
    for_each_draw([](const DesignShape& shape, const Design& design) {
        std::map<std::pair<std::size_t, std::size_t>, int> leaning;  // left less right, by clip and condition
        for (const Comparison& page : design.pages) {
            ++leaning[{page.clip, page.left}];
            --leaning[{page.clip, page.right}];
        }
        for (const auto& [place, more_left] : leaning) EXPECT_LE(std::abs(more_left), 1) << shape.conditions;
    });
}

TEST(DrawDesign, ShowsEachPageEitherWayEquallyOftenOverAllOrders) {
    for_each_draw([](const DesignShape& shape, const Design& design) {
        for (const SideBalance& pair : count_sides(design, shape.conditions)) {
            EXPECT_EQ(pair.first_left_over_orders, pair.second_left_over_orders);
        }
    });
}

TEST(DrawDesign, KeepsTheSidesWhenBothFiguresShareOneVideo) {
    const Design design = draw_design({.clips = 3, .conditions = 2, .may_swap = false}, 1);
    EXPECT_EQ(design.orders.size(), 6u);
    for (const PageOrder& order : design.orders) EXPECT_FALSE(order.swapped);
}

TEST(DrawDesign, ShowsEveryPageOnceInEveryOrder) {
    for_each_draw([](const DesignShape& shape, const Design& design) {
        for (PageOrder order : design.orders) {
            std::sort(order.pages.begin(), order.pages.end());
            ASSERT_EQ(order.pages.size(), count_pages(shape));
            for (std::size_t i = 0; i < order.pages.size(); ++i) EXPECT_EQ(order.pages[i], i);
        }
    });
}

// Williams' property: over the full design each page stands at each position, and follows each other page,
// equally often.
TEST(DrawDesign, IsCompleteWhenAllOrdersAreTaken) {
    for (DesignShape shape : kShapes) {
        shape.orders = full_orders(shape);
        const Design design = draw_design(shape, 3);
        const PositionBalance positions = count_positions(design);
        EXPECT_EQ(positions.least, positions.most) << shape.clips << " " << shape.conditions;

        const std::size_t pages = count_pages(shape);
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> follows;
        for (const PageOrder& order : design.orders) {
            for (std::size_t i = 0; i + 1 < pages; ++i) ++follows[{order.pages[i], order.pages[i + 1]}];
        }
        EXPECT_EQ(follows.size(), pages * (pages - 1));
        for (const auto& [neighbours, count] : follows) EXPECT_EQ(count, *shape.orders / pages);
    }
}

// A page that always came early would be judged by fresh eyes alone.
TEST(DrawDesign, KeepsPagesNearTheMiddleOnAverageWhenFewOrdersAreTaken) {
    for (const std::size_t orders : {4, 8, 16}) {
        const DesignShape shape{.clips = 30, .conditions = 2, .orders = orders};
        const Design design = draw_design(shape, 5);
        std::vector<double> sum(30);
        for (const PageOrder& order : design.orders) {
            for (std::size_t at = 0; at < 30; ++at) sum[order.pages[at]] += static_cast<double>(at);
        }
        for (const double total : sum) EXPECT_NEAR(total / static_cast<double>(orders), 14.5, 1.01) << orders;
    }
}

TEST(DrawDesign, StopsAtTheMostOrdersUnlessMoreAreAskedFor) {
    EXPECT_EQ(draw_design({.clips = 60, .conditions = 2}, 1).orders.size(), kMostOrders);
    EXPECT_EQ(draw_design({.clips = 60, .conditions = 2, .orders = 120}, 1).orders.size(), 120u);
    EXPECT_EQ(draw_design({.clips = 2, .conditions = 2, .orders = 7}, 1).orders.size(), 7u);
}

TEST(DrawDesign, DependsOnTheSeedAlone) {
    const DesignShape shape{.clips = 8, .conditions = 3};
    const Design first = draw_design(shape, 11);
    EXPECT_EQ(draw_design(shape, 11).pages, first.pages);
    EXPECT_EQ(draw_design(shape, 11).orders, first.orders);
    EXPECT_NE(draw_design(shape, 12).pages, first.pages);
}

// Whoever knows how a design is drawn but not its seed must not know who stands on the left.
TEST(DrawDesign, LeavesTheSideOfAClipToChance) {
    int first_left = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        for (const Comparison& page : draw_design({.clips = 3, .conditions = 2}, seed).pages) {
            if (page.clip == 0) first_left += page.left == 0;
        }
    }
    EXPECT_NEAR(first_left, 200, 50);  // 5 standard deviations
}

TEST(CountSides, CountsWhatIsThere) {
    const Design lopsided{
        .pages = {{.clip = 0, .left = 0, .right = 1}, {.clip = 1, .left = 0, .right = 1}},
        .orders = {{.pages = {0, 1}}, {.pages = {0, 1}, .swapped = true}, {.pages = {1, 0}}}};
    const auto sides = count_sides(lopsided, 2);
    ASSERT_EQ(sides.size(), 1u);
    EXPECT_EQ(sides[0].first_left, 2u);
    EXPECT_EQ(sides[0].second_left, 0u);
    EXPECT_EQ(sides[0].first_left_over_orders, 4u);
    EXPECT_EQ(sides[0].second_left_over_orders, 2u);
    EXPECT_EQ(count_positions(lopsided).least, 1u);
    EXPECT_EQ(count_positions(lopsided).most, 2u);
}

}  // namespace
}  // namespace chironomia
