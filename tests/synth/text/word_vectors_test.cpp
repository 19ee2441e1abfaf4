#include "synth/text/word_vectors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/hash.h"
#include "core/text.h"
#include "synth/corpus/records.h"

namespace chironomia {
namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (const std::string_view word : split_words(text)) words.emplace_back(word);
    return words;
}

std::vector<float> vector_of(const std::string& text, std::size_t word) {
    const std::vector<float> vectors = hashbert(words_of(text));
    const auto begin = vectors.begin() + static_cast<std::ptrdiff_t>(word * kWordVector);
    return {begin, begin + static_cast<std::ptrdiff_t>(kWordVector)};
}

double cosine(const std::vector<float>& a, const std::vector<float>& b) {
    double product = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        product += static_cast<double>(a[i]) * b[i];
        aa += static_cast<double>(a[i]) * a[i];
        bb += static_cast<double>(b[i]) * b[i];
    }
    return product / std::sqrt(aa * bb);
}

const std::string kText =
    "so what I would like to show you today is a small machine , which listens to people while they talk . "
    "can you imagine that ? every morning it wakes up , counts three hundred birds , and forgets them again "
    "!";

TEST(Hashbert, GivesTheSameVectorsOnEveryMachine) {
    std::string digits;
    for (const float number : hashbert(words_of(kText))) digits += format("{} ", std::lround(number * 1000));
    EXPECT_EQ(sha256(digits), "4b97a32bf0cb795187b3d52a44544aeb56e105b033e8e28bae2f2766c99550b2");
}

TEST(Hashbert, HasAStandardDeviationOfAHalf) {
    const std::vector<std::string> words = words_of(kText);
    const std::vector<float> vectors = hashbert(words);
    ASSERT_EQ(vectors.size(), words.size() * kWordVector);
    double sum = 0, squares = 0;
    for (const float number : vectors) {
        sum += number;
        squares += static_cast<double>(number) * number;
    }
    const auto count = static_cast<double>(vectors.size());
    EXPECT_NEAR(sum / count, 0, 0.03);
    EXPECT_NEAR(std::sqrt(squares / count), 0.5, 0.03);
}

TEST(Hashbert, PutsWordsThatAreSpelledAlikeNearEachOther) {
    const double alike = cosine(vector_of("remembering", 0), vector_of("remembered", 0));
    const double other = cosine(vector_of("remembering", 0), vector_of("chocolate", 0));
    EXPECT_GT(alike, 0.5);
    EXPECT_LT(other, 0.2);
}

TEST(Hashbert, GivesAWordAPartOfItsNeighbours) {
    const std::vector<float> one = vector_of("small birds sing", 1), other = vector_of("quiet birds sing", 1);
    EXPECT_NE(one, other);
    EXPECT_GT(cosine(one, other), 0.85);
    // Two words away nothing is left of it.
    EXPECT_EQ(vector_of("small birds sing", 2), vector_of("quiet birds sing", 2));
}

TEST(Hashbert, EncodesCaseAndAccentsInAFlagAlone) {
    EXPECT_NE(vector_of("cafe", 0), vector_of("Café", 0));
    EXPECT_GT(cosine(vector_of("cafe", 0), vector_of("Café", 0)), 0.99);
}

TEST(Hashbert, MarksAQuestionInEachOfItsWords) {
    EXPECT_NE(vector_of("you know that well ?", 0), vector_of("you know that well .", 0));
}

TEST(Hashbert, TakesWhateverIsThere) {
    EXPECT_TRUE(hashbert({}).empty());
    EXPECT_EQ(hashbert(std::vector<std::string>{"", ",", "日本"}).size(), 3 * kWordVector);
}

}  // namespace
}  // namespace chironomia
