#include "synth/corpus/face_points.h"

#include <gtest/gtest.h>

#include "synth/corpus/make/camera.h"

namespace chironomia {
namespace {

FacePoints points_with(std::vector<FaceChannel> channels, std::vector<float> intensities) {
    return place_face_points({.channels = std::move(channels), .intensities = std::move(intensities)}, 0);
}

TEST(FacePoints, AreAFaceOfPairs) {
    const FacePoints face = points_with({}, {});
    const auto expect_pair = [&](std::size_t right, std::size_t left) {
        EXPECT_LT(face[right].x, 0) << right;
        EXPECT_EQ(face[left], Vec3(-face[right].x, face[right].y, face[right].z)) << right << " and " << left;
    };
    for (std::size_t i = 0; i < 8; ++i) expect_pair(i, 16 - i);
    for (std::size_t i = 17; i < 22; ++i) expect_pair(i, 43 - i);
    expect_pair(36, 45);
    expect_pair(39, 42);
    expect_pair(48, 54);
    expect_pair(kRightPupil, kLeftPupil);
    EXPECT_NEAR(face[kLeftPupil].x - face[kRightPupil].x, 0.064, 1e-6);
    EXPECT_GT(face[19].y, face[37].y) << "brows are above lids";
    EXPECT_GT(face[37].y, face[41].y) << "upper lids above lower ones";
    EXPECT_GT(face[33].y, face[51].y) << "the nose above the mouth";
    EXPECT_GT(face[57].y, face[8].y) << "the mouth above the chin";
    EXPECT_GT(face[kNoseTip].z, face[27].z) << "the tip of the nose stands out";
}

TEST(FacePoints, MoveWithActionUnits) {
    const FacePoints rest = points_with({}, {});
    const FacePoints smile = points_with({{.unit = 12}}, {5});
    EXPECT_GT(smile[48].y, rest[48].y + 0.005);
    EXPECT_LT(smile[48].x, rest[48].x - 0.005);
    EXPECT_GT(smile[54].x, rest[54].x + 0.005);
    EXPECT_GT(points_with({{.unit = 1}}, {5})[22].y, rest[22].y + 0.008);
    EXPECT_EQ(points_with({{.unit = 1}}, {5})[17], rest[17]);
    EXPECT_GT(points_with({{.unit = 2}}, {5})[17].y, rest[17].y + 0.006);
    EXPECT_LT(points_with({{.unit = 26}}, {5})[8].y, rest[8].y - 0.015);
    const FacePoints wink = points_with({{.unit = 45, .side = FaceSide::left}}, {5});
    EXPECT_EQ(wink[43].y, wink[47].y);
    EXPECT_EQ(wink[44].y, wink[46].y);
    EXPECT_EQ(wink[37], rest[37]);
}

TEST(FacePoints, LookWhereTheEyesLook) {
    const FacePoints rest = points_with({}, {});
    const FacePoints face = place_face_points(
        {.channels = {}, .intensities = {}, .gaze = {{.left = {0.3f, 0}, .right = {0.3f, 0.2f}}}}, 0);
    EXPECT_GT(face[kLeftPupil].x, rest[kLeftPupil].x + 0.003);
    EXPECT_GT(face[kRightPupil].y, rest[kRightPupil].y + 0.002);
    EXPECT_EQ(face[36], rest[36]);
}

TEST(FarCamera, ShowsThePersonsRightOnTheLeftAndDownAsMore) {
    const Vec3 neck(0, 1.4f, 0);
    const Vec2 right = seen_from({.yaw = 0, .scale = 500}, {-0.2f, 1.4f, 0.1f}, neck);
    EXPECT_NEAR(right.x, -100, 1e-3);
    EXPECT_NEAR(right.y, 0, 1e-3);
    EXPECT_NEAR(seen_from({.yaw = 0, .scale = 500}, {0, 1.2f, 0}, neck).y, 100, 1e-3);
    // From the person's left what is in front goes to the left of the picture.
    EXPECT_NEAR(seen_from({.yaw = radians(30.0), .scale = 500}, {0, 1.4f, 0.2f}, neck).x, -50, 1e-3);
}

}  // namespace
}  // namespace chironomia
