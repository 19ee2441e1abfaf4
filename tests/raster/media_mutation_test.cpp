// Broken sound, clips and images are read or refused, and never crash: run it with the sanitizers.
#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "core/random.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/clip_reader.h"
#include "raster/ffmpeg/clip_writer.h"
#include "raster/images/image_file.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::output_of;
using testing::quoted;
using testing::smooth_frame;
using testing::TemporaryFolder;
using testing::tone;

constexpr RenderSize kSize{32, 32};
constexpr int kMutations = 60;

std::string mutated(std::string bytes, Random& random) {
    const auto place = [&] { return random.below(static_cast<std::uint32_t>(bytes.size())); };
    switch (random.below(4)) {
        case 0:
            bytes.resize(place());
            break;
        case 1:
            bytes.erase(place(), 1 + random.below(40));
            break;
        case 2:
            bytes.insert(place(), bytes.substr(place(), 1 + random.below(40)));
            break;
        default:
            break;
    }
    if (bytes.empty()) return bytes;
    // Half of the changes hit the head, where sizes and counts are.
    for (std::uint32_t i = 0; i < 1 + random.below(8); ++i) {
        const std::uint32_t end = static_cast<std::uint32_t>(bytes.size());
        const std::uint32_t at = random.below(2) ? random.below(end) : random.below(std::min(end, 400u));
        bytes[at] = static_cast<char>(random.below(256));
    }
    return bytes;
}

void read_frames(const fs::path& file) {
    ClipReader reader(file);
    while (reader.next()) continue;
}

void expect_survival(const fs::path& whole, const std::function<void(const fs::path&)>& read) {
    Random random(2026);
    const std::string bytes = read_text(whole);
    const fs::path broken = whole.parent_path() / ("broken" + whole.extension().string());
    int refused = 0;
    for (int i = 0; i < kMutations; ++i) {
        write_text(broken, mutated(bytes, random));
        try {
            read(broken);
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(broken.string() + ": ")) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(refused, 0) << whole;
}

class MutatedSound : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, MutatedSound, ::testing::Values("wav", "flac", "ogg", "mp3", "m4a"),
                         [](const auto& info) { return info.param; });

TEST_P(MutatedSound, IsReadOrRefused) {
    const TemporaryFolder folder;
    write_wav(folder / "source.wav", tone(0.3, 16000, 2));
    const fs::path file = folder / ("sound." + GetParam());
    output_of(format("ffmpeg -v error -i {} {}", quoted(folder / "source.wav"), quoted(file)));
    expect_survival(file, [](const fs::path& broken) { read_audio(broken); });
}

class MutatedClip : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, MutatedClip, ::testing::Values("mp4", "webm"),
                         [](const auto& i) { return i.param; });

TEST_P(MutatedClip, IsReadOrRefused) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    ClipWriter writer(file, {.size = kSize}, tone(0.2, 48000));
    for (int i = 0; i < 6; ++i) writer.write(smooth_frame(kSize, i));
    writer.finish();
    expect_survival(file, [](const fs::path& broken) { read_clip_info(broken); });
    expect_survival(file, read_frames);
}

class MutatedImage : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, MutatedImage, ::testing::Values("png", "exr"),
                         [](const auto& i) { return i.param; });

TEST_P(MutatedImage, IsReadOrRefused) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("image." + GetParam());
    write_image(file, smooth_frame(kSize, 0));
    expect_survival(file, [](const fs::path& broken) { read_image(broken); });
}

}  // namespace
}  // namespace chironomia
