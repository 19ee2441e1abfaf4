// Whether two names stand for the same recording: files, and folders of files, by their bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace chironomia::study {

// Files with the same bytes, or folders whose files, in the order of their names, have the same bytes.
bool have_same_contents(const std::filesystem::path& a, const std::filesystem::path& b);

// Recordings by their contents.
class RecordingContents {
  public:
    // The first path that was given and has the contents of this one; this one if there was none.
    std::filesystem::path first_like(const std::filesystem::path& path);

  private:
    std::map<std::uintmax_t, std::vector<std::filesystem::path>> by_bytes_;  // by how many bytes they have
};

}  // namespace chironomia::study
