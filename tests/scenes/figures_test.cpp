#include "scenes/figures.h"

#include <gtest/gtest.h>

#include "core/body/rest.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/scenes/stick_figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::stick_figure;

const Avatar& mannequin() {
    static const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    return avatar;
}

// The head of the posture turned, so that not all joints rest.
Pose nodding(const Avatar& avatar) {
    Pose pose = rest_pose(avatar);
    const auto head = static_cast<std::size_t>(avatar.humanoid[HumanJoint::head]);
    pose.joints[head].rotation = pose.joints[head].rotation * glm::angleAxis(0.3f, Vec3(1, 0, 0));
    return pose;
}

void expect_near(const PosedMesh& a, const PosedMesh& b, float tolerance) {
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
        ASSERT_EQ(a.surfaces[s].positions.size(), b.surfaces[s].positions.size());
        for (std::size_t v = 0; v < a.surfaces[s].positions.size(); ++v) {
            ASSERT_LE(distance(a.surfaces[s].positions[v], b.surfaces[s].positions[v]), tolerance);
            ASSERT_LE(distance(a.surfaces[s].normals[v], b.surfaces[s].normals[v]), 10 * tolerance);
        }
    }
}

TEST(WorldFromFigure, BringsTheShouldersOverThePlaceAndTurnsToTheHeading) {
    // A figure that faces +x and stands a metre above its place in the file.
    Avatar avatar = stick_figure(2, kPi / 2);
    avatar.skeleton.joints[0].rest.translation = {3, 1, 0};
    const FigureMeasures figure = measure_figure(avatar);
    const Transform place = world_from_figure(figure, {.x = -0.5f, .z = 2, .heading = -kPi / 2});
    const Mat4 world = to_matrix(place);
    EXPECT_LT(distance(Vec3(world * Vec4(3, 1, 0, 1)), Vec3(-0.5f, 0, 2)), 1e-5f);
    // From facing the viewer's right it turns about, to the viewer's left.
    EXPECT_LT(distance(Mat3(world) * Vec3(1, 0, 0), Vec3(-1, 0, 0)), 1e-5f);
    EXPECT_LT(distance(Mat3(world) * Vec3(0, 1, 0), Vec3(0, 1, 0)), 1e-6f);
}

TEST(JoinFigures, ScalesAFigureButNotItsNormals) {
    const Avatar* figure = &mannequin();
    const Transform small{.translation = {1, 0, 0}, .scale = Vec3(0.01f)};
    const PosedMesh posed = skin(mannequin(), rest_pose(mannequin()));
    const PosedMesh joined = join_meshes(std::span(&posed, 1), std::span(&small, 1));
    EXPECT_EQ(joined.surfaces[0].normals, posed.surfaces[0].normals);
    EXPECT_EQ(joined.surfaces[0].positions[7], posed.surfaces[0].positions[7] * 0.01f + Vec3(1, 0, 0));
    expect_near(rest_mesh(join_figures(std::span(&figure, 1), std::span(&small, 1))), joined, 1e-6f);
}

TEST(JoinFigures, AFigureAloneStaysWhatItIs) {
    const Avatar* figure = &mannequin();
    const Transform here;
    const Avatar alone = join_figures(std::span(&figure, 1), std::span(&here, 1));
    expect_near(rest_mesh(alone), rest_mesh(mannequin()), 0);
    const PosedMesh posed = skin(mannequin(), nodding(mannequin()));
    expect_near(join_meshes(std::span(&posed, 1), std::span(&here, 1)), posed, 0);
}

// Two ways: the joined avatar skinned as a whole, and each figure skinned by itself and then moved.
TEST(JoinFigures, SkinsAsItsFiguresDo) {
    const Avatar small = stick_figure(1.5f, 1);
    const Avatar* figures[] = {&mannequin(), &small};
    const Pose poses[] = {nodding(mannequin()), rest_pose(small)};
    const Transform places[] = {
        {.translation = {-0.7f, 0, 0.2f}, .rotation = glm::angleAxis(0.9f, Vec3(0, 1, 0))},
        {.translation = {0.7f, 0, 0}, .rotation = glm::angleAxis(-0.9f, Vec3(0, 1, 0))}};
    const Avatar both = join_figures(figures, places);
    Pose pose;
    for (const int i : {0, 1}) {
        pose.joints.push_back(places[i]);
        pose.joints.insert(pose.joints.end(), poses[i].joints.begin(), poses[i].joints.end());
        pose.morph_weights.insert(pose.morph_weights.end(), poses[i].morph_weights.begin(),
                                  poses[i].morph_weights.end());
    }
    const PosedMesh apart[] = {skin(mannequin(), poses[0]), skin(small, poses[1])};
    expect_near(skin(both, pose), join_meshes(apart, places), 1e-5f);
    EXPECT_EQ(both.surfaces.front().figure, 0);
    EXPECT_EQ(both.surfaces.back().figure, 1);
    EXPECT_EQ(both.source, mannequin().source + " + stick figure");
}

TEST(JoinFigures, KeepsImagesThatAreAlikeOnce) {
    Avatar person = stick_figure(1.7f);
    person.images = {{.name = "skin", .width = 1, .height = 1, .rgba = {1, 2, 3, 255}},
                     {.name = "shirt", .width = 1, .height = 1, .rgba = {4, 5, 6, 255}}};
    person.materials.resize(2);
    person.materials[0].base_colour_texture.image = 0;
    person.materials[1].base_colour_texture.image = 1;
    person.surfaces[0].material = 1;
    Avatar other = person;
    other.images[1].rgba[0] = 7;
    const Avatar* figures[] = {&person, &other};
    const Avatar both = join_figures(figures, std::vector<Transform>(2));
    ASSERT_EQ(both.images.size(), 3u);
    EXPECT_EQ(both.surfaces[1].material, 3);
    EXPECT_EQ(both.materials[2].base_colour_texture.image, 0);
    EXPECT_EQ(both.materials[3].base_colour_texture.image, 2);
    EXPECT_EQ(both.images[2].rgba[0], 7);
}

// Morph weights, skins and joints of the second figure lie behind those of the first.
TEST(JoinFigures, CountsOnBehindTheFirstFigure) {
    Avatar person = stick_figure(1.7f);
    person.rest_morph_weights = {0.25f, 0.5f};
    person.morph_names = {"smile", "frown"};
    person.surfaces[0].joint = -1;
    person.skins.push_back({.name = "skin", .joints = {0, 2}, .joint_from_mesh = {Mat4(1), Mat4(1)}});
    const Avatar* figures[] = {&person, &person};
    const Avatar both = join_figures(figures, std::vector<Transform>(2));
    const int joints = static_cast<int>(person.skeleton.joints.size());
    EXPECT_EQ(both.surfaces[1].first_morph_weight, 2);
    EXPECT_EQ(both.rest_morph_weights, (std::vector<float>{0.25f, 0.5f, 0.25f, 0.5f}));
    EXPECT_EQ(both.humanoid[HumanJoint::head], person.humanoid[HumanJoint::head] + 1);
    ASSERT_EQ(both.more_humanoids.size(), 1u);
    EXPECT_EQ(both.more_humanoids[0][HumanJoint::head], person.humanoid[HumanJoint::head] + joints + 2);
    EXPECT_EQ(both.skins[1].joints, (std::vector<int>{joints + 2, joints + 4}));
    // What hangs on no joint hangs on the place.
    EXPECT_EQ(both.surfaces[0].joint, 0);
    EXPECT_EQ(both.surfaces[1].joint, joints + 1);
    EXPECT_EQ(both.skeleton.joints[static_cast<std::size_t>(joints) + 2].parent, joints + 1);
}

}  // namespace
}  // namespace chironomia
