#include "skinning/gltf/gltf_expressions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/files/json_fault.h"
#include "core/text.h"

namespace chironomia {
namespace {

// VRM 0.x presets whose name changed.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kRenamed = {{
    {"joy", "happy"},
    {"sorrow", "sad"},
    {"fun", "relaxed"},
    {"a", "aa"},
    {"i", "ih"},
    {"u", "ou"},
    {"e", "ee"},
    {"o", "oh"},
    {"blink_l", "blinkLeft"},
    {"blink_r", "blinkRight"},
    {"lookup", "lookUp"},
    {"lookdown", "lookDown"},
    {"lookleft", "lookLeft"},
    {"lookright", "lookRight"},
}};

std::string name_of_preset(const std::string& preset) {
    const auto found = std::find_if(kRenamed.begin(), kRenamed.end(),
                                    [&](const auto& names) { return names.first == preset; });
    return found == kRenamed.end() ? preset : std::string(found->second);
}

// Where the binds of a version say what they move, and what counts as all of it.
struct BindForm {
    const char* owner;  // key of the node or mesh
    bool by_mesh = false;
    double whole = 1;  // the weight of the file that stands for 1
};
constexpr BindForm kVrm1 = {.owner = "node"};
constexpr BindForm kVrm0 = {.owner = "mesh", .by_mesh = true, .whole = 100};

void add_binds(Expression& expression, const Json& binds, const BindForm& form,
               const std::vector<MorphSet>& sets) {
    for (const Json& bind : binds) {
        const int owner = bind.at(form.owner), index = bind.at("index");
        const double weight = bind.value("weight", form.whole) / form.whole;
        if (!std::isfinite(weight)) continue;
        for (const MorphSet& set : sets) {
            if ((form.by_mesh ? set.mesh : set.node) != owner || index < 0 || index >= set.morphs) continue;
            expression.binds.push_back(
                {.morph = set.first + index, .weight = static_cast<float>(std::clamp(weight, 0.0, 1.0))});
        }
    }
}

void keep(std::vector<Expression>& all, Expression expression) {
    if (!expression.binds.empty()) all.push_back(std::move(expression));
}

const Json& empty_list() {
    static const Json list = Json::array();
    return list;
}

const Json& list_in(const Json& object, const char* key) {
    return object.contains(key) ? object.at(key) : empty_list();
}

std::vector<Expression> expressions_of_vrm1(const Json& vrm, const std::vector<MorphSet>& sets) {
    std::vector<Expression> all;
    if (!vrm.contains("expressions")) return all;
    for (const char* kind : {"preset", "custom"}) {
        for (const auto& [name, value] : list_in(vrm.at("expressions"), kind).items()) {
            Expression expression{.name = name, .binds = {}};
            add_binds(expression, list_in(value, "morphTargetBinds"), kVrm1, sets);
            keep(all, std::move(expression));
        }
    }
    return all;
}

std::vector<Expression> expressions_of_vrm0(const Json& vrm, const std::vector<MorphSet>& sets) {
    std::vector<Expression> all;
    if (!vrm.contains("blendShapeMaster")) return all;
    for (const Json& group : list_in(vrm.at("blendShapeMaster"), "blendShapeGroups")) {
        const std::string preset = to_lower(group.value("presetName", ""));
        const bool named = preset.empty() || preset == "unknown";
        Expression expression{.name = named ? group.value("name", "") : name_of_preset(preset), .binds = {}};
        add_binds(expression, list_in(group, "binds"), kVrm0, sets);
        keep(all, std::move(expression));
    }
    return all;
}

}  // namespace

std::vector<Expression> read_vrm_expressions(const GltfFile& file, const std::vector<MorphSet>& sets) {
    const Json extensions = file.json.value("extensions", Json::object());
    try {
        if (extensions.contains("VRMC_vrm")) return expressions_of_vrm1(extensions.at("VRMC_vrm"), sets);
        if (extensions.contains("VRM")) return expressions_of_vrm0(extensions.at("VRM"), sets);
    } catch (const Json::exception& fault) {
        refuse(file, format("its VRM expressions are broken: {}; write the file again", fault_of(fault)));
    }
    return {};
}

}  // namespace chironomia
