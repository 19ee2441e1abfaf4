#include "core/input_file.h"

#include <fstream>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

bool is_lfs_pointer(const fs::path& file) {
    constexpr std::string_view kBegins = "version https://git-lfs.github.com/spec/";
    constexpr std::size_t kMost = 1024;  // bytes, as Git LFS's specification has it
    std::error_code problem;
    if (fs::file_size(file, problem) >= kMost || problem) return false;
    std::string head(kBegins.size(), '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head == kBegins;
}

}  // namespace

void expect_file(const fs::path& file) {
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    if (status.type() == fs::file_type::none) {
        throw Error(format("{}: cannot be opened ({}); check the path and its permissions", file.string(),
                           problem.message()));
    }
    if (!fs::exists(status)) throw Error(format("{}: there is no such file; check the path", file.string()));
    if (fs::is_directory(status))
        throw Error(format("{}: this is a folder, a file is needed", file.string()));
    if (!fs::is_regular_file(status)) {
        throw Error(format("{}: this is a pipe or a device, a file is needed; write it to a file first",
                           file.string()));
    }
    if (is_lfs_pointer(file)) {
        throw Error(
            format("{}: is a pointer of Git LFS, the file itself is not there; fetch it with git lfs pull",
                   file.string()));
    }
}

}  // namespace chironomia
