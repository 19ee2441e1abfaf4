#include "raster/ffmpeg/clip_reader.h"

#include <cstdint>
#include <new>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/demuxer.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr int kLargestSide = 16384;                // [px]
constexpr std::int64_t kLargestPicture = 1 << 26;  // [px]

// What a file does not say about its colours is taken as players take it: by the height of the picture.
int matrix_of(const AVFrame& picture) {
    if (picture.colorspace != AVCOL_SPC_UNSPECIFIED) return picture.colorspace;
    return picture.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;
}

Owned<SwsContext> make_scaler(const AVFrame& picture) {
    Owned<SwsContext> scaler(sws_getContext(
        picture.width, picture.height, static_cast<AVPixelFormat>(picture.format), picture.width,
        picture.height, AV_PIX_FMT_RGBA, SWS_BILINEAR | SWS_BITEXACT | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT,
        nullptr, nullptr, nullptr));
    if (!scaler) return nullptr;
    const int* matrix = sws_getCoefficients(matrix_of(picture));
    const int full_range = picture.color_range == AVCOL_RANGE_JPEG ? 1 : 0;
    sws_setColorspaceDetails(scaler.get(), matrix, full_range, matrix, 1, 0, 1 << 16, 1 << 16);
    return scaler;
}

}  // namespace

struct ClipReader::Parts {
    explicit Parts(const fs::path& clip);

    bool decode();  // the next picture into `picture`; false at the end
    Frame to_frame();
    [[noreturn]] void fail(const std::string& problem) const;

    fs::path file;
    Owned<AVFormatContext> container;
    AVStream* stream = nullptr;
    Owned<AVCodecContext> decoder;
    Owned<SwsContext> scaler;
    Owned<AVPacket> packet = make_av_packet();
    Owned<AVFrame> picture = make_av_frame();
    std::int64_t frames_done = 0;
    int width = 0;
    int height = 0;
    int pixel_format = -1;
};

ClipReader::Parts::Parts(const fs::path& clip) : file(clip), container(open_media(clip, "a clip")) {
    stream = find_stream(*container, AVMEDIA_TYPE_VIDEO);
    if (!stream) throw Error(format("{}: holds no pictures; give a clip that does", file.string()));
    const AVCodecParameters& codec = *stream->codecpar;
    if (codec.width > kLargestSide || codec.height > kLargestSide ||
        static_cast<std::int64_t>(codec.width) * codec.height > kLargestPicture) {
        throw Error(format("{}: its pictures are {} x {}, at most {} px are supported; make them smaller",
                           file.string(), codec.width, codec.height, kLargestPicture));
    }
    decoder = open_decoder(*stream, file);
}

void ClipReader::Parts::fail(const std::string& problem) const {
    throw Error(format("{}: damaged or cut off at frame {} ({}); write it again", file.string(), frames_done,
                       problem));
}

bool ClipReader::Parts::decode() {
    for (;;) {
        int code = avcodec_receive_frame(decoder.get(), picture.get());
        if (code >= 0) return true;
        if (code == AVERROR_EOF) return false;
        if (code != AVERROR(EAGAIN)) fail(ffmpeg_message(code));
        do {
            av_packet_unref(packet.get());
            code = av_read_frame(container.get(), packet.get());
        } while (code >= 0 && packet->stream_index != stream->index);
        if (code == AVERROR_EOF && container->pb->error >= 0) {
            code = avcodec_send_packet(decoder.get(), nullptr);
        } else if (code >= 0) {
            code = avcodec_send_packet(decoder.get(), packet.get());
        }
        if (code < 0 && code != AVERROR_EOF) fail(ffmpeg_message(code));
    }
}

Frame ClipReader::Parts::to_frame() {
    if (picture->decode_error_flags != 0 || (picture->flags & AV_FRAME_FLAG_CORRUPT)) fail("broken picture");
    if (!scaler) {
        width = picture->width;
        height = picture->height;
        pixel_format = picture->format;
        scaler = make_scaler(*picture);
        if (!scaler) fail("unknown pixel format");
    }
    if (picture->width != width || picture->height != height || picture->format != pixel_format) {
        throw Error(format("{}: frame {} is {} x {}, those before are {} x {}; make them equal",
                           file.string(), frames_done, picture->width, picture->height, width, height));
    }
    Frame frame{width, height, {}};
    frame.rgba.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
    std::uint8_t* rows[] = {frame.rgba.data()};
    const int strides[] = {width * 4};
    sws_scale(scaler.get(), picture->data, picture->linesize, 0, height, rows, strides);
    return frame;
}

ClipReader::ClipReader(const fs::path& file) : parts_(std::make_unique<Parts>(file)) {}
ClipReader::~ClipReader() = default;
ClipReader::ClipReader(ClipReader&&) noexcept = default;

std::optional<Frame> ClipReader::next() {
    Parts& parts = *parts_;
    if (!parts.decode()) {
        if (parts.frames_done < parts.stream->nb_frames) {
            parts.fail(format("it should have {} frames", parts.stream->nb_frames));
        }
        return std::nullopt;
    }
    Frame frame = parts.to_frame();
    ++parts.frames_done;
    return frame;
}

}  // namespace chironomia
