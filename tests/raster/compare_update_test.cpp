#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <sys/stat.h>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_writer.h"
#include "raster/images/compare_folders.h"
#include "raster/images/compare_sets.h"
#include "raster/images/image_file.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::plain_frame;
using testing::refusal_of;
using testing::TemporaryFolder;

constexpr RenderSize kSize{16, 16};

class UpdateReferences : public ::testing::Test {
  protected:
    void SetUp() override {
        write_image(expected_ / "kept.png", plain_frame(kSize, {1, 1, 1}));
        write_image(expected_ / "deep/changed.png", plain_frame(kSize, {1, 1, 1}));
        write_image(expected_ / "removed.png", plain_frame(kSize, {1, 1, 1}));
        write_text(expected_ / "deep/README.md", "how they were made");
        write_image(actual_ / "kept.png", plain_frame(kSize, {1, 1, 1}));
        write_image(actual_ / "deep/changed.png", plain_frame(kSize, {9, 1, 1}));
        write_image(actual_ / "added.png", plain_frame(kSize, {1, 1, 1}));
        write_text(actual_ / "log.txt", "not compared");
    }

    // Everything beside references and results that the test did not put there.
    std::vector<std::string> beside() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    TemporaryFolder folder_;
    const fs::path expected_ = folder_ / "expected";
    const fs::path actual_ = folder_ / "actual";
};

TEST_F(UpdateReferences, MakesTheResultsTheReferencesAndKeepsWhatIsNotCompared) {
    const SetUpdate update = update_references(expected_ / "", actual_);
    EXPECT_EQ(update.changed, 1u);
    EXPECT_EQ(update.added, 1u);
    EXPECT_EQ(update.removed, 1u);
    EXPECT_EQ(update.kept, 1u);
    EXPECT_TRUE(compare_sets(expected_, actual_).all_same());
    EXPECT_THAT(compared_files(expected_), ElementsAre("added.png", "deep/changed.png", "kept.png"));
    EXPECT_EQ(read_text(expected_ / "deep/README.md"), "how they were made");
    EXPECT_FALSE(fs::exists(expected_ / "log.txt"));
    EXPECT_THAT(beside(), ElementsAre("actual", "expected"));
}

TEST_F(UpdateReferences, MakesTheFirstReferences) {
    EXPECT_EQ(update_references(folder_ / "new/frames", actual_).added, 3u);
    EXPECT_TRUE(compare_sets(folder_ / "new/frames", actual_).all_same());
    EXPECT_EQ(update_references(folder_ / "one.png", actual_ / "kept.png").added, 1u);
    EXPECT_EQ(update_references(folder_ / "one.png", actual_ / "kept.png").kept, 1u);
    EXPECT_EQ(update_references(folder_ / "one.png", actual_ / "deep/changed.png").changed, 1u);
    EXPECT_EQ(read_bytes(folder_ / "one.png"), read_bytes(actual_ / "deep/changed.png"));
}

// Links to other files and folders, empty folders and permissions are no pictures, and stay.
TEST_F(UpdateReferences, KeepsLinksEmptyFoldersAndPermissions) {
    fs::create_directories(folder_ / "shared");
    write_text(folder_ / "shared/notes.txt", "of all references");
    fs::create_directory_symlink("../shared", expected_ / "shared");
    fs::create_directories(expected_ / "empty");
    fs::permissions(expected_ / "deep", fs::perms::owner_all);
    fs::permissions(expected_, fs::perms::owner_all);
    update_references(expected_, actual_);
    EXPECT_EQ(fs::read_symlink(expected_ / "shared"), "../shared");
    EXPECT_TRUE(fs::is_directory(expected_ / "empty"));
    EXPECT_EQ(fs::status(expected_ / "deep").permissions(), fs::perms::owner_all);
    EXPECT_EQ(fs::status(expected_).permissions(), fs::perms::owner_all);
}

// A link to a folder of references becomes a folder, and what it leads to is as it was.
TEST_F(UpdateReferences, PutsAFolderInThePlaceOfALinkToOne) {
    fs::rename(expected_ / "deep", folder_ / "elsewhere");
    fs::create_directory_symlink("../elsewhere", expected_ / "deep");
    const SetUpdate update = update_references(expected_, actual_);
    EXPECT_EQ(update.changed, 1u);
    EXPECT_FALSE(fs::is_symlink(expected_ / "deep"));
    EXPECT_EQ(read_bytes(expected_ / "deep/changed.png"), read_bytes(actual_ / "deep/changed.png"));
    EXPECT_NE(read_bytes(folder_ / "elsewhere/changed.png"), read_bytes(actual_ / "deep/changed.png"));
}

TEST_F(UpdateReferences, PutsAFileInThePlaceOfALinkToOne) {
    fs::create_symlink("kept.png", expected_ / "link.png");
    update_references(expected_ / "link.png", actual_ / "deep/changed.png");
    EXPECT_FALSE(fs::is_symlink(expected_ / "link.png"));
    EXPECT_EQ(read_bytes(expected_ / "link.png"), read_bytes(actual_ / "deep/changed.png"));
    EXPECT_EQ(read_bytes(expected_ / "kept.png"), read_bytes(actual_ / "kept.png"));
}

TEST_F(UpdateReferences, RefusesAFileOfAnotherKind) {
    const fs::path reference = expected_ / "kept.png", result = folder_ / "kept.exr";
    write_image(result, plain_frame(kSize, {2, 2, 2}));
    const auto before = read_bytes(reference);
    EXPECT_EQ(refusal_of([&] { update_references(reference, result); }),
              reference.string() + ": cannot become " + result.string() +
                  ", a file of another kind; give the reference its ending");
    EXPECT_EQ(read_bytes(reference), before);
}

TEST_F(UpdateReferences, TakesAClipOnlyWhole) {
    ClipWriter writer(actual_ / "clip.mp4", {.size = kSize, .fps = {30, 1}}, std::nullopt);
    for (int i = 0; i < 30; ++i) writer.write(plain_frame(kSize, {i, 0, 0}));
    writer.finish();
    EXPECT_EQ(update_references(folder_ / "clip.mp4", actual_ / "clip.mp4").added, 1u);
    const std::string bytes = read_text(actual_ / "clip.mp4");
    write_text(actual_ / "clip.mp4", bytes.substr(0, bytes.size() - 100));
    EXPECT_THAT(refusal_of([&] { update_references(expected_, actual_); }), HasSubstr("clip.mp4"));
}

// Every refusal leaves the references as they were.
TEST_F(UpdateReferences, RefusesWhatWouldLoseReferences) {
    const auto refusal = [&](const fs::path& expected, const fs::path& actual) {
        const std::string message = refusal_of([&] { update_references(expected, actual); });
        EXPECT_THAT(compared_files(expected_), ElementsAre("deep/changed.png", "kept.png", "removed.png"));
        EXPECT_EQ(read_image(expected_ / "deep/changed.png").rgba[0], 1);
        return message;
    };
    const std::string expected = expected_.string(), actual = actual_.string();
    EXPECT_EQ(refusal(expected_, folder_ / "nowhere"),
              (folder_ / "nowhere").string() + ": there is no such file; check the path");
    EXPECT_EQ(refusal(expected_, actual_ / "kept.png"),
              expected + ": is a folder, " + actual + "/kept.png is a file; both must be of one kind");
    EXPECT_EQ(
        refusal(expected_, expected_ / "deep"),
        expected + ": lies within " + expected + "/deep or holds it; keep references and results apart");
    fs::create_directories(folder_ / "empty");
    EXPECT_EQ(
        refusal(expected_, folder_ / "empty"),
        (folder_ / "empty").string() + ": holds no .png, .exr, .mp4 or .webm to accept; render it again");
    write_text(actual_ / "added.png", "no picture");
    EXPECT_THAT(refusal(expected_, actual_), HasSubstr((actual_ / "added.png").string()));
    fs::remove(actual_ / "added.png");
    EXPECT_EQ(refusal("/proc/none", actual_),
              "/proc/.none.accepted: cannot be written (No such file or directory); check that the folder "
              "exists and is writable");
    fs::create_directories(expected_ / ".git");
    EXPECT_EQ(refusal(expected_, actual_),
              expected + ": holds a repository; name a folder of references alone");
}

TEST_F(UpdateReferences, LeavesTheReferencesWhenACopyFails) {
    ASSERT_EQ(mkfifo((expected_ / "pipe").c_str(), 0600), 0);  // what is no file, folder or link
    const std::string message = refusal_of([&] { update_references(expected_, actual_); });
    EXPECT_THAT(message, HasSubstr(expected_.string() + ": cannot be written ("));
    EXPECT_THAT(message, HasSubstr("); check free space and permissions"));
    EXPECT_THAT(compared_files(expected_), ElementsAre("deep/changed.png", "kept.png", "removed.png"));
    EXPECT_THAT(beside(), ElementsAre("actual", "expected"));
}

}  // namespace
}  // namespace chironomia
