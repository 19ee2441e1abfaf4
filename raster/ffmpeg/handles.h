// Owners of FFmpeg's objects, and its numbered errors as text. For this folder alone.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

struct AVBSFContext;
struct AVCodecContext;
struct AVFormatContext;
struct AVFrame;
struct AVPacket;
struct SwrContext;
struct SwsContext;

namespace chironomia {

struct FfmpegDeleter {
    void operator()(AVBSFContext* filter) const;
    void operator()(AVCodecContext* codec) const;
    void operator()(AVFormatContext* container) const;  // closes its file too
    void operator()(AVFrame* frame) const;
    void operator()(AVPacket* packet) const;
    void operator()(SwrContext* resampler) const;
    void operator()(SwsContext* scaler) const;
};

template <typename T>
using Owned = std::unique_ptr<T, FfmpegDeleter>;

Owned<AVFrame> make_av_frame();
Owned<AVPacket> make_av_packet();

// "Invalid data found when processing input"
std::string ffmpeg_message(int code);

// The path as FFmpeg's own file protocol takes it: a colon in a name is no protocol.
std::string ffmpeg_url(const std::filesystem::path& file);

// FFmpeg and its encoders print nothing; what goes wrong is said by our errors.
void silence_ffmpeg();

}  // namespace chironomia
