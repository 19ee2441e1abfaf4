#include "study/design.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "core/random.h"

namespace chironomia {
namespace {

// Streams of one seed, so that a change to one draw leaves the others alone.
enum Stream : std::uint64_t { kClipStream = 1, kConditionStream, kPageStream, kRowStream };

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed, Stream stream) {
    std::vector<std::size_t> items(count);
    std::iota(items.begin(), items.end(), 0u);
    Random random(seed, stream);
    random.shuffle(items);
    return items;
}

// Every pair of places on a circle, turned so that each place is first in half of its pairs, to within one: a
// place comes before the next half of the circle.
std::vector<std::pair<std::size_t, std::size_t>> balanced_pairs(std::size_t places) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < places; ++a) {
        for (std::size_t b = a + 1; b < places; ++b) {
            const bool near = 2 * (b - a) <= places;
            pairs.emplace_back(near ? a : b, near ? b : a);
        }
    }
    return pairs;
}

std::vector<Comparison> draw_pages(const DesignShape& shape, std::uint64_t seed) {
    const auto condition_at = shuffled(shape.conditions, seed, kConditionStream);
    const auto clips = shuffled(shape.clips, seed, kClipStream);
    std::vector<Comparison> pages;
    for (std::size_t i = 0; i < clips.size(); ++i) {
        for (const auto& [before, after] : balanced_pairs(shape.conditions)) {
            Comparison page{.clip = clips[i], .left = condition_at[before], .right = condition_at[after]};
            if (i % 2 == 1) std::swap(page.left, page.right);
            pages.push_back(page);
        }
    }
    Random random(seed, kPageStream);
    random.shuffle(pages);
    return pages;
}

// The first row of Williams' design: 0, 1, P - 1, 2, P - 2, ... The differences of its neighbours are all
// different, so in the rows made by adding 1, 2, ... modulo P every page follows every other equally often.
std::vector<std::size_t> first_row(std::size_t pages) {
    std::vector<std::size_t> row = {0};
    for (std::size_t step = 1; row.size() < pages; ++step) {
        row.push_back(step);
        if (row.size() < pages) row.push_back(pages - step);
    }
    return row;
}

std::size_t count_rows(std::size_t pages) {
    if (pages == 1) return 1;
    return pages % 2 == 0 ? pages : 2 * pages;
}

// Row `number` of Williams' design. An odd number of pages also needs the rows backwards; they alternate.
std::vector<std::size_t> williams_row(std::size_t pages, std::size_t number) {
    std::vector<std::size_t> row = first_row(pages);
    const bool odd = pages % 2 == 1;
    const std::size_t shift = odd ? number / 2 : number;
    for (std::size_t& page : row) page = (page + shift) % pages;
    if (odd && number % 2 == 1) std::reverse(row.begin(), row.end());
    return row;
}

std::vector<PageOrder> draw_orders(const DesignShape& shape, std::uint64_t seed) {
    const std::size_t pages = count_pages(shape);
    const std::size_t wanted = shape.orders.value_or(std::min(full_orders(shape), kMostOrders));
    const std::size_t ways = shape.may_swap ? 2 : 1;
    const std::size_t rows_used = (wanted + ways - 1) / ways;
    const std::size_t rows = count_rows(pages);
    const auto page_named = shuffled(pages, seed, kRowStream);

    std::vector<PageOrder> orders;
    for (std::size_t i = 0; i < wanted; ++i) {
        // Spread the rows evenly over the design; beyond its end, begin again.
        const std::size_t at = i / ways;
        const std::size_t row = rows_used < rows ? at * rows / rows_used : at % rows;
        PageOrder order{.pages = williams_row(pages, row), .swapped = i % ways == 1};
        for (std::size_t& page : order.pages) page = page_named[page];
        orders.push_back(std::move(order));
    }
    return orders;
}

}  // namespace

std::size_t count_pages(const DesignShape& shape) {
    return shape.clips * shape.conditions * (shape.conditions - 1) / 2;
}

std::size_t full_orders(const DesignShape& shape) {
    return count_rows(count_pages(shape)) * (shape.may_swap ? 2 : 1);
}

Design draw_design(const DesignShape& shape, std::uint64_t seed) {
    assert(shape.clips >= 1 && shape.conditions >= 2 && shape.orders.value_or(1) >= 1);
    return {.pages = draw_pages(shape, seed), .orders = draw_orders(shape, seed)};
}

std::vector<SideBalance> count_sides(const Design& design, std::size_t conditions) {
    std::vector<SideBalance> all;
    for (std::size_t first = 0; first < conditions; ++first) {
        for (std::size_t second = first + 1; second < conditions; ++second) {
            SideBalance balance{.first = first, .second = second};
            for (const Comparison& page : design.pages) {
                balance.first_left += page.left == first && page.right == second;
                balance.second_left += page.left == second && page.right == first;
            }
            for (const PageOrder& order : design.orders) {
                for (const std::size_t index : order.pages) {
                    Comparison page = design.pages[index];
                    if (order.swapped) std::swap(page.left, page.right);
                    balance.first_left_over_orders += page.left == first && page.right == second;
                    balance.second_left_over_orders += page.left == second && page.right == first;
                }
            }
            all.push_back(balance);
        }
    }
    return all;
}

PositionBalance count_positions(const Design& design) {
    const std::size_t pages = design.pages.size();
    std::vector<std::size_t> counts(pages * pages);
    for (const PageOrder& order : design.orders) {
        for (std::size_t at = 0; at < order.pages.size(); ++at) ++counts[order.pages[at] * pages + at];
    }
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    return {.least = *least, .most = *most};
}

}  // namespace chironomia
