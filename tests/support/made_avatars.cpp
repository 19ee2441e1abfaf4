#include "tests/support/made_avatars.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/math.h"
#include "core/text.h"
#include "tests/support/glb_file.h"
#include "tests/support/made_rigs.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

namespace fs = std::filesystem;

std::size_t add_floats(Glb& glb, const std::vector<float>& numbers, const char* type, std::size_t width) {
    glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
    glb.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", numbers.size() * sizeof(float)}});
    glb.binary.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
    glb.json["accessors"].push_back({{"bufferView", glb.json["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"count", numbers.size() / width},
                                     {"type", type}});
    return glb.json["accessors"].size() - 1;
}

std::vector<float> floats_of(const Glb& glb, const Json& accessor, std::size_t width) {
    std::vector<float> numbers(accessor["count"].get<std::size_t>() * width);
    std::memcpy(numbers.data(), glb.binary.data() + start_of(glb, accessor), numbers.size() * sizeof(float));
    return numbers;
}

struct OwnJoint {
    std::string name;
    int parent = -1;
    Mat4 world{1};
};

// Those of the first skin, in its order.
std::vector<OwnJoint> joints_of(const Json& gltf) {
    const auto nodes = gltf["skins"][0]["joints"].get<std::vector<int>>();
    std::map<int, int> joint_of_node;
    std::vector<OwnJoint> joints;
    for (const int node : nodes) {
        joint_of_node[node] = static_cast<int>(joints.size());
        joints.push_back({.name = gltf["nodes"][static_cast<std::size_t>(node)]["name"]});
    }
    for (const int node : nodes) {
        for (const Json& child :
             gltf["nodes"][static_cast<std::size_t>(node)].value("children", Json::array()))
            joints[static_cast<std::size_t>(joint_of_node.at(child))].parent = joint_of_node[node];
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const Json& node = gltf["nodes"][static_cast<std::size_t>(nodes[j])];
        if (node.contains("rotation") || node.contains("scale") || node.contains("matrix"))
            throw Error("made avatar: a joint of ours is turned at rest; its maker has changed");
        const auto move = node.value("translation", std::vector<float>{0, 0, 0});
        joints[j].world[3] = Vec4(move[0], move[1], move[2], 1);
        const int parent = joints[j].parent;
        if (parent >= static_cast<int>(j)) throw Error("made avatar: a child comes before its parent");
        if (parent >= 0) joints[j].world = joints[static_cast<std::size_t>(parent)].world * joints[j].world;
    }
    return joints;
}

Vec3 place(const Mat4& world) {
    return Vec3(world[3]);
}

// The skin of `glb` on the joints of another rig; at rest every vertex stays where it is.
void give_rig(Glb& glb, const Rig& rig) {
    const std::vector<OwnJoint> own = joints_of(glb.json);
    std::map<std::string, std::string> renamed(rig.names.begin(), rig.names.end());
    std::vector<std::size_t> kept;              // of our joints
    std::vector<std::size_t> heir(own.size());  // what our joints fall to, as places in `kept`
    std::vector<int> parents;
    for (std::size_t j = 0; j < own.size(); ++j) {
        const bool stays = renamed.contains(own[j].name);
        if (own[j].parent < 0 && !stays) throw Error("made avatar: its root has no name");
        const std::size_t above = own[j].parent < 0 ? 0 : heir[static_cast<std::size_t>(own[j].parent)];
        heir[j] = stays ? kept.size() : above;
        if (!stays) continue;
        parents.push_back(own[j].parent < 0 ? -1 : static_cast<int>(above));
        kept.push_back(j);
    }

    std::vector<Mat4> world;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        Quat turn = kNoTurn;
        if (rig.along_bones) {
            if (parents[k] >= 0) turn = glm::quat_cast(Mat3(world[static_cast<std::size_t>(parents[k])]));
            for (std::size_t child = kept.size(); child-- > k + 1;) {
                if (parents[child] != static_cast<int>(k)) continue;
                const Vec3 bone = place(own[kept[child]].world) - place(own[kept[k]].world);
                if (length(bone) > 1e-4f) turn = turn_between(Vec3(0, 1, 0), bone);
            }
        }
        Mat4 joint = glm::mat4_cast(turn);
        joint[3] = own[kept[k]].world[3];
        world.push_back(joint);
    }

    // The nodes: a root, the joints, and what carries the meshes.
    const Mat4 root = rig.z_up ? glm::mat4_cast(glm::angleAxis(-kPi / 2, Vec3(1, 0, 0))) : Mat4(1);
    Json nodes = Json::array({{{"name", rig.z_up ? "Z_UP" : "Armature"}, {"children", {1}}}});
    if (rig.z_up) nodes[0]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    Json joints = Json::array();
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const Mat4 local =
            inverse(parents[k] < 0 ? root : world[static_cast<std::size_t>(parents[k])]) * world[k];
        const Quat turn = normalize(glm::quat_cast(Mat3(local)));
        nodes.push_back({{"name", renamed.at(own[kept[k]].name)},
                         {"translation", {local[3].x, local[3].y, local[3].z}},
                         {"rotation", {turn.x, turn.y, turn.z, turn.w}}});
        if (parents[k] >= 0) nodes[static_cast<std::size_t>(parents[k]) + 1]["children"].push_back(k + 1);
        joints.push_back(k + 1);
    }
    Json roots = {0};
    for (Json node : glb.json["nodes"]) {
        if (!node.contains("mesh")) continue;
        if (rig.groups.empty()) {
            roots.push_back(nodes.size());
            nodes.push_back(node);
            continue;
        }
        node["name"] = rig.groups[roots.size() % rig.groups.size()];
        nodes[0]["children"].push_back(nodes.size());
        nodes.push_back(
            {{"name", rig.groups[nodes.size() % rig.groups.size()]}, {"children", {nodes.size() + 1}}});
        nodes.push_back(node);
    }
    glb.json["nodes"] = nodes;
    glb.json["scenes"][0]["nodes"] = roots;

    Json& skin = glb.json["skins"][0];
    const auto before =
        floats_of(glb, glb.json["accessors"][skin["inverseBindMatrices"].get<std::size_t>()], 16);
    std::vector<float> after;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const Mat4 bind =
            inverse(world[k]) * own[kept[k]].world * glm::make_mat4(before.data() + 16 * kept[k]);
        after.insert(after.end(), glm::value_ptr(bind), glm::value_ptr(bind) + 16);
    }
    skin["inverseBindMatrices"] = add_floats(glb, after, "MAT4", 16);
    skin["joints"] = joints;
    skin["skeleton"] = 1;

    std::map<std::size_t, bool> done;  // accessors that several primitives share
    for (const Json& mesh : glb.json["meshes"]) {
        for (const Json& primitive : mesh["primitives"]) {
            const auto index = primitive["attributes"]["JOINTS_0"].get<std::size_t>();
            if (std::exchange(done[index], true)) continue;
            const Json& accessor = glb.json["accessors"][index];
            if (accessor["componentType"] != 5121) throw Error("made avatar: joints are no bytes");
            const std::size_t start = start_of(glb, accessor);
            for (std::size_t i = 0; i < 4 * accessor["count"].get<std::size_t>(); ++i) {
                char& joint = glb.binary[start + i];
                joint = static_cast<char>(heir.at(static_cast<unsigned char>(joint)));
            }
        }
    }
}

// One more joint between neck01 and head.
void lengthen_neck(Glb& glb) {
    Json& nodes = glb.json["nodes"];
    const auto named = [&](std::string_view name) {
        for (std::size_t n = 0;; ++n) {
            if (nodes.at(n)["name"] == name) return n;
        }
    };
    const std::size_t head = named("head"), neck = named("neck01");
    std::vector<float> half = nodes[head]["translation"];
    for (float& x : half) x /= 2;
    nodes[head]["translation"] = half;
    nodes[neck]["children"] = {nodes.size()};
    nodes.push_back({{"name", "neck02"}, {"translation", half}, {"children", {head}}});
}

// ARKit's name of one of our morphs.
std::string arkit_name(const std::string& ours) {
    static const std::map<std::string, std::string> names = {
        {"AU1", "browInnerUp"},      {"AU2", "browOuterUp"},
        {"AU4", "browDown"},         {"AU5", "eyeWide"},
        {"AU6", "cheekSquint"},      {"AU7", "eyeSquint"},
        {"AU9", "noseSneer"},        {"AU10", "mouthUpperUp"},
        {"AU12", "mouthSmile"},      {"AU14", "mouthDimple"},
        {"AU15", "mouthFrown"},      {"AU16", "mouthLowerDown"},
        {"AU17", "mouthShrugLower"}, {"AU18", "mouthPucker"},
        {"AU19", "tongueOut"},       {"AU20", "mouthStretch"},
        {"AU22", "mouthFunnel"},     {"AU24", "mouthPress"},
        {"AU26", "jawOpen"},         {"AU28", "mouthRollLower"},
        {"AU29", "jawForward"},      {"AU30", "jaw"},
        {"AU34", "cheekPuff"},       {"AU45", "eyeBlink"}};
    const std::size_t line = ours.find('_');
    const auto found = names.find(ours.substr(0, line));
    if (found == names.end()) return ours;
    return found->second + (line == std::string::npos ? "" : ours[line + 1] == 'L' ? "Left" : "Right");
}

// Rigify's second set of joints: an "ORG-" joint beside each "DEF-" one, which it hangs from and moves nothing.
void add_originals(Glb& glb) {
    Json& nodes = glb.json["nodes"];
    for (std::size_t n = 0, count = nodes.size(); n < count; ++n) {
        const std::string name = nodes[n]["name"];
        if (!name.starts_with("DEF-")) continue;
        nodes[n]["children"].push_back(nodes.size());
        nodes.push_back({{"name", "ORG-" + name.substr(4)}, {"translation", {0, 0, 0.01}}});
        glb.json["skins"][0]["joints"].push_back(nodes.size() - 1);
    }
    Json& matrices = glb.json["skins"][0]["inverseBindMatrices"];
    std::vector<float> bind = floats_of(glb, glb.json["accessors"][matrices.get<std::size_t>()], 16);
    bind.reserve(2 * bind.size());
    bind.insert(bind.end(), bind.begin(), bind.end());
    matrices = add_floats(glb, bind, "MAT4", 16);
}

// Meshes with capital letters, a suit, and morphs as ARKit names them.
void give_arkit_names(Glb& glb) {
    for (Json& mesh : glb.json["meshes"]) {
        const std::string name = mesh["name"];
        mesh["name"] = name == "shirt" || name == "trousers" ? "Suit" : capital(name);
        if (!mesh.contains("extras")) continue;
        for (Json& morph : mesh["extras"]["targetNames"]) morph = arkit_name(morph);
    }
}

// Morphs that turn an eyeball about its middle by 20 degrees each way.
void add_looks(Glb& glb) {
    constexpr float kWhole = 20 * kPi / 180;
    for (Json& mesh : glb.json["meshes"]) {
        if (mesh["name"] != "Eyes") continue;
        Json targets = Json::array(), names = Json::array(), weights = Json::array();
        const Json& accessor =
            glb.json["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
        if (accessor["componentType"] != 5126) throw Error("made avatar: places of eyes are no floats");
        const auto view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        if (view.value("byteStride", 12) != 12) throw Error("made avatar: places of eyes are not packed");
        const std::vector<float> places = floats_of(glb, accessor, 3);
        Vec3 low(1e9f), high(-1e9f);
        for (std::size_t i = 0; i < places.size(); i += 3) {
            low = glm::min(low, Vec3(places[i], places[i + 1], places[i + 2]));
            high = glm::max(high, Vec3(places[i], places[i + 1], places[i + 2]));
        }
        const Vec3 middle = (low + high) / 2.0f;
        const bool left = middle.x > 0;
        struct LookMorph {
            const char* name;
            Vec3 axis;
        };
        // Outwards is to the side on which the eye is.
        for (const LookMorph& look : {LookMorph{"eyeLookUp", {-1, 0, 0}},
                                      {"eyeLookDown", {1, 0, 0}},
                                      {"eyeLookOut", {0, left ? 1 : -1, 0}},
                                      {"eyeLookIn", {0, left ? -1 : 1, 0}}}) {
            const Quat turn = glm::angleAxis(kWhole, look.axis);
            std::vector<float> moves;
            for (std::size_t i = 0; i < places.size(); i += 3) {
                const Vec3 from = Vec3(places[i], places[i + 1], places[i + 2]) - middle;
                const Vec3 move = turn * from - from;
                moves.insert(moves.end(), {move.x, move.y, move.z});
            }
            Json target;
            target["POSITION"] = add_floats(glb, moves, "VEC3", 3);
            targets.push_back(target);
            names.push_back(std::string(look.name) + (left ? "Left" : "Right"));
            weights.push_back(0);
        }
        mesh["primitives"][0]["targets"] = targets;
        mesh["extras"]["targetNames"] = names;
        mesh["weights"] = weights;
    }
}

// VRM 1.0 calls Mixamo's joints so.
std::string vrm_bone(std::string name) {
    const auto replace = [&](const std::string& from, const std::string& to) {
        const std::size_t at = name.find(from);
        if (at != std::string::npos) name.replace(at, from.size(), to);
    };
    if (const std::size_t hand = name.find("Hand"); hand != std::string::npos && hand + 4 < name.size()) {
        const bool thumb = name.find("Thumb") != std::string::npos;
        const int i = name.back() - '1';
        name.pop_back();
        replace("Hand", "");
        replace("Pinky", "Little");
        name += thumb ? std::array{"Metacarpal", "Proximal", "Distal"}[static_cast<std::size_t>(i)]
                      : std::array{"Proximal", "Intermediate", "Distal"}[static_cast<std::size_t>(i)];
    } else {
        replace("Spine2", "UpperChest");
        replace("Spine1", "Chest");
        replace("ForeArm", "LowerForearm");
        if (name.ends_with("Arm")) replace("Arm", "UpperArm");
        replace("LowerForearm", "LowerArm");
        if (name.ends_with("UpLeg"))
            replace("UpLeg", "UpperLeg");
        else
            replace("Leg", "LowerLeg");
        replace("ToeBase", "Toes");
    }
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    return name;
}

void add_vrm(Glb& glb, const std::string& prefix) {
    Json bones = Json::object(), preset = Json::object();
    Json& nodes = glb.json["nodes"];
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const std::string name = nodes[n]["name"];
        if (name.starts_with(prefix)) bones[vrm_bone(name.substr(prefix.size()))] = {{"node", n}};
    }
    const std::map<std::string, std::vector<std::string>> expressions = {
        {"happy", {"mouthSmileLeft", "mouthSmileRight"}},
        {"sad", {"mouthFrownLeft", "mouthFrownRight"}},
        {"angry", {"browDownLeft", "browDownRight"}},
        {"surprised", {"browInnerUpLeft", "browInnerUpRight", "browOuterUpLeft", "browOuterUpRight"}},
        {"aa", {"jawOpen"}},
        {"ih", {"mouthStretchLeft", "mouthStretchRight"}},
        {"ou", {"mouthPucker"}},
        {"oh", {"mouthFunnel"}},
        {"blink", {"eyeBlinkLeft", "eyeBlinkRight"}},
        {"blinkLeft", {"eyeBlinkLeft"}},
        {"blinkRight", {"eyeBlinkRight"}},
        {"lookUp", {"eyeLookUpLeft", "eyeLookUpRight"}},
        {"lookDown", {"eyeLookDownLeft", "eyeLookDownRight"}},
        {"lookLeft", {"eyeLookOutLeft", "eyeLookInRight"}},
        {"lookRight", {"eyeLookInLeft", "eyeLookOutRight"}},
    };
    for (const auto& [expression, morphs] : expressions) {
        Json binds = Json::array();
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            if (!nodes[n].contains("mesh")) continue;
            const Json& mesh = glb.json["meshes"][nodes[n]["mesh"].get<std::size_t>()];
            const Json names = mesh.value("extras", Json::object()).value("targetNames", Json::array());
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (std::find(morphs.begin(), morphs.end(), names[i]) != morphs.end())
                    binds.push_back({{"node", n}, {"index", i}, {"weight", 1}});
            }
        }
        preset[expression] = {{"morphTargetBinds", binds}};
    }
    glb.json["extensionsUsed"].push_back("VRMC_vrm");
    glb.json["extensions"]["VRMC_vrm"] = {{"specVersion", "1.0"},
                                          {"meta", {{"name", "made"}, {"authors", {"Chironomia"}}}},
                                          {"humanoid", {{"humanBones", bones}}},
                                          {"expressions", {{"preset", preset}}}};
}

Json& node_named(Glb& glb, std::string_view name) {
    for (Json& node : glb.json["nodes"])
        if (node.value("name", "") == name) return node;
    throw Error(format("made avatar: it has no node \"{}\"", name));
}

void move_from_origin(Json& root, const std::array<float, 3>& by) {
    auto place = root.value("translation", std::vector<float>{0, 0, 0});
    for (std::size_t i = 0; i < 3; ++i) place[i] += by[i];
    root["translation"] = place;
}

Glb own_avatar(const char* name) {
    return read_glb(source_dir() / "assets/avatars" / name);
}

}  // namespace

void write_made_avatar(const fs::path& file) {
    const std::string name = file.filename();
    Glb glb = own_avatar(name == "numbered.glb" ? "mannequin.glb"
                         : name == "mixamo.glb" ? "male.glb"
                                                : "neutral.glb");
    if (name == "numbered.glb") {
        give_rig(glb, numbered_rig());
    } else if (name == "sumerian.glb") {
        give_rig(glb, sumerian_rig());
    } else if (name == "rigify.glb") {
        give_rig(glb, rigify_rig());
        add_originals(glb);
    } else if (name == "biped.glb") {
        give_rig(glb, biped_rig());
    } else if (name == "makehuman.glb") {
        give_rig(glb, makehuman_rig());
        give_arkit_names(glb);
        lengthen_neck(glb);
    } else if (name == "mixamo.glb" || name == "vrm.vrm") {
        const std::string prefix = name == "vrm.vrm" ? "J_Bip_" : "mixamorig:";
        give_rig(glb, mixamo_rig(prefix));
        give_arkit_names(glb);
        add_looks(glb);
        if (name == "vrm.vrm") add_vrm(glb, prefix);
    } else if (name == "large_head.glb") {
        node_named(glb, "head")["scale"] = {2.5, 2.5, 2.5};
    } else if (name == "beside.glb") {
        move_from_origin(node_named(glb, "hips"), {0.9f, 0, 0.4f});
    } else {
        throw Error(format("{}: no such avatar is made; see tests/support/made_avatars.h", name));
    }
    write_glb(file, glb);
}

}  // namespace chironomia::testing
