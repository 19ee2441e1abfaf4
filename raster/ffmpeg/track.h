// One stream of a clip that is being written: an encoder and its way into the container. For this folder
// alone.
#pragma once

#include <filesystem>

#include "raster/ffmpeg/handles.h"

struct AVStream;

namespace chironomia {

// The container of a clip and the name its errors carry.
struct Container {
    Owned<AVFormatContext> format;
    std::filesystem::path file;  // the final name
};

// Throws Error that names the file unless `code` says success.
void expect_written(int code, const std::filesystem::path& file);

class Track {
  public:
    // Adds a stream to the container, which must outlive the track. The encoder is open.
    Track(Container& container, Owned<AVCodecContext> encoder);

    AVCodecContext& encoder() { return *encoder_; }
    AVStream& stream() { return *stream_; }

    void encode(const AVFrame& frame);  // throw Error if the file cannot be written
    void finish();

  private:
    void send(const AVFrame* frame);
    void send_filtered(AVPacket* packet);
    void write(AVPacket* packet);

    Container& container_;
    Owned<AVCodecContext> encoder_;
    AVStream* stream_;
    Owned<AVBSFContext> filter_;  // H.264: drops the encoder's message about itself
    Owned<AVPacket> packet_;
};

}  // namespace chironomia
