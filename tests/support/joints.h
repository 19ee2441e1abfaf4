// Joints by their names.
#pragma once

#include <optional>
#include <string_view>

#include "core/body/skeleton.h"

namespace chironomia::testing {

// The first joint of that name, if there is one.
inline std::optional<int> find_joint(const Skeleton& skeleton, std::string_view name) {
    for (size_t j = 0; j < skeleton.joints.size(); ++j)
        if (skeleton.joints[j].name == name) return static_cast<int>(j);
    return std::nullopt;
}

}  // namespace chironomia::testing
