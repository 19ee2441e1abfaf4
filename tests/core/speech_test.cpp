#include "core/speech.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

Speech two_words() {
    Speech speech;
    speech.words = {{.text = "quite", .start = 0.1, .end = 0.4}, {.text = "well", .start = 0.5, .end = 0.9}};
    return speech;
}

TEST(TimeOf, CountsFromAWordOrFromTheStart) {
    EXPECT_DOUBLE_EQ(time_of({.word = 1, .offset = 0.25}, two_words()), 0.75);
    EXPECT_DOUBLE_EQ(time_of({.word = {}, .offset = 0.25}, two_words()), 0.25);
}

TEST(TimeOf, TakesTheNumberOfWordsForTheEndOfTheLast) {
    EXPECT_DOUBLE_EQ(time_of({.word = 2, .offset = 0}, two_words()), 0.9);
    EXPECT_DOUBLE_EQ(time_of({.word = 0, .offset = 0.5}, {}), 0.5);
}

TEST(NameOf, SpellsMarksAsTheMarkupDoes) {
    EXPECT_EQ(name_of(MarkKind::theme), "theme");
    EXPECT_EQ(name_of(MarkKind::belief_relation), "belief-relation");
    EXPECT_EQ(name_of(MarkKind::gesture), "gesture");
}

}  // namespace
}  // namespace chironomia
