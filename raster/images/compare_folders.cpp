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

// A link to a folder.
void expect_no_loop(const fs::path& link) {
    if (!lies_within(link.parent_path(), link)) return;
    throw Error(format("{}: is a link to {}, which holds it; remove the link", link.string(),
                       fs::canonical(link).string()));
}

// A link that leads nowhere, or to itself, is read as a file, and reading says what is wrong.
bool is_file(const fs::directory_entry& entry) {
    std::error_code unknown;
    return entry.is_regular_file(unknown) || (entry.is_symlink() && !fs::exists(entry.status(unknown)));
}

bool is_folder(const fs::directory_entry& entry) {
    std::error_code unknown;
    return entry.is_directory(unknown);
}

}  // namespace

bool lies_within(const fs::path& path, const fs::path& folder) {
    const fs::path inner = fs::weakly_canonical(fs::absolute(path));
    const fs::path outer = fs::weakly_canonical(fs::absolute(folder));
    return std::mismatch(inner.begin(), inner.end(), outer.begin(), outer.end()).second == outer.end();
}

std::vector<std::string> compared_files(const fs::path& folder) {
    std::error_code problem;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::follow_directory_symlink, problem);
    std::vector<std::string> names;
    for (; !problem && entry != fs::recursive_directory_iterator(); entry.increment(problem)) {
        if (is_hidden(entry->path())) {
            if (is_folder(*entry)) entry.disable_recursion_pending();
        } else if (is_folder(*entry)) {
            if (entry->is_symlink()) expect_no_loop(entry->path());
        } else if (is_file(*entry) && is_compared(entry->path())) {
            names.push_back(entry->path().lexically_relative(folder).generic_string());
        }
    }
    if (problem)
        throw Error(format("{}: cannot be listed ({}); check the path", folder.string(), problem.message()));
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
