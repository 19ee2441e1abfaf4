#include "skinning/gltf/gltf_write.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_fault.h"
#include "core/text.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/gltf/gltf_nodes.h"
#include "skinning/gltf/ik_feet.h"
#include "skinning/gltf/rigify_joints.h"
#include "skinning/gltf/unmirror.h"
#include "skinning/humanoid/second_armatures.h"
#include "skinning/humanoid/stance.h"

namespace chironomia {
namespace {

constexpr float kStill = 1e-7f;  // a joint that moves less than this keeps its rest transform

Json numbers_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Json numbers_of(const Quat& q) {
    return {q.x, q.y, q.z, q.w};
}

bool differs(const Vec3& a, const Vec3& b) {
    return glm::any(glm::greaterThan(glm::abs(a - b), Vec3(kStill)));
}

bool differs(const Quat& a, const Quat& b) {
    // A turn and its negative are the same.
    return 1 - std::abs(dot(a, b)) > kStill;
}

std::string_view mime_type_of(const Bytes& image) {
    if (!image.empty() && image[0] == 0x89) return "image/png";
    return !image.empty() && image[0] == 'R' ? "image/webp" : "image/jpeg";
}

// The file's JSON with one buffer, to which accessors can be added.
class Glb {
  public:
    explicit Glb(GltfFile file) : json_(std::move(file.json)) {
        merge_buffers(file);
        embed_images(file);
    }

    Json& json() { return json_; }

    int add_view(std::span<const std::uint8_t> bytes) {
        pad(0);
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return static_cast<int>(json_["bufferViews"].size()) - 1;
    }

    int add_floats(const char* type, size_t count, std::span<const float> numbers) {
        Bytes bytes(numbers.size_bytes());
        std::memcpy(bytes.data(), numbers.data(), bytes.size());
        json_["accessors"].push_back(
            {{"bufferView", add_view(bytes)}, {"componentType", 5126}, {"count", count}, {"type", type}});
        return static_cast<int>(json_["accessors"].size()) - 1;
    }

    std::vector<std::byte> bytes() {
        pad(0);
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        std::string text = json_.dump();
        while (text.size() % 4 != 0) text += ' ';

        std::vector<std::byte> file;
        const auto add = [&](const void* data, size_t size) {
            const auto* first = static_cast<const std::byte*>(data);
            file.insert(file.end(), first, first + size);
        };
        const auto add_number = [&](size_t number) {
            const auto value = static_cast<std::uint32_t>(number);
            add(&value, 4);
        };
        add("glTF", 4);
        add_number(2);
        add_number(12 + 8 + text.size() + 8 + binary_.size());
        add_number(text.size());
        add("JSON", 4);
        add(text.data(), text.size());
        add_number(binary_.size());
        add("BIN\0", 4);
        add(binary_.data(), binary_.size());
        return file;
    }

  private:
    void pad(std::uint8_t with) {
        while (binary_.size() % 4 != 0) binary_.push_back(with);
    }

    void merge_buffers(const GltfFile& file) {
        std::vector<size_t> first_byte;
        for (const Bytes& buffer : file.buffers) {
            pad(0);
            first_byte.push_back(binary_.size());
            binary_.insert(binary_.end(), buffer.begin(), buffer.end());
        }
        for (Json& view : json_["bufferViews"]) {
            const auto buffer = view.at("buffer").get<size_t>();
            if (buffer >= first_byte.size())
                refuse(file, format("a buffer view is in buffer {}, there are {}; get the file again", buffer,
                                    first_byte.size()));
            view["byteOffset"] = view.value("byteOffset", size_t{0}) + first_byte[buffer];
            view["buffer"] = 0;
        }
    }

    void embed_images(const GltfFile& file) {
        for (size_t i = 0; i < file.images.size(); ++i) {
            Json& image = json_["images"][i];
            if (!image.contains("uri")) continue;
            const EncodedImage& encoded = file.images[i];
            if (!encoded.fault.empty()) throw Error(encoded.fault);
            image.erase("uri");
            image["mimeType"] = mime_type_of(encoded.bytes);
            image["bufferView"] = add_view(encoded.bytes);
        }
    }

    Json json_;
    Bytes binary_;
};

// What writes the animation of one avatar.
struct Bake {
    Glb& glb;
    const Avatar& avatar;
    std::span<const Pose> poses;
    const std::vector<int>& node_of_joint;
    int times = -1;  // accessor of the keys' times
    Json channels = Json::array();
    Json samplers = Json::array();
};

void add_channel(Bake& bake, int node, const char* path, int accessor) {
    bake.channels.push_back(
        {{"sampler", bake.samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    bake.samplers.push_back({{"input", bake.times}, {"interpolation", "LINEAR"}, {"output", accessor}});
}

// The values that one joint takes, if any of them is not its rest value.
template <typename Value, typename Read>
std::vector<Value> moved_values(const Bake& bake, size_t joint, Read read) {
    const Value rest = read(bake.avatar.skeleton.joints[joint].rest);
    std::vector<Value> values;
    bool moves = false;
    for (const Pose& pose : bake.poses) {
        values.push_back(read(pose.joints[joint]));
        moves = moves || differs(values.back(), rest);
    }
    if (!moves) values.clear();
    return values;
}

void add_vectors(Bake& bake, size_t joint, const char* path, const std::vector<Vec3>& values) {
    if (values.empty()) return;
    const std::span<const float> numbers(&values[0].x, 3 * values.size());
    add_channel(bake, bake.node_of_joint[joint], path, bake.glb.add_floats("VEC3", values.size(), numbers));
}

void add_turns(Bake& bake, size_t joint, std::vector<Quat> turns) {
    if (turns.empty()) return;
    std::vector<float> numbers;
    for (size_t t = 0; t < turns.size(); ++t) {
        // The same side of the sphere from key to key, for readers that blend numbers without care.
        if (t > 0 && dot(turns[t - 1], turns[t]) < 0) turns[t] = -turns[t];
        const Quat turn = normalize(turns[t]);
        numbers.insert(numbers.end(), {turn.x, turn.y, turn.z, turn.w});
    }
    add_channel(bake, bake.node_of_joint[joint], "rotation",
                bake.glb.add_floats("VEC4", turns.size(), numbers));
}

void add_joint(Bake& bake, size_t joint) {
    add_vectors(bake, joint, "translation",
                moved_values<Vec3>(bake, joint, [](const Transform& t) { return t.translation; }));
    add_turns(bake, joint, moved_values<Quat>(bake, joint, [](const Transform& t) { return t.rotation; }));
    add_vectors(bake, joint, "scale",
                moved_values<Vec3>(bake, joint, [](const Transform& t) { return t.scale; }));
}

// The morph weights of a node: its surfaces share them.
struct MorphNode {
    int joint = -1;
    size_t first = 0;
    size_t count = 0;
};

std::vector<MorphNode> morph_nodes(const Avatar& avatar) {
    std::vector<MorphNode> nodes;
    for (const Surface& surface : avatar.surfaces) {
        if (surface.morphs.empty()) continue;
        if (nodes.empty() || nodes.back().joint != surface.joint)
            nodes.push_back({surface.joint, static_cast<size_t>(surface.first_morph_weight), 0});
        nodes.back().count = std::max(nodes.back().count, surface.morphs.size());
    }
    return nodes;
}

void add_morphs(Bake& bake, const MorphNode& node) {
    const auto first = static_cast<std::ptrdiff_t>(node.first),
               count = static_cast<std::ptrdiff_t>(node.count);
    const auto rest = bake.avatar.rest_morph_weights.begin() + first;
    std::vector<float> weights;
    bool moves = false;
    for (const Pose& pose : bake.poses) {
        const auto own = pose.morph_weights.begin() + first;
        moves = moves || !std::equal(own, own + count, rest);
        weights.insert(weights.end(), own, own + count);
    }
    if (!moves) return;
    add_channel(bake, bake.node_of_joint[static_cast<size_t>(node.joint)], "weights",
                bake.glb.add_floats("SCALAR", weights.size(), weights));
}

void add_animation(Bake& bake, double fps) {
    std::vector<float> times;
    for (size_t t = 0; t < bake.poses.size(); ++t)
        times.push_back(static_cast<float>(static_cast<double>(t) / fps));
    bake.times = bake.glb.add_floats("SCALAR", times.size(), times);
    Json& accessor = bake.glb.json()["accessors"].back();
    accessor["min"] = {times.front()};
    accessor["max"] = {times.back()};

    for (size_t joint = 0; joint < bake.node_of_joint.size(); ++joint) add_joint(bake, joint);
    for (const MorphNode& node : morph_nodes(bake.avatar)) add_morphs(bake, node);
    bake.glb.json().erase("animations");
    if (bake.channels.empty()) return;
    bake.glb.json()["animations"] = Json::array({{{"name", "motion"},
                                                  {"channels", std::move(bake.channels)},
                                                  {"samplers", std::move(bake.samplers)}}});
}

// A node with a matrix cannot be animated.
void write_rest_transforms(Glb& glb, const Avatar& avatar, const std::vector<int>& node_of_joint) {
    for (size_t joint = 0; joint < node_of_joint.size(); ++joint) {
        Json& node = glb.json()["nodes"][static_cast<size_t>(node_of_joint[joint])];
        if (!node.contains("matrix")) continue;
        const Transform& rest = avatar.skeleton.joints[joint].rest;
        node.erase("matrix");
        node["translation"] = numbers_of(rest.translation);
        node["rotation"] = numbers_of(rest.rotation);
        node["scale"] = numbers_of(rest.scale);
    }
}

// The joint that the reader put above all others becomes a node. Returns its number.
int add_upright_node(Glb& glb, const Avatar& avatar) {
    Json& json = glb.json();
    const Transform& rest = avatar.skeleton.joints[0].rest;
    Json node = {{"name", kUprightJoint},
                 {"translation", numbers_of(rest.translation)},
                 {"rotation", numbers_of(rest.rotation)},
                 {"scale", numbers_of(rest.scale)}};
    const auto number = static_cast<int>(json["nodes"].size());
    Json& scene = json["scenes"][json.value("scene", size_t{0})];
    node["children"] = scene["nodes"];
    scene["nodes"] = Json::array({number});
    json["nodes"].push_back(std::move(node));
    return number;
}

// A file without scenes shows all its nodes.
void name_scene(Glb& glb, const NodeTree& tree) {
    if (!glb.json().value("scenes", Json::array()).empty()) return;
    Json roots = Json::array();
    for (size_t joint = 0; joint < tree.node_of_joint.size(); ++joint) {
        if (tree.skeleton.joints[joint].parent < 0) roots.push_back(tree.node_of_joint[joint]);
    }
    glb.json()["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
    glb.json()["scene"] = 0;
}

// The file of a bare skeleton at rest; node j is joint j.
GltfFile file_of(const Skeleton& skeleton) {
    Json nodes = Json::array(), roots = Json::array(), all = Json::array();
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        const auto& [name, parent, rest] = skeleton.joints[j];
        nodes.push_back({{"name", name},
                         {"translation", numbers_of(rest.translation)},
                         {"rotation", numbers_of(rest.rotation)},
                         {"scale", numbers_of(rest.scale)}});
        all.push_back(j);
        (parent < 0 ? roots : nodes[static_cast<size_t>(parent)]["children"]).push_back(j);
    }
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "chironomia"}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"nodes", std::move(roots)}}})},
                 {"nodes", std::move(nodes)},
                 {"skins", Json::array({{{"joints", std::move(all)}}})},
                 {"bufferViews", Json::array()},
                 {"accessors", Json::array()}};
    return {.name = "skeleton", .json = std::move(json), .buffers = {}, .images = {}};
}

// An avatar with poses, as it is written.
struct PosedAvatar {
    Avatar avatar;
    std::vector<Pose> poses;  // (T)
};

// Whether the avatar was unmirrored, or its rest pose is not the one of the file's nodes.
bool has_other_rest(const Skeleton& avatar, const Skeleton& file, size_t first) {
    for (size_t j = 0; j < file.joints.size(); ++j) {
        if (avatar.joints[first + j].rest != file.joints[j].rest) return true;
    }
    return false;
}

// In the axes of its file, whose first joint is joint `first` of the avatar.
PosedAvatar in_axes_of_file(const Avatar& avatar, std::vector<Pose> poses, const Skeleton& file,
                            size_t first) {
    PosedAvatar written{.avatar = avatar, .poses = std::move(poses)};
    for (size_t j = 0; j < file.joints.size(); ++j)
        written.avatar.skeleton.joints[first + j].rest = file.joints[j].rest;
    for (Pose& pose : written.poses) {
        const auto begin = pose.joints.begin() + static_cast<std::ptrdiff_t>(first);
        std::ranges::copy(mirrored_back(file, {begin, pose.joints.end()}), begin);
    }
    return written;
}

}  // namespace

void write_animated_glb(const std::filesystem::path& out, const std::filesystem::path& avatar_file,
                        const AnimatedAvatar& animated) {
    const auto& [avatar, poses, fps] = animated;
    assert(!poses.empty() && fps > 0);
    GltfFile file = with_feet_on_legs(with_rigify_joints_joined(open_gltf(avatar_file)).file).file;
    const std::vector<Pose> all = poses_of_all_armatures(avatar, poses);
    NodeTree tree = read_nodes(file, *parse_model(file));
    const size_t joints = avatar.skeleton.joints.size();
    const bool uprighted =
        joints == tree.node_of_joint.size() + 1 && avatar.skeleton.joints[0].name == kUprightJoint;
    if (joints != tree.node_of_joint.size() && !uprighted) {
        refuse(file,
               format("has {} nodes and the avatar {} joints; give the file that the avatar was read from",
                      tree.node_of_joint.size(), joints));
    }
    const size_t first = uprighted ? 1 : 0;
    std::optional<PosedAvatar> in_file;
    if (has_other_rest(avatar.skeleton, tree.skeleton, first))
        in_file = in_axes_of_file(avatar, all, tree.skeleton, first);
    const Avatar& written = in_file ? in_file->avatar : avatar;
    try {
        Glb glb(std::move(file));
        name_scene(glb, tree);
        std::vector<int> node_of_joint = tree.node_of_joint;
        if (uprighted) node_of_joint.insert(node_of_joint.begin(), add_upright_node(glb, avatar));
        write_rest_transforms(glb, written, node_of_joint);
        Bake bake{.glb = glb,
                  .avatar = written,
                  .poses = in_file ? in_file->poses : all,
                  .node_of_joint = node_of_joint};
        add_animation(bake, fps);
        write_bytes(out, glb.bytes());
    } catch (const Json::exception& fault) {
        throw Error(
            format("{}: its JSON is no glTF: {}; get the file again", avatar_file.string(), fault_of(fault)));
    }
}

void write_skeleton_glb(const std::filesystem::path& out, const Motion& motion) {
    if (!motion.joints || motion.joints->skeleton.joints.empty()) {
        throw Error(
            format("{}: the motion of {} has no joints; name the avatar that it is put onto with --avatar",
                   out.string(), motion.source));
    }
    Avatar figure;
    figure.skeleton = motion.joints->skeleton;
    const size_t count = figure.skeleton.joints.size();
    std::vector<int> node_of_joint(count);
    std::iota(node_of_joint.begin(), node_of_joint.end(), 0);
    std::vector<Pose> poses(motion.frames, {.joints = rest_transforms(figure.skeleton), .morph_weights = {}});
    for (size_t i = 0; i < motion.frames * count; ++i) {
        poses[i / count].joints[i % count].rotation = motion.joints->turns[i];
        poses[i / count].joints[i % count].translation = motion.joints->translations[i];
    }
    Glb glb(file_of(figure.skeleton));
    Bake bake{.glb = glb, .avatar = figure, .poses = poses, .node_of_joint = node_of_joint};
    add_animation(bake, motion.fps);
    write_bytes(out, glb.bytes());
}

}  // namespace chironomia
