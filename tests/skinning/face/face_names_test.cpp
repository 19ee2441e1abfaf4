#include "skinning/face/face_names.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

struct Reading {
    const char* name;
    int unit;
    FaceSide side = FaceSide::both;
    NameFamily family = NameFamily::arkit;
    float weight = 1;
};

class ShapeName : public ::testing::TestWithParam<Reading> {};

TEST_P(ShapeName, HasUnitSideAndFamily) {
    const ShapeMeaning meaning = read_shape_name(GetParam().name);
    EXPECT_EQ(meaning.side, GetParam().side);
    EXPECT_EQ(meaning.family, GetParam().family);
    float weight = 0;
    for (const UnitShare& share : meaning.units) {
        if (share.unit == GetParam().unit) weight = share.weight;
    }
    EXPECT_FLOAT_EQ(weight, GetParam().weight) << GetParam().name;
}

constexpr auto kLeft = FaceSide::left, kRight = FaceSide::right, kBoth = FaceSide::both;

INSTANTIATE_TEST_SUITE_P(
    Names, ShapeName,
    ::testing::Values(
        // our own, and other tools' FACS
        Reading{"AU12_L", 12, kLeft, NameFamily::facs}, Reading{"AU17", 17, kBoth, NameFamily::facs},
        Reading{"FACS_AU12", 12, kBoth, NameFamily::facs}, Reading{"AU_12_left", 12, kLeft, NameFamily::facs},
        Reading{"au_01_r", 1, kRight, NameFamily::facs},
        Reading{"AU_12_L_LipCornerPuller", 12, kLeft, NameFamily::facs},
        Reading{"lipCornerPullerR", 12, kRight, NameFamily::facs},
        Reading{"InnerBrowRaise_R", 1, kRight, NameFamily::facs},
        Reading{"NoseWrinkle_L", 9, kLeft, NameFamily::facs},
        Reading{"CTRL_expressions_mouthCornerPullL", 12, kLeft, NameFamily::other},
        // ARKit in its usual spellings
        Reading{"mouthSmileLeft", 12, kLeft}, Reading{"mouthSmile_L", 12, kLeft},
        Reading{"MouthSmileL", 12, kLeft}, Reading{"mouthsmileleft", 12, kLeft},
        Reading{"EYE_BLINK_RIGHT", 45, kRight}, Reading{"blendShape1.eyeBlink_R", 45, kRight},
        Reading{"browInnerUp", 1}, Reading{"AK_25_JawOpen", 26, kBoth, NameFamily::arkit, .7f},
        Reading{"A14_Eye_Blink_Left", 45, kLeft}, Reading{"jawLeft", 30, kLeft},
        Reading{"Jaw_Right", 30, kRight}, Reading{"mouthLowerDownLeft", 25, kLeft, NameFamily::arkit, .5f},
        // other tools
        Reading{"BrowsD_L", 4, kLeft, NameFamily::other}, Reading{"BrowsU_C", 1, kBoth, NameFamily::other},
        Reading{"Facial_Blends.Smile_Left", 12, kLeft, NameFamily::other},
        Reading{"BrowsUp_Right", 2, kRight, NameFamily::other},
        Reading{"Brow_Raise_Inner_L", 1, kLeft, NameFamily::other},
        Reading{"Cheek_Raise_R", 6, kRight, NameFamily::facs}, Reading{"Mouth_Dimple_R", 14, kRight},
        Reading{"Cheek_Raise_L", 6, kLeft, NameFamily::facs}, Reading{"mouthDimpleR", 14, kRight},
        Reading{"mouthSmile.L", 12, kLeft}, Reading{"Key.browDown.R", 4, kRight},
        Reading{"mouthClose", 8, kBoth, NameFamily::arkit, .7f},
        Reading{"face_shapes.ai_eyeUpperClose_L", 45, kLeft, NameFamily::other},
        Reading{"jawOpen.001", 26, kBoth, NameFamily::arkit, .7f},
        Reading{"h_expressions.LsmileClose_h", 12, kLeft, NameFamily::other},
        Reading{"h_expressions.ReyeClose_h", 45, kRight, NameFamily::other},
        Reading{"h_expressions.Ljaw_h", 30, kLeft, NameFamily::other},
        Reading{"h_expressions.MouthOpen_h", 26, kBoth, NameFamily::other, .7f},
        Reading{"Face.M_F00_000_00_Fcl_EYE_Close_L", 45, kLeft, NameFamily::other},
        Reading{"Face.M_F00_000_00_Fcl_MTH_A", 26, kBoth, NameFamily::other, .7f},
        Reading{"eye-left-closure", 45, kLeft, NameFamily::other},
        Reading{"mouth-corner-puller", 12, kBoth, NameFamily::other},
        // MikuMikuDance
        Reading{"あ", 26, kBoth, NameFamily::expression},
        Reading{"い", 20, kBoth, NameFamily::expression, .7f},
        Reading{"う", 18, kBoth, NameFamily::expression}, Reading{"お", 22, kBoth, NameFamily::expression},
        Reading{"まばたき", 45, kBoth, NameFamily::facs}, Reading{"ウィンク", 45, kLeft, NameFamily::facs},
        Reading{"ｳｨﾝｸ２右", 45, kRight, NameFamily::facs}, Reading{"びっくり", 5}, Reading{"怒り", 4},
        Reading{"口角上げ", 12}, Reading{"困る", 1},
        // VRM 0 without its extension, and VRChat
        Reading{"A", 26, kBoth, NameFamily::expression}, Reading{"Blink_L", 45, kLeft, NameFamily::facs},
        Reading{"Joy", 12, kBoth, NameFamily::expression},
        Reading{"Sorrow", 15, kBoth, NameFamily::expression},
        Reading{"vrc.v_aa", 26, kBoth, NameFamily::expression},
        Reading{"vrc.blink_left", 45, kLeft, NameFamily::facs}));

TEST(ShapeName, OfNothingKnownSaysNothing) {
    for (const char* name :
         {"", "morph 3", "mouthLeft", "doublechin", "AU99", "AU6_AU12", "viseme_PP", "basis", "AE_AA_h",
          "face_shapes.ca_jawOpen", "jawOpen_mouthSmileLeft", "corrective_jawOpen_mouthSmile_R",
          "h_expressions.FV_h", "jaunty", "Fcl_ALL_Joy", "え", "笑い", "e"}) {
        const ShapeMeaning meaning = read_shape_name(name);
        EXPECT_TRUE(meaning.units.empty()) << name;
        EXPECT_EQ(meaning.look, Look::none) << name;
    }
}

struct LookReading {
    const char* name;
    Look look;
    FaceSide side;
};

TEST(ShapeName, FindsWhereAnEyeLooks) {
    for (const LookReading& reading :
         {LookReading{"eyeLookUpLeft", Look::up, kLeft}, LookReading{"eyeLookIn_R", Look::in, kRight},
          LookReading{"Eye_L_Look_R", Look::right, kLeft}, LookReading{"Eye_R_Look_Down", Look::down, kRight},
          LookReading{"eyesLookDown", Look::down, kBoth}, LookReading{"lookLeft", Look::left, kBoth},
          LookReading{"EyeOut_L", Look::out, kLeft}}) {
        const ShapeMeaning meaning = read_shape_name(reading.name);
        EXPECT_EQ(meaning.look, reading.look) << reading.name;
        EXPECT_EQ(meaning.side, reading.side) << reading.name;
    }
}

TEST(ExpressionName, StandsForItsMostTypicalUnit) {
    for (const auto& [name, unit] :
         {std::pair("happy", 12), std::pair("angry", 4), std::pair("sad", 15), std::pair("surprised", 2),
          std::pair("aa", 26), std::pair("ou", 18), std::pair("viseme_aa", 26), std::pair("viseme_U", 18),
          std::pair("viseme_O", 22)}) {
        const ShapeMeaning meaning = read_expression_name(name);
        EXPECT_EQ(meaning.family, NameFamily::expression) << name;
        float most = 0;
        for (const UnitShare& share : meaning.units) {
            if (share.unit == unit) most = share.weight;
        }
        EXPECT_FLOAT_EQ(most, 1) << name;
    }
    EXPECT_EQ(read_expression_name("blinkLeft").side, kLeft);
    EXPECT_EQ(read_expression_name("lookUp").look, Look::up);
    EXPECT_TRUE(read_expression_name("relaxed").units.empty());
}

}  // namespace
}  // namespace chironomia
