// Reading whole files, and outputs that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// Throw Error if the file is missing, is a folder or cannot be read. A text may begin with the byte order
// mark of UTF-8, as programs for Windows write it; it is left out.
std::string read_text(const std::filesystem::path& file);
std::vector<std::byte> read_bytes(const std::filesystem::path& file);

// Throw Error if the folder is missing or unwritable or the disk is full; then nothing is left under `file`.
void write_text(const std::filesystem::path& file, std::string_view text);
void write_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

// A file or folder that is made under a hidden name beside its final one (".clip.mp4.partial") and takes the
// final name by one rename in commit(). Without commit() the destructor removes it. A leftover of a killed
// run is replaced, and so is what a run makes that began before and goes on.
class PendingOutput {
  public:
    enum class Kind { file, folder };

    // Creates missing parent folders. Throws Error if the place cannot be written, or if a folder with that
    // name already holds something.
    PendingOutput(std::filesystem::path final_path, Kind kind);
    ~PendingOutput();
    PendingOutput(const PendingOutput&) = delete;
    PendingOutput& operator=(const PendingOutput&) = delete;

    const std::filesystem::path& path() const { return partial_; }  // where to write
    const std::filesystem::path& final_path() const { return final_; }
    void commit();  // throws Error if the rename fails, or another run makes it now

  private:
    std::filesystem::path final_;
    std::filesystem::path partial_;
    bool committed_ = false;
};

// A bundled file by its path in the source tree ("assets/avatars/mannequin.glb"): looked for in
// $CHIRONOMIA_HOME, in share/chironomia beside the executable's folder, then in the source tree the program
// was built from. Throws Error naming every place that was tried.
std::filesystem::path find_asset(const std::filesystem::path& relative);

}  // namespace chironomia
