#include "core/quantile.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(Quantile, IsAValueThatAShareDoesNotPass) {
    const std::vector<double> values = {5, 1, 4, 2, 3};
    EXPECT_EQ(quantile(values, 0), 1);
    EXPECT_EQ(quantile(values, 0.5), 3);
    EXPECT_EQ(quantile(values, 0.74), 3);
    EXPECT_EQ(quantile(values, 0.75), 4);
    EXPECT_EQ(quantile(values, 1), 5);
    EXPECT_EQ(quantile(std::vector<float>{7}, 0.3), 7);
}

TEST(Median, IsTheGreaterOfTwoInTheMiddle) {
    EXPECT_EQ(median(std::vector<double>{5, 1, 3}), 3);
    EXPECT_EQ(median(std::vector<double>{5, 1, 3, 4}), 4);
    EXPECT_EQ(median(std::vector<float>{7}), 7);
}

}  // namespace
}  // namespace chironomia
