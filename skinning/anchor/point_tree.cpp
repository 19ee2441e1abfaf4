#include "skinning/anchor/point_tree.h"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "skinning/body/keypoint_layout.h"

namespace chironomia {
namespace {

// What carries a landmark, "" for none; of a finger's joint the one before it.
std::string carrier_of(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> kMiddle[] = {
        {"spine", "pelvis"},       {"chest", "spine"}, {"upper_chest", "chest"},
        {"thorax", "upper_chest"}, {"neck", "thorax"}, {"head", "neck"},
        {"head_top", "head"},      {"nose", "head"},   {"jaw", "head"}};
    constexpr std::pair<std::string_view, std::string_view> kSides[] = {
        {"collar", "thorax"}, {"shoulder", "collar"}, {"elbow", "shoulder"}, {"wrist", "elbow"},
        {"hand", "wrist"},    {"hip", "pelvis"},      {"knee", "hip"},       {"ankle", "knee"},
        {"heel", "ankle"},    {"toe", "ankle"},       {"small_toe", "ankle"}};
    for (const auto& [point, carrier] : kMiddle)
        if (name == point) return std::string(carrier);
    const std::size_t side_end = name.find('_');
    if (side_end == std::string_view::npos) return "";
    const std::string side(name.substr(0, side_end + 1));
    const std::string_view part = name.substr(side_end + 1);
    for (const auto& [point, carrier] : kSides)
        if (part == point)
            return carrier == "thorax" || carrier == "pelvis" ? std::string(carrier)
                                                              : side + std::string(carrier);
    const std::size_t joint = part.find('_');
    if (joint + 2 != part.size() || part.back() < '1' || part.back() > '9') return "nose";
    if (part.back() == '1') return side + "wrist";
    return side + std::string(part.substr(0, joint + 1)) + static_cast<char>(part.back() - 1);
}

}  // namespace

std::vector<std::vector<std::size_t>> carriers_of(const std::vector<std::string>& names) {
    std::vector<std::vector<std::size_t>> carriers(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        std::string carrier = landmark_named(names[k]) ? carrier_of(names[k]) : "nose";
        for (; !carrier.empty(); carrier = carrier_of(carrier)) {
            const auto found = std::find(names.begin(), names.end(), carrier);
            if (found != names.end()) carriers[k].push_back(static_cast<std::size_t>(found - names.begin()));
        }
    }
    return carriers;
}

std::vector<std::size_t> carriers_first(const std::vector<std::vector<std::size_t>>& carriers) {
    std::vector<std::size_t> order(carriers.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return carriers[a].size() < carriers[b].size(); });
    return order;
}

std::optional<std::size_t> seen_carrier(const std::vector<std::size_t>& carriers,
                                        std::span<const float> confidence) {
    for (const std::size_t carrier : carriers)
        if (confidence[carrier] > 0) return carrier;
    return std::nullopt;
}

}  // namespace chironomia
