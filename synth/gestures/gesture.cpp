#include "synth/gestures/gesture.h"

#include <algorithm>
#include <cassert>

namespace chironomia {
namespace {

template <typename Entry>
std::optional<std::size_t> index_of(const std::vector<Entry>& entries, std::string_view id) {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.id == id; });
    if (found == entries.end()) return std::nullopt;
    return static_cast<std::size_t>(found - entries.begin());
}

}  // namespace

std::string_view name_of(GesturePhase phase) {
    switch (phase) {
        case GesturePhase::rest:
            return "rest";
        case GesturePhase::preparation:
            return "preparation";
        case GesturePhase::pre_stroke_hold:
            return "pre-stroke-hold";
        case GesturePhase::stroke:
            return "stroke";
        case GesturePhase::post_stroke_hold:
            return "post-stroke-hold";
        case GesturePhase::retraction:
            return "retraction";
    }
    assert(false);
    return "";
}

std::string_view name_of(GestureCategory category) {
    switch (category) {
        case GestureCategory::beat:
            return "beat";
        case GestureCategory::metaphoric:
            return "metaphoric";
        case GestureCategory::iconic:
            return "iconic";
        case GestureCategory::deictic:
            return "deictic";
        case GestureCategory::emblem:
            return "emblem";
        case GestureCategory::adaptor:
            return "adaptor";
    }
    assert(false);
    return "";
}

std::optional<std::size_t> find_gesture(const Lexicon& lexicon, std::string_view id) {
    return index_of(lexicon.gestures, id);
}

std::optional<std::size_t> find_shape(const Lexicon& lexicon, std::string_view id) {
    return index_of(lexicon.shapes, id);
}

}  // namespace chironomia
