#include "raster/ffmpeg/handles.h"

#include <new>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavcodec/bsf.h>
#include <libavformat/avformat.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

namespace chironomia {

void FfmpegDeleter::operator()(AVBSFContext* filter) const {
    av_bsf_free(&filter);
}

void FfmpegDeleter::operator()(AVCodecContext* codec) const {
    avcodec_free_context(&codec);
}

void FfmpegDeleter::operator()(AVFormatContext* container) const {
    if (container->iformat) {
        avformat_close_input(&container);
        return;
    }
    if (container->pb) avio_closep(&container->pb);
    avformat_free_context(container);
}

void FfmpegDeleter::operator()(AVFrame* frame) const {
    av_frame_free(&frame);
}

void FfmpegDeleter::operator()(AVPacket* packet) const {
    av_packet_free(&packet);
}

void FfmpegDeleter::operator()(SwrContext* resampler) const {
    swr_free(&resampler);
}

void FfmpegDeleter::operator()(SwsContext* scaler) const {
    sws_freeContext(scaler);
}

Owned<AVFrame> make_av_frame() {
    Owned<AVFrame> frame(av_frame_alloc());
    if (!frame) throw std::bad_alloc();
    return frame;
}

Owned<AVPacket> make_av_packet() {
    Owned<AVPacket> packet(av_packet_alloc());
    if (!packet) throw std::bad_alloc();
    return packet;
}

std::string ffmpeg_message(int code) {
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(code, text, sizeof text);
    return text;
}

std::string ffmpeg_url(const std::filesystem::path& file) {
    return "file:" + file.string();
}

void silence_ffmpeg() {
    av_log_set_level(AV_LOG_QUIET);
}

}  // namespace chironomia
