#include "raster/ffmpeg/film_reader.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_writer.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::output_of;
using testing::plain_frame;
using testing::quoted;
using testing::refusal_of;
using testing::TemporaryFolder;

int grey_at(const Frame& frame, int x, int y) {
    return frame.rgba[static_cast<std::size_t>(y * frame.width + x) * 4 + 1];
}

// Frame i has a grey of 40 + 4 i.
fs::path write_film(const fs::path& file, const RenderSize& size, Rate fps, int frames) {
    ClipWriter writer(file, {.size = size, .fps = fps}, std::nullopt);
    for (int i = 0; i < frames; ++i) writer.write(plain_frame(size, {40 + 4 * i, 40 + 4 * i, 40 + 4 * i}));
    writer.finish();
    return file;
}

// Which frame of such a film is seen.
int frame_seen(const Frame& picture) {
    return static_cast<int>(
        std::lround((grey_at(picture, picture.width / 2, picture.height / 2) - 40) / 4.0));
}

TEST(FilmReader, ShowsTheNearestFrameAtAnyRate) {
    const TemporaryFolder folder;
    const fs::path file = write_film(folder / "a.mp4", {64, 64}, {25, 1}, 40);
    for (const Rate fps : {Rate{25, 1}, Rate{30, 1}, Rate{10, 1}, Rate{60, 1}}) {
        FilmReader film(file, {.size = {64, 64}, .fps = fps});
        EXPECT_NEAR(film.seconds(), 1.6, 1e-6);
        for (int n = 0; n < static_cast<int>(1.6 * fps.per_second()); ++n) {
            const double exact = n * 25.0 / fps.per_second();
            EXPECT_NEAR(frame_seen(film.next()), std::min(39.0, exact), 0.5 + 1e-9)
                << n << " at " << to_text(fps);
        }
    }
}

TEST(FilmReader, BeginsAtTheGivenTimeAndHoldsItsLastFrame) {
    const TemporaryFolder folder;
    const fs::path file = write_film(folder / "a.mp4", {64, 64}, {10, 1}, 20);
    FilmReader film(file, {.size = {64, 64}, .fps = {10, 1}, .begin = 1.5});
    for (const int expected : {15, 16, 17, 18, 19, 19, 19}) EXPECT_EQ(frame_seen(film.next()), expected);
}

TEST(FilmReader, PutsBlackBesideAndAbove) {
    const TemporaryFolder folder;
    const fs::path file = write_film(folder / "a.mp4", {128, 64}, {10, 1}, 3);
    const Frame below = FilmReader(file, {.size = {128, 128}, .fps = {10, 1}}).next();
    for (const int y : {0, 30, 97, 127}) EXPECT_EQ(grey_at(below, 64, y), 0) << y;
    for (const int y : {34, 64, 93}) EXPECT_NEAR(grey_at(below, 64, y), 40, 2) << y;
    const Frame beside = FilmReader(file, {.size = {200, 64}, .fps = {10, 1}}).next();
    for (const int x : {0, 34, 165, 199}) EXPECT_EQ(grey_at(beside, x, 32), 0) << x;
    for (const int x : {38, 100, 161}) EXPECT_NEAR(grey_at(beside, x, 32), 40, 2) << x;
    EXPECT_EQ(beside.rgba[3], 255);
}

// Pixels twice as wide as high make a square film of 128 x 64.
TEST(FilmReader, KnowsPixelsThatAreNotSquare) {
    const TemporaryFolder folder;
    output_of("ffmpeg -nostdin -v error -f lavfi -i color=white:s=64x64:r=10:d=1 -vf setsar=2/1 " +
              quoted(folder / "a.mp4"));
    const Frame frame = FilmReader(folder / "a.mp4", {.size = {128, 128}, .fps = {10, 1}}).next();
    EXPECT_EQ(grey_at(frame, 64, 20), 0);
    EXPECT_GT(grey_at(frame, 64, 64), 250);
    EXPECT_GT(grey_at(frame, 4, 64), 250);
}

// A phone held upright stores a picture that lies, and says so: what is white at its left is shown at the top
// or below, as ffmpeg's own player turns it.
TEST(FilmReader, TurnsWhatAPhoneFilmed) {
    const TemporaryFolder folder;
    output_of(
        "ffmpeg -nostdin -v error -f lavfi -i color=black:s=128x64:r=10:d=1 -vf "
        "drawbox=0:0:32:32:white:fill " +
        quoted(folder / "lying.mp4"));
    for (const int degrees : {90, 180, 270}) {
        output_of(format("ffmpeg -nostdin -v error -y -i {} -c copy -metadata:s:v:0 rotate={} {}",
                         quoted(folder / "lying.mp4"), degrees, quoted(folder / "turned.mp4")));
        output_of("ffmpeg -nostdin -v error -y -i " + quoted(folder / "turned.mp4") + " -frames:v 1 " +
                  quoted(folder / "shown.mp4"));
        const RenderSize size = degrees == 180 ? RenderSize{128, 64} : RenderSize{64, 128};
        const Frame ours = FilmReader(folder / "turned.mp4", {.size = size, .fps = {10, 1}}).next();
        const Frame theirs = FilmReader(folder / "shown.mp4", {.size = size, .fps = {10, 1}}).next();
        EXPECT_GT(testing::psnr(ours, theirs), 30) << degrees;
    }
}

// The sound begins with the file, the pictures half a second later.
TEST(FilmReader, CountsFromTheBeginOfTheSound) {
    const TemporaryFolder folder;
    write_film(folder / "a.mp4", {64, 64}, {10, 1}, 20);
    output_of("ffmpeg -nostdin -v error -itsoffset 0.5 -i " + quoted(folder / "a.mp4") +
              " -f lavfi -i sine=440:d=2.5 -map 0:v -map 1:a -c:v copy -c:a aac " + quoted(folder / "b.mkv"));
    FilmReader film(folder / "b.mkv", {.size = {64, 64}, .fps = {10, 1}});
    for (const int expected : {0, 0, 0, 0, 0, 0, 1, 2, 3}) EXPECT_EQ(frame_seen(film.next()), expected);
}

// The matrix of an MP4's track header is 40 bytes behind its name: 16.16 fixed point, row by row.
std::string turned_by_45_degrees(std::string mp4) {
    const std::size_t matrix = mp4.find("tkhd") + 4 + 40;
    const std::int32_t half = 46341;  // the root of 1/2
    const std::int32_t values[] = {half, half, 0, -half, half};
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t byte = 0; byte < 4; ++byte)
            mp4[matrix + 4 * i + byte] = static_cast<char>(values[i] >> (24 - 8 * byte) & 0xff);
    return mp4;
}

TEST(FilmReader, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    const auto open = [&](const char* name) {
        FilmReader film(folder / name, {.size = {64, 64}, .fps = {10, 1}});
        for (int i = 0; i < 100; ++i) film.next();
    };
    EXPECT_THAT(refusal_of([&] { open("none.mp4"); }), HasSubstr("there is no such file"));
    write_wav(folder / "a.wav", testing::tone(1, 48000));
    EXPECT_THAT(refusal_of([&] { open("a.wav"); }), HasSubstr("holds no pictures; give a clip that does"));
    write_film(folder / "a.webm", {64, 64}, {10, 1}, 40);
    const std::string whole = read_text(folder / "a.webm");
    write_text(folder / "cut.webm", whole.substr(0, whole.size() * 2 / 3));
    EXPECT_THAT(refusal_of([&] { open("cut.webm"); }),
                HasSubstr("cut.webm: cut off: it should last 4.000 s and ends after"));
    write_film(folder / "b.mp4", {64, 64}, {10, 1}, 5);
    write_text(folder / "askew.mp4", turned_by_45_degrees(read_text(folder / "b.mp4")));
    EXPECT_EQ(refusal_of([&] { open("askew.mp4"); }),
              (folder / "askew.mp4").string() +
                  ": is to be shown turned by 45.0 degrees, which are no quarter turns; turn it with another "
                  "program");
}

}  // namespace
}  // namespace chironomia
