#include "synth/corpus/face_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace chironomia {
namespace {

using ::testing::ElementsAre;

TEST(OpenFaceAngles, GiveEachTurnOfAHeadByOneAngle) {
    // Looking down, to its own right (x < 0), and leaning to its own left shoulder.
    EXPECT_LT((head_of_openface({0.3f, 0, 0}) * Vec3(0, 0, 1)).y, -0.29f);
    EXPECT_LT((head_of_openface({0, 0.3f, 0}) * Vec3(0, 0, 1)).x, -0.29f);
    EXPECT_GT((head_of_openface({0, 0, 0.3f}) * Vec3(0, 1, 0)).x, 0.29f);
    const Vec3 down = openface_angles(glm::angleAxis(0.4f, Vec3(1, 0, 0)));
    EXPECT_LT(distance(down, Vec3(0.4f, 0, 0)), 1e-6f);
}

TEST(OpenFaceAngles, ComeBackFromTheTurnThatTheyMake) {
    for (const Vec3& angles : {Vec3(0.3f, -0.2f, 0.1f), Vec3(-1.2f, 1.4f, -0.9f), Vec3(0.01f, 0, 2)})
        EXPECT_LT(distance(openface_angles(head_of_openface(angles)), angles), 2e-6f);
}

TEST(OpenFaceAngles, MakeTheTurnThatTheyCameFromLookingStraightToASide) {
    const Quat head = head_of_openface({0.3f, kPi / 2, 0.2f});
    EXPECT_LT(angle_between(head_of_openface(openface_angles(head)), head), 2e-3f);
}

TEST(OpenFaceGaze, IsAgainstTheCamera) {
    // A head turned to its right by 0.3 with eyes turned as far to its left looks into the camera.
    const Quat head = head_of_openface({0, 0.3f, 0});
    const Vec2 into_camera = openface_gaze({{0.3f, 0}, {0.3f, 0}}, head);
    EXPECT_NEAR(into_camera.x, 0, 1e-6);
    EXPECT_NEAR(into_camera.y, 0, 1e-6);
    // Eyes up: y grows downwards.
    EXPECT_NEAR(openface_gaze({{0, 0.2f}, {0, 0.2f}}, kNoTurn).y, -0.2f, 1e-6);
}

TEST(OpenFaceGaze, ComesBackFromTheGazeThatItMakes) {
    const Quat head = head_of_openface({0.2f, -0.4f, 0.1f});
    const Vec2 angles = {0.25f, -0.1f};
    const Vec2 back = openface_gaze(gaze_of_openface(angles, head), head);
    EXPECT_NEAR(back.x, angles.x, 1e-6);
    EXPECT_NEAR(back.y, angles.y, 1e-6);
}

TEST(IntensitiesOf, TakesTheLargerSideAndZeroForWhatIsNotThere) {
    const FaceTrack face{.channels = {{12, FaceSide::left}, {1, FaceSide::both}, {12, FaceSide::right}},
                         .intensities = {1, 2, 3, 4, 0.5f, 0}};
    constexpr std::array kUnits = {1, 12, 45};
    EXPECT_THAT(intensities_of(face, 2, kUnits), ElementsAre(2, 3, 0, 0.5f, 4, 0));
}

}  // namespace
}  // namespace chironomia
