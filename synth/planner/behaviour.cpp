#include "synth/planner/behaviour.h"

#include <algorithm>
#include <array>

namespace chironomia {

namespace {

// In the order of SignalKind.
constexpr std::array<std::string_view, 14> kNames = {
    "nod",        "shake",     "tilt",   "brow raise", "frown",     "smile",   "sad mouth",
    "angry face", "surprised", "afraid", "disgusted",  "look away", "look at", "shift"};

}  // namespace

std::string_view name_of(SignalKind kind) {
    return kNames[static_cast<std::size_t>(kind)];
}

std::optional<SignalKind> signal_named(std::string_view name) {
    const auto found = std::ranges::find(kNames, name);
    if (found == kNames.end()) return std::nullopt;
    return static_cast<SignalKind>(found - kNames.begin());
}

}  // namespace chironomia
