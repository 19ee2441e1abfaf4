#include "raster/ffmpeg/clip_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fstream>
#include <new>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
#include <libavutil/dict.h>
#include <libavutil/opt.h>
}

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/handles.h"
#include "raster/ffmpeg/sound.h"
#include "raster/ffmpeg/track.h"
#include "raster/ffmpeg/yuv.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// Part of the format of a clip, not a choice of the machine: another number of threads is another file.
constexpr int kVideoThreads = 4;
constexpr int kSoundRate = 48000;    // [Hz]
constexpr int kSoundBits = 160'000;  // [bit/s]
// A player seeks from these. Each is coded anew, so that what stands still jumps a little; ours, so that most clips of a
// study have a single one. 10 s of 1280x720 decode in a second on one core.
constexpr double kSecondsBetweenKeys = 10.0;
constexpr std::array kPresets = {"ultrafast", "superfast", "veryfast", "faster",  "fast",
                                 "medium",    "slow",      "slower",   "veryslow"};

enum class Kind { mp4, webm };

Kind kind_of(const fs::path& file) {
    const std::string ending = to_lower(file.extension().string());
    if (ending == ".mp4") return Kind::mp4;
    if (ending == ".webm") return Kind::webm;
    throw Error(format(
        "{}: a clip cannot end in \"{}\"; name it .mp4 or .webm, or name pictures, such as frames/%04d.png",
        file.string(), ending));
}

void expect_side(const fs::path& file, const char* name, int side) {
    if (side < 16 || side > 8192) {
        throw Error(format("{}: a {} of {} px is not between 16 and 8192; choose another size", file.string(),
                           name, side));
    }
    if (side % 2 != 0) {
        throw Error(format("{}: a {} of {} px is odd, and video stores colour for 2 x 2 pixels; use {} or {}",
                           file.string(), name, side, side - 1, side + 1));
    }
}

void expect_usable(const fs::path& file, const ClipSpec& spec, const std::optional<Audio>& sound) {
    kind_of(file);
    expect_side(file, "width", spec.size.width);
    expect_side(file, "height", spec.size.height);
    if (spec.fps.numerator <= 0 || spec.fps.denominator <= 0) {
        throw Error(format("{}: {}/{} is no frame rate; it must be above 0", file.string(),
                           spec.fps.numerator, spec.fps.denominator));
    }
    if (spec.crf < 0 || spec.crf > 51) {
        throw Error(
            format("{}: a crf of {} is not between 0 (best) and 51 (worst); 18 looks like the original",
                   file.string(), spec.crf));
    }
    if (std::find(kPresets.begin(), kPresets.end(), spec.preset) == kPresets.end()) {
        throw Error(format("{}: there is no preset \"{}\"; choose one of {}", file.string(), spec.preset,
                           join({kPresets.begin(), kPresets.end()})));
    }
    if (sound && sound->length() == 0) {
        throw Error(format("{}: the sound is empty; give one with samples or none", file.string()));
    }
}

Owned<AVCodecContext> make_encoder(const char* name) {
    const AVCodec* codec = avcodec_find_encoder_by_name(name);
    if (!codec) throw Error(format("FFmpeg: has no encoder \"{}\"; install one that has", name));
    Owned<AVCodecContext> encoder(avcodec_alloc_context3(codec));
    if (!encoder) throw std::bad_alloc();
    encoder->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
    return encoder;
}

void set_option(AVCodecContext& encoder, const char* name, const std::string& value) {
    [[maybe_unused]] const int problem = av_opt_set(encoder.priv_data, name, value.c_str(), 0);
    assert(problem >= 0);
}

void open_encoder(AVCodecContext& encoder) {
    const char* name = encoder.codec->name;  // which a failed start takes away
    const int problem = avcodec_open2(&encoder, nullptr, nullptr);
    if (problem < 0) {
        throw Error(format(
            "{}: the encoder cannot start ({}); it needs memory and threads, so end other programs or raise "
            "their limits (ulimit -v, ulimit -u)",
            name, ffmpeg_message(problem)));
    }
}

void describe_picture(AVCodecContext& encoder, const ClipSpec& spec) {
    encoder.width = spec.size.width;
    encoder.height = spec.size.height;
    encoder.sample_aspect_ratio = {1, 1};
    encoder.time_base = {spec.fps.denominator, spec.fps.numerator};
    encoder.framerate = {spec.fps.numerator, spec.fps.denominator};
    encoder.gop_size =
        std::max(1, static_cast<int>(std::lround(kSecondsBetweenKeys * spec.fps.per_second())));
    encoder.pix_fmt = AV_PIX_FMT_YUV420P;
    encoder.color_range = AVCOL_RANGE_MPEG;
    encoder.color_primaries = AVCOL_PRI_BT709;
    encoder.color_trc = AVCOL_TRC_BT709;
    encoder.colorspace = AVCOL_SPC_BT709;
    encoder.chroma_sample_location = AVCHROMA_LOC_CENTER;
    encoder.thread_count = kVideoThreads;
}

Owned<AVCodecContext> make_h264_encoder(const ClipSpec& spec) {
    Owned<AVCodecContext> encoder = make_encoder("libx264");
    describe_picture(*encoder, spec);
    encoder->thread_type = FF_THREAD_FRAME;
    set_option(*encoder, "preset", spec.preset);
    set_option(*encoder, "profile", "high");
    set_option(*encoder, "crf", std::to_string(spec.crf));
    // Without "cpu-independent" x264's AVX-512 code lets memory that was never written decide on quantisers.
    set_option(*encoder, "x264-params", "lookahead-threads=1:cpu-independent=1");
    open_encoder(*encoder);
    return encoder;
}

Owned<AVCodecContext> make_vp9_encoder(const ClipSpec& spec) {
    Owned<AVCodecContext> encoder = make_encoder("libvpx-vp9");
    describe_picture(*encoder, spec);
    encoder->bit_rate = 0;  // constant quality
    set_option(*encoder, "crf", std::to_string(spec.crf * 63 / 51));
    set_option(*encoder, "deadline", "realtime");
    set_option(*encoder, "cpu-used", "8");
    set_option(*encoder, "tile-columns", "1");
    open_encoder(*encoder);
    return encoder;
}

Owned<AVCodecContext> make_sound_encoder(Kind kind, int channels) {
    Owned<AVCodecContext> encoder = make_encoder(kind == Kind::mp4 ? "aac" : "libopus");
    encoder->sample_rate = kSoundRate;
    encoder->sample_fmt = kind == Kind::mp4 ? AV_SAMPLE_FMT_FLTP : AV_SAMPLE_FMT_FLT;
    encoder->bit_rate = kSoundBits;
    encoder->time_base = {1, kSoundRate};
    av_channel_layout_default(&encoder->ch_layout, channels);
    open_encoder(*encoder);
    return encoder;
}

Owned<AVFormatContext> make_container(Kind kind, const PendingOutput& output) {
    AVFormatContext* made = nullptr;
    const std::string url = ffmpeg_url(output.path());
    const int problem =
        avformat_alloc_output_context2(&made, nullptr, kind == Kind::mp4 ? "mp4" : "webm", url.c_str());
    if (problem < 0) throw std::bad_alloc();
    Owned<AVFormatContext> container(made);
    container->flags |= AVFMT_FLAG_BITEXACT;
    // Sound begins before 0 by the encoder's delay, which both containers state; nothing is to be shifted.
    container->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
    expect_written(avio_open(&container->pb, url.c_str(), AVIO_FLAG_WRITE), output.final_path());
    return container;
}

void write_header(Container& container, Kind kind) {
    AVDictionary* options = nullptr;
    if (kind == Kind::mp4) {
        av_dict_set(&options, "movflags", "+faststart", 0);
    } else {
        av_dict_set(&options, "cues_to_front", "1", 0);
        av_dict_set(&options, "write_crc32", "0", 0);
    }
    const int problem = avformat_write_header(container.format.get(), &options);
    av_dict_free(&options);
    expect_written(problem, container.file);
}

// WebM demands the name of the application that wrote it, and the muxer gives its own. Neither element
// (0x4D80 and 0x5741, each of 4 bytes) has to be true.
void forget_application(const fs::path& partial, const fs::path& file) {
    std::fstream stream(partial, std::ios::in | std::ios::out | std::ios::binary);
    std::string head(4096, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    stream.clear();
    for (const std::string_view element : {"\x4d\x80\x84Lavf", "\x57\x41\x84Lavf"}) {
        const size_t place = head.find(element);
        if (place == std::string::npos) continue;
        stream.seekp(static_cast<std::streamoff>(place + 3));
        stream.write("none", 4);
    }
    stream.close();
    if (!stream) expect_written(AVERROR(EIO), file);
}

// The next samples of the sound, in the encoder's order of channels.
Owned<AVFrame> slice(const Audio& sound, size_t begin, size_t count, const AVCodecContext& encoder) {
    Owned<AVFrame> frame = make_av_frame();
    frame->format = encoder.sample_fmt;
    frame->sample_rate = sound.rate;
    frame->nb_samples = static_cast<int>(count);
    frame->pts = static_cast<std::int64_t>(begin);
    if (av_channel_layout_copy(&frame->ch_layout, &encoder.ch_layout) < 0) throw std::bad_alloc();
    if (av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
    const size_t channels = static_cast<size_t>(sound.channels);
    const float* samples = sound.samples.data() + begin * channels;
    if (encoder.sample_fmt == AV_SAMPLE_FMT_FLT) {
        std::copy_n(samples, count * channels, reinterpret_cast<float*>(frame->data[0]));
        return frame;
    }
    for (size_t channel = 0; channel < channels; ++channel) {
        float* plane = reinterpret_cast<float*>(frame->extended_data[channel]);
        for (size_t i = 0; i < count; ++i) plane[i] = samples[i * channels + channel];
    }
    return frame;
}

}  // namespace

struct ClipWriter::Parts {
    Parts(const fs::path& file, const ClipSpec& clip_spec, const std::optional<Audio>& given_sound);

    void encode_sound_until(double seconds);
    void expect_same_end() const;
    void close();

    Kind kind;
    ClipSpec spec;
    std::optional<Audio> sound;  // at 48 kHz
    size_t sound_done = 0;       // [samples]
    std::int64_t frames_done = 0;
    PendingOutput output;
    Container container;
    std::optional<Track> picture_track;
    std::optional<Track> sound_track;
    Owned<AVFrame> picture;
};

ClipWriter::Parts::Parts(const fs::path& file, const ClipSpec& clip_spec,
                         const std::optional<Audio>& given_sound)
    : kind(kind_of(file)), spec(clip_spec), output(file, PendingOutput::Kind::file) {
    silence_ffmpeg();
    if (given_sound) sound = resample(*given_sound, kSoundRate);
    container = {.format = make_container(kind, output), .file = file};
    picture_track.emplace(container, kind == Kind::mp4 ? make_h264_encoder(spec) : make_vp9_encoder(spec));
    AVStream& stream = picture_track->stream();
    stream.avg_frame_rate = stream.r_frame_rate = picture_track->encoder().framerate;
    stream.sample_aspect_ratio = {1, 1};
    if (kind == Kind::mp4) av_dict_set(&stream.metadata, "handler_name", "video", 0);
    if (sound) {
        sound_track.emplace(container, make_sound_encoder(kind, sound->channels));
        if (kind == Kind::mp4) av_dict_set(&sound_track->stream().metadata, "handler_name", "sound", 0);
    }
    write_header(container, kind);

    picture = make_av_frame();
    picture->format = AV_PIX_FMT_YUV420P;
    picture->width = spec.size.width;
    picture->height = spec.size.height;
    if (av_frame_get_buffer(picture.get(), 0) < 0) throw std::bad_alloc();
}

void ClipWriter::Parts::encode_sound_until(double seconds) {
    if (!sound) return;
    AVCodecContext& encoder = sound_track->encoder();
    while (sound_done < sound->length() && static_cast<double>(sound_done) < seconds * kSoundRate) {
        const size_t count = std::min(static_cast<size_t>(encoder.frame_size), sound->length() - sound_done);
        sound_track->encode(*slice(*sound, sound_done, count, encoder));
        sound_done += count;
    }
}

void ClipWriter::Parts::expect_same_end() const {
    if (frames_done == 0) {
        throw Error(format("{}: a clip without frames cannot be written; give it at least one",
                           output.final_path().string()));
    }
    if (!sound) return;
    const double picture_s = spec.fps.seconds(static_cast<size_t>(frames_done));
    if (std::abs(picture_s - sound->duration()) <= spec.fps.seconds(1) + 1.0 / kSoundRate) return;
    throw Error(
        format("{}: the picture lasts {:.3f} s and the sound {:.3f} s; make them end within one frame",
               output.final_path().string(), picture_s, sound->duration()));
}

void ClipWriter::Parts::close() {
    picture_track->finish();
    if (sound) {
        encode_sound_until(sound->duration() + 1);
        sound_track->finish();
    }
    expect_written(av_write_trailer(container.format.get()), container.file);
    expect_written(container.format->pb->error, container.file);
    expect_written(avio_closep(&container.format->pb), container.file);
    if (kind == Kind::webm) forget_application(output.path(), container.file);
    output.commit();
}

ClipWriter::ClipWriter(const fs::path& file, const ClipSpec& spec, const std::optional<Audio>& sound) {
    expect_usable(file, spec, sound);
    parts_ = std::make_unique<Parts>(file, spec, sound);
}

ClipWriter::~ClipWriter() = default;
ClipWriter::ClipWriter(ClipWriter&&) noexcept = default;

void ClipWriter::write(const Frame& frame) {
    Parts& parts = *parts_;
    if (frame.width != parts.spec.size.width || frame.height != parts.spec.size.height) {
        throw Error(format("{}: frame {} is {} x {}, the clip is {} x {}; all frames must have its size",
                           parts.output.final_path().string(), parts.frames_done, frame.width, frame.height,
                           parts.spec.size.width, parts.spec.size.height));
    }
    AVFrame& picture = *parts.picture;
    if (av_frame_make_writable(&picture) < 0) throw std::bad_alloc();
    convert_to_i420(frame, {.y = picture.data[0],
                            .cb = picture.data[1],
                            .cr = picture.data[2],
                            .y_stride = picture.linesize[0],
                            .cb_stride = picture.linesize[1],
                            .cr_stride = picture.linesize[2]});
    picture.pts = parts.frames_done++;
    parts.picture_track->encode(picture);
    parts.encode_sound_until(parts.spec.fps.seconds(static_cast<size_t>(parts.frames_done)));
}

void ClipWriter::finish() {
    parts_->expect_same_end();
    parts_->close();
}

std::string ffmpeg_version() {
    return av_version_info();
}

}  // namespace chironomia
