// What several rooms' tests need: folders, the files that they read, and the text of a refusal.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace chironomia::testing {

// The root of the checkout.
std::filesystem::path source_dir();

// A file for tests, named from the root of the checkout: ours, or one of other people in ../shared/data, a
// folder beside the checkout that few have. What begins with "made/" is made when it is first asked for
// (tests/support/made_avatars.h, tests/support/made_pats.h) and lasts as long as the process.
std::filesystem::path test_file(const std::string& name);

// The cases whose file is there. A case is the name of a file for test_file, or has one as its `file`.
template <typename Case>
std::vector<Case> present(std::vector<Case> cases) {
    std::erase_if(cases, [](const Case& one) {
        std::string name;
        if constexpr (requires { one.file; })
            name = one.file;
        else
            name = one;
        return !name.starts_with("made/") && !std::filesystem::exists(source_dir() / name);
    });
    return cases;
}
inline std::vector<std::string> present(std::initializer_list<const char*> files) {
    return present(std::vector<std::string>(files.begin(), files.end()));
}

// For the names of parametrised tests: the stem of a file, in letters, digits and underscores.
std::string test_name_of(const std::string& file);

// A new empty folder that is removed at the end of the test.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

// The message of the Error that `action` throws; fails the test and returns "" if it throws none.
std::string refusal_of(const std::function<void()>& action);

}  // namespace chironomia::testing
