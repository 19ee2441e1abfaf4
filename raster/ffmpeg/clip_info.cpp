#include "raster/ffmpeg/clip_info.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
#include <libavutil/dict.h>
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"
#include "raster/ffmpeg/demuxer.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

struct Packet {
    std::int64_t time = 0;  // [ticks of the stream]
    std::int64_t duration = 0;
    std::string hash{};  // of its content; of sound alone
};

std::string text_of(const char* text) {
    return text ? text : "unknown";
}

// Whether the box "moov" comes before the box "mdat". Boxes are a big-endian size, a name, and content.
bool has_index_first(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const auto number = [&](int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<std::uint64_t>(stream.get() & 255);
        return value;
    };
    const std::uint64_t end = fs::file_size(file);
    for (std::uint64_t place = 0; place + 8 <= end;) {
        stream.seekg(static_cast<std::streamoff>(place));
        std::uint64_t size = number(4);
        std::string name(4, ' ');
        stream.read(name.data(), 4);
        if (size == 1) size = number(8);
        if (name == "moov") return true;
        if (name == "mdat" || size < 8 || size > end) return false;
        place += size;
    }
    return false;
}

void add_tags(const AVDictionary* dictionary, const std::string& place, std::vector<ClipTag>& tags) {
    const AVDictionaryEntry* entry = nullptr;
    while ((entry = av_dict_get(dictionary, "", entry, AV_DICT_IGNORE_SUFFIX))) {
        tags.push_back({place, entry->key, entry->value});
    }
}

std::vector<ClipTag> all_tags(const AVFormatContext& container) {
    std::vector<ClipTag> tags;
    add_tags(container.metadata, "file", tags);
    for (unsigned i = 0; i < container.nb_streams; ++i) {
        add_tags(container.streams[i]->metadata, format("stream {}", i), tags);
    }
    for (unsigned i = 0; i < container.nb_chapters; ++i) {
        add_tags(container.chapters[i]->metadata, format("chapter {}", i), tags);
    }
    return tags;
}

std::vector<std::string> tracks_of(const AVFormatContext& container) {
    std::vector<std::string> tracks;
    for (unsigned i = 0; i < container.nb_streams; ++i)
        tracks.push_back(text_of(av_get_media_type_string(container.streams[i]->codecpar->codec_type)));
    std::sort(tracks.begin(), tracks.end());
    return tracks;
}

std::string_view bytes_of(const std::uint8_t* data, int size) {
    return {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)};
}

// The packets of every stream, in order of presentation.
std::vector<std::vector<Packet>> read_packets(AVFormatContext& container, const fs::path& file) {
    std::vector<std::vector<Packet>> packets(container.nb_streams);
    const Owned<AVPacket> packet = make_av_packet();
    int code = 0;
    while ((code = av_read_frame(&container, packet.get())) >= 0) {
        const auto index = static_cast<size_t>(packet->stream_index);
        if (index < packets.size()) {
            const std::int64_t time = packet->pts != AV_NOPTS_VALUE ? packet->pts : packet->dts;
            packets[index].push_back({time, packet->duration});
            if (container.streams[index]->codecpar->codec_type == AVMEDIA_TYPE_AUDIO)
                packets[index].back().hash = sha256(bytes_of(packet->data, packet->size));
        }
        av_packet_unref(packet.get());
    }
    if (code == AVERROR_EOF && container.pb->error < 0) code = container.pb->error;
    if (code != AVERROR_EOF) {
        throw Error(
            format("{}: damaged or cut off ({}); write it again", file.string(), ffmpeg_message(code)));
    }
    for (std::vector<Packet>& stream : packets) {
        std::sort(stream.begin(), stream.end(),
                  [](const Packet& a, const Packet& b) { return a.time < b.time; });
    }
    return packets;
}

double start_of(const AVStream& stream, const std::vector<Packet>& packets) {
    if (packets.empty()) return 0;
    return std::max(0.0, static_cast<double>(packets.front().time) * av_q2d(stream.time_base));
}

// As the container says, or from the first frame that is heard or seen to the end of the last.
double duration_of(const AVStream& stream, const std::vector<Packet>& packets) {
    const double tick = av_q2d(stream.time_base);
    if (stream.duration != AV_NOPTS_VALUE) return static_cast<double>(stream.duration) * tick;
    if (packets.empty()) return 0;
    const Packet& last = packets.back();
    return static_cast<double>(last.time + last.duration) * tick - start_of(stream, packets);
}

// Frames stand where the rate puts them, as exactly as the container's clock can say.
bool is_constant(const AVStream& stream, const Rate& fps, const std::vector<Packet>& packets) {
    const double tick = av_q2d(stream.time_base);
    for (size_t i = 0; i < packets.size(); ++i) {
        const double time = static_cast<double>(packets[i].time - packets[0].time) * tick;
        if (std::abs(time - fps.seconds(i)) > 0.51 * tick + 1e-9) return false;
    }
    return true;
}

// (frames)
std::vector<double> times_of(const AVStream& stream, const std::vector<Packet>& packets) {
    std::vector<double> times;
    for (const Packet& packet : packets)
        times.push_back((static_cast<double>(packet.time) - static_cast<double>(packets[0].time)) *
                        av_q2d(stream.time_base));
    return times;
}

std::string pixel_shape_of(AVFormatContext& container, AVStream& stream) {
    const AVRational shape = av_guess_sample_aspect_ratio(&container, &stream, nullptr);
    return shape.num > 0 && shape.den > 0 ? format("{}:{}", shape.num, shape.den) : "1:1";
}

// How players are asked to show the pictures.
void describe_display(const AVStream& stream, PictureInfo& picture) {
    const std::int32_t* matrix = display_matrix(stream);
    if (matrix == nullptr) return;
    const auto at = [matrix](int i) { return static_cast<double>(matrix[i]); };
    picture.is_mirrored = at(0) * at(4) - at(1) * at(3) < 0;
    const double turn = -av_display_rotation_get(matrix);
    if (std::isfinite(turn)) picture.turn_deg = std::fmod(std::round(10 * turn) / 10 + 360, 360);
}

PictureInfo describe_picture(AVFormatContext& container, AVStream& stream,
                             const std::vector<Packet>& packets) {
    const AVCodecParameters& codec = *stream.codecpar;
    const char* profile = avcodec_profile_name(codec.codec_id, codec.profile);
    PictureInfo picture{
        .codec = avcodec_get_name(codec.codec_id),
        .profile = profile ? profile : "",
        .pixel_format = text_of(av_get_pix_fmt_name(static_cast<AVPixelFormat>(codec.format))),
        .colours = text_of(av_color_space_name(codec.color_space)),
        .transfer = text_of(av_color_transfer_name(codec.color_trc)),
        .primaries = text_of(av_color_primaries_name(codec.color_primaries)),
        .setup = sha256(bytes_of(codec.extradata, codec.extradata_size)),
        .width = codec.width,
        .height = codec.height,
        .pixel_shape = pixel_shape_of(container, stream),
        .fps = {std::max(1, stream.avg_frame_rate.num), std::max(1, stream.avg_frame_rate.den)},
        .frames = packets.size(),
        .times_s = times_of(stream, packets),
        .start_s = start_of(stream, packets),
        .duration_s = duration_of(stream, packets)};
    picture.constant_rate = is_constant(stream, picture.fps, packets);
    describe_display(stream, picture);
    return picture;
}

SoundInfo describe_sound(const AVStream& stream, const std::vector<Packet>& packets) {
    std::string heard;
    for (const Packet& packet : packets) heard += format("{} {}\n", packet.time, packet.hash);
    return {.codec = avcodec_get_name(stream.codecpar->codec_id),
            .hash = sha256(heard),
            .rate = stream.codecpar->sample_rate,
            .channels = stream.codecpar->ch_layout.nb_channels,
            .start_s = start_of(stream, packets),
            .duration_s = duration_of(stream, packets)};
}

// As the container counts them: of sound without compression each sample is a frame, and a packet has many.
std::int64_t count_frames(const AVStream& stream, const std::vector<Packet>& packets) {
    if (av_get_exact_bits_per_sample(stream.codecpar->codec_id) == 0)
        return static_cast<std::int64_t>(packets.size());
    std::int64_t ticks = 0;
    for (const Packet& packet : packets) ticks += packet.duration;
    return av_rescale_q(ticks, stream.time_base, {1, stream.codecpar->sample_rate});
}

void expect_whole(const AVStream& stream, const std::vector<Packet>& packets, const fs::path& file) {
    const std::int64_t found = count_frames(stream, packets);
    if (stream.nb_frames <= found) return;
    throw Error(format("{}: cut off: stream {} should have {} frames and has {}; write it again",
                       file.string(), stream.index, stream.nb_frames, found));
}

// WebM says at its beginning how long it is.
void expect_promised_length(const AVFormatContext& container, double found_s, const fs::path& file) {
    constexpr double kTolerance = 0.1;  // [s]
    if (!std::string_view(container.iformat->name).starts_with("matroska")) return;
    if (container.duration == AV_NOPTS_VALUE) return;
    const double promised_s = static_cast<double>(container.duration) / AV_TIME_BASE;
    if (found_s + kTolerance >= promised_s) return;
    throw Error(format("{}: cut off: it should last {:.3f} s and ends after {:.3f} s; write it again",
                       file.string(), promised_s, found_s));
}

}  // namespace

ClipInfo read_clip_info(const fs::path& file) {
    const Owned<AVFormatContext> container = open_media(file, "a clip");
    ClipInfo info{.container = container->iformat->name,
                  .bytes = static_cast<size_t>(fs::file_size(file)),
                  .picture = {},
                  .sound = {},
                  .tags = all_tags(*container),
                  .tracks = tracks_of(*container)};
    info.index_first = std::string_view(info.container).starts_with("mov") && has_index_first(file);
    AVStream* picture = find_stream(*container, AVMEDIA_TYPE_VIDEO);
    const AVStream* sound = find_stream(*container, AVMEDIA_TYPE_AUDIO);
    if (!picture && !sound) {
        throw Error(
            format("{}: holds neither pictures nor sound, or is cut off; give a whole clip", file.string()));
    }
    const std::vector<std::vector<Packet>> packets = read_packets(*container, file);
    for (const AVStream* stream : {static_cast<const AVStream*>(picture), sound}) {
        if (stream) expect_whole(*stream, packets[static_cast<size_t>(stream->index)], file);
    }
    if (picture)
        info.picture = describe_picture(*container, *picture, packets[static_cast<size_t>(picture->index)]);
    if (sound) info.sound = describe_sound(*sound, packets[static_cast<size_t>(sound->index)]);
    if (info.picture) info.duration_s = info.picture->start_s + info.picture->duration_s;
    if (info.sound) info.duration_s = std::max(info.duration_s, info.sound->start_s + info.sound->duration_s);
    expect_promised_length(*container, info.duration_s, file);
    return info;
}

}  // namespace chironomia
