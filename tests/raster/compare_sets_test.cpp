#include "raster/images/compare_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_writer.h"
#include "raster/images/compare_folders.h"
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
using testing::smooth_frame;
using testing::TemporaryFolder;
using testing::tone;

constexpr RenderSize kSize{64, 48};

void write_clip(const fs::path& file, double volume, int crf = 18) {
    Audio sound = tone(0.1, 48000);
    for (float& sample : sound.samples) sample *= static_cast<float>(volume);
    ClipWriter writer(file, {.size = kSize, .fps = {30, 1}, .crf = crf}, sound);
    for (size_t i = 0; i < 3; ++i) writer.write(smooth_frame(kSize, static_cast<double>(i) / 30));
    writer.finish();
}

// Two pictures, one of them deeper, and what is not compared.
void write_pictures(const fs::path& folder, int red = 10) {
    write_image(folder / "a.png", plain_frame(kSize, {10, 20, 30}));
    write_image(folder / "walk/00001.png", plain_frame(kSize, {red, 20, 30}));
    write_text(folder / "README.md", "about " + folder.filename().string());
    write_text(folder / ".b.png.partial", "half");
    write_text(folder / ".hidden/c.png", "not looked at");
}

std::vector<std::string> outcomes(const CompareSet& set) {
    std::vector<std::string> lines;
    for (const CompareCase& one : set.cases) lines.push_back(one.name + " " + to_text(one.outcome));
    return lines;
}

TEST(CompareSets, MatchesFoldersByRelativeName) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    write_pictures(folder / "b");
    EXPECT_THAT(compared_files(folder / "a"), ElementsAre("a.png", "walk/00001.png"));
    const CompareSet set = compare_sets(folder / "a", folder / "b", {.difference_folder = folder / "diff"});
    EXPECT_TRUE(set.all_same());
    EXPECT_EQ(set.files, 2u);
    EXPECT_THAT(outcomes(set), ElementsAre("a.png same", "walk/00001.png same"));
    EXPECT_FALSE(fs::exists(folder / "diff"));
}

TEST(CompareSets, NamesMissingExtraAndDifferentFiles) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    write_pictures(folder / "b", 200);
    fs::remove(folder / "b/a.png");
    write_image(folder / "b/z.png", plain_frame(kSize, {}));
    const CompareSet set = compare_sets(folder / "a", folder / "b", {.difference_folder = folder / "diff"});
    EXPECT_THAT(outcomes(set), ElementsAre("a.png missing", "walk/00001.png different", "z.png extra"));
    EXPECT_EQ(set.cases[0].message, (folder / "a/a.png").string() +
                                        ": was expected, and no result has that name; render it, or accept "
                                        "its absence");
    EXPECT_THAT(set.cases[1].message, HasSubstr("3072 of 3072 pixels differ by more than 1 of 255"));
    EXPECT_EQ(set.cases[2].message,
              (folder / "b/z.png").string() + ": no reference has that name; accept it, or remove it");
    EXPECT_EQ(set.cases[1].difference, folder / "diff/walk/00001.png");
    EXPECT_EQ(read_image(set.cases[1].difference).rgba[0], 255);
}

TEST(CompareSets, FollowsLinks) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    write_pictures(folder / "b", 200);
    write_pictures(folder / "elsewhere");
    for (const char* side : {"a", "b"}) {
        fs::rename(folder / side / "walk", folder / (std::string(side) + "-walk"));
        fs::create_directory_symlink(folder / (std::string(side) + "-walk"), folder / side / "walk");
    }
    fs::create_symlink("../nowhere.png", folder / "b/lost.png");
    fs::create_symlink("self.png", folder / "b/self.png");
    const CompareSet set = compare_sets(folder / "a", folder / "b");
    EXPECT_THAT(outcomes(set),
                ElementsAre("a.png same", "lost.png extra", "self.png extra", "walk/00001.png different"));
}

TEST(CompareSets, RefusesLinksThatRunInACircle) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    fs::create_directory_symlink("..", folder / "a/walk/up");
    EXPECT_EQ(refusal_of([&] { compared_files(folder / "a"); }),
              (folder / "a/walk/up").string() + ": is a link to " + fs::canonical(folder / "a").string() +
                  ", which holds it; remove the link");
}

TEST(CompareSets, WritesNoDifferencesIntoWhatIsCompared) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    write_pictures(folder / "b", 200);
    const fs::path inside = folder / "a/differences";
    EXPECT_EQ(refusal_of([&] { compare_sets(folder / "a", folder / "b", {.difference_folder = inside}); }),
              inside.string() + ": lies in " + (folder / "a").string() +
                  ", which is compared; write the differences elsewhere");
}

TEST(CompareSets, KeepsThePicturesOfTheFirstFailures) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    write_pictures(folder / "b", 200);
    fs::remove(folder / "b/a.png");
    EXPECT_FALSE(compare_sets(folder / "a", folder / "b").cases[0].pictures);
    const CompareSet one = compare_sets(folder / "a", folder / "b", {.most_pictures = 1});
    EXPECT_EQ(one.cases[0].pictures->expected, read_bytes(folder / "a/a.png"));
    EXPECT_TRUE(one.cases[0].pictures->actual.empty());
    EXPECT_FALSE(one.cases[1].pictures);
    const CompareSet two = compare_sets(folder / "a", folder / "b", {.most_pictures = 2});
    EXPECT_EQ(two.cases[1].pictures->actual, read_bytes(folder / "b/walk/00001.png"));
    EXPECT_FALSE(two.cases[1].pictures->difference.empty());
}

TEST(CompareSets, ADamagedFileOrAnotherFormIsACaseOfItsOwn) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    write_pictures(folder / "b");
    write_text(folder / "b/a.png", "no picture");
    write_image(folder / "b/walk/00001.png", plain_frame({32, 48}, {}));
    const CompareSet set = compare_sets(folder / "a", folder / "b");
    EXPECT_THAT(outcomes(set), ElementsAre("a.png unreadable", "walk/00001.png different"));
    EXPECT_THAT(set.cases[0].message, HasSubstr((folder / "b/a.png").string() + ":"));
    EXPECT_THAT(set.cases[1].message, HasSubstr("is 64 x 48"));
}

TEST(CompareSets, ShowsEachFrameAndTheSoundOfAClip) {
    const TemporaryFolder folder;
    write_clip(folder / "a/talk.mp4", 1);
    write_clip(folder / "b/talk.mp4", 0.2);
    const CompareSet set = compare_sets(folder / "a", folder / "b");
    EXPECT_THAT(outcomes(set), ElementsAre("talk.mp4: frame 0 same", "talk.mp4: frame 1 same",
                                           "talk.mp4: frame 2 same", "talk.mp4: sound different"));
    EXPECT_THAT(set.cases[3].message, HasSubstr("of 1, at most 0.0100 may"));
    // Half a tone of -46 dB, and none of it.
    write_clip(folder / "quiet/talk.mp4", 0.01);
    write_clip(folder / "silent/talk.mp4", 0);
    const CompareSet quiet = compare_sets(folder / "quiet", folder / "silent");
    EXPECT_EQ(quiet.cases[3].outcome, CaseOutcome::different) << quiet.cases[3].message;
    EXPECT_TRUE(compare_sets(folder / "silent", folder / "silent").all_same());
    write_clip(folder / "b/talk.mp4", 1, 45);
    const CompareSet coarse =
        compare_sets(folder / "a/talk.mp4", folder / "b/talk.mp4", {.difference_folder = folder / "diff"});
    EXPECT_EQ(coarse.cases[1].difference, folder / "diff/talk.mp4/00001.png");
    EXPECT_TRUE(fs::exists(coarse.cases[1].difference));
}

TEST(CompareSets, RefusesWhatIsNotThereOrHoldsNothing) {
    const TemporaryFolder folder;
    write_pictures(folder / "a");
    fs::create_directories(folder / "empty");
    fs::create_directories(folder / "none");
    EXPECT_EQ(refusal_of([&] { compare_sets(folder / "a", folder / "nowhere"); }),
              (folder / "nowhere").string() + ": there is no such file; check the path");
    EXPECT_EQ(refusal_of([&] { compare_sets(folder / "empty", folder / "none"); }),
              (folder / "empty").string() + ": neither it nor " + (folder / "none").string() +
                  " holds a .png, .exr, .mp4 or .webm; name folders of results");
    EXPECT_EQ(
        refusal_of([&] { compared_files(folder / "nowhere"); }),
        (folder / "nowhere").string() + ": cannot be listed (No such file or directory); check the path");
    write_pictures(folder / "b", 200);
    EXPECT_THAT(
        refusal_of([&] { compare_sets(folder / "a", folder / "b", {.difference_folder = "/proc/none"}); }),
        HasSubstr("/proc/none/walk/00001.png: cannot be written"));
}

}  // namespace
}  // namespace chironomia
