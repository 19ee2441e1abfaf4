#include "core/files/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <optional>

#include "core/files/private_output.h"
#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

TEST(ReadText, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] { read_text(folder / "none"); }),
              (folder / "none").string() + ": there is no such file; check the path");
    EXPECT_EQ(refusal_of([&] { read_text(folder.path()); }),
              folder.path().string() + ": this is a folder, a file is needed");
}

TEST(ReadText, RefusesAPointerOfGitLfs) {
    const TemporaryFolder folder;
    const std::string pointer =
        "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, '0') + "\nsize 12345\n";
    write_text(folder / "a.bvh", pointer);
    EXPECT_EQ(refusal_of([&] { read_text(folder / "a.bvh"); }),
              (folder / "a.bvh").string() +
                  ": is a pointer of Git LFS, the file itself is not there; fetch it with git lfs pull");
    write_text(folder / "about.txt", "a " + pointer);
    EXPECT_EQ(read_text(folder / "about.txt"), "a " + pointer);
}

TEST(ReadText, LeavesOutTheByteOrderMark) {
    const TemporaryFolder folder;
    write_text(folder / "a", "\xEF\xBB\xBFtext \xEF\xBB\xBF");
    EXPECT_EQ(read_text(folder / "a"), "text \xEF\xBB\xBF");
    write_text(folder / "b", "\xEF\xBB");
    EXPECT_EQ(read_text(folder / "b"), "\xEF\xBB");
}

TEST(ReadText, RefusesWhatTheSystemCannotFollow) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(refusal_of([&] { read_text(folder / "pipe"); }),
              (folder / "pipe").string() +
                  ": this is a pipe or a device, a file is needed; write it to a file first");
    EXPECT_EQ(refusal_of([&] { write_text(folder / "pipe", "x"); }),
              (folder / "pipe").string() + ": this is a pipe or a device; name a file to write");
    std::filesystem::create_symlink(folder / "a", folder / "b");
    std::filesystem::create_symlink(folder / "b", folder / "a");
    EXPECT_EQ(refusal_of([&] { read_text(folder / "a"); }),
              (folder / "a").string() +
                  ": cannot be opened (Too many levels of symbolic links); check the path "
                  "and its permissions");
    const std::filesystem::path long_name = folder / std::string(300, 'x');
    EXPECT_EQ(refusal_of([&] { write_text(long_name, "x"); }),
              long_name.string() + ": cannot be written (File name too long); choose another name");
}

TEST(PendingOutput, ShowsNothingUntilItIsCommitted) {
    const TemporaryFolder folder;
    {
        PendingOutput output(folder / "deep/clip.mp4", PendingOutput::Kind::file);
        EXPECT_FALSE(std::filesystem::exists(folder / "deep/clip.mp4"));
        output.commit();
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "deep/clip.mp4"));
}

// As of two runs: what began later is whole, and the other says so and removes nothing.
TEST(PendingOutput, IsOfTheRunThatBeganLast) {
    for (const auto kind : {PendingOutput::Kind::file, PendingOutput::Kind::folder}) {
        const TemporaryFolder folder;
        std::optional<PendingOutput> first, second;
        first.emplace(folder / "out", kind);
        second.emplace(folder / "out", kind);
        EXPECT_THAT(
            refusal_of([&] { first->commit(); }),
            HasSubstr("out: another run began to write it meanwhile; let each run write a name of its own"));
        first.reset();
        second->commit();
        EXPECT_TRUE(std::filesystem::exists(folder / "out"));
    }
}

TEST(PendingOutput, LeavesNothingWhenItIsAbandoned) {
    const TemporaryFolder folder;
    { PendingOutput output(folder / "study", PendingOutput::Kind::folder); }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PendingOutput, TakesAFolderThatEndsWithASlash) {
    const TemporaryFolder folder;
    PendingOutput output(folder / "study/", PendingOutput::Kind::folder);
    write_text(output.path() / "clip.txt", "a");
    output.commit();
    EXPECT_EQ(read_text(folder / "study/clip.txt"), "a");
}

TEST(PendingOutput, RefusesAFolderThatHoldsSomething) {
    const TemporaryFolder folder;
    write_text(folder / "study/key.json", "{}");
    EXPECT_EQ(
        refusal_of([&] { PendingOutput(folder / "study", PendingOutput::Kind::folder); }),
        (folder / "study").string() + ": already holds something; name a new folder or remove this one");
}

TEST(PendingOutput, KeepsLinksAndMakesWhatTheyLeadTo) {
    const TemporaryFolder folder;
    write_text(folder / "deep/target", "old");
    fs::create_symlink("deep/target", folder / "link");
    fs::create_symlink("link", folder / "link-to-link");
    write_text(folder / "link-to-link", "new");
    EXPECT_EQ(read_text(folder / "deep/target"), "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    fs::create_symlink("deeper/made", folder / "dangling");
    write_text(folder / "dangling", "made");
    EXPECT_EQ(read_text(folder / "deeper/made"), "made");
    fs::create_directory(folder / "clips");
    fs::create_directory_symlink("clips/", folder / "clips-link");
    PendingOutput output(folder / "clips-link/", PendingOutput::Kind::folder);
    write_text(output.path() / "a", "a");
    output.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "clips-link"));
    EXPECT_EQ(read_text(folder / "clips/a"), "a");
}

TEST(PendingOutput, KeepsThePermissionsOfWhatItReplaces) {
    const TemporaryFolder folder;
    write_text(folder / "a", "old");
    fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::owner_write);
    write_text(folder / "a", "new");
    EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(PendingOutput, RefusesWhatIsProtectedFromWriting) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everything";
    const TemporaryFolder folder;
    write_text(folder / "a", "old");
    fs::permissions(folder / "a", fs::perms::owner_read);
    EXPECT_EQ(
        refusal_of([&] { write_text(folder / "a", "new"); }),
        (folder / "a").string() +
            ": may not be replaced (Permission denied); change its permissions, or name a file to write");
    EXPECT_EQ(read_text(folder / "a"), "old");
}

TEST(PendingOutput, TakesNamesAsLongAsTheSystemDoes) {
    const TemporaryFolder folder;
    for (const std::size_t length : {246u, 247u, 255u}) {
        const std::string name(length, 'x');
        write_text(folder / name, "a");
        EXPECT_EQ(read_text(folder / name), "a");
    }
}

TEST(PendingOutput, RefusesADeviceInPlaceOfAFolder) {
    EXPECT_EQ(refusal_of([] { PendingOutput("/dev/null", PendingOutput::Kind::folder); }),
              "/dev/null: this is a pipe or a device; name a new folder");
}

TEST(KeepPrivate, LetsOthersReadOnlyWhatTheyCouldReadBefore) {
    const TemporaryFolder folder;
    const auto permissions_after_write = [&] {
        PendingOutput output(folder / "answers.json", PendingOutput::Kind::file);
        keep_private(output);
        output.commit();
        return static_cast<int>(fs::status(folder / "answers.json").permissions());
    };
    EXPECT_EQ(permissions_after_write(), 0600);
    fs::permissions(folder / "answers.json", static_cast<fs::perms>(0640));
    EXPECT_EQ(permissions_after_write(), 0640);
}

TEST(WriteText, RefusesANewNameThatEndsLikeAFolder) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] { write_text(folder / "c.csv/", "x"); }),
              (folder / "c.csv/").string() + ": ends like a folder; name a file to write");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(WriteText, RefusesAFolderInPlaceOfAFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] { write_text(folder.path(), "x"); }),
              folder.path().string() + ": this is a folder; name a file to write");
}

TEST(WriteText, RefusesAPlaceWithoutPermission) {
    EXPECT_EQ(
        refusal_of([] { write_text("/proc/none/x", "x"); }),
        "/proc/none/x: cannot be written (No such file or directory); check that the folder exists and is "
        "writable");
}

TEST(FindAsset, NamesEveryPlaceItTried) {
    EXPECT_TRUE(std::filesystem::exists(find_asset("LICENSE")));
    const std::string refusal = refusal_of([] { find_asset("assets/none.glb"); });
    EXPECT_NE(refusal.find("assets/none.glb: this bundled file is in none of "), std::string::npos)
        << refusal;
    EXPECT_NE(refusal.find("set CHIRONOMIA_HOME"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace chironomia
