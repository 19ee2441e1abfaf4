// Masks and mitts: what they hide, and that they move with their joint and with nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "core/body/rest.h"
#include "core/files/files.h"
#include "core/text.h"
#include "skinning/covers/cover.h"
#include "skinning/covers/face_mask.h"
#include "skinning/covers/mitts.h"
#include "skinning/face_region/face_region.h"
#include "skinning/face_region/still_face.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

struct Ray {
    Vec3 from{0};
    Vec3 towards{0, 0, 1};
};

struct Hit {
    size_t surface = 0;
    size_t triangle = 0;  // first index into Surface::triangles
    float distance = 0;   // along Ray::towards
};

// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
std::optional<float> meet(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, p = cross(ray.towards, ac);
    const float determinant = dot(ab, p);
    if (std::abs(determinant) < 1e-12f) return std::nullopt;
    const Vec3 from = ray.from - a, q = cross(from, ab);
    const float u = dot(from, p) / determinant, v = dot(ray.towards, q) / determinant;
    const float t = dot(ac, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) return std::nullopt;
    return t;
}

// How far along a ray a surface is first met.
std::optional<float> first_hit_of(size_t surface, const Ray& ray, const Avatar& avatar,
                                  const PosedMesh& mesh) {
    std::optional<float> first;
    const auto& triangles = avatar.surfaces[surface].triangles;
    const auto& places = mesh.surfaces[surface].positions;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const auto t = meet(ray, places[triangles[i]], places[triangles[i + 1]], places[triangles[i + 2]]);
        if (t && (!first || *t < *first)) first = t;
    }
    return first;
}

// Whether a closed surface is met an odd number of times on the way out.
bool is_inside(const Vec3& place, size_t surface, const Avatar& avatar, const PosedMesh& mesh) {
    const auto& triangles = avatar.surfaces[surface].triangles;
    const auto& places = mesh.surfaces[surface].positions;
    int met = 0;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const Ray ray{place, normalize(Vec3(0.31f, 0.87f, 0.4f))};
        if (meet(ray, places[triangles[i]], places[triangles[i + 1]], places[triangles[i + 2]])) ++met;
    }
    return met % 2 == 1;
}

std::optional<Hit> first_hit(const Ray& ray, const Avatar& avatar, const PosedMesh& mesh) {
    std::optional<Hit> first;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const auto& triangles = avatar.surfaces[s].triangles;
        const auto& places = mesh.surfaces[s].positions;
        for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
            const auto t =
                meet(ray, places[triangles[i]], places[triangles[i + 1]], places[triangles[i + 2]]);
            if (t && (!first || *t < first->distance)) first = Hit{s, i, *t};
        }
    }
    return first;
}

Avatar mannequin() {
    return read_avatar(find_asset("assets/avatars/mannequin.glb"));
}

// Vertices of eyes, nose and lips: what lies within 40 degrees of straight ahead, between the lower lip and the brows.
// 0.08 of the face's height, 15 mm, below the mouth there is no lip any more.
bool is_feature(const FaceRegion& face, FacePart part, const Vec3& place) {
    const Vec3 from = place - face.middle;
    return part >= FacePart::face && from.z > 0.15f * face.height && std::abs(from.x) < 0.8f * from.z &&
           place.y > face.mouth.y - 0.08f * face.height && place.y < face.eyes.y + 0.1f * face.height;
}

class MaskOf : public ::testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        bare_ = read_avatar(testing::test_file(GetParam()));
        face_ = find_face(bare_);
        rest_ = rest_mesh(bare_);
        masked_ = with_face_mask(bare_, face_);
    }

    // Some vertices of the features, spread over them: surface and vertex.
    std::vector<std::pair<size_t, size_t>> features(size_t at_most) const {
        std::vector<std::pair<size_t, size_t>> all, some;
        for (size_t s = 0; s < bare_.surfaces.size(); ++s) {
            for (size_t v = 0; v < face_.parts[s].size(); ++v) {
                if (is_feature(face_, face_.parts[s][v], rest_.surfaces[s].positions[v]))
                    all.emplace_back(s, v);
            }
        }
        for (size_t i = 0; i < at_most && !all.empty(); ++i) some.push_back(all[i * all.size() / at_most]);
        return some;
    }

    Avatar bare_, masked_;
    FaceRegion face_;
    PosedMesh rest_;
};

TEST_P(MaskOf, LiesOutsideEveryFeature) {
    const size_t mask = masked_.surfaces.size() - 1;
    EXPECT_EQ(masked_.surfaces[mask].name, "face mask");
    EXPECT_EQ(masked_.surfaces[mask].joint, face_.head);
    const PosedMesh mesh = rest_mesh(masked_);
    for (const auto& [s, v] : features(60)) {
        const Vec3 place = rest_.surfaces[s].positions[v];
        const Ray outward{place, normalize(place - face_.middle)};
        const auto hit = first_hit_of(mask, outward, masked_, mesh);
        ASSERT_TRUE(hit) << bare_.surfaces[s].name << " " << v;
        const Ray beyond{place + (*hit + 1e-4f) * outward.towards, outward.towards};
        EXPECT_FALSE(first_hit(beyond, masked_, mesh)) << bare_.surfaces[s].name << " " << v;
    }
}

// From twelve directions, at rest and with the mouth wide open or drawn aside.
TEST_P(MaskOf, LetsNothingBeSeenOfEyesNoseAndLips) {
    const auto points = features(16);
    for (const char* expression : {"", "jawOpen", "mouthSmileLeft", "mouthPucker"}) {
        Pose pose = rest_pose(masked_);
        for (size_t m = 0; m < masked_.morph_names.size(); ++m) {
            if (masked_.morph_names[m] == expression) pose.morph_weights[m] = 1;
        }
        const PosedMesh mesh = skin(masked_, pose), bare = skin(bare_, pose);
        for (int direction = 0; direction < 12; ++direction) {
            const float across = (static_cast<float>(direction % 6) - 2.5f) * 30 * kPi / 180;
            const float up = direction < 6 ? -0.3f : 0.35f;
            const Vec3 towards(std::sin(across) * std::cos(up), std::sin(up),
                               std::cos(across) * std::cos(up));
            for (const auto& [s, v] : points) {
                const Vec3 place = bare.surfaces[s].positions[v];
                const auto hit = first_hit({place + 2.0f * towards, -towards}, masked_, mesh);
                if (!hit || hit->surface >= bare_.surfaces.size()) continue;
                for (size_t corner = 0; corner < 3; ++corner) {
                    const size_t seen = masked_.surfaces[hit->surface].triangles[hit->triangle + corner];
                    EXPECT_FALSE(is_feature(face_, face_.parts[hit->surface][seen],
                                            rest_.surfaces[hit->surface].positions[seen]))
                        << expression << " from " << direction << ": " << bare_.surfaces[hit->surface].name;
                }
            }
        }
    }
}

// The last vertices of the mask are those of its rim, sunk into the head.
TEST_P(MaskOf, EndsInsideTheHead) {
    const auto mesh = rest_mesh(masked_);
    const auto& places = mesh.surfaces.back().positions;
    const Vec3 middle(face_.middle.x, face_.chin.y + 0.5f * face_.height, face_.middle.z);
    for (size_t i = places.size() - 72; i < places.size(); i += 6) {
        EXPECT_TRUE(first_hit({places[i], normalize(places[i] - middle)}, bare_, rest_)) << i;
    }
}

TEST_P(MaskOf, IsEvenOnBothSidesAndStandsOutLittle) {
    const auto mesh = rest_mesh(masked_);
    const Bounds mask = bounds_of(PosedMesh{{mesh.surfaces.back()}});
    EXPECT_NEAR(mask.low.x + mask.high.x, 2 * face_.middle.x, 0.01f * face_.height);
    Vec3 high(-1e9f);
    for (const auto& [s, v] : features(1000)) high = glm::max(high, rest_.surfaces[s].positions[v]);
    EXPECT_LT(mask.high.z, high.z + 0.15f * face_.height);
    EXPECT_GT(mask.high.z, high.z);
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, MaskOf,
    ::testing::ValuesIn(testing::present({"assets/avatars/mannequin.glb", "made/makehuman.glb",
                                          "made/mixamo.glb", "made/vrm.vrm", "made/numbered.glb",
                                          "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
                                          "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
                                          "../shared/data/avatars/tests/mh_neutral_vrm1.vrm",
                                          "../shared/data/avatars/tests/mh_neutral_poseunits.glb",
                                          "../shared/data/avatars/tests/CesiumMan.glb"})));

TEST(FaceMask, TurnsWithTheHeadAndWithNothingElse) {
    const Avatar bare = mannequin();
    const Avatar masked = with_face_mask(bare, find_face(bare));
    Pose pose = rest_pose(masked);
    const Vec3 before = skin(masked, pose).surfaces.back().positions[0];
    pose.joints[static_cast<size_t>(masked.humanoid[HumanJoint::left_upper_arm])].rotation *=
        glm::angleAxis(1.0f, Vec3(1, 0, 0));
    EXPECT_EQ(skin(masked, pose).surfaces.back().positions[0], before);
    const auto head = static_cast<size_t>(masked.humanoid[HumanJoint::head]);
    pose.joints[head].rotation *= glm::angleAxis(0.5f, Vec3(0, 1, 0));
    const PosedMesh turned = skin(masked, pose);
    EXPECT_GT(distance(turned.surfaces.back().positions[0], before), 0.02f);
    // Rigid: no two vertices come nearer to each other.
    const auto& places = turned.surfaces.back().positions;
    const auto rest = rest_mesh(masked).surfaces.back().positions;
    EXPECT_NEAR(distance(places[1], places[500]), distance(rest[1], rest[500]), 1e-5f);
}

TEST(StillFace, TakesMorphsJawAndEyesToRestAndLeavesTheHead) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/neutral.glb"));
    Pose pose = rest_pose(avatar);
    const Pose rest = pose;
    for (float& weight : pose.morph_weights) weight = 0.7f;
    for (const HumanJoint part :
         {HumanJoint::jaw, HumanJoint::left_eye, HumanJoint::right_eye, HumanJoint::head}) {
        ASSERT_TRUE(avatar.humanoid.has(part));
        pose.joints[static_cast<size_t>(avatar.humanoid[part])].rotation = Quat(0, 1, 0, 0);
    }
    const Pose still = with_still_face(avatar, pose);
    EXPECT_EQ(still.morph_weights, rest.morph_weights);
    for (size_t j = 0; j < rest.joints.size(); ++j) {
        const bool is_head = static_cast<int>(j) == avatar.humanoid[HumanJoint::head];
        EXPECT_EQ(still.joints[j] == rest.joints[j], !is_head) << avatar.skeleton.joints[j].name;
    }
}

// Every edge of a closed surface lies in two triangles, once in each direction.
TEST(Mitts, AreClosed) {
    const Avatar avatar = with_mitts(mannequin());
    for (const size_t s : {avatar.surfaces.size() - 2, avatar.surfaces.size() - 1}) {
        const Surface& mitt = avatar.surfaces[s];
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (size_t i = 0; i < mitt.triangles.size(); ++i) {
            const size_t next = i % 3 == 2 ? i - 2 : i + 1;
            ++edges[{mitt.triangles[i], mitt.triangles[next]}];
        }
        for (const auto& [edge, count] : edges) {
            EXPECT_EQ(count, 1);
            EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
        }
    }
}

class MittsOf : public ::testing::TestWithParam<std::string> {
  protected:
    void SetUp() override { avatar_ = with_mitts(read_avatar(testing::test_file(GetParam()))); }

    Avatar avatar_;
};

TEST_P(MittsOf, ShowNothingOfFingers) {
    Pose pose = rest_pose(avatar_);
    const PosedMesh before = skin(avatar_, pose);
    for (int i = static_cast<int>(HumanJoint::left_thumb_1); i < kHumanJoints; ++i) {
        const int joint = avatar_.humanoid[static_cast<HumanJoint>(i)];
        if (joint >= 0)
            pose.joints[static_cast<size_t>(joint)].rotation *= glm::angleAxis(0.8f, Vec3(0.6f, 0, 0.8f));
    }
    // What is drawn stays where it is, or moves inside a mitt.
    const PosedMesh after = skin(avatar_, pose);
    const size_t mitts = avatar_.surfaces.size() - 2;
    for (size_t s = 0; s < mitts; ++s) {
        const std::set<std::uint32_t> drawn(avatar_.surfaces[s].triangles.begin(),
                                            avatar_.surfaces[s].triangles.end());
        for (const std::uint32_t v : drawn) {
            const Vec3 place = after.surfaces[s].positions[v];
            if (distance(place, before.surfaces[s].positions[v]) < 0.001f) continue;
            EXPECT_TRUE(is_inside(place, mitts, avatar_, after) ||
                        is_inside(place, mitts + 1, avatar_, after))
                << avatar_.surfaces[s].name << " " << v;
        }
    }
    for (size_t s = mitts; s < mitts + 2; ++s) {
        EXPECT_EQ(after.surfaces[s].positions, before.surfaces[s].positions);
    }
}

TEST_P(MittsOf, LieWhereTheHandsAre) {
    const auto joints = world_from_joints(avatar_.skeleton, rest_transforms(avatar_.skeleton));
    const PosedMesh mesh = rest_mesh(avatar_);
    for (const bool left : {true, false}) {
        const size_t s = avatar_.surfaces.size() - (left ? 2 : 1);
        const int hand = avatar_.humanoid[left ? HumanJoint::left_hand : HumanJoint::right_hand];
        EXPECT_EQ(avatar_.surfaces[s].joint, hand);
        const Bounds mitt = bounds_of(PosedMesh{{mesh.surfaces[s]}});
        const Vec3 wrist = origin(joints[static_cast<size_t>(hand)]);
        EXPECT_LT(distance((mitt.low + mitt.high) * 0.5f, wrist), length(mitt.high - mitt.low));
        EXPECT_LT(length(mitt.high - mitt.low), 0.4f);
        EXPECT_GT(length(mitt.high - mitt.low), 0.08f);
    }
}

INSTANTIATE_TEST_SUITE_P(
    TestAvatars, MittsOf,
    ::testing::ValuesIn(testing::present(
        {"assets/avatars/mannequin.glb", "made/makehuman.glb", "made/mixamo.glb", "made/vrm.vrm",
         "made/numbered.glb", "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
         "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
         "../shared/data/avatars/tests/mh_neutral_vrm1.vrm", "../shared/data/avatars/tests/CesiumMan.glb"})));

TEST(Mitts, AreRefusedWhereThereIsNoHand) {
    Avatar avatar = mannequin();
    avatar.source = "some.glb";
    Avatar handless = avatar;
    handless.humanoid[HumanJoint::right_hand] = -1;
    EXPECT_EQ(
        refusal_of([&] { with_mitts(handless); }),
        "some.glb: has no joint for its right hand, so its hands cannot be hidden; choose --hands motion or "
        "relaxed, or another avatar");
    for (Surface& surface : avatar.surfaces) surface.skin = -1;
    EXPECT_THAT(
        refusal_of([&] { with_mitts(avatar); }),
        HasSubstr("some.glb: its hand joint \"left_hand\" carries no surface, so its hands cannot be hidden; "
                  "choose --hands motion or relaxed, or another avatar"));
}

}  // namespace
}  // namespace chironomia
