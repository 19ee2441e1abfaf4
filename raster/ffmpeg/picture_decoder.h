// The pictures of a file as its decoder gives them. For this folder alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/render/frame.h"
#include "raster/ffmpeg/handles.h"

struct AVStream;

namespace chironomia {

class PictureDecoder {
  public:
    // Throws Error if the file is missing, holds no pictures, holds too large ones or is of no known kind.
    explicit PictureDecoder(const std::filesystem::path& file);

    // The next picture; false after the last. Throws Error if the file is damaged or cut off.
    bool next();

    const AVFrame& picture() const { return *picture_; }
    void move_to(AVFrame& frame);  // the picture leaves the decoder
    AVFormatContext& container() const { return *container_; }
    const AVStream& stream() const { return *stream_; }
    const std::filesystem::path& file() const { return file_; }
    std::int64_t number() const { return number_; }  // of the picture, from 0

    // Throws Error that names the file and the frame.
    [[noreturn]] void fail(const std::string& problem) const;

  private:
    bool decode();

    std::filesystem::path file_;
    Owned<AVFormatContext> container_;
    AVStream* stream_ = nullptr;
    Owned<AVCodecContext> decoder_;
    Owned<AVPacket> packet_ = make_av_packet();
    Owned<AVFrame> picture_ = make_av_frame();
    std::int64_t number_ = -1;
};

// From the decoder's pixels to sRGB at another size (0: its own), always to the same bytes; null if it does
// not know the pixels. What a file does not say about its colours is taken as players take it: by the height
// of the picture.
Owned<SwsContext> make_scaler(const AVFrame& picture, int width = 0, int height = 0);

// The picture as the scaler makes it.
Frame scaled(const AVFrame& picture, SwsContext& scaler, int width, int height);

}  // namespace chironomia
