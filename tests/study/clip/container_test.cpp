#include "study/clip/container.h"

#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/study/limits.h"
#include "tests/study/tiny_clips.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using testing::LowLimit;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::tiny_mp4;
using testing::tiny_webm;

std::vector<std::string> types_of(const std::vector<ContainerBox>& boxes) {
    std::vector<std::string> types;
    for (const ContainerBox& box : boxes) types.push_back(box.type);
    return types;
}

TEST(ReadBoxes, ListsTheOutermostBoxesOfAnMp4) {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", tiny_mp4("pictures"));
    const std::vector<ContainerBox> boxes = read_boxes(folder / "a.mp4");
    EXPECT_EQ(types_of(boxes), (std::vector<std::string>{"ftyp", "moov", "mdat"}));
    EXPECT_EQ(boxes[2], (ContainerBox{.type = "mdat", .begin = 32, .body = 40, .end = 48}));
}

TEST(ReadBoxes, ListsTheElementsOfASegmentOfWebm) {
    const TemporaryFolder folder;
    write_text(folder / "a.webm", tiny_webm("pictures"));
    EXPECT_EQ(types_of(read_boxes(folder / "a.webm")),
              (std::vector<std::string>{"1a45dfa3", "18538067", "1549a966", "1f43b675"}));
}

TEST(ReadBoxes, TakesABoxWithALongSize) {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", tiny_mp4("x") + std::string("\0\0\0\1free\0\0\0\0\0\0\0\x12zz", 18));
    EXPECT_EQ(read_boxes(folder / "a.mp4").back(),
              (ContainerBox{.type = "free", .begin = 41, .body = 57, .end = 59}));
}

TEST(ReadBoxes, RefusesWhatIsNoClip) {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", "just some text");
    EXPECT_EQ(refusal_of([&] { read_boxes(folder / "a.mp4"); }),
              (folder / "a.mp4").string() + ": is neither MP4 nor WebM, its first bytes say; write it again");
    EXPECT_EQ(refusal_of([&] { read_boxes(folder / "none.mp4"); }),
              (folder / "none.mp4").string() + ": cannot be read; check the path");
}

TEST(ReadBoxes, RefusesATruncatedClip) {
    const TemporaryFolder folder;
    const std::string whole = tiny_mp4("pictures");
    for (const std::size_t cut : {1, 7, 12}) {
        write_text(folder / "a.mp4", whole.substr(0, whole.size() - cut));
        EXPECT_EQ(refusal_of([&] { read_boxes(folder / "a.mp4"); }),
                  format("{}: the box at byte 32 does not fit into the {} bytes of the file; write it again",
                         (folder / "a.mp4").string(), whole.size() - cut));
    }
    write_text(folder / "a.webm", tiny_webm("pictures").substr(0, 20));
    EXPECT_EQ(refusal_of([&] { read_boxes(folder / "a.webm"); }),
              (folder / "a.webm").string() +
                  ": the box at byte 9 does not fit into the 20 bytes of the file; write it again");
}

TEST(PadClip, MakesAClipLongerByOneBoxThatPlayersSkip) {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", tiny_mp4("pictures"));
    write_text(folder / "a.webm", tiny_webm("pictures"));
    for (const auto& [name, type] : {std::pair{"a.mp4", "free"}, std::pair{"a.webm", "ec"}}) {
        const std::string before = read_text(folder / name);
        for (const std::size_t added : {16, 17, 100000}) {
            write_text(folder / name, before);
            pad_clip(folder / name, before.size() + added);
            const std::string after = read_text(folder / name);
            EXPECT_EQ(after.size(), before.size() + added);
            EXPECT_EQ(after.substr(0, before.size()), before);
            const ContainerBox last = read_boxes(folder / name).back();
            EXPECT_EQ(last.type, type);
            EXPECT_EQ(last.begin, before.size());
        }
    }
}

TEST(PadClip, RefusesWhenTheDiskIsFull) {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", tiny_mp4("pictures"));
    const LowLimit disk(RLIMIT_FSIZE, 1000);
    EXPECT_EQ(refusal_of([&] { pad_clip(folder / "a.mp4", 100000); }),
              (folder / "a.mp4").string() + ": cannot be made longer; check the free space");
}

}  // namespace
}  // namespace chironomia::study
