// The faces of the test avatars, each by its own means, seen in where their vertices go.
#include <gmock/gmock.h>

#include <algorithm>

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
using testing::shared_data;

Avatar test_avatar(const std::string& name) {
    return read_avatar(shared_data("avatars/tests/" + name));
}

// The avatar without the names of its morphs, so that only the expressions of its VRM say what they are.
Avatar by_expressions() {
    Avatar avatar = test_avatar("mh_neutral_vrm1.vrm");
    for (size_t m = 0; m < avatar.morph_names.size(); ++m) avatar.morph_names[m] = "morph";
    return avatar;
}

// The avatar with other names for the shapes of a smile.
Avatar renamed(const char* left, const char* right) {
    Avatar avatar = test_avatar("mh_neutral_arkit52.glb");
    for (std::string& name : avatar.morph_names) {
        name = name == "mouthSmileLeft" ? left : name == "mouthSmileRight" ? right : "morph";
    }
    return avatar;
}

struct SmileCase {
    const char* name;
    Avatar (*avatar)();
};

class Smile : public ::testing::TestWithParam<SmileCase> {
  protected:
    void SetUp() override { SKIP_WITHOUT_SHARED_DATA("avatars/tests"); }
};

// The corner of each side is the vertex of the skin that a smile moves most.
TEST_P(Smile, DrawsBothCornersOfTheMouthUpAndOutwards) {
    const Avatar avatar = GetParam().avatar();
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
    ::testing::Values(SmileCase{"Arkit", [] { return test_avatar("mh_neutral_arkit52.glb"); }},
                      SmileCase{"Mixamo", [] { return test_avatar("mh_male_mixamo_arkit52.glb"); }},
                      SmileCase{"PoseUnits", [] { return test_avatar("mh_neutral_poseunits.glb"); }},
                      SmileCase{"Vrm", [] { return test_avatar("mh_neutral_vrm1.vrm"); }},
                      SmileCase{"VrmExpressions", by_expressions},
                      SmileCase{"OurOwn", [] { return renamed("AU12_L", "AU12_R"); }},
                      SmileCase{"OtherFacs", [] { return renamed("FACS_AU12_left", "FACS_AU12_right"); }},
                      SmileCase{"Daz",
                                [] {
                                    return renamed("h_expressions.LsmileClose_h",
                                                   "h_expressions.RsmileClose_h");
                                }},
                      SmileCase{"CharacterCreator", [] { return renamed("Mouth_Smile_L", "Mouth_Smile_R"); }},
                      SmileCase{"MixamoFace", [] { return renamed("Smile_Left", "Smile_Right"); }}),
    [](const auto& test) { return test.param.name; });

TEST(TestAvatars, CesiumManSaysThatItCannotSmile) {
    SKIP_WITHOUT_SHARED_DATA("avatars/tests");
    const Avatar avatar = test_avatar("CesiumMan.glb");
    const FaceReport report = drive_face(face_of({{"AU12", 5}}), avatar, {rest_pose(avatar)}).report;
    EXPECT_THAT(
        warnings_of(report),
        ElementsAre(HasSubstr("CesiumMan.glb: cannot show AU12 lip corner puller: it has no morphs")));
}

// What of OpenFace's 17 units the avatars of the test set cannot show; the faces of the other rows are whole.
TEST(TestAvatars, ShowEveryUnitOfOpenFaceThatTheyHaveAShapeFor) {
    SKIP_WITHOUT_SHARED_DATA("avatars/tests");
    for (const char* name : {"mh_neutral_arkit52.glb", "mh_male_mixamo_arkit52.glb",
                             "mh_neutral_poseunits.glb", "mh_neutral_vrm1.vrm"}) {
        const Avatar avatar = test_avatar(name);
        const FaceMap map = map_face(avatar);
        for (const int unit : {1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 20, 23, 25, 26, 45})
            EXPECT_THAT(shown_by(map, avatar, {.unit = unit}), Not(IsEmpty())) << name << " AU" << unit;
    }
}

// How many vertices of the eyeballs a viewer in front sees past skin and lashes.
size_t seen_of_eyes(const Avatar& avatar, const PosedMesh& mesh) {
    size_t seen = 0;
    for (size_t e = 0; e < avatar.surfaces.size(); ++e) {
        if (avatar.surfaces[e].name != "Eyes") continue;
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
    const Avatar avatar = GetParam().avatar();
    EXPECT_GE(seen_of_eyes(avatar, posed_with(avatar, face_of({{"AU45", 0}}))), 12u);
    for (const float up : {0.0f, 0.3f, -0.3f}) {
        FaceTrack track = face_of({{"AU45", 5}, {"AU5", 5}, {"AU7", 5}});
        track.gaze = {{.left = {0, up}, .right = {0, up}}};
        EXPECT_EQ(seen_of_eyes(avatar, posed_with(avatar, track)), 0u) << up;
    }
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, Blink,
    ::testing::Values(SmileCase{"Arkit", [] { return test_avatar("mh_neutral_arkit52.glb"); }},
                      SmileCase{"Mixamo", [] { return test_avatar("mh_male_mixamo_arkit52.glb"); }},
                      SmileCase{"PoseUnits", [] { return test_avatar("mh_neutral_poseunits.glb"); }},
                      SmileCase{"Vrm", [] { return test_avatar("mh_neutral_vrm1.vrm"); }},
                      SmileCase{"VrmExpressions", by_expressions}),
    [](const auto& test) { return test.param.name; });

TEST(Lids, FollowTheVerticalGaze) {
    SKIP_WITHOUT_SHARED_DATA("avatars/tests");
    for (const bool with_look_shapes : {true, false}) {
        Avatar avatar = test_avatar("mh_neutral_arkit52.glb");
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

TEST(FaceMap, AJawThatGoesSidewaysNeedsASide) {
    const Avatar avatar = testing::faced_avatar({"jawLeft", "jawRight", "AU30"});
    EXPECT_THAT(shown_by(map_face(avatar), avatar, {.unit = 30}), ElementsAre("jawLeft", "jawRight"));
}

}  // namespace
}  // namespace chironomia
