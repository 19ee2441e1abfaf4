// The faces of the test avatars, each by its own means, seen in where their vertices go.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/text.h"
#include "skinning/face/face_drive.h"
#include "skinning/face/face_map.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/skinning/face/face_figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using testing::face_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::posed_with;
using testing::test_file;

// The avatar without the names of its morphs, so that only the expressions of its VRM say what they are.
Avatar by_expressions(const std::string& file) {
    Avatar avatar = read_avatar(test_file(file));
    for (size_t m = 0; m < avatar.morph_names.size(); ++m) avatar.morph_names[m] = "morph";
    return avatar;
}

// The avatar with other names for the shapes of a smile.
Avatar renamed(const std::string& file, const char* left, const char* right) {
    Avatar avatar = read_avatar(test_file(file));
    for (std::string& name : avatar.morph_names) {
        name = name == "mouthSmileLeft" ? left : name == "mouthSmileRight" ? right : "morph";
    }
    return avatar;
}

struct SmileCase {
    std::string file;
    std::string name;
    Avatar (*avatar)(const std::string& file) = [](const std::string& file) {
        return read_avatar(test_file(file));
    };
};

class Smile : public ::testing::TestWithParam<SmileCase> {};

constexpr const char* kMakeHuman = "made/makehuman.glb";
constexpr const char* kVrm = "made/vrm.vrm";
constexpr const char* kSharedArkit = "../shared/data/avatars/tests/mh_neutral_arkit52.glb";
constexpr const char* kSharedMixamo = "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb";
constexpr const char* kSharedPoseUnits = "../shared/data/avatars/tests/mh_neutral_poseunits.glb";
constexpr const char* kSharedVrm = "../shared/data/avatars/tests/mh_neutral_vrm1.vrm";

// The corner of each side is the vertex of the skin that a smile moves most.
TEST_P(Smile, DrawsBothCornersOfTheMouthUpAndOutwards) {
    const Avatar avatar = GetParam().avatar(GetParam().file);
    const PosedMesh still = posed_with(avatar, face_of({{"AU12", 0}}));
    const PosedMesh smile = posed_with(avatar, face_of({{"AU12", 5}}));
    for (const float side : {1.0f, -1.0f}) {
        Vec3 most(0);
        for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
            for (size_t v = 0; v < still.surfaces[s].positions.size(); ++v) {
                const Vec3& from = still.surfaces[s].positions[v];
                const Vec3 move = smile.surfaces[s].positions[v] - from;
                if (from.x * side > 0.01f && length(move) > length(most)) most = move;
            }
        }
        EXPECT_GT(most.y, 0.003f) << side;
        EXPECT_GT(most.x * side, 0.001f) << side;
    }
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, Smile,
    ::testing::ValuesIn(testing::present<SmileCase>(
        {{"assets/avatars/neutral.glb", "Bundled"},
         {kMakeHuman, "Arkit"},
         {"made/mixamo.glb", "Mixamo"},
         {kVrm, "Vrm"},
         {kVrm, "VrmExpressions", by_expressions},
         {kMakeHuman, "OurOwn", [](const std::string& file) { return renamed(file, "AU12_L", "AU12_R"); }},
         {kMakeHuman, "OtherFacs",
          [](const std::string& file) { return renamed(file, "FACS_AU12_left", "FACS_AU12_right"); }},
         {kMakeHuman, "Daz",
          [](const std::string& file) {
              return renamed(file, "h_expressions.LsmileClose_h", "h_expressions.RsmileClose_h");
          }},
         {kMakeHuman, "CharacterCreator",
          [](const std::string& file) { return renamed(file, "Mouth_Smile_L", "Mouth_Smile_R"); }},
         {kMakeHuman, "MixamoFace",
          [](const std::string& file) { return renamed(file, "Smile_Left", "Smile_Right"); }},
         {kSharedArkit, "SharedArkit"},
         {kSharedMixamo, "SharedMixamo"},
         {kSharedPoseUnits, "SharedPoseUnits"},
         {kSharedVrm, "SharedVrm"},
         {kSharedVrm, "SharedVrmExpressions", by_expressions}})),
    [](const auto& test) { return test.param.name; });

TEST(TestAvatars, OneWithoutMorphsSaysThatItCannotSmile) {
    const Avatar avatar = read_avatar(test_file("made/numbered.glb"));
    const FaceReport report = drive_face(face_of({{"AU12", 5}}), avatar, {rest_pose(avatar)}).report;
    EXPECT_THAT(warnings_of(report),
                ElementsAre(HasSubstr("numbered.glb: cannot show AU12 lip corner puller: it has no morphs")));
}

// OpenFace's 17 units.
TEST(TestAvatars, ShowEveryUnitOfOpenFaceThatTheyHaveAShapeFor) {
    for (const std::string& file :
         testing::present({"assets/avatars/neutral.glb", kMakeHuman, "made/mixamo.glb", kVrm, kSharedArkit,
                           kSharedMixamo, kSharedPoseUnits, kSharedVrm})) {
        const Avatar avatar = read_avatar(test_file(file));
        const FaceMap map = map_face(avatar);
        for (const int unit : {1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 20, 23, 25, 26, 45})
            EXPECT_THAT(shown_by(map, avatar, {.unit = unit}), Not(IsEmpty())) << file << " AU" << unit;
    }
}

// How many vertices of the eyeballs a viewer in front sees past skin and lashes.
size_t seen_of_eyes(const Avatar& avatar, const PosedMesh& mesh) {
    size_t seen = 0;
    for (size_t e = 0; e < avatar.surfaces.size(); ++e) {
        if (to_lower(avatar.surfaces[e].name) != "eyes") continue;
        for (const Vec3& point : mesh.surfaces[e].positions) {
            bool covered = false;
            for (size_t s = 0; s < avatar.surfaces.size() && !covered; ++s) {
                const std::vector<std::uint32_t>& corners = avatar.surfaces[s].triangles;
                const std::vector<Vec3>& places = mesh.surfaces[s].positions;
                for (size_t t = 0; t + 2 < corners.size() && !covered; t += 3) {
                    const Vec3 &a = places[corners[t]], &b = places[corners[t + 1]],
                               &c = places[corners[t + 2]];
                    const auto area = [](const Vec3& p, const Vec3& q, const Vec3& r) {
                        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
                    };
                    const float u = area(point, b, c), v = area(a, point, c), w = area(a, b, point);
                    const bool inside = (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
                    if (!inside) continue;
                    const float z = (u * a.z + v * b.z + w * c.z) / (u + v + w);
                    covered = z > point.z + 1e-4f;
                }
            }
            seen += covered ? 0 : 1;
        }
    }
    return seen;
}

class Blink : public Smile {};

TEST_P(Blink, ClosesTheLidsFullyWhereverTheEyesLook) {
    const Avatar avatar = GetParam().avatar(GetParam().file);
    EXPECT_GE(seen_of_eyes(avatar, posed_with(avatar, face_of({{"AU45", 0}}))), 12u);
    for (const float up : {0.0f, 0.3f, -0.3f}) {
        FaceTrack track = face_of({{"AU45", 5}, {"AU5", 5}, {"AU7", 5}});
        track.gaze = {{.left = {0, up}, .right = {0, up}}};
        EXPECT_EQ(seen_of_eyes(avatar, posed_with(avatar, track)), 0u) << up;
    }
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, Blink,
    ::testing::ValuesIn(testing::present<SmileCase>({{"assets/avatars/neutral.glb", "Bundled"},
                                                     {kMakeHuman, "Arkit"},
                                                     {"made/mixamo.glb", "Mixamo"},
                                                     {kVrm, "Vrm"},
                                                     {kVrm, "VrmExpressions", by_expressions},
                                                     {kSharedArkit, "SharedArkit"},
                                                     {kSharedMixamo, "SharedMixamo"},
                                                     {kSharedPoseUnits, "SharedPoseUnits"},
                                                     {kSharedVrm, "SharedVrm"},
                                                     {kSharedVrm, "SharedVrmExpressions", by_expressions}})),
    [](const auto& test) { return test.param.name; });

TEST(Lids, FollowTheVerticalGaze) {
    // Where there is one, an avatar whose look shapes move its lids, too.
    const std::string file = testing::present({kSharedArkit, kMakeHuman}).front();
    for (const bool with_look_shapes : {true, false}) {
        Avatar avatar = read_avatar(test_file(file));
        for (std::string& name : avatar.morph_names) {
            if (!with_look_shapes && name.starts_with("eyeLook")) name = "morph";
        }
        const auto seen = [&](float up) {
            FaceTrack track;
            track.gaze = {{.left = {0, up}, .right = {0, up}}};
            return seen_of_eyes(avatar, posed_with(avatar, track));
        };
        EXPECT_LT(seen(-0.5f), seen(0)) << with_look_shapes;
        EXPECT_GT(seen(-0.5f), 0u) << with_look_shapes;
    }
}

// The families in their order: a shape of our own before ARKit's before an expression.
TEST(FaceMap, TakesTheFirstFamilyThatShowsAUnitOnASide) {
    const Avatar avatar = testing::faced_avatar({"AU12_L", "mouthSmileLeft", "mouthSmileRight", "browInnerUp",
                                                 "browInnerUpLeft", "browInnerUpRight"});
    const FaceMap map = map_face(avatar);
    EXPECT_THAT(shown_by(map, avatar, {.unit = 12}), ElementsAre("AU12_L", "mouthSmileRight"));
    EXPECT_THAT(shown_by(map, avatar, {.unit = 12, .side = FaceSide::right}), ElementsAre("mouthSmileRight"));
    EXPECT_THAT(shown_by(map, avatar, {.unit = 1}), ElementsAre("browInnerUpLeft", "browInnerUpRight"));
}

TEST(FaceMap, LeavesOutWhatItCouldOnlyHintAt) {
    const Avatar avatar = testing::faced_avatar({"jawOpen"});
    const FaceMap map = map_face(avatar);
    EXPECT_THAT(shown_by(map, avatar, {.unit = 26}), ElementsAre("jawOpen"));
    EXPECT_THAT(shown_by(map, avatar, {.unit = 25}), IsEmpty());
}

// As of a VRoid whose jawOpen moves nothing, and of Snap's lids, whose in-betweens lie on the way.
TEST(FaceMap, TakesMorphsThatMoveSomethingAndTheWhole) {
    Avatar avatar = testing::faced_avatar(
        {"jawOpen", "viseme_aa", "ai_eyeUpperClose_50_L", "ai_eyeUpperClose_L", "ai_eyeLowerClose_R"});
    for (Vec3& move : avatar.surfaces.at(0).morphs.at(0).moves) move = Vec3(0);
    const FaceMap map = map_face(avatar);
    EXPECT_THAT(shown_by(map, avatar, {.unit = 26}), ElementsAre("viseme_aa"));
    EXPECT_THAT(shown_by(map, avatar, {.unit = 45}), ElementsAre("ai_eyeUpperClose_L", "ai_eyeLowerClose_R"));
}

TEST(FaceMap, AJawThatGoesSidewaysNeedsASide) {
    const Avatar avatar = testing::faced_avatar({"jawLeft", "jawRight", "AU30"});
    EXPECT_THAT(shown_by(map_face(avatar), avatar, {.unit = 30}), ElementsAre("jawLeft", "jawRight"));
}

}  // namespace
}  // namespace chironomia
