// The clips in the player that participants use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_writer.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::click;
using testing::output_of;
using testing::quoted;
using testing::smooth_frame;
using testing::TemporaryFolder;

constexpr const char* kChromium = "/usr/bin/chromium";
constexpr RenderSize kSize{320, 180};

void record(const fs::path& file, const Audio& sound) {
    ClipWriter writer(file, {.size = kSize}, sound);
    for (int i = 0; i < 45; ++i) writer.write(smooth_frame(kSize, i / 30.0));
    writer.finish();
}

std::string base64(const std::string& bytes) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) {
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (size_t k = 0; k < 4; ++k) {
            text.push_back(i + k > bytes.size() ? '=' : kLetters[group >> (18 - 6 * k) & 63]);
        }
    }
    return text;
}

// The words that the page's script reports after "RESULT".
std::vector<std::string> result_of_page(const TemporaryFolder& folder, const std::string& body) {
    write_text(folder / "page.html", "<!doctype html><body>" + body + "</body>");
    const std::string console = output_of(format(
        "timeout 60 {} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync "
        "--autoplay-policy=no-user-gesture-required --enable-logging=stderr --user-data-dir={} {} 2>&1 "
        ">/dev/null | grep -a RESULT",
        kChromium, quoted(folder / "profile"), "'file://" + (folder / "page.html").string() + "'"));
    const size_t begin = console.find("RESULT");
    if (begin == std::string::npos) return {};
    const std::string line = console.substr(begin, console.find('"', begin) - begin);
    std::vector<std::string> words;
    for (const std::string_view word : split_words(line)) words.emplace_back(word);
    return words;
}

#define SKIP_WITHOUT_CHROMIUM() \
    if (!fs::exists(kChromium)) GTEST_SKIP() << "needs " << kChromium << ", not present"

class ClipInBrowser : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ClipInBrowser, ::testing::Values("mp4", "webm"),
                         [](const auto& i) { return i.param; });

TEST_P(ClipInBrowser, PlaysToItsEndWithSound) {
    SKIP_WITHOUT_CHROMIUM();
    const TemporaryFolder folder;
    const std::string name = "clip." + GetParam();
    record(folder / name, testing::tone(1.5, 48000));
    const std::vector<std::string> result =
        result_of_page(folder, format(R"(<video id="v" src="{}" autoplay></video>
        <script>
        const v = document.getElementById('v');
        v.onended = () => {{
            console.log('RESULT', v.currentTime, v.duration, v.videoWidth, v.webkitDecodedFrameCount,
                        v.webkitAudioDecodedByteCount);
            window.close();
        }};
        v.onerror = () => {{ console.log('RESULT', v.error.message); window.close(); }};
        </script>)",
                                      name));
    ASSERT_EQ(result.size(), 6u) << ::testing::PrintToString(result);
    EXPECT_NEAR(parse_number(result[1]).value_or(-1), 1.5, 1 / 30.0);
    EXPECT_NEAR(parse_number(result[2]).value_or(-1), 1.5, 1 / 30.0);
    EXPECT_EQ(result[3], "320");
    EXPECT_EQ(result[4], "45");
    EXPECT_GT(parse_number(result[5]).value_or(-1), 1000);
}

TEST_P(ClipInBrowser, IsHeardInTime) {
    SKIP_WITHOUT_CHROMIUM();
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    record(file, click(1.5, 44100, 1.0));
    const std::vector<std::string> result = result_of_page(folder, format(R"(<script>
        const bytes = Uint8Array.from(atob('{}'), letter => letter.charCodeAt(0));
        new OfflineAudioContext(1, 48000, 48000).decodeAudioData(bytes.buffer).then(sound => {{
            let loudest = 0;
            const samples = sound.getChannelData(0);
            samples.forEach((x, i) => {{ if (Math.abs(x) > Math.abs(samples[loudest])) loudest = i; }});
            console.log('RESULT', loudest / sound.sampleRate, sound.duration);
            window.close();
        }});
        </script>)",
                                                                          base64(read_text(file))));
    ASSERT_EQ(result.size(), 3u) << ::testing::PrintToString(result);
    // This way of decoding takes Opus 6 ms early, about the delay of its encoder.
    EXPECT_NEAR(parse_number(result[1]).value_or(-1), 1.0, GetParam() == "mp4" ? 0.002 : 0.008);
    EXPECT_NEAR(parse_number(result[2]).value_or(-1), 1.5, 1 / 30.0);
}

}  // namespace
}  // namespace chironomia
