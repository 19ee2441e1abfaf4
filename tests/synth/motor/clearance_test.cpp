#include "synth/motor/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synth/body/agent_body.h"
#include "synth/motor/body_distance.h"

namespace chironomia {
namespace {

using Place = glm::dvec3;

// Two seconds in which the arms do what `at` says of a share of the time.
template <typename At>
ArmGrid grid_of(const At& at) {
    ArmGrid grid;
    constexpr std::size_t kCount = 241;
    for (const ArmSide side : kArmSides) {
        for (std::size_t n = 0; n < kCount; ++n)
            grid.arms[index_of(side)].push_back(at(side, static_cast<double>(n) / (kCount - 1)));
        grid.closed[index_of(side)].assign(kCount, 0.5);
    }
    return grid;
}

ArmPoint hanging(ArmSide side) {
    const ArmState rest = resting_arm(side, {});
    return {.wrist = Place(rest.wrist),
            .bends = {rest.twist, rest.flexion, rest.deviation},
            .swivel = rest.swivel};
}

double fastest_change(const std::vector<ArmPoint>& points, double rate) {
    double fastest = 0;
    for (std::size_t n = 2; n < points.size(); ++n) {
        const Place change = points[n].wrist - 2.0 * points[n - 1].wrist + points[n - 2].wrist;
        fastest = std::max(fastest, length(change) * rate * rate);
    }
    return fastest;
}

TEST(BodyGap, IsTheDistanceFromTheSkin) {
    EXPECT_NEAR(signed_distance_to_body({0, 1.26, 0.652}).distance, 0.5, 1e-9);
    EXPECT_LT(distance(signed_distance_to_body({0, 1.26, 0.652}).away, Place(0, 0, 1)), 1e-9);
    EXPECT_LT(signed_distance_to_body({0, 1.26, 0.1}).distance, -0.04);
    EXPECT_GT(signed_distance_to_body({0.5, 1.1, 0}).away.x, 0.9);
    EXPECT_LT(signed_distance_to_body({-0.5, 1.1, 0}).away.x, -0.9);
}

TEST(BodyGap, KnowsThighsButNotAsTrunk) {
    const Place thigh(0.104, 0.7, 0.035);
    EXPECT_LT(signed_distance_to_body(thigh).distance, -0.09);
    EXPECT_LT(signed_distance_to_body(thigh * Place(-1, 1, 1)).distance, -0.09);
    EXPECT_GT(signed_distance_to_trunk_and_head(thigh).distance, 0.05);
    const Place outside = thigh * Place(-1, 1, 1) - Place(0.2, 0, 0);
    EXPECT_LT(signed_distance_to_body(outside).away.x, -0.99);
}

TEST(Clearance, LeavesArmsThatAreClear) {
    ArmGrid grid = grid_of([](ArmSide side, double) { return hanging(side); });
    const ArmGrid before = grid;
    clear(grid);
    for (std::size_t arm = 0; arm < 2; ++arm)
        EXPECT_LT(distance(grid.arms[arm][100].wrist, before.arms[arm][100].wrist), 0.006);
}

TEST(Clearance, LeadsAWayThroughTheTrunkAroundItSmoothly) {
    const Place from(-0.3, 1.15, 0.12), to(0.25, 1.15, 0.12);
    ArmGrid grid = grid_of([&](ArmSide side, double share) {
        if (side == ArmSide::left) return hanging(side);
        const double eased = share * share * (3 - 2 * share);
        return ArmPoint{.wrist = from + (to - from) * eased, .bends = {0, 0, 0}, .swivel = 0.4};
    });
    const auto nearest = [&] {
        double gap = 1;
        for (const ArmPoint& point : grid.arms[1])
            gap = std::min(gap, signed_distance_to_body(point.wrist).distance);
        return gap;
    };
    ASSERT_LT(nearest(), -0.02);
    const double change_before = fastest_change(grid.arms[1], grid.rate);
    clear(grid);
    EXPECT_GT(nearest(), 0.025);
    EXPECT_LT(fastest_change(grid.arms[1], grid.rate), change_before + 25);
    EXPECT_LT(distance(grid.arms[1].front().wrist, from), 0.03);
}

TEST(Clearance, KeepsTheHandsApart) {
    ArmGrid grid = grid_of([](ArmSide side, double) {
        const double x = side == ArmSide::left ? 0.01 : -0.01;
        return ArmPoint{.wrist = {x, 1.2, 0.35}, .bends = {0, 0, 0}, .swivel = 0.4};
    });
    clear(grid);
    EXPECT_GT(distance(grid.arms[0][120].wrist, grid.arms[1][120].wrist), 0.028);
    EXPECT_GT(grid.arms[0][120].wrist.x, grid.arms[1][120].wrist.x);
}

// Both hands cross the midline on the same line, in opposite directions.
TEST(Clearance, LetsHandsPassBesideEachOther) {
    ArmGrid grid = grid_of([](ArmSide side, double share) {
        const double way = 0.18 * std::cos(double(kPi) * share) * (side == ArmSide::left ? 1 : -1);
        return ArmPoint{.wrist = {way, 1.25, 0.35}, .bends = {0, 0, 0}, .swivel = 0.6};
    });
    clear(grid);
    double nearest = 1;
    for (std::size_t n = 0; n < grid.arms[0].size(); ++n)
        nearest = std::min(nearest, distance(grid.arms[0][n].wrist, grid.arms[1][n].wrist));
    EXPECT_GT(nearest, 0.04);
    EXPECT_LT(grid.arms[0].back().wrist.x, grid.arms[1].back().wrist.x - 0.2);
}

TEST(Clearance, BringsAWristIntoReach) {
    ArmGrid grid = grid_of([](ArmSide side, double) {
        const double x = side == ArmSide::left ? 0.9 : -0.2;
        return ArmPoint{
            .wrist = {x, 1.36, side == ArmSide::left ? 0.5 : 0.08}, .bends = {0, 0, 0}, .swivel = 0.5};
    });
    clear(grid);
    const auto turns = turns_of({.wrist = Vec3(grid.arms[0][120].wrist), .swivel = 0.5f}, ArmSide::left);
    EXPECT_TRUE(turns.reached);
    EXPECT_GT(distance(chain_of(turns, ArmSide::left).shoulder, Vec3(grid.arms[0][120].wrist)),
              0.95f * agent_arm_length());
    const auto folded = turns_of({.wrist = Vec3(grid.arms[1][120].wrist), .swivel = 0.5f}, ArmSide::right);
    EXPECT_TRUE(folded.reached);
}

TEST(Clearance, SmoothsByEachPointsOwnWidth) {
    std::vector<ArmPoint> points(121);
    for (std::size_t n = 60; n < points.size(); ++n) points[n].wrist.x = 1;
    std::vector<double> sigmas(points.size(), 0.05);
    const auto soft = smoothed(points, sigmas, 120);
    EXPECT_NEAR(soft[59].wrist.x + soft[60].wrist.x, 1, 1e-9);
    // A Gaussian's integral: 0.84 at one sigma, which is 6 points after the middle of the step.
    EXPECT_NEAR((soft[65].wrist.x + soft[66].wrist.x) / 2, 0.841, 0.01);
    sigmas.assign(points.size(), 0.01);
    EXPECT_NEAR(smoothed(points, sigmas, 120)[64].wrist.x, 1, 1e-3);
    EXPECT_EQ(smoothed(points, sigmas, 120).front().wrist.x, 0);
}

}  // namespace
}  // namespace chironomia
