#include "synth/motor/tcb_spline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chironomia {
namespace {

using Place = glm::dvec3;

constexpr double kFree = 1e9;  // no limit of tangents

// A crooked way with uneven times.
std::vector<TcbKey<Place>> crooked(const TcbShape& shape) {
    return {{.time = 0, .value = {0, 0, 0}, .shape = shape},
            {.time = 0.5, .value = {1, 0.2, 0}, .shape = shape},
            {.time = 0.7, .value = {1.2, 1, 0.4}, .shape = shape},
            {.time = 1.9, .value = {-0.5, 0.6, 0.1}, .shape = shape},
            {.time = 2.2, .value = {0, 0, 0}, .shape = shape}};
}

Place velocity_before(const TcbSpline<Place>& spline, const std::vector<TcbKey<Place>>& keys, std::size_t k) {
    return spline.tangents()[k].in / (keys[k].time - keys[k - 1].time);
}

Place velocity_behind(const TcbSpline<Place>& spline, const std::vector<TcbKey<Place>>& keys, std::size_t k) {
    return spline.tangents()[k].out / (keys[k + 1].time - keys[k].time);
}

TEST(TcbSpline, GoesThroughEveryKeyWhateverItsShape) {
    for (const TcbShape& shape :
         {TcbShape{}, TcbShape{1, -1, 1}, TcbShape{-1, 1, -1}, TcbShape{0.3, -0.7, 0.9}}) {
        const auto keys = crooked(shape);
        const TcbSpline<Place> spline(keys, kFree);
        for (const TcbKey<Place>& key : keys) EXPECT_LT(distance(spline.at(key.time), key.value), 1e-12);
    }
}

TEST(TcbSpline, IsTheCatmullRomSplineWhereNothingIsSet) {
    const std::vector<TcbKey<double>> even = {{0, 0}, {1, 2}, {2, 3}, {3, 7}};
    const TcbSpline<double> spline(even, kFree);
    EXPECT_DOUBLE_EQ(spline.tangents()[1].in, (3 - 0) / 2.0);
    EXPECT_DOUBLE_EQ(spline.tangents()[2].out, (7 - 2) / 2.0);
    // Catmull and Rom's matrix for the middle of the second segment: (-p0 + 9 p1 + 9 p2 - p3) / 16.
    EXPECT_DOUBLE_EQ(spline.at(1.5), (-0.0 + 9 * 2 + 9 * 3 - 7) / 16.0);

    // With uneven times the velocity at a key is still the way from neighbour to neighbour by its time.
    const auto keys = crooked({});
    const TcbSpline<Place> uneven(keys, kFree);
    for (std::size_t k = 1; k + 1 < keys.size(); ++k) {
        const Place velocity =
            (keys[k + 1].value - keys[k - 1].value) / (keys[k + 1].time - keys[k - 1].time);
        EXPECT_LT(distance(velocity_before(uneven, keys, k), velocity), 1e-12);
        EXPECT_LT(distance(velocity_behind(uneven, keys, k), velocity), 1e-12);
    }
}

TEST(TcbSpline, HasOneVelocityAtAKeyOfUnevenTimesWhereContinuityIsZero) {
    for (const TcbShape& shape : {TcbShape{}, TcbShape{-0.6, 0, 0.4}, TcbShape{0.5, 0, -1}}) {
        const auto keys = crooked(shape);
        const TcbSpline<Place> spline(keys, kFree);
        for (std::size_t k = 1; k + 1 < keys.size(); ++k) {
            EXPECT_LT(distance(velocity_before(spline, keys, k), velocity_behind(spline, keys, k)), 1e-12);
        }
    }
    const auto keys = crooked({0, -0.5, 0});
    const TcbSpline<Place> cornered(keys, kFree);
    EXPECT_GT(distance(velocity_before(cornered, keys, 2), velocity_behind(cornered, keys, 2)), 0.5);
}

TEST(TcbSpline, StopsAtAKeyOfFullTension) {
    const auto keys = crooked({1, -0.4, 0.8});
    const TcbSpline<Place> spline(keys, kFree);
    for (const auto& tangents : spline.tangents()) EXPECT_EQ(length(tangents.in) + length(tangents.out), 0);
    constexpr double kMoment = 1e-4;
    EXPECT_LT(distance(spline.at(0.7 + kMoment), spline.at(0.7 - kMoment)), 1e-6);
}

// At b, on the way from a to c by even times.
TcbTangents<Place> even_tangents(const Place& a, const Place& b, const Place& c, const TcbShape& shape) {
    return tcb_tangents<Place>({.time = 0, .value = a}, {.time = 1, .value = b, .shape = shape},
                               {.time = 2, .value = c});
}

TEST(TcbSpline, ExchangesItsTangentsWhenContinuityChangesItsSign) {
    const Place a(0, 0, 0), b(1, 0.2, 0), c(1.2, 1, 0.4);
    const auto one = even_tangents(a, b, c, {0.2, 0.7, -0.3});
    const auto other = even_tangents(a, b, c, {0.2, -0.7, -0.3});
    EXPECT_LT(distance(one.in, other.out), 1e-15);
    EXPECT_LT(distance(one.out, other.in), 1e-15);
}

TEST(TcbSpline, LeansTowardsTheWayThatFollowsOrLedThereByItsBias) {
    const Place a(0, 0, 0), b(1, 0, 0), c(1, 3, 0);
    EXPECT_LT(distance(even_tangents(a, b, c, {0, 0, 1}).out, b - a), 1e-15);
    EXPECT_LT(distance(even_tangents(a, b, c, {0, 0, -1}).out, c - b), 1e-15);
}

TEST(TcbSpline, RestsAtStopsAndBeyondItsEnds) {
    auto keys = crooked({});
    keys[2].stops = true;
    const TcbSpline<Place> spline(keys, kFree);
    EXPECT_EQ(length(spline.tangents()[2].in) + length(spline.tangents()[2].out), 0);
    EXPECT_EQ(length(spline.tangents().front().out) + length(spline.tangents().back().in), 0);
    EXPECT_EQ(spline.at(-3), keys.front().value);
    EXPECT_EQ(spline.at(30), keys.back().value);
}

TEST(TcbSpline, BoundsItsOvershootAndStaysSmooth) {
    const auto keys = crooked({-1, 0, -1});
    const TcbSpline<Place> free(keys, kFree), bound(keys, 1.5);
    const auto longest = [&](const TcbSpline<Place>& spline) {
        double most = 0;
        for (std::size_t k = 1; k + 1 < keys.size(); ++k) {
            most =
                std::max({most, length(spline.tangents()[k].in) / distance(keys[k].value, keys[k - 1].value),
                          length(spline.tangents()[k].out) / distance(keys[k + 1].value, keys[k].value)});
        }
        return most;
    };
    EXPECT_GT(longest(free), 3);
    EXPECT_LT(longest(bound), 1.5 + 1e-12);
    for (std::size_t k = 1; k + 1 < keys.size(); ++k)
        EXPECT_LT(distance(velocity_before(bound, keys, k), velocity_behind(bound, keys, k)), 1e-12);
}

}  // namespace
}  // namespace chironomia
