// Folders of motions that belong together by the names of their files: what systems made, what people did, sounds.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace chironomia::study {

enum class FolderOf { made, reference, sounds };

// By the name that pairs them, without folder and ending. Of `made` a leading "res_", of `reference` a leading "gt_"
// goes, and where a folder has such files it has no others, as EMAGE writes both side by side. A file stands for
// itself; a folder of OpenPose or Panoptic is a motion. Throws Error if a folder holds none or two of one name.
std::map<std::string, std::filesystem::path> files_by_name(const std::filesystem::path& path, FolderOf what);

bool is_folder_of_motions(const std::filesystem::path& path);

}  // namespace chironomia::study
