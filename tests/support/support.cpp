#include "tests/support/support.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "tests/support/made_avatars.h"
#include "tests/support/made_pats.h"

namespace chironomia::testing {
namespace fs = std::filesystem;

fs::path source_dir() {
    return CHIRONOMIA_SOURCE_DIR;
}

fs::path test_file(const std::string& name) {
    if (!name.starts_with("made/")) return source_dir() / name;
    static const TemporaryFolder folder;
    const fs::path file = folder / name.substr(5);
    if (fs::exists(file)) return file;
    if (file.extension() == ".h5")
        write_made_pats(file);
    else
        write_made_avatar(file);
    return file;
}

std::string test_name_of(const std::string& file) {
    std::string name = fs::path(file).stem().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
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
