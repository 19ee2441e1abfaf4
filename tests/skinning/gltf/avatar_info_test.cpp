#include "skinning/gltf/avatar_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::test_file;

TEST(DescribeAvatar, DescribesTheMannequin) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const Json description = describe_avatar(avatar);
    EXPECT_NEAR(description["height_m"].get<double>(), 1.72, 0.01);
    EXPECT_NEAR(description["facing_deg"].get<double>(), 0, 1);
    EXPECT_EQ(description["humanoid"]["left_upper_arm"], "left_upper_arm");
    EXPECT_EQ(description["joints"].get<size_t>(), avatar.skeleton.joints.size());
    EXPECT_THAT(description["missing"], Contains("jaw"));
}

TEST(DescribeAvatar, PrintsThePartsUnderOneAnother) {
    const std::string text = avatar_text(describe_avatar(read_avatar(test_file("made/mixamo.glb"))));
    EXPECT_THAT(text, HasSubstr("height        1.776 m\n"));
    EXPECT_THAT(text, HasSubstr("mesh          14 surfaces, 29661 triangles"));
    EXPECT_THAT(text, HasSubstr("\n  left_upper_arm      mixamorig:LeftArm\n"));
    EXPECT_THAT(text, HasSubstr("browDownLeft"));
    EXPECT_THAT(text, HasSubstr("missing       jaw, left_eye, right_eye\n"));
}

}  // namespace
}  // namespace chironomia
