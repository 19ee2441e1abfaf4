#include "core/speech.h"

#include <array>
#include <cassert>

namespace chironomia {

std::string_view name_of(MarkKind kind) {
    // In the order of MarkKind.
    constexpr std::array<std::string_view, 15> kNames = {
        "theme",        "rheme",     "emphasis",        "pitch-accent", "boundary",
        "performative", "certainty", "belief-relation", "deictic",      "world",
        "emotion",      "turn",      "backchannel",     "gesture",      "signal"};
    return kNames[static_cast<std::size_t>(kind)];
}

double time_of(const SyncPoint& point, const Speech& speech) {
    if (!point.word) return point.offset;
    assert(*point.word <= speech.words.size());
    if (*point.word < speech.words.size()) return speech.words[*point.word].start + point.offset;
    return (speech.words.empty() ? 0 : speech.words.back().end) + point.offset;
}

}  // namespace chironomia
