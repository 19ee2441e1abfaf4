// A folder for temporary files.
#pragma once

#include <filesystem>
#include <string_view>

namespace chironomia {

// Made empty, in the system's folder for temporary files if no other is named, and removed with all that is in it by
// the destructor.
class ScratchFolder {
  public:
    // Throws Error if it cannot be made. `purpose` stands in its name.
    explicit ScratchFolder(std::string_view purpose);

    // In `folder`, which other machines may share: under a hidden name that no process of any of them has. Throws
    // Error if it cannot be made.
    static ScratchFolder within(const std::filesystem::path& folder);

    ~ScratchFolder();
    ScratchFolder(ScratchFolder&& other) noexcept;
    ScratchFolder& operator=(ScratchFolder&& other) noexcept;

    const std::filesystem::path& path() const { return path_; }

    // Gives a file or folder its final name by one rename; a file of that name is replaced. Throws Error if the system
    // refuses.
    //   made   its path in this folder
    void move_out(const std::filesystem::path& made, const std::filesystem::path& final_path) const;

  private:
    ScratchFolder() = default;

    std::filesystem::path path_;  // empty: moved away
};

}  // namespace chironomia
