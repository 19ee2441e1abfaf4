// Proves that a study is what it should be: complete, unchanged, blind and balanced.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.h"

namespace chironomia {

// One property of a study.
struct Proof {
    std::string property;  // "the videos of a page are equally long"
    bool holds = false;
    std::string detail;  // what was counted, or the first thing that is wrong
};

struct CheckReport {
    std::filesystem::path folder;
    std::vector<Proof> proofs;

    bool passed() const;
};

// Looks at the files alone; nothing that the build remembered is trusted but the key.
// Throws Error if the folder holds no finished study, or its key or lists are damaged. Videos that are
// damaged are an answer, not an error.
CheckReport check_study(const std::filesystem::path& folder);

// A line per property: "yes" or "NO", the property, the detail.
std::string to_text(const CheckReport& report);

// {"folder", "holds", "proofs": [{"property", "holds", "detail"}]}
Json to_json(const CheckReport& report);

}  // namespace chironomia
