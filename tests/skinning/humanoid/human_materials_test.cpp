#include "skinning/humanoid/human_materials.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

HumanMaterial kind_of(const std::string& name, const Vec4& colour = {0.6f, 0.35f, 0.25f, 1}) {
    return human_material_of({.name = name, .base_colour = colour}, {});
}

TEST(HumanMaterials, AreKnownByTheWordsOfTheirNames) {
    for (const char* name : {"Skin", "skin", "Wolf3D_Skin", "N00_000_00_Body_00_SKIN", "MI_SkinArms"})
        EXPECT_EQ(kind_of(name), HumanMaterial::skin) << name;
    for (const char* name : {"Eye", "eyes", "Wolf3D_Eye", "EyeLeft", "eye_R", "N00_000_00_EyeIris_00_EYE"})
        EXPECT_EQ(kind_of(name), HumanMaterial::eye) << name;
    for (const char* name : {"Teeth", "Wolf3D_Teeth", "tooth_L"})
        EXPECT_EQ(kind_of(name), HumanMaterial::teeth) << name;
    for (const char* name : {"tongue", "Gums"}) EXPECT_EQ(kind_of(name), HumanMaterial::mouth) << name;
    for (const char* name : {"", "skinny", "hair", "HairSkin", "Eyebrows", "eye_lashes", "EyeShadow",
                             "glasses", "shirt", "BodySuit", "Cesium_Man-effect", "eyelet"})
        EXPECT_EQ(kind_of(name), HumanMaterial::other) << name;
}

TEST(HumanMaterials, CallBodySkinOnlyIfItsColourIs) {
    EXPECT_EQ(kind_of("Body", {0.8f, 0.5f, 0.37f, 1}), HumanMaterial::skin);      // light
    EXPECT_EQ(kind_of("Head", {0.09f, 0.035f, 0.018f, 1}), HumanMaterial::skin);  // dark
    EXPECT_EQ(kind_of("Body", {0.1f, 0.2f, 0.5f, 1}), HumanMaterial::other);      // denim
    EXPECT_EQ(kind_of("Body", {0.5f, 0.5f, 0.5f, 1}), HumanMaterial::other);      // grey
    EXPECT_EQ(kind_of("Body", {0.9f, 0.02f, 0.01f, 1}), HumanMaterial::other);    // signal red
}

TEST(HumanMaterials, LookAtTheTextureWhereThereIsOne) {
    Image image{.name = "half", .width = 2, .height = 1, .rgba = {40, 60, 140, 255, 210, 160, 130, 255}};
    const Material body{.name = "Body", .base_colour_texture = {.image = 0}};
    EXPECT_EQ(human_material_of(body, {image}), HumanMaterial::other);  // half is not most
    image.rgba = {0, 0, 0, 255, 210, 160, 130, 255};                    // black lies outside the mesh
    EXPECT_EQ(human_material_of(body, {image}), HumanMaterial::skin);
    image.rgba = {0, 0, 0, 255, 0, 0, 0, 255};
    EXPECT_EQ(human_material_of(body, {image}), HumanMaterial::other);
}

TEST(HumanMaterials, GiveSkinAndTeethScatterAndEyesACoat) {
    Avatar avatar;
    avatar.materials = {{.name = "skin", .metallic = 0},
                        {.name = "eyes", .metallic = 0},
                        {.name = "shirt"},
                        {.name = "teeth", .metallic = 0}};
    finish_human_materials(avatar);
    EXPECT_GT(avatar.materials[0].scatter.r, avatar.materials[0].scatter.b);
    EXPECT_FLOAT_EQ(avatar.materials[1].coat, 1);
    EXPECT_FLOAT_EQ(avatar.materials[2].coat, 0);
    EXPECT_EQ(avatar.materials[2].scatter, Vec3(0));
    EXPECT_EQ(avatar.materials[3].scatter, Vec3(0.6f)) << "all colours alike";
    EXPECT_GT(avatar.materials[3].coat, 0);
}

TEST(HumanMaterials, SayWhatLiesInTheMouth) {
    Avatar avatar;
    avatar.materials = {{.name = "Wolf3D_Teeth", .unlit = true}, {.name = "skin"}};
    finish_human_materials(avatar);
    EXPECT_TRUE(avatar.materials[0].in_mouth);
    EXPECT_FALSE(avatar.materials[1].in_mouth);
}

TEST(HumanMaterials, LeaveWhatTheFileSaysItself) {
    Avatar avatar;
    avatar.materials = {{.name = "skin", .metallic = 0, .scatter = {0.1f, 0, 0}},
                        {.name = "eyes", .metallic = 0, .coat = 0.5f},
                        {.name = "skin", .metallic = 0, .unlit = true},
                        {.name = "body", .metallic = 1}};
    finish_human_materials(avatar);
    EXPECT_EQ(avatar.materials[0].scatter, Vec3(0.1f, 0, 0));
    EXPECT_FLOAT_EQ(avatar.materials[0].coat, 0);
    EXPECT_FLOAT_EQ(avatar.materials[1].coat, 0.5f);
    EXPECT_EQ(avatar.materials[2].scatter, Vec3(0));
    EXPECT_EQ(avatar.materials[3].scatter, Vec3(0));
}

}  // namespace
}  // namespace chironomia
