#include "study/design/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;

// Shapes from the smallest study to several systems, with even and odd numbers of everything. Every
// participant sees all pages.
std::vector<DesignShape> whole_shapes() {
    std::vector<DesignShape> shapes;
    for (const auto& [clips, conditions] : {std::pair<std::size_t, std::size_t>{1, 2},
                                            {2, 2},
                                            {5, 2},
                                            {3, 3},
                                            {4, 4},
                                            {7, 5},
                                            {2, 6},
                                            {60, 2}}) {
        shapes.push_back({.clips = clips, .groups = all_pairs(conditions), .sides = SideRule::mirror});
    }
    shapes.push_back({.clips = 4, .groups = {{0}, {1}, {2}, {3}}});                       // single
    shapes.push_back({.clips = 6, .groups = {{0, 2, 1}}, .sides = SideRule::mirror});     // triplet
    shapes.push_back({.clips = 5, .groups = {{0, 1, 2, 3}}, .sides = SideRule::rotate});  // parallel
    shapes.push_back(
        {.clips = 6, .groups = all_pairs(2), .sides = SideRule::mirror, .block_of_clip = {0, 1, 0, 1, 0, 1}});
    return shapes;
}

// The same where a participant sees only some of them.
std::vector<DesignShape> sampled_shapes() {
    return {{.clips = 6, .groups = all_pairs(3), .sides = SideRule::mirror, .each_clip_once = true},
            {.clips = 7, .groups = {{0}, {1}, {2}, {3}}, .each_clip_once = true},
            {.clips = 10, .groups = all_pairs(4), .sides = SideRule::mirror, .pages_per_sheet = 7},
            {.clips = 9, .groups = all_pairs(2), .sides = SideRule::mirror, .pages_per_sheet = 5},
            {.clips = 9,
             .groups = all_pairs(3),
             .sides = SideRule::mirror,
             .block_of_clip = {0, 0, 0, 1, 1, 1, 2, 2, 2},
             .each_clip_once = true}};
}

using Look = std::function<void(const DesignShape&, const Design&)>;

void for_each_draw(std::vector<DesignShape> shapes, const Look& look) {
    for (DesignShape& shape : shapes) {
        if (shape.each_clip_once || shape.pages_per_sheet) shape.sheets = full_sheets(shape);
        for (std::uint64_t seed = 0; seed < 25; ++seed) look(shape, draw_design(shape, seed));
    }
}

void for_all_draws(const Look& look) {
    for_each_draw(whole_shapes(), look);
    for_each_draw(sampled_shapes(), look);
}

std::set<std::size_t> as_set(const std::vector<std::size_t>& places) {
    return {places.begin(), places.end()};
}

TEST(DrawDesign, ShowsEveryGroupOnEveryClipOnce) {
    for_all_draws([](const DesignShape& shape, const Design& design) {
        std::set<std::pair<std::size_t, std::set<std::size_t>>> seen;
        for (const DesignPage& page : design.pages) seen.emplace(page.clip, as_set(page.places));
        EXPECT_EQ(design.pages.size(), shape.clips * shape.groups.size());
        EXPECT_EQ(seen.size(), design.pages.size());
    });
}

TEST(DrawDesign, ShowsEitherConditionOfAPairOnTheLeftEquallyOftenToWithinOneInEverySheet) {
    for_all_draws([](const DesignShape& shape, const Design& design) {
        if (shape.sides != SideRule::mirror) return;
        std::optional<std::size_t> reference;
        if (shape.groups.front().size() == 3) reference = 2;
        for (const SideBalance& pair : count_sides(design, reference)) {
            EXPECT_LE(pair.worst_sheet, 1u) << shape.clips << " clips, " << shape.groups.size() << " groups";
            EXPECT_LE(pair.worst_page, 1u);
            EXPECT_EQ(pair.first_left, pair.second_left);
        }
    });
}

// Of three places a row and the same backwards have the same one in the middle, and nobody else there.
TEST(DrawDesign, PutsEachConditionAtEachPlaceOfAPageEquallyOftenWherePlacesRotate) {
    std::vector<std::vector<std::size_t>> groups(1);
    for (std::size_t conditions = 2; conditions <= 8; ++conditions) {
        groups[0].resize(conditions);
        std::iota(groups[0].begin(), groups[0].end(), 0u);
        std::size_t most = 0;
        for (std::size_t sheets = 1; sheets <= 2 * conditions; ++sheets) {
            const Design design = draw_design(
                {.clips = 5, .groups = groups, .sides = SideRule::rotate, .sheets = sheets}, sheets);
            for (const std::size_t apart : places_apart(design)) {
                most = std::max(most, apart);
                if (sheets == 2 * conditions) EXPECT_EQ(apart, 0u) << conditions << " conditions";
            }
        }
        EXPECT_EQ(most, place_limit(conditions)) << conditions << " conditions";
    }
}

// Times that each condition stood at each place, over all pages and so many participants who take the sheets in turn.
std::vector<std::size_t> times_at_places(const Design& design, std::size_t participants) {
    const std::size_t places = design.pages.front().places.size();
    std::vector<std::size_t> counts(places * places);
    for (const Sheet& sheet : taken_in_turn(design, participants).sheets) {
        for (const Showing& shown : sheet.pages) {
            for (std::size_t at = 0; at < places; ++at)
                ++counts[design.pages[shown.page].places[shown.order[at]] * places + at];
        }
    }
    return counts;
}

// Everybody sees all pages, and as many orders as pages need would leave conditions at some places more often for ever:
// of four pages with three places 4 orders, where it takes 6 to lead three conditions through their places.
TEST(DrawDesign, PutsEachConditionAtEachPlaceEquallyOftenHoweverManyTakeTheOrders) {
    struct Case {
        std::size_t conditions, clips, blocks, sheets;
    };
    for (const Case& one : {Case{2, 3, 1, 6}, Case{3, 4, 1, 12}, Case{8, 3, 1, 24}, Case{7, 12, 1, 56},
                            Case{6, 80, 1, 60}, Case{3, 5, 2, 12}, Case{7, 10, 5, 70}}) {
        std::vector<std::size_t> all(one.conditions);
        std::iota(all.begin(), all.end(), 0u);
        DesignShape shape{.clips = one.clips, .groups = {all}, .sides = SideRule::rotate};
        if (one.blocks > 1) {
            for (std::size_t i = 0; i < one.clips; ++i) shape.block_of_clip.push_back(i % one.blocks);
        }
        EXPECT_EQ(usual_sheets(shape, std::nullopt), one.sheets) << one.conditions << " of " << one.clips;
        const Design design = draw_design(shape, 3);
        EXPECT_EQ(design.sheets.size(), one.sheets);
        for (const std::size_t apart : places_apart(design)) EXPECT_EQ(apart, 0u);
        for (const std::size_t apart : places_apart(taken_in_turn(design, 401)))
            EXPECT_LE(apart, place_limit(one.conditions));
        const std::vector<std::size_t> times = times_at_places(design, 10 * one.sheets);
        EXPECT_EQ(std::set<std::size_t>(times.begin(), times.end()).size(), 1u) << one.conditions;
    }
}

TEST(DrawDesign, KeepsTheReferenceInTheMiddle) {
    const Design design = draw_design({.clips = 6, .groups = {{0, 2, 1}}, .sides = SideRule::mirror}, 4);
    for (const Sheet& sheet : design.sheets) {
        for (const Showing& shown : sheet.pages)
            EXPECT_EQ(design.pages[shown.page].places[shown.order[1]], 2u);
    }
}

TEST(DrawDesign, PutsEachConditionOfAClipOnTheLeftEquallyOftenToWithinOne) {
    for (const std::size_t conditions : {2, 3, 4, 5, 6}) {
        const Design design =
            draw_design({.clips = 7, .groups = all_pairs(conditions), .sides = SideRule::mirror}, 9);
        std::map<std::pair<std::size_t, std::size_t>, int> leaning;  // left less right, by clip and condition
        for (const DesignPage& page : design.pages) {
            ++leaning[{page.clip, page.places[0]}];
            --leaning[{page.clip, page.places[1]}];
        }
        for (const auto& [place, more_left] : leaning) EXPECT_LE(std::abs(more_left), 1) << conditions;
    }
}

TEST(DrawDesign, LeavesSidesAsListedWhereTheyAreFixed) {
    const Design design = draw_design({.clips = 5, .groups = {{1, 0}, {1, 2}}, .sides = SideRule::fixed}, 2);
    for (const DesignPage& page : design.pages) EXPECT_EQ(page.places[0], 1u);
    for (const Sheet& sheet : design.sheets) {
        for (const Showing& shown : sheet.pages) EXPECT_THAT(shown.order, ElementsAre(0, 1));
    }
}

TEST(DrawDesign, DrawsTheSidesOfSharedVideosButNeverMovesThem) {
    const Design design = draw_design({.clips = 6, .groups = all_pairs(2)}, 1);
    int first_left = 0;
    for (const DesignPage& page : design.pages) first_left += page.places[0] == 0;
    EXPECT_EQ(first_left, 3);
    for (const Sheet& sheet : design.sheets) {
        for (const Showing& shown : sheet.pages) EXPECT_THAT(shown.order, ElementsAre(0, 1));
    }
}

// Over whole rounds each condition stands at each place, and beside each other, equally often.
TEST(DrawDesign, RotatesConditionsThroughAllPlaces) {
    const DesignShape shape{.clips = 4, .groups = {{0, 1, 2, 3}}, .sides = SideRule::rotate, .sheets = 8};
    const Design design = draw_design(shape, 6);
    std::map<std::pair<std::size_t, std::size_t>, int> at_place, follows;
    for (const Sheet& sheet : design.sheets) {
        for (const Showing& shown : sheet.pages) {
            const auto& places = design.pages[shown.page].places;
            for (std::size_t i = 0; i < 4; ++i) {
                ++at_place[{places[shown.order[i]], i}];
                if (i > 0) ++follows[{places[shown.order[i - 1]], places[shown.order[i]]}];
            }
        }
    }
    EXPECT_EQ(at_place.size(), 16u);
    for (const auto& [place, count] : at_place) EXPECT_EQ(count, 8);
    EXPECT_EQ(follows.size(), 12u);
    for (const auto& [pair, count] : follows) EXPECT_EQ(count, 8);
}

TEST(DrawDesign, ShowsEveryPageOfItsBlockOnceInEverySheet) {
    for_each_draw(whole_shapes(), [](const DesignShape& shape, const Design& design) {
        for (const Sheet& sheet : design.sheets) {
            std::set<std::size_t> seen;
            for (const Showing& shown : sheet.pages) {
                EXPECT_TRUE(seen.insert(shown.page).second);
                EXPECT_EQ(design.pages[shown.page].block, sheet.block);
            }
            EXPECT_EQ(seen.size(), count_shown(shape, sheet.block));
        }
    });
}

TEST(DrawDesign, ShowsEachClipOnceAndEachPageEquallyOften) {
    for_each_draw(sampled_shapes(), [](const DesignShape& shape, const Design& design) {
        const CountRange repeats = count_repeats(design);
        EXPECT_EQ(repeats.most, 1u);
        const CountRange showings = count_showings(design);
        EXPECT_GE(showings.least, 1u);
        EXPECT_EQ(showings.least, showings.most) << shape.clips;
    });
}

// A Latin square: each group is seen equally often by every participant.
TEST(DrawDesign, ShowsEachGroupEquallyOftenInASheet) {
    for_each_draw(sampled_shapes(), [](const DesignShape& shape, const Design& design) {
        for (const Sheet& sheet : design.sheets) {
            std::map<std::set<std::size_t>, std::size_t> count;
            for (const auto& group : shape.groups) count[as_set(group)] = 0;
            for (const Showing& shown : sheet.pages) ++count[as_set(design.pages[shown.page].places)];
            std::vector<std::size_t> counts;
            for (const auto& [group, times] : count) counts.push_back(times);
            const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
            const bool prime = std::gcd(shape.clips / count_blocks(shape), shape.groups.size()) == 1;
            EXPECT_LE(*most - *least, prime ? 1u : 2u);
        }
    });
}

TEST(DrawDesign, TakesTheBlocksInTurn) {
    const Design design =
        draw_design({.clips = 4, .groups = {{0}, {1}}, .block_of_clip = {1, 0, 1, 0}, .sheets = 6}, 3);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(design.sheets[i].block, i % 2);
    for (const DesignPage& page : design.pages) EXPECT_EQ(page.block, page.clip % 2 == 0 ? 1u : 0u);
}

// Williams' property: over the full design each page stands at each position, and follows each other page,
// equally often.
TEST(DrawDesign, IsCompleteWhenAllSheetsAreTaken) {
    for (DesignShape shape : whole_shapes()) {
        if (!shape.block_of_clip.empty()) continue;
        shape.sheets = full_sheets(shape);
        const Design design = draw_design(shape, 3);
        const CountRange positions = count_positions(design);
        EXPECT_EQ(positions.least, positions.most) << shape.clips << " " << shape.groups.size();

        const std::size_t pages = design.pages.size();
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> follows;
        for (const Sheet& sheet : design.sheets) {
            for (std::size_t i = 0; i + 1 < pages; ++i)
                ++follows[{sheet.pages[i].page, sheet.pages[i + 1].page}];
        }
        EXPECT_EQ(follows.size(), pages * (pages - 1));
        for (const auto& [neighbours, count] : follows) EXPECT_EQ(count, *shape.sheets / pages);
    }
}

// A page that always came early would be judged by fresh eyes alone.
TEST(DrawDesign, KeepsPagesNearTheMiddleOnAverageWhenFewSheetsAreTaken) {
    for (const std::size_t sheets : {4, 8, 16}) {
        const Design design = draw_design(
            {.clips = 30, .groups = all_pairs(2), .sides = SideRule::mirror, .sheets = sheets}, 5);
        std::vector<double> sum(30);
        for (const Sheet& sheet : design.sheets) {
            for (std::size_t at = 0; at < 30; ++at) sum[sheet.pages[at].page] += static_cast<double>(at);
        }
        for (const double total : sum) EXPECT_NEAR(total / static_cast<double>(sheets), 14.5, 1.01) << sheets;
    }
}

TEST(UsualSheets, AreAsManyAsParticipantsWhereThoseAreFewerThanRows) {
    DesignShape shape{.clips = 12, .groups = {{0}, {1}}};
    EXPECT_EQ(usual_sheets(shape, std::nullopt), 24u);
    EXPECT_EQ(usual_sheets(shape, 10), 10u);
    EXPECT_EQ(usual_sheets(shape, 24), 24u);
    EXPECT_EQ(usual_sheets(shape, 100), 24u);
    shape.block_of_clip = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
    EXPECT_EQ(usual_sheets(shape, 7), 8u) << "as many of either block";
    const DesignShape pairs{.clips = 12, .groups = all_pairs(2), .sides = SideRule::mirror};
    EXPECT_EQ(usual_sheets(pairs, 9), 10u) << "both ways round";
    EXPECT_EQ(usual_sheets(pairs, 23), 24u);
    EXPECT_EQ(usual_sheets({.clips = 60, .groups = all_pairs(2), .sides = SideRule::mirror}, 100), 64u);
    // Four rows of pages, which 7 participants fill; the places take 12.
    EXPECT_EQ(usual_sheets({.clips = 4, .groups = {{0, 1, 2}}, .sides = SideRule::rotate}, 7), 12u);
    EXPECT_EQ(usual_sheets({.clips = 4, .groups = {{0, 1, 2}}, .sides = SideRule::rotate}, 3), 3u);
}

// Of two conditions and five clips, each once: two sets of pages, each at every position.
TEST(DrawDesign, LeadsPagesOfSamplesThroughThePositions) {
    DesignShape shape{.clips = 5, .groups = {{0}, {1}}, .sides = SideRule::fixed, .each_clip_once = true};
    EXPECT_EQ(full_sheets(shape), 20u);
    shape.sheets = full_sheets(shape);
    const CountRange positions = count_positions(draw_design(shape, 3));
    EXPECT_EQ(positions.least, 2u);
    EXPECT_EQ(positions.most, 2u);
    shape.clips = 1500;
    shape.pages_per_sheet = 7;
    EXPECT_EQ(full_sheets(shape), 3000u) << "every page is shown";
}

// Thirty participants who see two of six pages: each page comes ten times, five times first and five times second.
TEST(DrawDesign, PutsThePagesOfSamplesAtEachPositionEquallyOften) {
    for (const SideRule sides : {SideRule::per_page, SideRule::mirror}) {
        const Design design = draw_design(
            {.clips = 6, .groups = all_pairs(2), .sides = sides, .pages_per_sheet = 2, .sheets = 30}, 7);
        EXPECT_EQ(count_positions(design).least, 5u);
        EXPECT_EQ(count_positions(design).most, 5u);
    }
}

// A round: as many sheets as show every page equally often, and either way round where sides are mirrored. After as
// many rounds as it takes to lead a page through all positions, no position goes with a side.
TEST(DrawDesign, PutsThePagesOfSamplesAtEachPositionToWithinOneInEveryRound) {
    for (const SideRule sides : {SideRule::per_page, SideRule::mirror}) {
        for (const auto& [clips, conditions, each] : {std::array<std::size_t, 3>{6, 2, 2},
                                                      {4, 2, 2},
                                                      {3, 2, 2},
                                                      {6, 2, 4},
                                                      {5, 4, 4},
                                                      {3, 3, 3},
                                                      {12, 2, 9},
                                                      {16, 2, 4},
                                                      {5, 3, 5},
                                                      {14, 2, 12}}) {
            DesignShape shape{
                .clips = clips, .groups = all_pairs(conditions), .sides = sides, .pages_per_sheet = each};
            const std::size_t ways = sides == SideRule::mirror ? 2 : 1;
            const std::size_t pages = clips * shape.groups.size(), turns = std::gcd(pages, each);
            for (std::size_t rounds = 1; rounds <= 2 * turns + 1; ++rounds) {
                shape.sheets = rounds * ways * pages / turns;
                const Design design = draw_design(shape, rounds);
                const CountRange positions = count_positions(design);
                EXPECT_LE(positions.most - positions.least, 1u) << pages << " " << each << " " << rounds;
                if (rounds % turns != 0) continue;
                std::map<std::array<std::size_t, 3>, std::size_t> counts;
                for (const Sheet& sheet : design.sheets) {
                    for (std::size_t at = 0; at < each; ++at)
                        ++counts[{sheet.pages[at].page, at, sheet.pages[at].order.front()}];
                }
                EXPECT_EQ(counts.size(), pages * each * ways) << pages << " " << each << " " << rounds;
                for (const auto& [of, count] : counts) EXPECT_EQ(count, rounds / turns);
            }
        }
    }
}

TEST(DrawDesign, StopsAtTheMostSheetsUnlessMoreAreAskedFor) {
    const DesignShape shape{.clips = 60, .groups = all_pairs(2), .sides = SideRule::mirror};
    EXPECT_EQ(full_sheets(shape), 120u);
    EXPECT_EQ(draw_design(shape, 1).sheets.size(), kMostSheets);
    DesignShape more = shape;
    more.sheets = 120;
    EXPECT_EQ(draw_design(more, 1).sheets.size(), 120u);
    more.sheets = 7;
    EXPECT_EQ(draw_design(more, 1).sheets.size(), 7u);
}

TEST(DrawDesign, DependsOnTheSeedAlone) {
    const DesignShape shape{.clips = 8, .groups = all_pairs(3), .sides = SideRule::mirror};
    const Design first = draw_design(shape, 11);
    EXPECT_EQ(draw_design(shape, 11).pages, first.pages);
    EXPECT_EQ(draw_design(shape, 11).sheets, first.sheets);
    EXPECT_NE(draw_design(shape, 12).pages, first.pages);
}

// The way in which designs are drawn must not reveal who stands on the left to anybody without the seed.
TEST(DrawDesign, LeavesTheSideOfAClipToChance) {
    for (const std::size_t clips : {1, 3}) {
        int first_left = 0;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            const Design design =
                draw_design({.clips = clips, .groups = all_pairs(2), .sides = SideRule::mirror}, seed);
            for (const DesignPage& page : design.pages) {
                if (page.clip == 0) first_left += page.places[0] == 0;
            }
        }
        EXPECT_NEAR(first_left, 200, 50) << clips;  // 5 standard deviations
    }
}

TEST(AllPairs, PutsEachConditionFirstInHalfOfItsPairs) {
    EXPECT_THAT(all_pairs(2), ElementsAre(ElementsAre(0, 1)));
    EXPECT_THAT(all_pairs(3), ElementsAre(ElementsAre(0, 1), ElementsAre(2, 0), ElementsAre(1, 2)));
}

TEST(CountSides, CountsWhatIsThere) {
    const Design asymmetric{.pages = {{.clip = 0, .places = {0, 1}}, {.clip = 1, .places = {0, 1}}},
                            .sheets = {{.pages = {{0, {0, 1}}, {1, {0, 1}}}},
                                       {.pages = {{0, {1, 0}}, {1, {1, 0}}}},
                                       {.pages = {{1, {0, 1}}, {0, {0, 1}}}}}};
    const auto sides = count_sides(asymmetric);
    ASSERT_EQ(sides.size(), 1u);
    EXPECT_EQ(sides[0].first_left, 4u);
    EXPECT_EQ(sides[0].second_left, 2u);
    EXPECT_EQ(sides[0].worst_sheet, 2u);
    EXPECT_EQ(sides[0].worst_page, 1u);
    EXPECT_EQ(count_positions(asymmetric).least, 1u);
    EXPECT_EQ(count_positions(asymmetric).most, 2u);
    EXPECT_EQ(count_showings(asymmetric).most, 3u);
    EXPECT_EQ(count_repeats(asymmetric).most, 1u);
}

}  // namespace
}  // namespace chironomia::study
