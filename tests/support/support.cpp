#include "tests/support/support.h"

#include <unistd.h>

#include <string>

#include "core/error.h"

namespace chironomia::testing {
namespace fs = std::filesystem;

fs::path source_dir() {
    return CHIRONOMIA_SOURCE_DIR;
}

fs::path shared_data(const fs::path& relative) {
    return source_dir().parent_path() / "shared/data" / relative;
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "chironomia-test-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string refusal_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return "";
}

}  // namespace chironomia::testing
