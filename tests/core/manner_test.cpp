#include "core/manner.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(Manner, IsTheGenericAgentUnlessItIsSet) {
    const Manner manner;
    EXPECT_EQ(manner[Expressivity::overall_activation], 0.5);
    EXPECT_EQ(manner[Expressivity::power], 0);
}

TEST(Manner, KnowsItsDimensionsByTheSymbolsOfThePaper) {
    for (std::size_t i = 0; i < kExpressivities; ++i) {
        const auto dimension = static_cast<Expressivity>(i);
        EXPECT_EQ(expressivity_named(symbol_of(dimension)), dimension);
    }
    EXPECT_EQ(symbol_of(Expressivity::fluidity), "flt");
    EXPECT_EQ(name_of(Expressivity::spatial_extent), "spatial extent");
    EXPECT_FALSE(expressivity_named("FLT"));
    EXPECT_EQ(least_of(Expressivity::overall_activation), 0);
    EXPECT_EQ(least_of(Expressivity::repetition), -1);
}

TEST(Manner, YieldsToWhatAnActSetsForItself) {
    Manner agent;
    agent[Expressivity::power] = 0.7;
    LocalManner act;
    act[Expressivity::power] = -0.2;
    const Manner manner = overridden(agent, act);
    EXPECT_EQ(manner[Expressivity::power], -0.2);
    EXPECT_EQ(manner[Expressivity::overall_activation], 0.5);
    EXPECT_EQ(overridden(agent, {}), agent);
}

}  // namespace
}  // namespace chironomia
