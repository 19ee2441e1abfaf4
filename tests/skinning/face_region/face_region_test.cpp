#include "skinning/face_region/face_region.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/body/rest.h"
#include "core/files/files.h"
#include "core/text.h"
#include "skinning/gltf/gltf.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::test_file;

Bounds bounds_of_surface(const Avatar& avatar, const std::string& name) {
    const PosedMesh rest = rest_mesh(avatar);
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        if (avatar.surfaces[s].name == name) return bounds_of(PosedMesh{{rest.surfaces[s]}});
    }
    ADD_FAILURE() << "no surface " << name;
    return {};
}

// What every face has: nothing of it lies lower than the throat or behind the ears, and it is seen from the
// front on both sides.
void expect_a_face(const Avatar& avatar, const FaceRegion& face) {
    const PosedMesh rest = rest_mesh(avatar);
    EXPECT_GT(face.eyes.y, face.mouth.y);
    EXPECT_GT(face.mouth.y, face.chin.y);
    Vec3 low(1e9f), high(-1e9f);
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        ASSERT_EQ(face.parts[s].size(), avatar.surfaces[s].positions.size());
        for (size_t v = 0; v < face.parts[s].size(); ++v) {
            if (face.parts[s][v] < FacePart::face) continue;
            low = glm::min(low, rest.surfaces[s].positions[v]);
            high = glm::max(high, rest.surfaces[s].positions[v]);
        }
    }
    EXPECT_LT(low.y, face.chin.y + 0.02f * face.height);
    EXPECT_GT(low.y, face.chin.y - 0.12f * face.height);
    EXPECT_GT(high.y, face.eyes.y + 0.2f * face.height);
    EXPECT_LT(high.y, face.chin.y + 1.05f * face.height);
    EXPECT_GT(high.x - low.x, 0.6f * face.height);
    EXPECT_NEAR(low.x + high.x, 2 * face.middle.x, 0.1f * face.height);
}

size_t count(const FaceRegion& face, FacePart part) {
    size_t sum = 0;
    for (const auto& parts : face.parts)
        sum += static_cast<size_t>(std::count(parts.begin(), parts.end(), part));
    return sum;
}

struct Made {
    std::string file;
    std::string eyes;
};

void PrintTo(const Made& made, std::ostream* out) {
    *out << made.file;
}

// All have the same structure, with eyes and teeth as surfaces of their own, which show where eyes and mouth are.
class FaceOf : public ::testing::TestWithParam<Made> {};

TEST_P(FaceOf, HoldsEyesAndTeethWhereTheyAre) {
    const Avatar avatar = read_avatar(test_file(GetParam().file));
    const FaceRegion face = find_face(avatar);
    expect_a_face(avatar, face);
    EXPECT_THAT(face.notes, ElementsAre(format("eyes by {}", GetParam().eyes), "mouth by its morphs"));

    const Bounds eyes = bounds_of_surface(avatar, "Eyes"), teeth = bounds_of_surface(avatar, "Teeth");
    EXPECT_NEAR(face.eyes.y, (eyes.low.y + eyes.high.y) / 2, 0.008);
    EXPECT_GT(face.mouth.y, teeth.low.y);
    EXPECT_LT(face.mouth.y, teeth.high.y);
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const std::string& name = avatar.surfaces[s].name;
        const auto is = [&](FacePart least) {
            return std::count_if(face.parts[s].begin(), face.parts[s].end(),
                                 [&](FacePart part) { return part >= least; });
        };
        const auto all = static_cast<long>(face.parts[s].size());
        if (name == "Eyes" || name == "Lashes") {
            EXPECT_EQ(is(FacePart::face), all) << name;
            EXPECT_EQ(is(FacePart::mouth), 0) << name;
        } else if (name == "Teeth") {
            EXPECT_EQ(is(FacePart::mouth), all);
        } else if (name == "Suit") {
            EXPECT_EQ(is(FacePart::head), 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, FaceOf,
    ::testing::ValuesIn(testing::present<Made>(
        {{"made/makehuman.glb", "the eye joints"},
         {"made/mixamo.glb", "the morphs that close them"},
         {"made/vrm.vrm", "the morphs that close them"},
         {"../shared/data/avatars/tests/mh_neutral_arkit52.glb", "the eye joints"},
         {"../shared/data/avatars/tests/mh_neutral_poseunits.glb", "the eye joints"},
         {"../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb", "the morphs that close them"},
         {"../shared/data/avatars/tests/mh_neutral_vrm1.vrm", "the morphs that close them"}})));

// What lies beside the middle of the lips belongs to the mouth, and nothing above half the way to the eyes
// does.
TEST_P(FaceOf, HasAMouthAroundTheLips) {
    const Avatar avatar = read_avatar(test_file(GetParam().file));
    const FaceRegion face = find_face(avatar);
    const PosedMesh rest = rest_mesh(avatar);
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        for (size_t v = 0; v < face.parts[s].size(); ++v) {
            const Vec3 place = rest.surfaces[s].positions[v];
            if (face.parts[s][v] == FacePart::mouth) {
                EXPECT_LT(place.y, face.mouth.y + 0.5f * (face.eyes.y - face.mouth.y));
            } else if (std::abs(place.x) < 0.025f && std::abs(place.y - face.mouth.y) < 0.012f) {
                EXPECT_LT(place.z, face.middle.z + 0.05f) << "the lips belong to the mouth";
            }
        }
    }
}

TEST(FindFace, OfTheMannequinComesFromItsShape) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const FaceRegion face = find_face(avatar);
    expect_a_face(avatar, face);
    EXPECT_THAT(face.notes, ElementsAre("eyes by the shape of the head", "mouth by the shape of the head"));
    EXPECT_NEAR(face.height, 0.18f, 0.03f);
    EXPECT_GT(count(face, FacePart::mouth), 10u);
    EXPECT_GT(count(face, FacePart::arm), 1000u);
}

TEST(FindFace, OfAFigureWithNumberedJointsComesFromItsShape) {
    for (const std::string& file :
         testing::present({"made/numbered.glb", "../shared/data/avatars/tests/CesiumMan.glb"})) {
        const Avatar avatar = read_avatar(test_file(file));
        const FaceRegion face = find_face(avatar);
        expect_a_face(avatar, face);
        EXPECT_GT(count(face, FacePart::mouth), 3u) << file;
    }
}

// A face of any size and place gives the same parts.
TEST(FindFace, DoesNotDependOnTheSizeOfTheAvatar) {
    Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const FaceRegion face = find_face(avatar);
    for (Joint& joint : avatar.skeleton.joints) {
        if (joint.parent < 0) joint.rest.scale *= 3.0f;
    }
    const FaceRegion large = find_face(avatar);
    EXPECT_NEAR(large.height, 3 * face.height, 0.05f * face.height);
    EXPECT_NEAR(static_cast<double>(count(large, FacePart::face)),
                static_cast<double>(count(face, FacePart::face)),
                0.02 * static_cast<double>(count(face, FacePart::face)));
}

TEST(FindFace, RefusesAHeadWithoutASurface) {
    Avatar avatar = testing::avatar_of(testing::make_figure({}));
    avatar.source = "bare.glb";
    EXPECT_THAT(
        refusal_of([&] { find_face(avatar); }),
        ::testing::AllOf(HasSubstr("bare.glb: its head joint \""),
                         HasSubstr("carries no surface, so its face cannot be found; choose --face-mode "
                                   "au or neutral, or an avatar whose head is bound to its head joint")));
}

}  // namespace
}  // namespace chironomia
