#include "study/models/motion_folder.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/motion/points/bodies_json.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

bool is_motion_folder(const fs::path& path) {
    return is_openpose_folder(path) || is_panoptic_folder(path);
}

bool may_be(const fs::path& file, FolderOf what) {
    const std::set<std::string> sounds = {".wav", ".flac", ".ogg", ".opus", ".mp3", ".m4a", ".mp4"};
    if (file.filename().string().starts_with('.')) return false;  // macOS hides files beside others
    if (fs::is_directory(file)) return what != FolderOf::sounds && is_motion_folder(file);
    const std::string ending = to_lower(file.extension().string());
    // Beside an array a JSON of its name says how it is read.
    const auto is_beside = [&](const char* array) {
        return fs::exists(fs::path(file).replace_extension(array));
    };
    if (ending == ".json" && (is_beside(".npz") || is_beside(".npy"))) return false;
    return what == FolderOf::sounds ? sounds.contains(ending) : may_be_motion(file);
}

std::string name_of(const fs::path& file) {
    return fs::is_directory(file) ? file.filename().string() : file.stem().string();
}

}  // namespace

bool is_folder_of_motions(const fs::path& path) {
    return fs::is_directory(path) && !is_motion_folder(path);
}

std::map<std::string, fs::path> files_by_name(const fs::path& path, FolderOf what) {
    const std::string prefix = what == FolderOf::made ? "res_" : what == FolderOf::reference ? "gt_" : "";
    std::vector<fs::path> files;
    if (is_folder_of_motions(path)) {
        for (const auto& entry : fs::directory_iterator(path))
            if (may_be(entry.path(), what)) files.push_back(entry.path());
        const auto is_other = [&](const fs::path& file) { return !name_of(file).starts_with(prefix); };
        if (!std::ranges::all_of(files, is_other)) std::erase_if(files, is_other);
    } else {
        files.push_back(path);
    }
    if (files.empty()) {
        throw Error(format("{}: holds no {}", path.string(),
                           what == FolderOf::sounds
                               ? "sound; give a folder with WAV, FLAC, OGG or MP3 in it"
                               : "motion; give a folder with BVH, keypoints or OpenPose in it"));
    }
    std::map<std::string, fs::path> named;
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        const std::string whole = name_of(file);
        const std::string name = whole.starts_with(prefix) ? whole.substr(prefix.size()) : whole;
        const auto [other, is_new] = named.emplace(name, file);
        if (is_new) continue;
        throw Error(format("{} and {}: both are called {}; keep one of them in the folder",
                           other->second.string(), file.string(), name));
    }
    return named;
}

}  // namespace chironomia::study
