// Records real videos that are quick to make: plain grey frames and a tone, of another grey for each recipe.
#pragma once

#include <cmath>

#include "core/hash.h"
#include "raster/ffmpeg/clip_writer.h"
#include "tests/study/fake_maker.h"

namespace chironomia::testing {

inline Frame grey_frame(const RenderSize& size, std::uint8_t grey) {
    Frame frame{.width = size.width, .height = size.height, .rgba = {}};
    frame.rgba.assign(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 4, grey);
    return frame;
}

inline Audio tone(double seconds, float gain = 0.1f) {
    Audio sound{.rate = 48000, .channels = 1, .samples = {}};
    sound.samples.resize(static_cast<std::size_t>(std::lround(seconds * sound.rate)));
    for (std::size_t i = 0; i < sound.samples.size(); ++i) {
        sound.samples[i] = gain * std::sin(0.05f * static_cast<float>(i % 100000));
    }
    return sound;
}

struct TinyVideo {
    RenderSize size;
    Rate fps;
    std::size_t frames = 1;
    std::uint8_t grey = 128;
    bool sound = true;
    float gain = 0.1f;
};

inline void write_tiny_video(const std::filesystem::path& file, const TinyVideo& video) {
    std::optional<Audio> sound;
    if (video.sound) sound = tone(video.fps.seconds(video.frames), video.gain);
    ClipWriter writer(file, {.size = video.size, .fps = video.fps}, sound);
    for (std::size_t i = 0; i < video.frames; ++i) {
        writer.write(grey_frame(video.size, static_cast<std::uint8_t>(video.grey + i % 40)));
    }
    writer.finish();
}

// Like FakeMaker's, but with pictures and sound.
inline ClipMaker tiny_maker(const FakeMaker& fake) {
    ClipMaker maker = fake.maker();
    maker.record = [](const ClipJob& job) {
        const std::string hash = sha256(FakeMaker::recipe(job).dump());
        TinyVideo video{.size = job.size,
                        .fps = job.fps,
                        .sound = !job.silent && (job.audio || job.performers.front().voice)};
        video.frames = static_cast<std::size_t>(std::lround(job.at_least.value_or(0) * job.fps.per_second()));
        video.grey = static_cast<std::uint8_t>(hash[0] + hash[1]);
        write_tiny_video(job.out, video);
        return ClipResult{
            .frames = video.frames, .seconds = video.fps.seconds(video.frames), .warnings = {}, .report = {}};
    };
    return maker;
}

}  // namespace chironomia::testing
