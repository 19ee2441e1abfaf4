#include "study/build/blinding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <set>

#include "core/files/files.h"
#include "study/clip/container.h"
#include "tests/study/tiny_clips.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::Each;
using ::testing::MatchesRegex;
using testing::refusal_of;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using testing::tiny_mp4;

std::vector<std::string> many_texts() {
    std::vector<std::string> texts;
    for (int i = 0; i < 200; ++i) texts.push_back("clip " + std::to_string(i));
    return texts;
}

TEST(MakeStudyKey, TakesInTheSeedAndTheInputs) {
    const std::string key = make_study_key(7, {"aa", "bb"});
    EXPECT_EQ(make_study_key(7, {"aa", "bb"}), key);
    EXPECT_NE(make_study_key(8, {"aa", "bb"}), key);
    EXPECT_NE(make_study_key(7, {"aa", "bc"}), key);
}

TEST(MakeTokens, AreHexadecimalAndAllDifferent) {
    const auto tokens = make_tokens("key", many_texts());
    EXPECT_THAT(tokens, Each(MatchesRegex("[0-9a-f]{16}")));
    EXPECT_EQ(std::set<std::string>(tokens.begin(), tokens.end()).size(), 200u);
}

TEST(MakeTokens, AreOthersForAnotherKey) {
    EXPECT_EQ(make_tokens("key", {"clip"}), make_tokens("key", {"clip"}));
    EXPECT_NE(make_tokens("key", {"clip"}), make_tokens("kez", {"clip"}));
}

// 200 texts in 256 names of two digits cannot all be lucky.
TEST(MakeTokens, StayDifferentWhenHashesCollide) {
    const auto tokens = make_tokens("key", many_texts(), 2);
    EXPECT_THAT(tokens, Each(SizeIs(2)));
    EXPECT_EQ(std::set<std::string>(tokens.begin(), tokens.end()).size(), 200u);
}

TEST(MakeSizesEqual, PadsEveryClipBeyondTheLargest) {
    const TemporaryFolder folder;
    const std::vector<fs::path> clips = {folder / "a.mp4", folder / "b.mp4", folder / "c.mp4"};
    write_text(clips[0], tiny_mp4("12345678"));
    write_text(clips[1], tiny_mp4("1234567"));  // one byte less: too little for a box of its own
    write_text(clips[2], tiny_mp4(""));
    make_sizes_equal(clips);
    for (const fs::path& clip : clips) {
        EXPECT_EQ(fs::file_size(clip), 48u + kLeastPadding);
        EXPECT_EQ(read_boxes(clip).back().type, "free");
    }
}

TEST(MakeTracesEqual, SetsTimesAndPermissionsOfEverything) {
    const TemporaryFolder folder;
    write_text(folder / "public/index.html", "x");
    write_text(folder / "public/clips/a.mp4", "x");
    fs::permissions(folder / "public/clips/a.mp4", fs::perms::owner_all);
    reset_times_and_permissions(folder / "public");
    for (const char* name : {"public", "public/clips", "public/index.html", "public/clips/a.mp4"}) {
        struct stat status {};
        ASSERT_EQ(::stat((folder / name).c_str(), &status), 0);
        EXPECT_EQ(status.st_mtim.tv_sec, kNeutralTime) << name;
        EXPECT_EQ(status.st_mtim.tv_nsec, 0) << name;
        EXPECT_EQ(status.st_mode & 0777, fs::is_directory(folder / name) ? 0755u : 0644u) << name;
    }
}

TEST(MakeTracesEqual, RefusesAFileSystemThatKeepsItsOwnTimes) {
    EXPECT_THAT(refusal_of([] { reset_times_and_permissions("/proc/self/attr"); }),
                MatchesRegex("/proc/self/attr/.*: its time and permissions cannot be set \\(.*\\); build on "
                             "another file system"));
}

}  // namespace
}  // namespace chironomia::study
