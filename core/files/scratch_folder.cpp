#include "core/files/scratch_folder.h"

#include <atomic>
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

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

ScratchFolder::ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

ScratchFolder& ScratchFolder::operator=(ScratchFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
}

}  // namespace chironomia
