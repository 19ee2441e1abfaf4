// Which conditions are shown together, who stands where, and what each participant sees in which order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace chironomia::study {

// One page: conditions of one clip.
struct DesignPage {
    std::size_t clip = 0;
    std::vector<std::size_t> places;  // conditions from left to right, before a sheet moves them
    std::size_t block = 0;

    bool operator==(const DesignPage&) const = default;
};

// A page as one participant sees it.
struct Showing {
    std::size_t page = 0;
    std::vector<std::size_t> order;  // indices into the page's places, from left to right as shown

    bool operator==(const Showing&) const = default;
};

// What one participant sees, from first to last.
struct Sheet {
    std::size_t block = 0;
    std::vector<Showing> pages;  // no page twice

    bool operator==(const Sheet&) const = default;
};

struct Design {
    std::vector<DesignPage> pages;  // (P)
    std::vector<Sheet> sheets;      // each participant gets one of them
};

// How the conditions of a page get their places.
enum class SideRule {
    fixed,     // as the groups are listed, on every page
    per_page,  // drawn for each page, the same on all sheets: of one place, or of places in one video
    mirror,    // as per_page, and every other sheet swaps left and right; the middle of three stays
    rotate,    // any place: rows of Williams' design, so that each condition stands at each place and beside
               // each other equally often
};

// As the key of a study has them: "fixed", "none" (per_page: no sheet changes them), "mirror", "rotate".
const char* to_text(SideRule sides);

struct DesignShape {
    std::size_t clips = 1;
    std::vector<std::vector<std::size_t>> groups;  // (K) conditions shown together; each group with each clip
    SideRule sides = SideRule::per_page;
    std::vector<std::size_t> block_of_clip = {};      // empty: one block
    bool each_clip_once = false;                      // a sheet shows one of the groups of each clip
    std::optional<std::size_t> pages_per_sheet = {};  // none: all of the block, or one of each clip
    std::optional<std::size_t> sheets = {};           // none: usual_sheets()
};

inline constexpr std::size_t kMostSheets = 64;

// Every pair of `conditions`, turned so that each stands first in half of its pairs, to within one.
std::vector<std::vector<std::size_t>> all_pairs(std::size_t conditions);

std::size_t count_blocks(const DesignShape& shape);

// How many pages a sheet of that block shows.
std::size_t count_shown(const DesignShape& shape, std::size_t block);

// How many sheets it takes until everything is balanced: where a sheet shows all pages of its block,
// Williams, "Experimental designs balanced for the estimation of residual effects of treatments", 1949 (P
// orders for an even number of pages, 2 P for an odd one), and where places rotate so many times that, as it takes to
// lead the conditions through the places, too; else until every page was shown equally often, and then so
// many times that, up to kMostSheets, as it takes to lead pages through the positions. Twice as many where sides are
// mirrored.
std::size_t full_sheets(const DesignShape& shape);

// The same, but at most kMostSheets. Where places rotate, as many as give each condition of a page each place equally
// often, in every block; with many blocks that may be more than kMostSheets. Of fewer `participants` than rows of a
// design of all pages, a sheet for each of them, rounded up to whole blocks and both ways round, so that the rows that
// they see are as far apart as can be.
std::size_t usual_sheets(const DesignShape& shape, std::optional<std::size_t> participants);

// The same shape and seed give the same design.
//
// Sides: within a sheet each group is shown either way equally often, to within one, and so is each page over
// all sheets (to within one for each block). Where each clip is shown with all pairs, each condition stands first in
// half of its pages. Where places rotate, a sheet may lean to one side; over all sheets each condition of a page stands
// at each place equally often, to within place_limit().
//
// Pages: every page is shown equally often, to within one for each block. With `each_clip_once`, or where a
// sheet shows no more pages than there are clips, no sheet shows a clip twice (a Latin square of clips and
// groups), and each group is shown equally often within a sheet: to within one where the numbers of clips and
// groups have no common divisor, else to within two.
//
// Orders: rows of Williams' design, as far apart as their number allows. Where a sheet shows some of the pages, each
// page stands at each position equally often, to within one for each block, over every round of sheets that show every
// page equally often (and either way round, where sides are mirrored).
Design draw_design(const DesignShape& shape, std::uint64_t seed);

// How often either of two conditions of the same pages stands further left.
struct SideBalance {
    std::size_t first = 0;  // condition
    std::size_t second = 0;
    std::size_t first_left = 0;  // over all sheets
    std::size_t second_left = 0;
    std::size_t worst_page = 0;   // the largest difference for one page over all sheets of its block
    std::size_t worst_sheet = 0;  // the largest difference within one sheet
};

// One entry for each pair of conditions that any page shows together, counted from the design itself.
// `without` is left out, such as the reference in the middle.
std::vector<SideBalance> count_sides(const Design& design, std::optional<std::size_t> without = {});

// For each page: how often a condition stands at a place over all sheets, the most less the fewest times.
std::vector<std::size_t> places_apart(const Design& design);

// The sheets that so many participants see who take them in turn.
Design taken_in_turn(const Design& design, std::size_t participants);

// The most of places_apart() that rotating leaves. Sheets take the rows of Williams' design in turn: each condition
// has each place once in as many rows as there are places; with an odd number of places, twice in twice as many rows.
std::size_t place_limit(std::size_t places);

// The fewest and the most of something, over all of its kind.
struct CountRange {
    std::size_t least = 0;
    std::size_t most = 0;
};
CountRange count_showings(const Design& design);  // times that a page is shown, over all sheets
// Times that a page stands at a position of the sheets, over all pages and positions of sheets as long as the
// longest.
CountRange count_positions(const Design& design);
// Times that one sheet shows a clip, over the clips that it shows.
CountRange count_repeats(const Design& design);

}  // namespace chironomia::study
