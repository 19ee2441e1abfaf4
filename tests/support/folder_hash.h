// One hash for all files of a folder.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/hash.h"

namespace chironomia::testing {

// Of their names and bytes.
inline std::string hash_of_folder(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string all;
    for (const std::filesystem::path& file : files)
        all += std::filesystem::relative(file, folder).string() + " " + sha256_of_file(file) + "\n";
    return sha256(all);
}

}  // namespace chironomia::testing
