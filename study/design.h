// Which comparisons a study shows, which condition stands on which side, and in which orders the pages come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace chironomia {

// One page: two conditions of one clip.
struct Comparison {
    std::size_t clip = 0;
    std::size_t left = 0;  // condition
    std::size_t right = 0;

    bool operator==(const Comparison&) const = default;
};

// What one participant sees, from first to last.
struct PageOrder {
    std::vector<std::size_t> pages;  // (P) indices into Design::pages, each once
    bool swapped = false;            // left and right of every page change places

    bool operator==(const PageOrder&) const = default;
};

struct Design {
    std::vector<Comparison> pages;  // (P) in a shuffled sequence that says nothing about the clips
    std::vector<PageOrder> orders;  // participant n takes order n modulo their number
};

struct DesignShape {
    std::size_t clips = 1;
    std::size_t conditions = 2;              // every pair of them is compared on every clip
    bool may_swap = true;                    // false: the sides are fixed, because both share one video
    std::optional<std::size_t> orders = {};  // none: full_orders(), at most kMostOrders
};

inline constexpr std::size_t kMostOrders = 64;

// Clips times pairs of conditions.
std::size_t count_pages(const DesignShape& shape);

// How many orders it takes until every page stood equally often at every position and after every other page:
// Williams, "Experimental designs balanced for the estimation of residual effects of treatments", 1949: P
// orders for an even number of pages, 2 P for an odd one; twice as many when each is also shown with swapped
// sides.
std::size_t full_orders(const DesignShape& shape);

// The same shape and seed give the same design.
//   Sides: within one order each pair of conditions has its first condition on the left in half of the clips,
//   to within one; each condition of a clip stands on the left in half of its pages, to within one. Over all
//   orders each page is shown either way equally often, to within one, when sides may swap. Orders: rows of
//   Williams' design, as far apart as their number allows, so that the mean position of every page is near
//   the middle even when only some rows are used.
Design draw_design(const DesignShape& shape, std::uint64_t seed);

// How often either condition of a pair stands on the left.
struct SideBalance {
    std::size_t first = 0;  // condition
    std::size_t second = 0;
    std::size_t first_left = 0;  // pages as listed in Design::pages
    std::size_t second_left = 0;
    std::size_t first_left_over_orders = 0;  // pages of all orders
    std::size_t second_left_over_orders = 0;
};

// One entry for each pair of conditions, counted from the design itself.
std::vector<SideBalance> count_sides(const Design& design, std::size_t conditions);

// The fewest and most times a page stands at a position, over all pages and positions.
struct PositionBalance {
    std::size_t least = 0;
    std::size_t most = 0;
};
PositionBalance count_positions(const Design& design);

}  // namespace chironomia
