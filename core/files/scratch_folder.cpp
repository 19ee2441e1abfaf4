#include "core/files/scratch_folder.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(std::string_view purpose) {
    static std::atomic<int> count = 0;
    std::error_code problem;
    fs::path path = fs::temp_directory_path(problem);
    path /= format("chironomia-{}-{}-{}", purpose, ::getpid(), ++count);
    if (!problem) fs::remove_all(path, problem);
    if (!problem) fs::create_directories(path, problem);
    if (problem) {
        throw Error(format("{}: cannot be made ({}); let TMPDIR name a folder that can be written in",
                           path.string(), problem.message()));
    }
    path_ = std::move(path);
}

ScratchFolder ScratchFolder::within(const fs::path& folder) {
    std::string name = (folder / ".partial-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw Error(format("{}: no folder can be made in it ({}); check free space and permissions",
                           folder.string(), std::strerror(errno)));
    }
    ScratchFolder made;
    made.path_ = name;
    return made;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

ScratchFolder::ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

ScratchFolder& ScratchFolder::operator=(ScratchFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
}

void ScratchFolder::move_out(const fs::path& made, const fs::path& final_path) const {
    std::error_code problem;
    fs::rename(path_ / made, final_path, problem);
    if (problem)
        throw Error(format("{}: cannot be put in place ({})", final_path.string(), problem.message()));
}

}  // namespace chironomia
