// What several rooms' tests need: folders, the shared data, and the text of a refusal.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

namespace chironomia::testing {

// The root of the checkout.
std::filesystem::path source_dir();

// A file of the test data that lies beside the checkout, ../shared/data/<relative>.
// Use SKIP_WITHOUT_SHARED_DATA first.
std::filesystem::path shared_data(const std::filesystem::path& relative);

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

#define SKIP_WITHOUT_SHARED_DATA(relative)                                                         \
    if (!std::filesystem::exists(chironomia::testing::shared_data(relative))) {                    \
        GTEST_SKIP() << "needs " << chironomia::testing::shared_data(relative) << ", not present"; \
    }
