#include "core/files/private_output.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;

void keep_private(const PendingOutput& output) {
    if (!fs::exists(output.final_path()))
        fs::permissions(output.path(), fs::perms::owner_read | fs::perms::owner_write);
}

void make_private_folder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) {
        throw Error(format("{}: cannot be made ({}); check that the folder above exists and is writable",
                           folder.string(), problem.message()));
    }
    // Somebody else's stays as its owner wants it.
    fs::permissions(folder, fs::perms::owner_all, problem);
}

}  // namespace chironomia
