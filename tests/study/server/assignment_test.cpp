#include "study/server/assignment.h"

#include <gtest/gtest.h>

namespace chironomia::study::server {
namespace {

TEST(Assignment, TakesTheSheetThatFewestHave) {
    EXPECT_EQ(most_needed_sheet(
                  {{.finished = 2, .active = 0}, {.finished = 1, .active = 0}, {.finished = 1, .active = 1}}),
              1u);
}

TEST(Assignment, CountsTheActiveAsMuchAsTheFinished) {
    EXPECT_EQ(most_needed_sheet({{.finished = 0, .active = 3}, {.finished = 2, .active = 0}}), 1u);
}

TEST(Assignment, TakesTheFirstOfSeveral) {
    EXPECT_EQ(most_needed_sheet({{.finished = 1}, {}, {}}), 1u);
}

TEST(Assignment, GivesSheetsInTurn) {
    std::vector<SheetLoad> loads(3);
    std::vector<std::size_t> given;
    for (int i = 0; i < 7; ++i) {
        given.push_back(most_needed_sheet(loads));
        ++loads[given.back()].active;
    }
    EXPECT_EQ(given, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2, 0}));
    EXPECT_EQ(count_taken(loads), 7u);
}

TEST(Assignment, GivesAReturnedSheetFirst) {
    std::vector<SheetLoad> loads(3, {.finished = 0, .active = 2});
    loads[2].active = 1;
    EXPECT_EQ(most_needed_sheet(loads), 2u);
}

}  // namespace
}  // namespace chironomia::study::server
