// A hundred ways to write one figure, all read as the same; and two hundred kinds and places of damage, all refused.
#include "tests/skinning/gltf/made_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using testing::DamagedFigure;
using testing::FigureForm;
using ::testing::HasSubstr;
using testing::made_figure;
using ::testing::Not;
using testing::refusal_of;
using testing::TemporaryFolder;

constexpr size_t kValid = 100;
constexpr size_t kDamaged = 200;
constexpr float kTolerance = 2e-4f;  // [m]; shorts place a vertex to 0.03 mm

// Where the corners of all triangles are when the figure turns, raises an arm and smiles.
std::vector<Vec3> posed_corners(const Avatar& avatar) {
    Pose pose = rest_pose(avatar);
    for (size_t j = 0; j < pose.joints.size(); ++j) {
        const std::string& name = avatar.skeleton.joints[j].name;
        if (name == "mixamorig:LeftArm") pose.joints[j].rotation = glm::angleAxis(1.0f, Vec3(0, 0, 1));
        if (name == "mixamorig:Spine") pose.joints[j].rotation = glm::angleAxis(0.5f, Vec3(0, 1, 0));
    }
    for (float& weight : pose.morph_weights) weight = 1;
    const PosedMesh mesh = skin(avatar, pose);
    std::vector<Vec3> corners;
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        for (const std::uint32_t corner : avatar.surfaces[s].triangles)
            corners.push_back(mesh.surfaces[s].positions[corner]);
    }
    return corners;
}

class MadeFigures : public ::testing::Test {
  protected:
    Avatar read(const FigureForm& form) const {
        const auto file = folder_ / (form.as_text ? "x.gltf" : "x.glb");
        if (form.as_text)
            made_figure(form).write_gltf(file);
        else
            made_figure(form).write_glb(file);
        return read_avatar(file);
    }

    TemporaryFolder folder_;
};

TEST_F(MadeFigures, AreTheSameHoweverTheyAreWritten) {
    const std::vector<Vec3> plain = posed_corners(read({}));
    ASSERT_GT(plain.size(), 700u);
    const std::vector<std::string> kinds = testing::figure_kinds();
    for (size_t n = 0; n < kValid; ++n) {
        Random random(24, n);
        const std::string& kind = kinds[n % kinds.size()];
        SCOPED_TRACE(kind + " " + std::to_string(n));
        const Avatar avatar = read(testing::figure_form(kind, random));
        const std::vector<Vec3> corners = posed_corners(avatar);
        ASSERT_EQ(corners.size(), plain.size());
        for (size_t c = 0; c < corners.size(); ++c)
            ASSERT_LT(distance(corners[c], plain[c]), kTolerance) << c;
    }
}

TEST_F(MadeFigures, SayThatWeightsAreNormalised) {
    EXPECT_THAT(read(testing::figure_of_kind("double_weights")).humanoid_notes,
                Contains(HasSubstr("vertices sum to 2, not 1; they are normalised")));
    EXPECT_THAT(read(testing::figure_of_kind("low_weights")).humanoid_notes,
                Contains(HasSubstr("vertices sum to 0.4, not 1; they are normalised")));
    EXPECT_THAT(read(testing::figure_of_kind("byte_weights")).humanoid_notes,
                Not(Contains(HasSubstr("normalised"))));
}

TEST_F(MadeFigures, AreRefusedWhenTheyAreDamaged) {
    for (const DamagedFigure& figure : testing::damaged_figures(kDamaged, 24)) {
        SCOPED_TRACE(figure.kind);
        write_bytes(folder_ / "x.glb", std::as_bytes(std::span(figure.glb)));
        const std::string refusal = refusal_of([&] { read_avatar(folder_ / "x.glb"); });
        EXPECT_THAT(refusal, ::testing::StartsWith((folder_ / "x.glb").string() + ": "));
        EXPECT_THAT(refusal, HasSubstr(figure.message));
        EXPECT_THAT(refusal, HasSubstr("; ")) << "what to do";
    }
}

}  // namespace
}  // namespace chironomia
