#include "study/measure/vectors/tsne.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "study/measure/vectors/silhouette.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

// Gaussians of standard deviation 1 in 10 dimensions, `apart` from each other along one dimension each.
struct Clusters {
    Vectors vectors{.width = 10};
    std::vector<std::size_t> labels;
};

Clusters three_clusters(std::size_t each, double apart = 20) {
    Random random(11);
    Clusters clusters;
    for (std::size_t i = 0; i < 3 * each; ++i) {
        clusters.labels.push_back(i % 3);
        for (std::size_t d = 0; d < clusters.vectors.width; ++d)
            clusters.vectors.values.push_back(random.normal() + (d == i % 3 ? apart : 0));
    }
    return clusters;
}

TEST(ConditionalAffinities, HaveThePerplexityInEveryRow) {
    const Clusters clusters = three_clusters(20);
    const std::size_t n = clusters.vectors.count();
    for (const double perplexity : {2.0, 19.5, 45.0}) {
        const std::vector<double> p = conditional_affinities(clusters.vectors, perplexity);
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0, bits = 0;
            for (std::size_t j = 0; j < n; ++j) {
                sum += p[i * n + j];
                if (p[i * n + j] > 0) bits -= p[i * n + j] * std::log2(p[i * n + j]);
            }
            EXPECT_NEAR(sum, 1, 1e-12);
            EXPECT_NEAR(std::exp2(bits), perplexity, 1e-4);
            EXPECT_EQ(p[i * n + i], 0);
        }
    }
}

// The nearer of two has exp(-b) against exp(-4 b); entropies are right whatever the unit of length.
TEST(ConditionalAffinities, DoNotKnowTheUnitOfLength) {
    Vectors metres = three_clusters(5).vectors, millimetres = metres;
    for (double& value : millimetres.values) value *= 1000;
    const std::vector<double> a = conditional_affinities(metres, 4),
                              b = conditional_affinities(millimetres, 4);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5);
}

TEST(JointAffinities, AreSymmetricAndSumToOne) {
    const std::vector<double> joint =
        joint_affinities(std::vector<double>{0, .25, .75, 1, 0, 0, .5, .5, 0}, 3);
    EXPECT_NEAR(joint[1], 1.25 / 6, 1e-15);
    EXPECT_EQ(joint[1], joint[3]);
    double sum = 0;
    for (const double p : joint) sum += p;
    EXPECT_NEAR(sum, 1, 1e-15);
}

// Of two points q_12 = q_21 = 1/2 wherever they lie.
TEST(TsneDivergence, IsNothingOfTwoPoints) {
    const std::vector<double> joint = {0, 0.5, 0.5, 0};
    const Vectors map{.width = 2, .values = {0, 0, 3, 4}};
    EXPECT_NEAR(tsne_divergence(joint, map), 0, 1e-12);
    for (const double slope : tsne_gradient(joint, map)) EXPECT_NEAR(slope, 0, 1e-12);
}

TEST(TsneGradient, IsWhatTheDivergenceChangesBy) {
    const Clusters clusters = three_clusters(4);
    const std::size_t n = clusters.vectors.count();
    const std::vector<double> joint = joint_affinities(conditional_affinities(clusters.vectors, 3), n);
    Random random(5);
    Vectors map{.width = 2};
    for (std::size_t i = 0; i < 2 * n; ++i) map.values.push_back(random.normal());
    const std::vector<double> gradient = tsne_gradient(joint, map);
    for (std::size_t i = 0; i < 2 * n; ++i) {
        constexpr double kStep = 1e-5;
        Vectors more = map, less = map;
        more.values[i] += kStep;
        less.values[i] -= kStep;
        const double change = (tsne_divergence(joint, more) - tsne_divergence(joint, less)) / (2 * kStep);
        EXPECT_NEAR(gradient[i], change, 1e-8);
    }
}

TEST(Tsne, KeepsThreeClustersApart) {
    for (const std::size_t each : {7, 40}) {
        const Clusters clusters = three_clusters(each);
        const TsneMap map = tsne(clusters.vectors);
        EXPECT_EQ(map.points.count(), 3 * each);
        EXPECT_GT(*mean_silhouette(map.points, clusters.labels), 0.85);
        EXPECT_GT(map.divergence, 0);
    }
}

TEST(Tsne, TakesThePerplexityThatTheVectorsAllow) {
    const TsneOptions quick{.iterations = 1};
    EXPECT_EQ(tsne(three_clusters(4).vectors, quick).perplexity, 11.0 / 3);
    EXPECT_EQ(tsne(three_clusters(40).vectors, quick).perplexity, 30);
}

TEST(Tsne, IsTheSameEveryTimeButForItsSeed) {
    const Vectors vectors = three_clusters(10).vectors;
    const TsneOptions options{.iterations = 300};
    const std::vector<double> first = tsne(vectors, options).points.values;
    EXPECT_EQ(first, tsne(vectors, options).points.values);
    EXPECT_NE(first, tsne(vectors, {.iterations = 300, .seed = 43}).points.values);
}

// Beyond the 50 components that are kept there is nothing: the map is the same but for rounding at first.
TEST(Tsne, ReducesWideVectorsFirst) {
    const Clusters clusters = three_clusters(15);
    Vectors wide{.width = 80};
    for (std::size_t i = 0; i < clusters.vectors.count(); ++i) {
        const auto vector = clusters.vectors[i];
        wide.values.insert(wide.values.end(), vector.begin(), vector.end());
        wide.values.resize((i + 1) * wide.width);
    }
    const TsneOptions options{.iterations = 5};
    const Vectors a = tsne(clusters.vectors, options).points, b = tsne(wide, options).points;
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-8);
}

TEST(Tsne, RefusesWhatItCannotPlace) {
    EXPECT_EQ(testing::refusal_of([] {
                  tsne({.width = 1, .values = {1, 2, 3}});
              }),
              "t-SNE: 3 vectors, at least 7 are needed; give more");
    // Three copies are as many as the perplexity; six are more.
    EXPECT_NO_THROW(tsne({.width = 1, .values = {0, 0, 0, 0, 5, 6, 7, 8, 9, 10}}, {.iterations = 1}));
    EXPECT_EQ(
        testing::refusal_of([] {
            tsne({.width = 1, .values = {0, 0, 0, 0, 0, 0, 0, 8, 9, 10}});
        }),
        "t-SNE: vector 0 cannot have the perplexity 3: too many others are equally near; leave out copies "
        "or ask for more");
}

}  // namespace
}  // namespace chironomia::study
