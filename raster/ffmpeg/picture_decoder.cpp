#include "raster/ffmpeg/picture_decoder.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/demuxer.h"

namespace chironomia {
namespace {

constexpr int kLargestSide = 16384;                // [px]
constexpr std::int64_t kLargestPicture = 1 << 26;  // [px]

int matrix_of(const AVFrame& picture) {
    if (picture.colorspace != AVCOL_SPC_UNSPECIFIED) return picture.colorspace;
    return picture.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;
}

}  // namespace

Owned<SwsContext> make_scaler(const AVFrame& picture, int width, int height) {
    const bool scales = width > 0;
    const int flags = (scales ? SWS_BICUBIC | SWS_FULL_CHR_H_INP : SWS_BILINEAR) | SWS_BITEXACT |
                      SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT;
    Owned<SwsContext> scaler(sws_getContext(picture.width, picture.height,
                                            static_cast<AVPixelFormat>(picture.format),
                                            scales ? width : picture.width, scales ? height : picture.height,
                                            AV_PIX_FMT_RGBA, flags, nullptr, nullptr, nullptr));
    if (!scaler) return nullptr;
    const int* matrix = sws_getCoefficients(matrix_of(picture));
    const int full_range = picture.color_range == AVCOL_RANGE_JPEG ? 1 : 0;
    sws_setColorspaceDetails(scaler.get(), matrix, full_range, matrix, 1, 0, 1 << 16, 1 << 16);
    return scaler;
}

Frame scaled(const AVFrame& picture, SwsContext& scaler, int width, int height) {
    Frame frame{width, height, {}};
    frame.rgba.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
    std::uint8_t* rows[] = {frame.rgba.data()};
    const int strides[] = {width * 4};
    sws_scale(&scaler, picture.data, picture.linesize, 0, picture.height, rows, strides);
    return frame;
}

PictureDecoder::PictureDecoder(const std::filesystem::path& file)
    : file_(file), container_(open_media(file, "a clip")) {
    stream_ = find_stream(*container_, AVMEDIA_TYPE_VIDEO);
    if (!stream_) throw Error(format("{}: holds no pictures; give a clip that does", file.string()));
    const AVCodecParameters& codec = *stream_->codecpar;
    if (codec.width > kLargestSide || codec.height > kLargestSide ||
        static_cast<std::int64_t>(codec.width) * codec.height > kLargestPicture) {
        throw Error(format("{}: its pictures are {} x {}, at most {} px are supported; make them smaller",
                           file.string(), codec.width, codec.height, kLargestPicture));
    }
    decoder_ = open_decoder(*stream_, file);
}

void PictureDecoder::fail(const std::string& problem) const {
    throw Error(
        format("{}: damaged or cut off at frame {} ({}); write it again", file_.string(), number_, problem));
}

bool PictureDecoder::decode() {
    for (;;) {
        int code = avcodec_receive_frame(decoder_.get(), picture_.get());
        if (code >= 0) return true;
        if (code == AVERROR_EOF) return false;
        if (code != AVERROR(EAGAIN)) fail(ffmpeg_message(code));
        do {
            av_packet_unref(packet_.get());
            code = av_read_frame(container_.get(), packet_.get());
        } while (code >= 0 && packet_->stream_index != stream_->index);
        if (code == AVERROR_EOF && container_->pb->error >= 0) {
            code = avcodec_send_packet(decoder_.get(), nullptr);
        } else if (code >= 0) {
            code = avcodec_send_packet(decoder_.get(), packet_.get());
        }
        if (code < 0 && code != AVERROR_EOF) fail(ffmpeg_message(code));
    }
}

bool PictureDecoder::next() {
    ++number_;
    if (!decode()) return false;
    if (picture_->decode_error_flags != 0 || (picture_->flags & AV_FRAME_FLAG_CORRUPT))
        fail("broken picture");
    return true;
}

void PictureDecoder::move_to(AVFrame& frame) {
    av_frame_unref(&frame);
    av_frame_move_ref(&frame, picture_.get());
}

}  // namespace chironomia
