#include "core/files/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

TEST(ScratchFolder, GoesWithAllThatIsInIt) {
    fs::path kept;
    {
        ScratchFolder first("test");
        const ScratchFolder second("test");
        EXPECT_NE(first.path(), second.path());
        write_text(first.path() / "file", "x");
        kept = first.path();
        const ScratchFolder moved = std::move(first);
        EXPECT_EQ(moved.path(), kept);
        EXPECT_TRUE(fs::exists(kept / "file"));
    }
    EXPECT_FALSE(fs::exists(kept));
}

TEST(ScratchFolder, LiesHiddenInTheFolderThatIsNamed) {
    const testing::TemporaryFolder folder;
    std::filesystem::path kept;
    {
        const ScratchFolder first = ScratchFolder::within(folder.path());
        const ScratchFolder second = ScratchFolder::within(folder.path());
        EXPECT_NE(first.path(), second.path());
        kept = first.path();
        EXPECT_EQ(kept.parent_path(), folder.path());
        EXPECT_EQ(kept.filename().string().front(), '.');
        write_text(kept / "file", "x");
    }
    EXPECT_FALSE(std::filesystem::exists(kept));
}

TEST(ScratchFolder, SaysWhereItCannotBeMade) {
    const testing::TemporaryFolder folder;
    write_text(folder / "file", "x");
    EXPECT_EQ(testing::refusal_of([&] { ScratchFolder::within(folder / "file"); }),
              (folder / "file").string() +
                  ": no folder can be made in it (Not a directory); check free space and permissions");
    const char* before = std::getenv("TMPDIR");
    const std::string kept = before ? before : "";
    ::setenv("TMPDIR", (folder / "file").c_str(), 1);
    const std::string message = testing::refusal_of([] { ScratchFolder("test"); });
    before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
    EXPECT_THAT(message, ::testing::HasSubstr("let TMPDIR name a folder that can be written in"));
}

}  // namespace
}  // namespace chironomia
