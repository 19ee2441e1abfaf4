#include "study/record/page_kinds.h"

#include <algorithm>

namespace chironomia::study {
namespace {

// In the order of the enums.
const std::vector<std::string> kLayouts = {"single", "pair", "triplet", "parallel"};
const std::vector<std::string> kPageKinds = {"trial", "check", "practice"};

}  // namespace

const std::string& to_text(Layout layout) {
    return kLayouts.at(static_cast<std::size_t>(layout));
}

const std::string& to_text(PageKind kind) {
    return kPageKinds.at(static_cast<std::size_t>(kind));
}

std::size_t index_of_choice(const JsonValue& value, const std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), value.choice(names));
    return static_cast<std::size_t>(found - names.begin());
}

Layout layout_named(const JsonValue& value) {
    return static_cast<Layout>(index_of_choice(value, kLayouts));
}

PageKind page_kind_named(const JsonValue& value) {
    return static_cast<PageKind>(index_of_choice(value, kPageKinds));
}

}  // namespace chironomia::study
