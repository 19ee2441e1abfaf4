#include "synth/planner/behaviour.h"

#include <array>

namespace chironomia {

std::string_view name_of(SignalKind kind) {
    // In the order of SignalKind.
    constexpr std::array<std::string_view, 14> kNames = {
        "nod",        "shake",     "tilt",   "brow raise", "frown",     "smile",   "sad mouth",
        "angry face", "surprised", "afraid", "disgusted",  "look away", "look at", "shift"};
    return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace chironomia
