#include "core/body/face.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace chironomia {
namespace {

constexpr std::array<std::pair<int, std::string_view>, 27> kUnits = {{
    {1, "inner brow raiser"},
    {2, "outer brow raiser"},
    {4, "brow lowerer"},
    {5, "upper lid raiser"},
    {6, "cheek raiser"},
    {7, "lid tightener"},
    {8, "lips toward each other"},
    {9, "nose wrinkler"},
    {10, "upper lip raiser"},
    {12, "lip corner puller"},
    {14, "dimpler"},
    {15, "lip corner depressor"},
    {16, "lower lip depressor"},
    {17, "chin raiser"},
    {18, "lip pucker"},
    {19, "tongue show"},
    {20, "lip stretcher"},
    {22, "lip funneler"},
    {23, "lip tightener"},
    {24, "lip pressor"},
    {25, "lips part"},
    {26, "jaw drop"},
    {28, "lip suck"},
    {29, "jaw thrust"},
    {30, "jaw sideways"},
    {34, "cheek puff"},
    {45, "blink"},
}};

}  // namespace

const std::vector<int>& known_action_units() {
    static const std::vector<int> units = [] {
        std::vector<int> numbers;
        for (const auto& [number, name] : kUnits) numbers.push_back(number);
        return numbers;
    }();
    return units;
}

std::string_view name_of_unit(int unit) {
    const auto found =
        std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& known) { return known.first == unit; });
    return found == kUnits.end() ? std::string_view() : found->second;
}

std::string to_text(const FaceChannel& channel) {
    const std::string number = "AU" + std::to_string(channel.unit);
    if (channel.side == FaceSide::both) return number;
    return number + (channel.side == FaceSide::left ? "_L" : "_R");
}

std::optional<FaceChannel> face_channel_named(std::string_view text) {
    FaceChannel channel;
    if (text.ends_with("_L")) channel.side = FaceSide::left;
    if (text.ends_with("_R")) channel.side = FaceSide::right;
    if (channel.side != FaceSide::both) text.remove_suffix(2);
    if (!text.starts_with("AU")) return std::nullopt;
    text.remove_prefix(2);
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), channel.unit);
    if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if (name_of_unit(channel.unit).empty()) return std::nullopt;
    return channel;
}

}  // namespace chironomia
