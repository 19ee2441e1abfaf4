#include "study/clip/avatars.h"

#include <algorithm>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

const fs::path kAvatars = "assets/avatars";

}  // namespace

std::vector<std::string> bundled_avatars() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(find_asset(kAvatars))) {
        if (entry.path().extension() == ".glb") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool is_stick(const fs::path& avatar) {
    return avatar == "stick";
}

std::vector<std::string> avatar_names() {
    std::vector<std::string> names = bundled_avatars();
    names.emplace_back("stick");
    return names;
}

fs::path find_avatar(const fs::path& name_or_file) {
    if (is_stick(name_or_file)) {
        throw Error(
            format("{}: is drawn from a motion by render and study, and has no file; choose one of {}",
                   name_or_file.string(), join(bundled_avatars())));
    }
    if (fs::exists(name_or_file) && !fs::is_directory(name_or_file)) return name_or_file;
    const std::vector<std::string> bundled = bundled_avatars();
    if (std::find(bundled.begin(), bundled.end(), name_or_file) != bundled.end()) {
        return find_asset(kAvatars / (name_or_file.string() + ".glb"));
    }
    throw Error(format("{}: is neither a file nor a bundled avatar; the bundled ones are {}",
                       name_or_file.string(), join(avatar_names())));
}

}  // namespace chironomia::study
