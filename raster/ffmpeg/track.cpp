#include "raster/ffmpeg/track.h"

#include <new>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavcodec/bsf.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// x264 writes its version and all its options into the first picture, as a unit of type 6.
Owned<AVBSFContext> make_filter(const AVCodecContext& encoder) {
    if (encoder.codec_id != AV_CODEC_ID_H264) return nullptr;
    AVBSFContext* made = nullptr;
    int problem = av_bsf_alloc(av_bsf_get_by_name("filter_units"), &made);
    Owned<AVBSFContext> filter(made);
    if (problem >= 0) problem = avcodec_parameters_from_context(filter->par_in, &encoder);
    if (problem >= 0) problem = av_opt_set(filter->priv_data, "remove_types", "6", 0);
    if (problem >= 0) problem = av_bsf_init(filter.get());
    if (problem < 0) throw Error(format("H.264 stream filter: cannot start ({})", ffmpeg_message(problem)));
    filter->time_base_in = encoder.time_base;
    return filter;
}

}  // namespace

void expect_written(int code, const std::filesystem::path& file) {
    if (code >= 0) return;
    throw Error(format("{}: cannot be written ({}); check free space and permissions", file.string(),
                       ffmpeg_message(code)));
}

Track::Track(Container& container, Owned<AVCodecContext> encoder)
    : container_(container),
      encoder_(std::move(encoder)),
      stream_(avformat_new_stream(container.format.get(), nullptr)),
      filter_(make_filter(*encoder_)),
      packet_(make_av_packet()) {
    if (!stream_) throw std::bad_alloc();
    const int problem = avcodec_parameters_from_context(stream_->codecpar, encoder_.get());
    if (problem < 0) throw std::bad_alloc();
    stream_->time_base = encoder_->time_base;
}

void Track::encode(const AVFrame& frame) {
    send(&frame);
}

void Track::finish() {
    send(nullptr);
}

void Track::send(const AVFrame* frame) {
    expect_written(avcodec_send_frame(encoder_.get(), frame), container_.file);
    for (;;) {
        const int code = avcodec_receive_packet(encoder_.get(), packet_.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) break;
        expect_written(code, container_.file);
        if (encoder_->codec_type == AVMEDIA_TYPE_VIDEO) packet_->duration = 1;
        send_filtered(packet_.get());
    }
    if (!frame && filter_) send_filtered(nullptr);
}

void Track::send_filtered(AVPacket* packet) {
    if (!filter_) return write(packet);
    expect_written(av_bsf_send_packet(filter_.get(), packet), container_.file);
    for (;;) {
        const int code = av_bsf_receive_packet(filter_.get(), packet_.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
        expect_written(code, container_.file);
        write(packet_.get());
    }
}

void Track::write(AVPacket* packet) {
    av_packet_rescale_ts(packet, encoder_->time_base, stream_->time_base);
    packet->stream_index = stream_->index;
    expect_written(av_interleaved_write_frame(container_.format.get(), packet), container_.file);
}

}  // namespace chironomia
