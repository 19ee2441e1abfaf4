#include "skinning/fit/fit_report.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

// A left arm of two bones of equal length along x, of that size, standing still.
BodyTrack arm(float size, size_t frames) {
    BodyTrack track;
    for (const HumanJoint part :
         {HumanJoint::left_upper_arm, HumanJoint::left_lower_arm, HumanJoint::left_hand}) {
        track.known.set(index_of(part));
    }
    track.places.resize(frames);
    for (auto& places : track.places) {
        places[index_of(HumanJoint::left_upper_arm)] = {1, 1, 1};
        places[index_of(HumanJoint::left_lower_arm)] = Vec3(1, 1, 1) + Vec3(size, 0, 0);
        places[index_of(HumanJoint::left_hand)] = Vec3(1, 1, 1) + Vec3(2 * size, 0, 0);
    }
    return track;
}

TEST(SpreadOf, HasMeanNearestRankAndLargest) {
    std::vector<double> values;
    for (int i = 20; i >= 1; --i) values.push_back(i);
    const Spread spread = spread_of(values);
    EXPECT_EQ(spread.n, 20u);
    EXPECT_DOUBLE_EQ(spread.mean, 10.5);
    EXPECT_DOUBLE_EQ(spread.p95, 19);
    EXPECT_DOUBLE_EQ(spread.max, 20);
    EXPECT_EQ(spread_of({}).n, 0u);
}

TEST(LimbDistances, AreNoneBetweenArmsOfDifferentSizeInTheSamePosture) {
    for (const NamedSpread& named : limb_distances_mm(arm(0.2f, 3), arm(0.3f, 3))) {
        EXPECT_EQ(named.spread.n, 3u);
        EXPECT_LT(named.spread.max, 1e-3);
    }
}

TEST(LimbDistances, SeeAWristThatIsOffInTheAvatarsOwnSize) {
    BodyTrack avatar = arm(0.3f, 5);
    avatar.places[1][index_of(HumanJoint::left_hand)] += Vec3(0, 0.01f, 0);
    const std::vector<NamedSpread> distances = limb_distances_mm(arm(0.2f, 5), avatar);
    ASSERT_EQ(distances.size(), 2u);
    EXPECT_EQ(distances[0].part, "left_elbow");
    EXPECT_EQ(distances[1].part, "left_wrist");
    EXPECT_NEAR(distances[1].spread.max, 10, 1e-3);
    EXPECT_NEAR(distances[1].spread.mean, 2, 1e-3);
}

TEST(BoneErrors, AreTheAnglesBetweenTheBones) {
    BodyTrack avatar = arm(0.3f, 2);
    avatar.places[0][index_of(HumanJoint::left_hand)] =
        avatar.places[0][index_of(HumanJoint::left_lower_arm)] + Vec3(0, 0, 0.3f);
    const std::vector<NamedSpread> errors = bone_errors_deg(arm(0.2f, 2), avatar);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].part, "left_upper_arm");
    EXPECT_LT(errors[0].spread.max, 1e-3);
    EXPECT_NEAR(errors[1].spread.max, 90, 1e-3);
    EXPECT_NEAR(errors[1].spread.mean, 45, 1e-3);
}

TEST(FootSlide, CountsTheWayOnTheFloorAndNotThatInTheAir) {
    // The left foot slides 10 mm a frame on its ball; the right one is moved through the air.
    std::vector<std::array<Vec3, 4>> soles;
    for (int t = 0; t < 4; ++t) {
        const float way = 0.01f * float(t);
        soles.push_back({Vec3(0, 0.05f, way), {0, 0, way}, {0, 0.2f, 3 * way}, {0, 0.2f, 3 * way}});
    }
    const FootSlide slide = foot_slide(soles, 30);
    EXPECT_EQ(slide.frames, 3u);
    EXPECT_NEAR(slide.metres, 0.03, 1e-7);
    EXPECT_NEAR(slide.mm_per_second, 300, 1e-3);
}

// p = t^3 has the third difference 6 everywhere.
TEST(JerkOf, IsTheThirdDifferenceTimesTheCubeOfTheRate) {
    BodyTrack track = arm(0.2f, 6);
    for (size_t t = 0; t < 6; ++t) {
        const float time = float(t);
        track.places[t][index_of(HumanJoint::left_hand)] = {time * time * time, 0, 0};
    }
    const Jerk jerk = jerk_of(track, 2, 0.5);
    EXPECT_EQ(jerk.n, 9u);
    EXPECT_NEAR(jerk.wrists, 6 * 8 * 0.5, 1e-4);
    EXPECT_NEAR(jerk.all, 6 * 8 * 0.5 / 3, 1e-4);
}

TEST(JerkOf, IsNoneForAClipTooShortToHaveOne) {
    EXPECT_EQ(jerk_of(arm(0.2f, 3), 30, 1).n, 0u);
    EXPECT_EQ(jerk_of(arm(0.2f, 3), 30, 1).wrists, 0);
}

TEST(WarningsOf, NameSidesThatLookExchanged) {
    FitReport report;
    report.motion = "a.bvh";
    EXPECT_TRUE(warnings_of(report).empty());
    EXPECT_FALSE(to_json(report).contains("sides_look_exchanged"));
    report.sides_look_exchanged = true;
    EXPECT_EQ(warnings_of(report),
              std::vector<std::string>(
                  {"a.bvh: its left and right look exchanged, as feet, face or knees show: if its "
                   "axes are left-handed (Unity, Unreal), it is shown mirrored; export it with "
                   "right-handed axes"}));
    EXPECT_EQ(to_json(report)["sides_look_exchanged"], true);
}

TEST(WarningsOf, NameAnUpAxisInDoubt) {
    FitReport report;
    report.motion = "a.bvh";
    report.doubtful_up = "y was taken for up";
    EXPECT_EQ(warnings_of(report), std::vector<std::string>({"a.bvh: y was taken for up"}));
    EXPECT_EQ(to_json(report)["doubtful_up_axis"], "y was taken for up");
}

TEST(ToJson, NamesEveryUnitAndCount) {
    FitReport report{.motion = "a.bvh", .avatar = "b.glb", .source = "joint turns", .frames = 2, .fps = 30};
    report.direction_deg = {{"left_upper_arm", spread_of({1, 3})}};
    report.reached = {{"left_arm", 4, spread_of({2})}};
    report.limits = {{"left_elbow", 7}};
    const Json json = to_json(report);
    EXPECT_EQ(json["bone_direction_error_deg"]["left_upper_arm"]["mean"], 2.0);
    EXPECT_EQ(json["bone_direction_error_deg"]["left_upper_arm"]["n"], 2);
    EXPECT_EQ(json["reach"]["left_arm"]["unreachable_frames"], 4);
    EXPECT_EQ(json["joint_limits"]["frames"]["left_elbow"], 7);
    EXPECT_TRUE(json["jerk_in"].contains("wrists_mean_m_per_s3"));
    EXPECT_TRUE(json["foot_slide"].contains("mean_mm_per_s"));
}

}  // namespace
}  // namespace chironomia
