#include "skinning/gltf/avatar_info.h"

#include <algorithm>
#include <cmath>

#include "core/body/rest.h"
#include "core/text.h"
#include "skinning/humanoid/stance.h"
#include "skinning/skin.h"

namespace chironomia {
namespace {

double rounded(double value, double unit) {
    return std::round(value / unit) * unit;
}

float rest_height(const Avatar& avatar) {
    const Bounds figure = bounds_of(figure_of(avatar, skin(avatar, rest_pose(avatar))));
    return figure.high.y - figure.low.y;
}

std::string_view name_of(AlphaMode mode) {
    switch (mode) {
        case AlphaMode::mask:
            return "mask";
        case AlphaMode::blend:
            return "blend";
        default:
            return "opaque";
    }
}

Json describe(const Material& material) {
    Json textures = Json::array();
    if (material.base_colour_texture.image >= 0) textures.push_back("base colour");
    if (material.normal_texture.image >= 0) textures.push_back("normal");
    if (material.metallic_roughness_texture.image >= 0) textures.push_back("metallic-roughness");
    if (material.occlusion_texture.image >= 0) textures.push_back("occlusion");
    if (material.emissive_texture.image >= 0) textures.push_back("emissive");
    if (material.anisotropy_texture.image >= 0) textures.push_back("anisotropy");
    return {{"name", material.name},
            {"alpha", name_of(material.alpha_mode)},
            {"double_sided", material.double_sided},
            {"unlit", material.unlit},
            {"textures", std::move(textures)}};
}

void add_surfaces(Json& description, const Avatar& avatar) {
    size_t vertices = 0, triangles = 0, most = 0;
    for (const Surface& surface : avatar.surfaces) {
        vertices += surface.positions.size();
        triangles += surface.triangles.size() / 3;
        for (size_t v = 0; v + 1 < surface.first_influence.size(); ++v)
            most = std::max<size_t>(most, surface.first_influence[v + 1] - surface.first_influence[v]);
    }
    description["joints"] = avatar.skeleton.joints.size();
    description["surfaces"] = avatar.surfaces.size();
    description["vertices"] = vertices;
    description["triangles"] = triangles;
    description["influences"] = most;
}

void add_humanoid(Json& description, const Avatar& avatar) {
    Json parts = Json::object(), missing = Json::array();
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        const std::string name(name_of(part));
        if (avatar.humanoid.has(part)) {
            parts[name] = avatar.skeleton.joints[static_cast<size_t>(avatar.humanoid[part])].name;
        } else {
            missing.push_back(name);
        }
    }
    description["humanoid"] = std::move(parts);
    description["missing"] = std::move(missing);
    description["notes"] = avatar.humanoid_notes;
    for (const std::string& warning : avatar.warnings) description["notes"].push_back(warning);
}

std::vector<std::string> strings(const Json& array) {
    return array.get<std::vector<std::string>>();
}

// Finger joints by their number instead of their names.
std::vector<std::string> shortened_missing(const std::vector<std::string>& parts) {
    std::vector<std::string> shortened;
    int fingers = 0;
    for (const std::string& part : parts) {
        const bool finger = *human_joint_named(part) >= HumanJoint::left_thumb_1;
        if (finger) ++fingers;
        if (!finger) shortened.push_back(part);
    }
    if (fingers > 0) shortened.push_back(format("{} of 30 finger joints", fingers));
    return shortened;
}

std::string material_words(const Json& material) {
    std::vector<std::string> facts = strings(material["textures"]);
    if (material["alpha"] != "opaque") facts.push_back(material["alpha"]);
    if (material["double_sided"]) facts.emplace_back("double-sided");
    if (material["unlit"]) facts.emplace_back("unlit");
    const std::string name = material["name"].get<std::string>();
    return facts.empty() ? name : format("{} ({})", name, join(facts));
}

}  // namespace

Json describe_avatar(const Avatar& avatar) {
    Json description = {{"source", avatar.source}};
    description["height_m"] = rounded(rest_height(avatar), 0.001);
    if (avatar.humanoid.has(HumanJoint::hips)) {
        const Vec3 forward = stance_of(avatar.skeleton, avatar.humanoid).forward;
        description["facing_deg"] = rounded(glm::degrees(std::atan2(forward.x, forward.z)), 0.1);
    }
    add_surfaces(description, avatar);
    description["materials"] = Json::array();
    for (const Material& material : avatar.materials) description["materials"].push_back(describe(material));
    description["images"] = Json::array();
    for (const Image& image : avatar.images)
        description["images"].push_back(
            {{"name", image.name}, {"width", image.width}, {"height", image.height}});
    std::vector<std::string> morphs;
    for (const std::string& name : avatar.morph_names) {
        if (std::find(morphs.begin(), morphs.end(), name) == morphs.end()) morphs.push_back(name);
    }
    description["morphs"] = std::move(morphs);
    add_humanoid(description, avatar);
    return description;
}

std::string avatar_text(const Json& description) {
    std::string text = labelled_list("avatar", {description["source"]});
    text += labelled_list("height", {format("{:.3f} m", description["height_m"].get<double>())});
    if (description.contains("facing_deg")) {
        text += labelled_list(
            "faces", {format("+z within {:.1f} degrees", std::abs(description["facing_deg"].get<double>()))});
    }
    text += labelled_list(
        "mesh", {format("{} surfaces", description["surfaces"].get<size_t>()),
                 format("{} triangles", description["triangles"].get<size_t>()),
                 format("{} vertices", description["vertices"].get<size_t>()),
                 format("at most {} influences a vertex", description["influences"].get<size_t>())});
    std::vector<std::string> materials, images;
    for (const Json& material : description["materials"]) materials.push_back(material_words(material));
    for (const Json& image : description["images"]) {
        images.push_back(format("{} {} x {}", image["name"].get<std::string>(), image["width"].get<int>(),
                                image["height"].get<int>()));
    }
    text += labelled_list("materials", materials);
    text += labelled_list("images", images);
    text += labelled_list("morphs", strings(description["morphs"]));
    text += labelled_list(
        "joints", {format("{}, of which these play a human part:", description["joints"].get<size_t>())});
    for (const auto& [part, joint] : description["humanoid"].items())
        text += format("  {:<18}  {}\n", part, joint.get<std::string>());
    text += labelled_list("missing", shortened_missing(strings(description["missing"])));
    for (const std::string& note : strings(description["notes"])) {
        if (!note.starts_with("missing: ")) text += labelled_list("note", {note});
    }
    return text;
}

}  // namespace chironomia
