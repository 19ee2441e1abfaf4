#include "skinning/degrade/point_tree.h"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "skinning/body/keypoint_layout.h"

namespace chironomia {
namespace {

// The parent of a landmark, "" for none; of a finger's joint the joint before it.
std::string parent_of(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> kMiddle[] = {
        {"spine", "pelvis"},       {"chest", "spine"}, {"upper_chest", "chest"},
        {"thorax", "upper_chest"}, {"neck", "thorax"}, {"head", "neck"},
        {"head_top", "head"},      {"nose", "head"},   {"jaw", "head"}};
    constexpr std::pair<std::string_view, std::string_view> kSides[] = {
        {"collar", "thorax"}, {"shoulder", "collar"}, {"elbow", "shoulder"}, {"wrist", "elbow"},
        {"hand", "wrist"},    {"hip", "pelvis"},      {"knee", "hip"},       {"ankle", "knee"},
        {"heel", "ankle"},    {"toe", "ankle"},       {"small_toe", "ankle"}};
    for (const auto& [point, parent] : kMiddle)
        if (name == point) return std::string(parent);
    const std::size_t side_end = name.find('_');
    if (side_end == std::string_view::npos) return "";
    const std::string side(name.substr(0, side_end + 1));
    const std::string_view part = name.substr(side_end + 1);
    for (const auto& [point, parent] : kSides)
        if (part == point)
            return parent == "thorax" || parent == "pelvis" ? std::string(parent)
                                                            : side + std::string(parent);
    const std::size_t joint = part.find('_');
    if (joint + 2 != part.size() || part.back() < '1' || part.back() > '9') return "nose";
    if (part.back() == '1') return side + "wrist";
    return side + std::string(part.substr(0, joint + 1)) + static_cast<char>(part.back() - 1);
}

}  // namespace

std::vector<std::vector<std::size_t>> ancestors_of(const std::vector<std::string>& names) {
    std::vector<std::vector<std::size_t>> ancestors(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        std::string parent = landmark_named(names[k]) ? parent_of(names[k]) : "nose";
        for (; !parent.empty(); parent = parent_of(parent)) {
            const auto found = std::find(names.begin(), names.end(), parent);
            if (found != names.end()) ancestors[k].push_back(static_cast<std::size_t>(found - names.begin()));
        }
    }
    return ancestors;
}

std::vector<std::size_t> ancestors_first(const std::vector<std::vector<std::size_t>>& ancestors) {
    std::vector<std::size_t> order(ancestors.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return ancestors[a].size() < ancestors[b].size(); });
    return order;
}

std::optional<std::size_t> seen_ancestor(const std::vector<std::size_t>& ancestors,
                                         std::span<const float> confidence) {
    for (const std::size_t parent : ancestors)
        if (confidence[parent] > 0) return parent;
    return std::nullopt;
}

}  // namespace chironomia
