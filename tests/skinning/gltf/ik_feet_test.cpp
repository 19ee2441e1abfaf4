#include "skinning/gltf/ik_feet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/skin.h"
#include "tests/support/joints.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

const char* const kFeet[] = {"left_foot", "right_foot"};

size_t node_named(const Json& json, const std::string& name) {
    for (size_t n = 0; n < json["nodes"].size(); ++n) {
        if (json["nodes"][n].value("name", "") == name) return n;
    }
    ADD_FAILURE() << name;
    return 0;
}

// The parts of a GLB.
Json json_of(const std::vector<std::byte>& glb, size_t& rest) {
    std::uint32_t length = 0;
    std::memcpy(&length, &glb[12], 4);
    rest = 20 + length;
    return Json::parse(std::string(reinterpret_cast<const char*>(&glb[20]), length));
}

// The mannequin with its feet beside its hips, `lower` metres below where they were.
void write_ik_feet(const std::filesystem::path& out, float lower = 0) {
    const auto whole = find_asset("assets/avatars/mannequin.glb");
    const std::vector<std::byte> glb = read_bytes(whole);
    size_t rest = 0;
    Json json = json_of(glb, rest);
    const Skeleton skeleton = read_animated_scene(whole).scene.skeleton;
    const std::vector<Mat4> world = world_from_joints(skeleton, rest_transforms(skeleton));
    const size_t hips = node_named(json, "hips");
    const Mat4 from_world = inverse(world[*testing::find_joint(skeleton, "hips")]);
    for (const char* name : kFeet) {
        const size_t foot = node_named(json, name);
        for (Json& node : json["nodes"]) {
            Json kept = Json::array();
            for (const Json& child : node.value("children", Json::array())) {
                if (child != foot) kept.push_back(child);
            }
            node.erase("children");
            if (!kept.empty()) node["children"] = kept;
        }
        json["nodes"][hips]["children"].push_back(foot);
        const Mat4 local = from_world * world[*testing::find_joint(skeleton, name)];
        const Quat turn = rotation_of(local);
        const Vec3 place = origin(local);
        json["nodes"][foot].erase("scale");
        json["nodes"][foot]["translation"] = {place.x, place.y - lower, place.z};
        json["nodes"][foot]["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    }
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string file(reinterpret_cast<const char*>(glb.data()), 20);
    const auto whole_size = static_cast<std::uint32_t>(20 + text.size() + glb.size() - rest),
               text_size = static_cast<std::uint32_t>(text.size());
    std::memcpy(&file[8], &whole_size, 4);
    std::memcpy(&file[12], &text_size, 4);
    file += text;
    file.append(reinterpret_cast<const char*>(&glb[rest]), glb.size() - rest);
    write_text(out, file);
}

TEST(IkFeet, HangFromTheLegsWhereTheyAreAtRest) {
    const TemporaryFolder folder;
    write_ik_feet(folder / "ik_feet.glb");
    const Avatar whole = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const Avatar avatar = read_avatar(folder / "ik_feet.glb");
    EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("they were hung from the lower legs")));
    for (const HumanJoint part : {HumanJoint::left_foot, HumanJoint::right_toes})
        EXPECT_TRUE(avatar.humanoid.has(part)) << name_of(part);
    // A bent knee takes the foot along.
    const auto bent = [](const Avatar& of) {
        Pose pose = rest_pose(of);
        Quat& knee = pose.joints[*testing::find_joint(of.skeleton, "left_lower_leg")].rotation;
        knee = knee * glm::angleAxis(1.0f, Vec3(1, 0, 0));
        return skin(of, pose);
    };
    const PosedMesh wanted = bent(whole), found = bent(avatar);
    ASSERT_EQ(wanted.surfaces.size(), found.surfaces.size());
    for (size_t s = 0; s < wanted.surfaces.size(); ++s) {
        for (size_t v = 0; v < wanted.surfaces[s].positions.size(); ++v)
            ASSERT_LT(distance(wanted.surfaces[s].positions[v], found.surfaces[s].positions[v]), 1e-4f);
    }
}

TEST(IkFeet, HangFromTheLegsInWhatIsWritten) {
    const TemporaryFolder folder;
    write_ik_feet(folder / "ik_feet.glb");
    const Avatar avatar = read_avatar(folder / "ik_feet.glb");
    write_animated_glb(folder / "out.glb", folder / "ik_feet.glb", {avatar, {{rest_pose(avatar)}}, 30});
    EXPECT_FALSE(with_feet_on_legs(open_gltf(folder / "out.glb")).moved);
}

TEST(IkFeet, StayWhereTheyAreUnlessTheyEndTheLegs) {
    EXPECT_FALSE(with_feet_on_legs(open_gltf(find_asset("assets/avatars/mannequin.glb"))).moved);
    const TemporaryFolder folder;
    write_ik_feet(folder / "far.glb", 1.5f);
    EXPECT_FALSE(with_feet_on_legs(open_gltf(folder / "far.glb")).moved);
}

}  // namespace
}  // namespace chironomia
