// The files of two folders, matched by their relative names.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace chironomia {

// The relative names ("walk/00012.png") of the .png, .exr, .mp4 and .webm files below a folder, ascending. Hidden files
// and folders are passed over, links are followed; one that leads nowhere counts as a file. Throws Error if it is none,
// or if a link leads to a folder that holds the link.
std::vector<std::string> compared_files(const std::filesystem::path& folder);

// Whether it is the folder or lies in it, by their real paths; neither needs to exist.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

struct FileMatch {
    bool expected = false;  // whether it is there
    bool actual = false;
};

// By relative name.
std::map<std::string, FileMatch> match_files(const std::filesystem::path& expected,
                                             const std::filesystem::path& actual);

}  // namespace chironomia
