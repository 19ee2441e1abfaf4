#include "raster/ffmpeg/audio_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <string_view>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/samplefmt.h>
}

#include "core/error.h"
#include "core/files/files.h"
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

// Ogg does not state its length, but the last page of a whole file is whole and marked as the last.
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

AVStream& sound_of(AVFormatContext& container, const fs::path& file) {
    AVStream* stream = find_stream(container, AVMEDIA_TYPE_AUDIO);
    if (!stream) throw Error(format("{}: holds no sound; give a file that does", file.string()));
    return *stream;
}

// Whether it is a WAV that a program wrote into a pipe, where its size cannot be filled in afterwards: FFmpeg leaves
// 0xffffffff, espeak-ng 0x7ffff000, others 0.
bool has_open_end(const fs::path& file) {
    constexpr std::uint32_t kLeastOpen = 0x7ffff000;
    std::ifstream stream(file, std::ios::binary);
    std::array<unsigned char, 12> head{};  // of the file, then of each chunk
    const auto read = [&](std::streamsize bytes) {
        return bool(stream.read(reinterpret_cast<char*>(head.data()), bytes));
    };
    if (!read(12) || std::memcmp(head.data(), "RIFF", 4) != 0) return false;
    while (read(8)) {
        std::uint32_t size = 0;
        for (size_t i = 0; i < 4; ++i) size |= std::uint32_t(head[4 + i]) << (8 * i);
        if (std::memcmp(head.data(), "data", 4) == 0) return size == 0 || size >= kLeastOpen;
        stream.seekg(static_cast<std::streamoff>(size) + size % 2, std::ios::cur);
    }
    return false;
}

class SoundReader {
  public:
    //   begin, end   what is kept [s]
    SoundReader(const fs::path& file, double begin, double end)
        : file_(file), container_(open_media(file, "sound")), begin_(begin), end_(end) {
        stream_ = &sound_of(*container_, file);
        decoder_ = open_decoder(*stream_, file);
        open_end_ = has_open_end(file);
    }

    AudioPart read() {
        const Owned<AVPacket> packet = make_av_packet();
        for (;;) {
            const int code = av_read_frame(container_.get(), packet.get());
            if (code == AVERROR_EOF) break;
            if (code < 0) fail(code);
            if (packet->stream_index == stream_->index) {
                if (packet->flags & AV_PKT_FLAG_CORRUPT && !open_end_) fail(AVERROR_INVALIDDATA);
                delivered_ += packet->duration;
                decode(packet.get());
            }
            av_packet_unref(packet.get());
            if (is_beyond_part()) return part();
        }
        if (container_->pb->error < 0) fail(container_->pb->error);
        decode(nullptr);
        keep_what_was_promised();
        return part();
    }

  private:
    size_t sample_at(double seconds) const {
        return static_cast<size_t>(std::llround(std::min(seconds, kLongest + 1) * audio_.rate));
    }
    double seconds() const { return static_cast<double>(length_) / audio_.rate; }

    // By so much that nothing that is left out at the end of the file is missed.
    bool is_beyond_part() const {
        return length_ > 0 && end_ < kLongest && length_ >= sample_at(end_) + 2 * kFrame;
    }

    AudioPart part() {
        expect_finite();
        return {.sound = std::move(audio_), .first = sample_at(begin_), .length = length_};
    }

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
        if (length_ == 0) {
            audio_.rate = frame.sample_rate;
            audio_.channels = channels;
        }
        if (audio_.rate != frame.sample_rate || audio_.channels != channels) {
            throw Error(
                format("{}: changes from {} Hz, {} channels to {} Hz, {} channels at {:.3f} s; make it one",
                       file_.string(), audio_.rate, audio_.channels, frame.sample_rate, channels, seconds()));
        }
        keep_part(frame);
        if (seconds() > kLongest) {
            throw Error(
                format("{}: lasts over {:.0f} hours; cut it into clips", file_.string(), kLongest / 3600));
        }
    }

    void keep_part(const AVFrame& frame) {
        const auto channels = static_cast<size_t>(audio_.channels);
        decoded_.clear();
        append(frame, decoded_);
        if (!bad_) {
            const auto bad = std::find_if_not(decoded_.begin(), decoded_.end(),
                                              [](float sample) { return std::isfinite(sample); });
            const size_t index = static_cast<size_t>(bad - decoded_.begin());
            if (bad != decoded_.end()) bad_ = BadSample{.sample = length_ + index / channels, .value = *bad};
        }
        const size_t count = decoded_.size() / channels;
        const auto place = [&](double time) {
            const size_t sample = std::clamp(sample_at(time), length_, length_ + count) - length_;
            return decoded_.begin() + static_cast<std::ptrdiff_t>(sample * channels);
        };
        if (begin_ < end_) audio_.samples.insert(audio_.samples.end(), place(begin_), place(end_));
        length_ += count;
    }

    [[noreturn]] void fail(int code) const {
        throw Error(format("{}: damaged or cut off after {:.3f} s ({}); write it again", file_.string(),
                           length_ > 0 ? seconds() : 0, ffmpeg_message(code)));
    }

    // What the file's beginning promised must have come, and what an encoder added to fill its last frame
    // goes. Only a promise counts, not FFmpeg's estimate.
    void keep_what_was_promised() {
        if (length_ == 0) {
            throw Error(format("{}: its sound is empty; record it again", file_.string()));
        }
        const std::string_view kind = container_->iformat->name;
        if (kind == "ogg") expect_last_page(file_, seconds());
        if (container_->duration_estimation_method == AVFMT_DURATION_FROM_BITRATE) return;
        if (kind == "ogg" || open_end_ || stream_->duration == AV_NOPTS_VALUE) return;
        const double tick = av_q2d(stream_->time_base);
        const double promised = static_cast<double>(stream_->duration) * tick;
        // The promise of an MP3 counts what the decoder has left out at both ends.
        const double kept = kind == "mp3" ? static_cast<double>(delivered_) * tick : seconds();
        const bool exact = kind == "wav" || kind == "flac" || kind == "aiff";
        const double tolerance = (exact ? 0.5 : kFrame / 4.0) / audio_.rate;
        if (kept + tolerance < promised) {
            throw Error(format("{}: cut off: it should last {:.3f} s and ends after {:.3f} s; write it again",
                               file_.string(), promised, kept));
        }
        const auto length = static_cast<size_t>(std::llround(promised * audio_.rate));
        if (kind.starts_with("mov") && length_ > length && length_ < length + 2 * kFrame) {
            length_ = length;
            const size_t left = length - std::min(length, sample_at(begin_));
            audio_.samples.resize(std::min(audio_.length(), left) * static_cast<size_t>(audio_.channels));
        }
    }

    void expect_finite() const {
        if (!bad_ || bad_->sample >= length_) return;
        throw Error(format("{}: sample {} ({:.3f} s) is {}, no finite number; write it again", file_.string(),
                           bad_->sample, static_cast<double>(bad_->sample) / audio_.rate, bad_->value));
    }

    struct BadSample {
        size_t sample = 0;
        float value = 0;
    };

    fs::path file_;
    Owned<AVFormatContext> container_;
    AVStream* stream_ = nullptr;
    Owned<AVCodecContext> decoder_;
    Owned<AVFrame> frame_ = make_av_frame();
    bool open_end_ = false;       // it ends where the file ends
    double begin_, end_;          // of the part [s]
    Audio audio_;                 // the part
    std::vector<float> decoded_;  // of the last frame
    size_t length_ = 0;           // decoded [samples]
    std::optional<BadSample> bad_;
    std::int64_t delivered_ = 0;  // [ticks of the stream]
};

}  // namespace

Audio read_audio(const fs::path& file) {
    return SoundReader(file, 0, kLongest + 1).read().sound;
}

AudioPart read_audio_part(const fs::path& file, double begin, std::optional<double> end) {
    return SoundReader(file, begin, end.value_or(kLongest + 1)).read();
}

double sound_after_pictures(const fs::path& file) {
    const Owned<AVFormatContext> container = open_media(file, "sound");
    const AVStream& sound = sound_of(*container, file);
    const AVStream* pictures = find_stream(*container, AVMEDIA_TYPE_VIDEO);
    const bool is_film = pictures && !(pictures->disposition & AV_DISPOSITION_ATTACHED_PIC);
    return is_film ? start_of(sound) - start_of(*pictures) : 0;
}

std::optional<std::string> unstated_delay(const fs::path& file) {
    // As Debian's encoders write, and FFmpeg leaves out where a header or a container says so: LAME's 576 and the 529 of
    // every decoder; the first frame of FFmpeg's AAC.
    constexpr double kMp3 = 576 + 529, kAac = 1024;  // [samples]
    const Owned<AVFormatContext> container = open_media(file, "sound");
    const AVStream& sound = sound_of(*container, file);
    const std::string_view kind = container->iformat->name;
    const bool is_mp3 = sound.codecpar->codec_id == AV_CODEC_ID_MP3;
    const bool is_bare = kind == "mp3" || kind == "aac";
    const bool is_wrapped = kind == "avi" || kind.starts_with("matroska");
    if (!is_mp3 && sound.codecpar->codec_id != AV_CODEC_ID_AAC) return std::nullopt;
    if (!is_bare && (!is_wrapped || find_stream(*container, AVMEDIA_TYPE_VIDEO))) return std::nullopt;
    const Owned<AVPacket> packet = make_av_packet();
    do {
        av_packet_unref(packet.get());
        if (av_read_frame(container.get(), packet.get()) < 0) return std::nullopt;
    } while (packet->stream_index != sound.index);
    if (av_packet_get_side_data(packet.get(), AV_PKT_DATA_SKIP_SAMPLES, nullptr)) return std::nullopt;
    const std::string what =
        is_wrapped ? format("{} in {} does", is_mp3 ? "MP3" : "AAC", kind == "avi" ? "AVI" : "Matroska")
        : is_mp3   ? "an MP3 without a Xing header does"
                   : "bare AAC does";
    return format(
        "{}: {} not say how much its encoder put before the sound, which is heard late by that: by {:.0f} ms "
        "if {} wrote it; give the sound as WAV, FLAC or {}",
        file.string(), what, 1000 * (is_mp3 ? kMp3 : kAac) / sound.codecpar->sample_rate,
        is_mp3 ? "LAME" : "FFmpeg", is_mp3 ? "MP3 with a Xing header" : "M4A");
}

void check_audio(const fs::path& file) {
    SoundReader(file, kLongest + 1, kLongest + 1).read();
}

}  // namespace chironomia
