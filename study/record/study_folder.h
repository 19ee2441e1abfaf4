// Where the files of a finished study lie.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia::study {

// A study in its folder.
struct StudyFolder {
    std::filesystem::path root;

    std::filesystem::path open() const { return root / "public"; }
    std::filesystem::path closed() const { return root / "private"; }
    std::filesystem::path work() const { return closed() / "work"; }
    std::filesystem::path key() const { return closed() / "key.json"; }
    std::filesystem::path plan() const { return closed() / "plan.json"; }
    std::filesystem::path recordings() const { return closed() / "recordings.json"; }
    std::filesystem::path report() const { return closed() / "report.html"; }
    std::filesystem::path manifest() const { return closed() / "manifest.json"; }
    std::filesystem::path answers() const { return closed() / "answers.sqlite"; }  // unless kept elsewhere
    std::filesystem::path database_elsewhere() const { return closed() / "database.txt"; }  // then its path
    std::filesystem::path archive() const { return root / "archive.json"; }  // where an archive was unpacked
};

inline constexpr std::string_view kManifestFormat = "chironomia manifest 1";

// All files below a folder, by their paths in it, in order.
std::vector<std::string> list_files(const std::filesystem::path& folder);

}  // namespace chironomia::study
