#include "core/input_file.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;

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
}

}  // namespace chironomia
