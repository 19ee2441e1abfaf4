#include "study/measure/lexical.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using Words = std::vector<std::string>;

TEST(LexicalDiversity, CountsDistinctWords) {
    EXPECT_EQ(lexical_diversity(Words{"the", "cat", "the", "dog"}).all, 0.75);
    EXPECT_FALSE(lexical_diversity(Words{"the", "cat"}).windowed);
}

// Windows {a a}, {a b}, and a rest that is shorter.
TEST(LexicalDiversity, AveragesOverWholeWindows) {
    EXPECT_EQ(lexical_diversity(Words{"a", "a", "a", "b", "c"}, 2).windowed, 0.75);
}

TEST(KMeans, FindsGroupsThatLieApart) {
    const std::vector<float> places{0, 0, 10, 10, 0, 1, -20, 5, 11, 10, -20, 7};
    const Clusters found = k_means(places, 2);
    EXPECT_THAT(found.of, ElementsAre(0, 1, 0, 2, 1, 2));
    EXPECT_NEAR(found.inertia, 0.5 + 0.5 + 2, 1e-9);
}

TEST(KMeans, GivesEachOfAsManyVectorsAClusterOfItsOwn) {
    const Clusters found = k_means(std::vector<float>{1, 5, 9}, 1);
    EXPECT_THAT(found.of, ElementsAre(0, 1, 2));
    EXPECT_EQ(found.inertia, 0);
}

TEST(KMeans, KnowsOneCluster) {
    EXPECT_EQ(k_means(std::vector<float>{1, 3}, 1, {.clusters = 1}).inertia, 2);
}

}  // namespace
}  // namespace chironomia::study
