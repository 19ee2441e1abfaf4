// The people that come with the program: what every one of them must hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/body/face.h"
#include "core/files/files.h"
#include "core/quantile.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::source_dir;

const char* const kPeople[] = {"neutral", "female", "male", "female2", "male2"};

// Units of the middle of the face; all others have a left and a right side.
const std::set<int> kMiddle = {17, 18, 19, 22, 23, 24, 25, 26, 28, 29, 34};

std::filesystem::path file_of(const std::string& name) {
    return source_dir() / "assets/avatars" / (name + ".glb");
}

size_t triangles_of(const Avatar& avatar) {
    size_t corners = 0;
    for (const Surface& surface : avatar.surfaces) corners += surface.triangles.size();
    return corners / 3;
}

const Avatar& person(const std::string& name) {
    static std::map<std::string, Avatar> read;
    const auto known = read.find(name);
    return known != read.end() ? known->second : read.emplace(name, read_avatar(file_of(name))).first->second;
}

std::string material_of(const Avatar& avatar, const Surface& surface) {
    return avatar.materials[static_cast<size_t>(surface.material)].name;
}

std::vector<const Surface*> surfaces_of(const Avatar& avatar, const std::string& material) {
    std::vector<const Surface*> found;
    for (const Surface& surface : avatar.surfaces) {
        if (material_of(avatar, surface) == material) found.push_back(&surface);
    }
    return found;
}

const Surface& skin_of(const Avatar& avatar) {
    return *surfaces_of(avatar, "skin").at(0);
}

const Morph& morph_named(const Surface& surface, const std::string& name) {
    const auto found = std::find_if(surface.morphs.begin(), surface.morphs.end(),
                                    [&](const Morph& morph) { return morph.name == name; });
    if (found == surface.morphs.end()) throw std::runtime_error("no morph " + name);
    return *found;
}

Vec3 joint_place(const Avatar& avatar, HumanJoint joint) {
    Vec3 place(0);
    for (int j = avatar.humanoid[joint]; j >= 0; j = avatar.skeleton.joints[static_cast<size_t>(j)].parent)
        place += avatar.skeleton.joints[static_cast<size_t>(j)].rest.translation;
    return place;
}

std::vector<FaceChannel> all_channels() {
    std::vector<FaceChannel> channels;
    for (const int unit : known_action_units()) {
        if (unit == 8) continue;  // the jaw drops less
        if (kMiddle.contains(unit)) {
            channels.push_back({unit, FaceSide::both});
        } else {
            channels.push_back({unit, FaceSide::left});
            channels.push_back({unit, FaceSide::right});
        }
    }
    return channels;
}

std::vector<Vec3> moved(const Surface& surface, const std::vector<std::string>& morphs) {
    std::vector<Vec3> points = surface.positions;
    for (const std::string& name : morphs) {
        const Morph& morph = morph_named(surface, name);
        for (size_t m = 0; m < morph.vertices.size(); ++m) points[morph.vertices[m]] += morph.moves[m];
    }
    return points;
}

// Whether a triangle lies before a point that is looked at along -z.
bool covers(const std::array<Vec3, 3>& corners, const Vec3& point) {
    const Vec2 p(point);
    const auto side = [&](const Vec3& a, const Vec3& b) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    const float u = side(corners[1], corners[2]), v = side(corners[2], corners[0]);
    const float w = side(corners[0], corners[1]);
    const float area = u + v + w;
    if (area == 0 || u / area < 0 || v / area < 0 || w / area < 0) return false;
    return (u * corners[0].z + v * corners[1].z + w * corners[2].z) / area > point.z;
}

// Vertices of an eye's front that no skin covers when looked at from the front.
int bare_eye_vertices(const Avatar& avatar, const std::vector<std::string>& morphs) {
    const Surface& skin = skin_of(avatar);
    const std::vector<Vec3> points = moved(skin, morphs);
    int bare = 0;
    for (const Surface* eye : surfaces_of(avatar, "eyes")) {
        for (size_t v = 0; v < eye->positions.size(); ++v) {
            bool covered = eye->normals[v].z < 0.3f;
            for (size_t c = 0; c < skin.triangles.size() && !covered; c += 3) {
                covered = covers(
                    {points[skin.triangles[c]], points[skin.triangles[c + 1]], points[skin.triangles[c + 2]]},
                    eye->positions[v]);
            }
            bare += !covered;
        }
    }
    return bare;
}

class OwnAvatar : public ::testing::TestWithParam<const char*> {
  protected:
    const Avatar& avatar() const { return person(GetParam()); }
};

TEST(BundledAvatars, AreSmallAndFineEnough) {
    for (const std::string name : {"neutral", "female", "male", "female2", "male2", "mannequin"}) {
        EXPECT_LE(std::filesystem::file_size(file_of(name)), 3u * 1024 * 1024) << name;
        const size_t triangles = triangles_of(read_avatar(file_of(name)));
        EXPECT_GE(triangles, 15'000u) << name;
        EXPECT_LE(triangles, 30'000u) << name;
    }
}

TEST(BundledAvatars, HaveTheirLicenceAndOriginBesideThem) {
    EXPECT_TRUE(std::filesystem::exists(source_dir() / "assets/avatars/CC0-1.0.txt"));
    const std::string readme = read_text(source_dir() / "assets/avatars/README.md");
    for (const std::string name : {"neutral", "female", "male", "female2", "male2", "mannequin"})
        EXPECT_THAT(readme, HasSubstr("`" + name + ".glb`"));
}

// Folds that follow the light, and lids that shade the eyes as they move.
TEST_P(OwnAvatar, HasFoldsAndLidsThatShadeTheEyes) {
    const auto material_of = [&](const Surface& surface) -> const Material& {
        return avatar().materials.at(static_cast<size_t>(surface.material));
    };
    EXPECT_GE(material_of(*surfaces_of(avatar(), "shirt").at(0)).normal_texture.image, 0);
    for (const char* strip : {"eye_shadow", "eye_wet"}) {
        ASSERT_EQ(surfaces_of(avatar(), strip).size(), 1u) << strip;
        const Surface& surface = *surfaces_of(avatar(), strip)[0];
        EXPECT_EQ(material_of(surface).alpha_mode, AlphaMode::blend) << strip;
        EXPECT_TRUE(std::ranges::any_of(surface.morphs, [](const Morph& morph) {
            return morph.name == "AU45_L";
        })) << strip;
    }
}

TEST_P(OwnAvatar, HasAllHumanJoints) {
    for (int joint = 0; joint < kHumanJoints; ++joint) {
        EXPECT_GE(avatar().humanoid[static_cast<HumanJoint>(joint)], 0)
            << name_of(static_cast<HumanJoint>(joint));
    }
}

TEST_P(OwnAvatar, StandsOnTheFloorAndHasTheSizeOfAnAdult) {
    float low = 1e9f, high = -1e9f;
    for (const Surface& surface : avatar().surfaces) {
        for (const Vec3& point : surface.positions) {
            low = std::min(low, point.y);
            high = std::max(high, point.y);
        }
    }
    EXPECT_NEAR(low, 0, 0.002);
    EXPECT_GT(high, 1.55f);
    EXPECT_LT(high, 1.95f);
}

TEST_P(OwnAvatar, HoldsAVertexByAtMostFourJoints) {
    for (const Surface& surface : avatar().surfaces) {
        for (size_t v = 0; v + 1 < surface.first_influence.size(); ++v)
            ASSERT_LE(surface.first_influence[v + 1] - surface.first_influence[v], 4u);
    }
}

TEST_P(OwnAvatar, HasAllPartsWithTheirTextures) {
    std::map<std::string, const Material*> materials;
    for (const Material& material : avatar().materials) materials[material.name] = &material;
    for (const char* name : {"skin", "eyes", "hair", "brows", "lashes", "tongue", "shirt", "trousers"}) {
        ASSERT_TRUE(materials.contains(name)) << name;
        EXPECT_GE(materials[name]->base_colour_texture.image, 0) << name;
    }
    for (const char* name : {"teeth", "gums", "shoes"}) EXPECT_TRUE(materials.contains(name)) << name;
    for (const auto& [name, material] : materials) EXPECT_EQ(material->metallic, 0) << name;
    EXPECT_LE(materials["eyes"]->roughness, 0.1f);
    for (const Image& image : avatar().images) {
        EXPECT_GE(image.width, 256) << image.name;
        if (image.name == "skin") {
            EXPECT_GE(image.width, 1024);
        }
    }
}

// Of two corners of a strip with the same u, one lies further along its strands.
// Else those behind the canines stand out at the corners of an open mouth.
TEST_P(OwnAvatar, HasTeethThatAreDarkFurtherBack) {
    const Surface& teeth = *surfaces_of(avatar(), "teeth").at(0);
    ASSERT_EQ(teeth.colours.size(), teeth.positions.size());
    float foremost = -1e9f;
    for (const Vec3& point : teeth.positions) foremost = std::max(foremost, point.z);
    size_t lit = 0, dark = 0;
    for (size_t v = 0; v < teeth.positions.size(); ++v) {
        const float behind = foremost - teeth.positions[v].z;  // [m]
        const Vec4& colour = teeth.colours[v];
        EXPECT_GE(colour.r, colour.g) << "reddened, not cold";
        if (behind < 0.006f) {
            ++lit;
            EXPECT_EQ(colour, Vec4(1));
        } else if (behind > 0.023f) {
            ++dark;
            EXPECT_LT(colour.r, 0.22f);
        }
    }
    EXPECT_GT(lit, 100u);
    EXPECT_GT(dark, 20u);
}

TEST_P(OwnAvatar, HasTangentsAcrossTheStrandsOfItsHair) {
    const Avatar& avatar = person(GetParam());
    const Surface& hair = *surfaces_of(avatar, "hair").at(0);
    EXPECT_GT(avatar.materials[static_cast<size_t>(hair.material)].anisotropy, 0);
    ASSERT_EQ(hair.tangents.size(), hair.positions.size());
    size_t across = 0, edges = 0;
    for (size_t i = 0; i < hair.triangles.size(); ++i) {
        const std::uint32_t a = hair.triangles[i], b = hair.triangles[i / 3 * 3 + (i + 1) % 3];
        EXPECT_NEAR(dot(Vec3(hair.tangents[a]), hair.normals[a]), 0, 0.03f);
        if (hair.uvs[a].x != hair.uvs[b].x || hair.uvs[a].y == hair.uvs[b].y) continue;
        ++edges;
        const Vec3 along = normalize(hair.positions[b] - hair.positions[a]);
        across += std::abs(dot(Vec3(hair.tangents[a]), along)) < 0.4f ? 1 : 0;
    }
    EXPECT_GT(edges, 3000u);
    EXPECT_GT(static_cast<double>(across) / static_cast<double>(edges), 0.85);
}

TEST_P(OwnAvatar, ShowsEveryActionUnit) {
    for (const FaceChannel& channel : all_channels()) {
        const Morph& morph = morph_named(skin_of(avatar()), to_text(channel));
        float furthest = 0;
        for (const Vec3& move : morph.moves) furthest = std::max(furthest, length(move));
        EXPECT_GT(furthest, 0.0025f) << to_text(channel);
        EXPECT_LT(furthest, 0.030f) << to_text(channel);
    }
    EXPECT_EQ(skin_of(avatar()).morphs.size(), all_channels().size());
}

TEST_P(OwnAvatar, CarriesBrowsLashesTeethAndTongueAlong) {
    const auto names = [&](const char* material) {
        std::vector<std::string> list;
        for (const Morph& morph : surfaces_of(avatar(), material).at(0)->morphs) list.push_back(morph.name);
        return list;
    };
    for (const char* unit : {"AU1_L", "AU2_R", "AU4_L"}) EXPECT_THAT(names("brows"), Contains(unit));
    for (const char* unit : {"AU5_L", "AU7_R", "AU45_L"}) EXPECT_THAT(names("lashes"), Contains(unit));
    for (const char* unit : {"AU26", "AU29", "AU30_L"}) EXPECT_THAT(names("teeth"), Contains(unit));
    for (const char* unit : {"AU19", "AU26"}) EXPECT_THAT(names("tongue"), Contains(unit));
}

// Else it closes an open mouth like a wall.
TEST_P(OwnAvatar, LaysItsTongueOnTheJaw) {
    const Surface& tongue = *surfaces_of(avatar(), "tongue").at(0);
    const auto tip = std::max_element(tongue.positions.begin(), tongue.positions.end(),
                                      [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
    const auto vertex = static_cast<size_t>(tip - tongue.positions.begin());
    EXPECT_LT(moved(tongue, {"AU26"})[vertex].y, tip->y - 0.010f);
}

TEST_P(OwnAvatar, ClosesItsEyesFully) {
    EXPECT_GT(bare_eye_vertices(avatar(), {}), 40);
    EXPECT_EQ(bare_eye_vertices(avatar(), {"AU45_L", "AU45_R"}), 0);
}

// Heights against the eyes [m] between which a unit may move the skin.
struct Region {
    float low, high;
};

Region region_of(int unit) {
    switch (unit) {
        case 1:
        case 2:
        case 4:
            return {-0.007f, 0.10f};
        case 5:
        case 7:
        case 45:
            return {-0.03f, 0.035f};
        case 6:
            return {-0.09f, 0.035f};
        case 9:
            return {-0.10f, 0.06f};
        case 29:
        case 30:
            return {-0.18f, -0.008f};
        default:
            return {-0.15f, 0};
    }
}

TEST_P(OwnAvatar, MovesOnlyTheRegionOfAUnit) {
    const Surface& skin = skin_of(avatar());
    const Vec3 eye = joint_place(avatar(), HumanJoint::left_eye);
    for (const FaceChannel& channel : all_channels()) {
        const Region region = region_of(channel.unit);
        const Morph& morph = morph_named(skin, to_text(channel));
        for (size_t m = 0; m < morph.vertices.size(); ++m) {
            const Vec3 place = skin.positions[morph.vertices[m]];
            ASSERT_GT(place.y - eye.y, region.low) << to_text(channel);
            ASSERT_LT(place.y - eye.y, region.high) << to_text(channel);
            if (channel.unit != 30 && channel.side == FaceSide::left) {
                ASSERT_GT(place.x, -0.015f) << to_text(channel);
            }
            if (channel.unit != 30 && channel.side == FaceSide::right) {
                ASSERT_LT(place.x, 0.015f) << to_text(channel);
            }
        }
    }
}

// The move of the vertex nearest to a place, if one lies within a tenth of a millimetre.
std::optional<Vec3> move_at(const Surface& surface, const Morph& morph, const Vec3& place) {
    float nearest = 0.0001f;
    std::optional<Vec3> move;
    for (size_t m = 0; m < morph.vertices.size(); ++m) {
        const float far = distance(surface.positions[morph.vertices[m]], place);
        if (far >= nearest) continue;
        nearest = far;
        move = morph.moves[m];
    }
    return move;
}

TEST_P(OwnAvatar, HasMirroredSides) {
    const Surface& skin = skin_of(avatar());
    const Vec3 flip(-1, 1, 1);
    for (const FaceChannel& channel : all_channels()) {
        if (channel.side != FaceSide::left) continue;
        const Morph& left = morph_named(skin, to_text(channel));
        const Morph& right = morph_named(skin, to_text({channel.unit, FaceSide::right}));
        size_t found = 0;
        for (size_t m = 0; m < left.vertices.size(); ++m) {
            const auto move = move_at(skin, right, skin.positions[left.vertices[m]] * flip);
            if (!move) continue;
            ++found;
            ASSERT_LT(distance(*move * flip, left.moves[m]), 0.0003f) << to_text(channel);
        }
        EXPECT_GT(found, left.vertices.size() * 8 / 10) << to_text(channel);
    }
}

// The pose at rest, but the left upper arm points up by 60 degrees.
Pose with_raised_arm(const Avatar& avatar) {
    const Vec3 hanging =
        joint_place(avatar, HumanJoint::left_lower_arm) - joint_place(avatar, HumanJoint::left_upper_arm);
    Pose pose = rest_pose(avatar);
    Quat& turn = pose.joints[static_cast<size_t>(avatar.humanoid[HumanJoint::left_upper_arm])].rotation;
    turn = glm::angleAxis(kPi / 3 - std::atan2(hanging.y, hanging.x), Vec3(0, 0, 1)) * turn;
    return pose;
}

// The angles between neighbouring triangles of clothes that lie above the left shoulder at rest, in the
// places `now` [degrees].
std::vector<float> folds_above_shoulder(const Avatar& avatar, const Surface& clothes,
                                        const std::vector<Vec3>& now) {
    const Vec3 shoulder = joint_place(avatar, HumanJoint::left_upper_arm);
    const auto place = [](const Vec3& at) { return std::array{at.x, at.y, at.z}; };
    std::map<std::set<std::array<float, 3>>, Vec3> normals;  // of the triangle that an edge was first seen in
    std::vector<float> folds;
    for (size_t c = 0; c < clothes.triangles.size(); c += 3) {
        const std::uint32_t* corner = clothes.triangles.data() + c;
        const Vec3 normal = cross(now[corner[1]] - now[corner[0]], now[corner[2]] - now[corner[0]]);
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 &a = clothes.positions[corner[k]], &b = clothes.positions[corner[(k + 1) % 3]];
            const Vec3 middle = 0.5f * (a + b);
            if (distance(middle, shoulder) > 0.16f || middle.y < shoulder.y) continue;
            const auto [other, is_new] = normals.emplace(std::set{place(a), place(b)}, normal);
            if (!is_new) folds.push_back(angle_between(normal, other->second) * 180 / kPi);
        }
    }
    return folds;
}

TEST_P(OwnAvatar, FoldsItsShoulderLittleUnderARaisedArm) {
    const PosedMesh raised = skin(avatar(), with_raised_arm(avatar()));
    for (size_t i = 0; i < avatar().surfaces.size(); ++i) {
        const Surface& surface = avatar().surfaces[i];
        if (material_of(avatar(), surface) != "shirt") continue;
        const auto folds = folds_above_shoulder(avatar(), surface, raised.surfaces[i].positions);
        ASSERT_GT(folds.size(), 100u);
        EXPECT_LT(quantile(folds, 0.95), 30);
    }
}

INSTANTIATE_TEST_SUITE_P(People, OwnAvatar, ::testing::ValuesIn(kPeople),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace chironomia
