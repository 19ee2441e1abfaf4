#include "skinning/face/look_angle.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

constexpr float kDegree = kPi / 180;

// A ball of 26 points round (0.03, 1.6, 0.1), and the morph that turns it.
struct Ball {
    Surface surface;
    Morph morph;
};
Ball turned_ball(const Quat& turn) {
    Ball ball;
    const Vec3 centre(0.03f, 1.6f, 0.1f);
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Vec3 spoke = 0.012f * normalize(Vec3(x, y, z));
                ball.morph.vertices.push_back(static_cast<std::uint32_t>(ball.surface.positions.size()));
                ball.surface.positions.push_back(centre + spoke);
                ball.morph.moves.push_back(turn * spoke - spoke);
            }
        }
    }
    return ball;
}

TEST(TurnOfMorph, IsTheAngleOfAStiffTurnAboutAnyAxis) {
    for (const float degrees : {5.0f, 27.0f, 60.0f}) {
        for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(.6f, .48f, .64f)}) {
            const Ball ball = turned_ball(glm::angleAxis(degrees * kDegree, axis));
            const auto turn = turn_of_morph(ball.surface, ball.morph);
            ASSERT_TRUE(turn);
            EXPECT_NEAR(*turn / kDegree, degrees, 0.01f);
        }
    }
}

TEST(TurnOfMorph, IsNothingForWhatIsNotStiffOrHardlyTurns) {
    Ball stretched = turned_ball(kNoTurn);
    for (size_t i = 0; i < stretched.morph.moves.size(); ++i)
        stretched.morph.moves[i] = {0, stretched.surface.positions[i].x - 0.03f, 0};
    EXPECT_FALSE(turn_of_morph(stretched.surface, stretched.morph));
    const Ball still = turned_ball(glm::angleAxis(1 * kDegree, Vec3(0, 1, 0)));
    EXPECT_FALSE(turn_of_morph(still.surface, still.morph));
    EXPECT_FALSE(turn_of_morph(Surface{}, Morph{}));
}

TEST(WeightOfTurn, PutsAPointOnItsChordAtTheAngle) {
    const float whole = 40 * kDegree;
    for (const float degrees : {0.0f, 10.0f, 20.0f, 33.0f, 40.0f}) {
        const float weight = weight_of_turn(degrees * kDegree, whole);
        const Vec2 end(std::cos(whole), std::sin(whole));
        const Vec2 point = Vec2(1, 0) + weight * (end - Vec2(1, 0));
        EXPECT_NEAR(std::atan2(point.y, point.x) / kDegree, degrees, 1e-3f);
    }
    EXPECT_EQ(weight_of_turn(1, 0.5f), 1);
}

}  // namespace
}  // namespace chironomia
