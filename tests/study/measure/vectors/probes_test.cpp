#include "study/measure/vectors/probes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "study/measure/distributions.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using Labels = std::vector<std::size_t>;

// Every second vector judges.
ProbeSplit halves(std::size_t n) {
    ProbeSplit split;
    for (std::size_t i = 0; i < n; ++i) (i % 2 == 0 ? split.train : split.test).push_back(i);
    return split;
}

Vectors noise(std::size_t n, std::size_t width, std::uint64_t seed = 1) {
    Random random(seed);
    Vectors vectors{.width = width};
    for (std::size_t i = 0; i < n * width; ++i) vectors.values.push_back(random.normal());
    return vectors;
}

Labels random_labels(std::size_t n, std::uint32_t choices) {
    Random random(2);
    Labels labels;
    for (std::size_t i = 0; i < n; ++i) labels.push_back(random.below(choices));
    return labels;
}

TEST(ProbeLabels, FindsWhatALineDivides) {
    const Labels labels = random_labels(120, 3);
    Vectors vectors = noise(120, 8);
    for (std::size_t i = 0; i < labels.size(); ++i) vectors.values[i * 8 + labels[i]] += 12;
    const LabelProbe probe = probe_labels(vectors, labels, halves(120));
    EXPECT_EQ(probe.n, 60u);
    EXPECT_EQ(probe.right, 60u);
    EXPECT_EQ(probe.accuracy, 1);
    EXPECT_EQ(probe.answers[0], labels[1]);
    EXPECT_GT(probe.accuracy_95.low, 0.9);
}

// More dimensions than vectors take the other way through the algebra.
TEST(ProbeLabels, FindsItInWideVectors) {
    const Labels labels = random_labels(40, 2);
    Vectors vectors = noise(40, 100);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        for (std::size_t d = 0; d < 20; ++d) vectors.values[i * 100 + d] += labels[i] == 1 ? 5 : -5;
    }
    EXPECT_EQ(probe_labels(vectors, labels, halves(40)).accuracy, 1);
}

// Of 500 guesses with a chance of 1/4, what 99.9 % of guessers stay within.
TEST(ProbeLabels, GuessesWhereVectorsSayNothing) {
    const LabelProbe probe = probe_labels(noise(1000, 10), random_labels(1000, 4), halves(1000));
    EXPECT_GT(binomial_at_most(probe.right, 500, 0.25), 0.0005);
    EXPECT_GT(1 - binomial_at_most(probe.right - 1, 500, 0.25), 0.0005);
    EXPECT_NEAR(probe.chance, 0.25, 0.06);
}

TEST(ProbeLabels, KnowsWhatOneAnswerGetsRight) {
    const Labels labels = {7, 7, 8, 7, 8, 8, 7, 7};
    const LabelProbe probe = probe_labels(noise(8, 2), labels, halves(8));
    EXPECT_EQ(probe.chance, 0.75);
}

TEST(ProbeLabels, DoesNotKnowTheUnitOfADimension) {
    const Labels labels = random_labels(60, 3);
    const Vectors vectors = noise(60, 5);
    Vectors other = vectors;
    for (std::size_t i = 0; i < 60; ++i) other.values[i * 5] = 1000 * other.values[i * 5] + 77;
    EXPECT_EQ(probe_labels(vectors, labels, halves(60)).answers,
              probe_labels(other, labels, halves(60)).answers);
}

TEST(ProbeLabels, LeavesOutDimensionsThatDoNotVaryInTraining) {
    const Labels labels = random_labels(60, 2);
    Vectors vectors{.width = 2};
    Random random(4);
    for (std::size_t i = 0; i < 60; ++i) {
        vectors.values.push_back((labels[i] == 1 ? 5 : -5) + random.normal());
        vectors.values.push_back(i % 2 == 0 ? 0.1 : 1000 * random.normal());
    }
    EXPECT_EQ(probe_labels(vectors, labels, halves(60)).accuracy, 1);
}

TEST(ProbeLabels, NeedsTwoLabelsToLearn) {
    EXPECT_EQ(testing::refusal_of([] {
                  probe_labels(noise(4, 1), Labels{0, 1, 0, 1}, {.train = {0, 2}, .test = {1}});
              }),
              "probe: all training vectors have one label, at least two are needed; split them otherwise");
}

// 0 and 1 are near each other, and so are 10, 11 and 12; the last is one of the wrong label.
TEST(NeighbourAccuracy, CountsVotesOfTheNearest) {
    const Vectors vectors{.width = 1, .values = {0, 1, 10, 11, 12, 11.5}};
    const Labels labels = {0, 0, 1, 1, 1, 0};
    const Labels alone = {0, 1, 2, 3, 4, 5};
    EXPECT_EQ(neighbour_accuracy(vectors, labels, alone, 1), 3.0 / 6);
    EXPECT_EQ(neighbour_accuracy(vectors, labels, alone, 3), 3.0 / 6);
}

// Pairs of one group lie beside each other; of others 0 and 1 are near 10 alone, 10 and 11 near 1, 20 and 21 near 11.
TEST(NeighbourAccuracy, AsksOtherGroupsAlone) {
    const Vectors vectors{.width = 1, .values = {0, 1, 10, 11, 20, 21}};
    const Labels groups = {5, 5, 6, 6, 7, 7};
    EXPECT_EQ(neighbour_accuracy(vectors, groups, Labels{0, 1, 2, 3, 4, 5}, 1), 1);
    EXPECT_EQ(neighbour_accuracy(vectors, groups, groups, 1), 0);
    EXPECT_EQ(neighbour_accuracy(vectors, Labels{1, 1, 2, 2, 2, 2}, groups, 1), 3.0 / 6);
    EXPECT_FALSE(neighbour_accuracy(vectors, groups, Labels(6, 0))) << "nobody to ask";
}

// Two votes each among the four others of 0: the nearer one's label wins.
TEST(NeighbourAccuracy, BreaksTiesByDistance) {
    const Vectors vectors{.width = 1, .values = {0, 1, 2, 3, 4}};
    const Labels labels = {7, 7, 8, 8, 7};
    EXPECT_EQ(neighbour_accuracy(vectors, labels, Labels{0, 1, 2, 3, 4}, 4), 2.0 / 5);
}

// Of the four numbers the mean leaves 2 x 1 and 2 x 9 squared, in all 20.
TEST(ExplainedVariance, IsTheShareThatAGuessGetsRightOfAllNumbersTogether) {
    const Vectors truth{.width = 2, .values = {1, 3, -1, -3}};
    EXPECT_EQ(explained_variance(truth, truth), 1);
    EXPECT_EQ(explained_variance(truth, {.width = 2, .values = {0, 0, 0, 0}}), 0) << "as near as the mean";
    EXPECT_DOUBLE_EQ(*explained_variance(truth, {.width = 2, .values = {0, 3, 0, -3}}), 0.9);
    EXPECT_DOUBLE_EQ(*explained_variance(truth, {.width = 2, .values = {-1, -3, 1, 3}}), -3);
    EXPECT_FALSE(explained_variance({.width = 1, .values = {2, 2}}, {.width = 1, .values = {2, 3}}));
}

}  // namespace
}  // namespace chironomia::study
