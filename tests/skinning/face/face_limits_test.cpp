#include "skinning/face/face_limits.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "core/body/face.h"

namespace chironomia {
namespace {

UnitIntensities with(std::initializer_list<std::pair<int, float>> values) {
    UnitIntensities intensities{};
    for (const auto& [unit, value] : values) intensities[static_cast<size_t>(unit)] = value;
    return intensities;
}

TEST(FaceLimits, LeaveASingleUnitAlone) {
    for (const int unit : known_action_units()) {
        const UnitIntensities alone = with({{unit, 5}});
        EXPECT_EQ(limited(alone), alone) << unit;
    }
}

TEST(FaceLimits, NeverRaiseAndNeverPassZero) {
    UnitIntensities all{};
    for (const int unit : known_action_units()) all[static_cast<size_t>(unit)] = 5;
    for (const float intensity : limited(all)) {
        EXPECT_GE(intensity, 0);
        EXPECT_LE(intensity, 5);
    }
}

TEST(FaceLimits, AreEachForTwoKnownUnitsOnceWithAReason) {
    std::set<std::pair<int, int>> seen;
    for (const FaceLimit& limit : face_limits()) {
        EXPECT_FALSE(name_of_unit(limit.suppressed).empty()) << limit.suppressed;
        EXPECT_FALSE(name_of_unit(limit.suppressor).empty()) << limit.suppressor;
        EXPECT_NE(limit.suppressed, limit.suppressor);
        EXPECT_TRUE(seen.emplace(limit.suppressed, limit.suppressor).second)
            << limit.suppressed << " by " << limit.suppressor;
        EXPECT_GT(limit.share, 0);
        EXPECT_LE(limit.share, 1);
        EXPECT_STRNE(limit.reason, "");
    }
}

TEST(FaceLimits, AClosedLidIsNeitherRaisedNorTightened) {
    const UnitIntensities result = limited(with({{45, 5}, {5, 4}, {7, 3}}));
    EXPECT_EQ(result, with({{45, 5}}));
}

TEST(FaceLimits, AreInProportionToWhatHoldsBack) {
    EXPECT_FLOAT_EQ(limited(with({{25, 5}, {26, 5}}))[25], 5 * .3f);
    EXPECT_FLOAT_EQ(limited(with({{25, 5}, {26, 2.5f}}))[25], 5 * .65f);
    EXPECT_FLOAT_EQ(limited(with({{12, 4}, {6, 4}}))[12], 4);
}

// 1+4, 25+26+12: the part that would be doubled is held back, the rest is whole.
TEST(FaceLimits, MeetWhereSeveralHoldBackOne) {
    const UnitIntensities brows = limited(with({{1, 5}, {4, 5}}));
    EXPECT_FLOAT_EQ(brows[1], 5);
    EXPECT_FLOAT_EQ(brows[4], 5 * .65f);
    const UnitIntensities laugh = limited(with({{12, 5}, {25, 5}, {26, 5}}));
    EXPECT_FLOAT_EQ(laugh[12], 5 * .8f);
    EXPECT_FLOAT_EQ(laugh[25], 5 * .75f * .3f);
    EXPECT_FLOAT_EQ(laugh[26], 5);
}

}  // namespace
}  // namespace chironomia
