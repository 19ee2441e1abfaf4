#include "raster/ffmpeg/audio_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/samplefmt.h>
}

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "raster/ffmpeg/demuxer.h"
#include "raster/ffmpeg/handles.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr double kLongest = 6 * 3600.0;  // [s]
constexpr int kFrame = 1152;             // [samples] the longest frame of MP3 and AAC

// One sample in [-1, 1].
float to_float(std::uint8_t value) {
    return static_cast<float>(value - 128) / 128.0f;
}
float to_float(std::int16_t value) {
    return static_cast<float>(value) / 32768.0f;
}
float to_float(std::int32_t value) {
    return static_cast<float>(static_cast<double>(value) / 2147483648.0);
}
float to_float(std::int64_t value) {
    return static_cast<float>(static_cast<double>(value) / 9223372036854775808.0);
}
float to_float(float value) {
    return value;
}
float to_float(double value) {
    return static_cast<float>(value);
}

template <typename Sample>
void append_as(const AVFrame& frame, std::vector<float>& samples) {
    const int channels = frame.ch_layout.nb_channels;
    const bool planar = av_sample_fmt_is_planar(static_cast<AVSampleFormat>(frame.format));
    for (int i = 0; i < frame.nb_samples; ++i) {
        for (int channel = 0; channel < channels; ++channel) {
            const std::uint8_t* plane = frame.extended_data[planar ? channel : 0];
            const int place = planar ? i : i * channels + channel;
            Sample value;
            std::memcpy(&value, plane + static_cast<size_t>(place) * sizeof value, sizeof value);
            samples.push_back(to_float(value));
        }
    }
}

void append(const AVFrame& frame, std::vector<float>& samples) {
    switch (av_get_packed_sample_fmt(static_cast<AVSampleFormat>(frame.format))) {
        case AV_SAMPLE_FMT_U8:
            return append_as<std::uint8_t>(frame, samples);
        case AV_SAMPLE_FMT_S16:
            return append_as<std::int16_t>(frame, samples);
        case AV_SAMPLE_FMT_S32:
            return append_as<std::int32_t>(frame, samples);
        case AV_SAMPLE_FMT_S64:
            return append_as<std::int64_t>(frame, samples);
        case AV_SAMPLE_FMT_FLT:
            return append_as<float>(frame, samples);
        default:
            return append_as<double>(frame, samples);
    }
}

// Ogg tells its length nowhere; but the last page of a whole file says that it is the last, and is whole.
void expect_last_page(const fs::path& file, double seconds) {
    constexpr size_t kLongestPage = 27 + 255 + 255 * 255;
    const std::string bytes = read_text(file);
    const size_t begin = bytes.size() > kLongestPage ? bytes.size() - kLongestPage : 0;
    for (size_t page = bytes.find("OggS", begin); page != std::string::npos;
         page = bytes.find("OggS", page + 1)) {
        if (page + 27 > bytes.size()) break;
        const auto byte = [&](size_t place) { return static_cast<unsigned char>(bytes[page + place]); };
        size_t size = 27u + byte(26);
        if (page + size > bytes.size()) break;
        for (size_t i = 0; i < byte(26); ++i) size += byte(27 + i);
        const bool last = byte(5) & 4;
        if (last && page + size == bytes.size()) return;
    }
    throw Error(format("{}: cut off: its last page is missing after {:.3f} s; write it again", file.string(),
                       seconds));
}

class SoundReader {
  public:
    explicit SoundReader(const fs::path& file) : file_(file), container_(open_media(file, "sound")) {
        stream_ = find_stream(*container_, AVMEDIA_TYPE_AUDIO);
        if (!stream_) throw Error(format("{}: holds no sound; give a file that does", file.string()));
        decoder_ = open_decoder(*stream_, file);
    }

    Audio read() {
        const Owned<AVPacket> packet = make_av_packet();
        for (;;) {
            const int code = av_read_frame(container_.get(), packet.get());
            if (code == AVERROR_EOF) break;
            if (code < 0) fail(code);
            if (packet->stream_index == stream_->index) {
                if (packet->flags & AV_PKT_FLAG_CORRUPT) fail(AVERROR_INVALIDDATA);
                delivered_ += packet->duration;
                decode(packet.get());
            }
            av_packet_unref(packet.get());
        }
        if (container_->pb->error < 0) fail(container_->pb->error);
        decode(nullptr);
        keep_what_was_promised();
        expect_finite();
        return std::move(audio_);
    }

  private:
    void decode(const AVPacket* packet) {
        if (const int code = avcodec_send_packet(decoder_.get(), packet); code < 0) fail(code);
        for (;;) {
            const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
            if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
            if (code < 0) fail(code);
            take(*frame_);
        }
    }

    void take(const AVFrame& frame) {
        const int channels = frame.ch_layout.nb_channels;
        if (audio_.samples.empty()) {
            audio_.rate = frame.sample_rate;
            audio_.channels = channels;
        }
        if (audio_.rate != frame.sample_rate || audio_.channels != channels) {
            throw Error(
                format("{}: changes from {} Hz, {} channels to {} Hz, {} channels at {:.3f} s; make it one",
                       file_.string(), audio_.rate, audio_.channels, frame.sample_rate, channels,
                       audio_.duration()));
        }
        append(frame, audio_.samples);
        if (audio_.duration() > kLongest) {
            throw Error(
                format("{}: lasts over {:.0f} hours; cut it into clips", file_.string(), kLongest / 3600));
        }
    }

    [[noreturn]] void fail(int code) const {
        throw Error(format("{}: damaged or cut off after {:.3f} s ({}); write it again", file_.string(),
                           audio_.duration(), ffmpeg_message(code)));
    }

    // What the file's beginning promised must have come, and what an encoder added to fill its last frame
    // goes. Only a promise counts, not FFmpeg's estimate.
    void keep_what_was_promised() {
        if (audio_.samples.empty()) {
            throw Error(format("{}: its sound is empty; record it again", file_.string()));
        }
        const std::string_view kind = container_->iformat->name;
        if (kind == "ogg") expect_last_page(file_, audio_.duration());
        if (container_->duration_estimation_method == AVFMT_DURATION_FROM_BITRATE) return;
        if (kind == "ogg" || stream_->duration == AV_NOPTS_VALUE) return;
        const double tick = av_q2d(stream_->time_base);
        const double promised = static_cast<double>(stream_->duration) * tick;
        // The promise of an MP3 counts what the decoder has left out at both ends.
        const double kept = kind == "mp3" ? static_cast<double>(delivered_) * tick : audio_.duration();
        const bool exact = kind == "wav" || kind == "flac" || kind == "aiff";
        const double tolerance = (exact ? 0.5 : kFrame / 4.0) / audio_.rate;
        if (kept + tolerance < promised) {
            throw Error(format("{}: cut off: it should last {:.3f} s and ends after {:.3f} s; write it again",
                               file_.string(), promised, kept));
        }
        const auto length = static_cast<size_t>(std::llround(promised * audio_.rate));
        if (kind.starts_with("mov") && audio_.length() > length && audio_.length() < length + 2 * kFrame) {
            audio_.samples.resize(length * static_cast<size_t>(audio_.channels));
        }
    }

    void expect_finite() const {
        const auto bad = std::find_if_not(audio_.samples.begin(), audio_.samples.end(),
                                          [](float sample) { return std::isfinite(sample); });
        if (bad == audio_.samples.end()) return;
        const size_t index =
            static_cast<size_t>(bad - audio_.samples.begin()) / static_cast<size_t>(audio_.channels);
        throw Error(format("{}: sample {} ({:.3f} s) is {}, no finite number; write it again", file_.string(),
                           index, static_cast<double>(index) / audio_.rate, *bad));
    }

    fs::path file_;
    Owned<AVFormatContext> container_;
    AVStream* stream_ = nullptr;
    Owned<AVCodecContext> decoder_;
    Owned<AVFrame> frame_ = make_av_frame();
    Audio audio_;
    std::int64_t delivered_ = 0;  // [ticks of the stream]
};

}  // namespace

Audio read_audio(const fs::path& file) {
    return SoundReader(file).read();
}

}  // namespace chironomia
