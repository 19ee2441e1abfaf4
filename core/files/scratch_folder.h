// A folder for files that nobody needs for long.
#pragma once

#include <filesystem>
#include <string_view>

namespace chironomia {

// Made empty in the system's folder for temporary files, and removed with all that is in it by the destructor.
class ScratchFolder {
  public:
    // Throws Error if it cannot be made. `purpose` stands in its name.
    explicit ScratchFolder(std::string_view purpose);
    ~ScratchFolder();
    ScratchFolder(ScratchFolder&& other) noexcept;
    ScratchFolder& operator=(ScratchFolder&& other) noexcept;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;  // empty: moved away
};

}  // namespace chironomia
