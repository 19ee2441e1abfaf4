#include "study/server/rate_limit.h"

#include <gtest/gtest.h>

namespace chironomia::study::server {
namespace {

TEST(RateLimit, LetsABurstThroughAndThenOneForEachSpanOfTheRate) {
    RateLimit limit(2, 3);  // two a second, three at once
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.allows("a", 1000));
    EXPECT_FALSE(limit.allows("a", 1000));
    EXPECT_FALSE(limit.allows("a", 1400));
    EXPECT_TRUE(limit.allows("a", 1500));
    EXPECT_FALSE(limit.allows("a", 1500));
}

TEST(RateLimit, KeepsClientsApart) {
    RateLimit limit(1, 1);
    EXPECT_TRUE(limit.allows("a", 0));
    EXPECT_TRUE(limit.allows("b", 0));
    EXPECT_FALSE(limit.allows("a", 0));
}

TEST(RateLimit, NeverHoldsMoreThanTheBurst) {
    RateLimit limit(1, 2);
    EXPECT_TRUE(limit.allows("a", 0));
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(limit.allows("a", 1'000'000));
    EXPECT_FALSE(limit.allows("a", 1'000'000));
}

TEST(RateLimit, ForgetsWhoWasUnheardOfForLongest) {
    RateLimit limit(1, 1, 2);
    EXPECT_TRUE(limit.allows("a", 0));
    EXPECT_TRUE(limit.allows("b", 0));
    EXPECT_FALSE(limit.allows("a", 0));  // now b is the oldest
    EXPECT_TRUE(limit.allows("c", 0));   // b is forgotten
    EXPECT_FALSE(limit.allows("a", 0));
    EXPECT_TRUE(limit.allows("b", 0));
}

TEST(ClientLimit, GivesSoManyPlacesAtOnceToEachClient) {
    ClientLimit limit(2);
    std::optional<ClientLimit::Place> first = limit.enter("a"), second = limit.enter("a");
    EXPECT_TRUE(first && second);
    EXPECT_FALSE(limit.enter("a"));
    EXPECT_TRUE(limit.enter("b"));
    first.reset();
    std::optional<ClientLimit::Place> third = limit.enter("a");
    EXPECT_TRUE(third);
    second = std::move(third);
    third.reset();
    EXPECT_TRUE(limit.enter("a"));
}

TEST(ClientOfAddress, IsAnAddressOrTheNetworkOfOne) {
    EXPECT_EQ(client_of_address("10.0.0.7"), "10.0.0.7");
    EXPECT_EQ(client_of_address("::ffff:10.0.0.7"), "10.0.0.7");
    EXPECT_EQ(client_of_address("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::/64");
    EXPECT_EQ(client_of_address("2001:db8:1:2::7"), "2001:db8:1:2::/64");
    EXPECT_EQ(client_of_address("unknown"), "unknown");
}

}  // namespace
}  // namespace chironomia::study::server
