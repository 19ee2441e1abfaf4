#include "raster/images/frame_stack.h"

#include <gtest/gtest.h>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::refusal_of;
using testing::TemporaryFolder;

TEST(ParseStackPattern, NumbersFramesAsAsked) {
    EXPECT_EQ(parse_stack_pattern("out/%05d.png").file(7), "out/00007.png");
    EXPECT_EQ(parse_stack_pattern("out/frame_%04d_x.exr").file(123456), "out/frame_123456_x.exr");
    EXPECT_EQ(parse_stack_pattern("%d.png").file(0), "0.png");
    EXPECT_EQ(parse_stack_pattern("100%%/50%%_%03d.png").file(1), "100%%/50%_001.png");
    EXPECT_TRUE(is_stack_pattern("out/%05d.png"));
    EXPECT_FALSE(is_stack_pattern("out%/clip.mp4"));
}

TEST(ParseStackPattern, RefusesWhatNamesNoFrames) {
    EXPECT_EQ(refusal_of([] { parse_stack_pattern("out/%%.png"); }),
              "out/%%.png: it has no number for the frames; write it like frames/%05d.png");
    EXPECT_EQ(refusal_of([] { parse_stack_pattern("out/%s.png"); }),
              "out/%s.png: \"%\" is not followed by a number and \"d\"; write it like frames/%05d.png");
    EXPECT_EQ(refusal_of([] { parse_stack_pattern("out/%d_%d.png"); }),
              "out/%d_%d.png: it has two numbers, one is needed; write it like frames/%05d.png");
    EXPECT_EQ(refusal_of([] { parse_stack_pattern("out/%99d.png"); }),
              "out/%99d.png: \"%99d\" is no number of digits; write it like frames/%05d.png");
    EXPECT_EQ(refusal_of([] { parse_stack_pattern("out/%05d.jpg"); }),
              "out/%05d.jpg: frames are .png or .exr; write it like frames/%05d.png");
    EXPECT_EQ(refusal_of([] { parse_stack_pattern("out/%05d"); }),
              "out/%05d: frames are .png or .exr; write it like frames/%05d.png");
}

TEST(ListStack, OrdersByNumberNotByName) {
    const TemporaryFolder folder;
    for (const char* name : {"frame_9.png", "frame_10.png", "frame_11.png", "notes.txt", "cover.png"})
        write_text(folder / name, "");
    EXPECT_EQ(
        list_stack(folder.path()),
        (std::vector<fs::path>{folder / "frame_9.png", folder / "frame_10.png", folder / "frame_11.png"}));
}

TEST(ListStack, RefusesGapsDoublesAndEmptyFolders) {
    const TemporaryFolder folder;
    const std::string where = folder.path().string();
    EXPECT_EQ(refusal_of([&] { list_stack(folder.path()); }),
              where + ": holds no numbered .png or .exr; name a folder of frames");
    write_text(folder / "00000.png", "");
    write_text(folder / "00002.png", "");
    EXPECT_EQ(refusal_of([&] { list_stack(folder.path()); }),
              where + ": frame 1 is missing between 0 and 2; render it again");
    write_text(folder / "2.png", "");
    EXPECT_EQ(refusal_of([&] { list_stack(folder.path()); }),
              where + ": frame 2 is there twice, as 00002.png and 2.png; keep one stack in a folder");
}

}  // namespace
}  // namespace chironomia
