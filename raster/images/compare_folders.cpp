#include "raster/images/compare_folders.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 4> kCompared = {".png", ".exr", ".mp4", ".webm"};

bool is_hidden(const fs::path& path) {
    return path.filename().string().starts_with('.');
}

bool is_compared(const fs::path& file) {
    return std::find(kCompared.begin(), kCompared.end(), to_lower(file.extension().string())) !=
           kCompared.end();
}

}  // namespace

std::vector<std::string> compared_files(const fs::path& folder) {
    std::error_code problem;
    fs::recursive_directory_iterator entry(folder, problem);
    if (problem)
        throw Error(format("{}: cannot be listed ({}); check the path", folder.string(), problem.message()));
    std::vector<std::string> names;
    for (; entry != fs::recursive_directory_iterator(); ++entry) {
        if (is_hidden(entry->path())) {
            if (entry->is_directory()) entry.disable_recursion_pending();
        } else if (entry->is_regular_file() && is_compared(entry->path())) {
            names.push_back(entry->path().lexically_relative(folder).generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::map<std::string, FileMatch> match_files(const fs::path& expected, const fs::path& actual) {
    std::map<std::string, FileMatch> matches;
    for (const std::string& name : compared_files(expected)) matches[name].expected = true;
    for (const std::string& name : compared_files(actual)) matches[name].actual = true;
    return matches;
}

}  // namespace chironomia
