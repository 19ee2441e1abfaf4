// All that the server reads of a study: its pages and key, how many participants are wanted, and where they
// go at the end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/record/key.h"
#include "study/record/pages.h"

namespace chironomia::study::server {

// Where participants go, and the code that they bring there; empty: nowhere, none.
struct Completion {
    std::string url;
    std::string code;
    std::string failed_url;  // of those who failed attention checks; without both: the same as the others
    std::string failed_code;
    std::string declined_url;  // of those who do not agree to take part
};

struct ServedStudy {
    std::filesystem::path folder;
    Json data;  // pages.json
    StudyPages pages;
    StudyKey key;
    std::vector<std::vector<Step>> sheets;  // the steps of each
    std::optional<std::size_t> wanted;      // participants; none: as many as come
    Completion completion;
};

// Reads public/pages.json, private/key.json and, if it is there, private/plan.json ("participants":
// {"wanted"}, "completion"). Throws Error if one is damaged, they do not fit together, or public/index.html
// is missing.
ServedStudy read_served_study(const std::filesystem::path& folder);

}  // namespace chironomia::study::server
