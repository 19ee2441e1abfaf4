#include "raster/ffmpeg/demuxer.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
}

#include "core/error.h"
#include "core/input_file.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// Kinds of file that hold pictures and sound in themselves: a playlist could lead to any other file.
constexpr const char* kFormats =
    "wav,w64,aiff,au,caf,flac,ogg,mp3,aac,mov,matroska,avi,mpeg,mpegts,flv,nut,ivf,yuv4mpegpipe,h264,asf,gif";

constexpr int kRecognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE;

void expect_content(const fs::path& file) {
    expect_file(file);
    if (!std::ifstream(file, std::ios::binary)) {
        throw Error(
            format("{}: cannot be opened ({}); check its permissions", file.string(), std::strerror(errno)));
    }
    if (fs::file_size(file) == 0) {
        throw Error(format("{}: the file is empty; write it again", file.string()));
    }
}

// Files write any number for their colours; one without a name stands for no colour that is known.
template <class Colour>
void forget_unnamed(Colour& colour, Colour first_without_name, Colour unspecified) {
    std::uint32_t number = 0;  // not yet a Colour: reading one that has no name is undefined
    static_assert(sizeof(number) == sizeof(colour));
    std::memcpy(&number, &colour, sizeof(number));
    if (number >= static_cast<std::uint32_t>(first_without_name)) colour = unspecified;
}

void forget_unnamed_colours(AVCodecParameters& codec) {
    forget_unnamed(codec.color_range, AVCOL_RANGE_NB, AVCOL_RANGE_UNSPECIFIED);
    forget_unnamed(codec.color_primaries, AVCOL_PRI_NB, AVCOL_PRI_UNSPECIFIED);
    forget_unnamed(codec.color_trc, AVCOL_TRC_NB, AVCOL_TRC_UNSPECIFIED);
    forget_unnamed(codec.color_space, AVCOL_SPC_NB, AVCOL_SPC_UNSPECIFIED);
}

}  // namespace

Owned<AVFormatContext> open_media(const fs::path& file, const char* needed) {
    expect_content(file);
    silence_ffmpeg();
    AVDictionary* options = nullptr;
    av_dict_set(&options, "format_whitelist", kFormats, 0);
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    AVFormatContext* opened = avformat_alloc_context();
    if (!opened) throw std::bad_alloc();
    opened->error_recognition = kRecognition;
    int problem = avformat_open_input(&opened, ffmpeg_url(file).c_str(), nullptr, &options);
    av_dict_free(&options);
    Owned<AVFormatContext> container(problem >= 0 ? opened : nullptr);
    if (problem >= 0) problem = avformat_find_stream_info(container.get(), nullptr);
    if (problem < 0) {
        throw Error(format("{}: is not {} that can be read ({}); convert it with another program",
                           file.string(), needed, ffmpeg_message(problem)));
    }
    for (unsigned i = 0; i < container->nb_streams; ++i)
        forget_unnamed_colours(*container->streams[i]->codecpar);
    return container;
}

Owned<AVCodecContext> open_decoder(const AVStream& stream, const fs::path& file) {
    const char* name = avcodec_get_name(stream.codecpar->codec_id);
    const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
    if (!codec) throw Error(format("{}: no decoder for \"{}\"; convert it to another", file.string(), name));
    Owned<AVCodecContext> decoder(avcodec_alloc_context3(codec));
    if (!decoder) throw std::bad_alloc();
    decoder->err_recognition = kRecognition;
    decoder->pkt_timebase = stream.time_base;
    decoder->thread_count = 1;
    int problem = avcodec_parameters_to_context(decoder.get(), stream.codecpar);
    if (problem >= 0) problem = avcodec_open2(decoder.get(), codec, nullptr);
    if (problem < 0) {
        throw Error(format("{}: its {} stream cannot be decoded ({}); convert it with another program",
                           file.string(), name, ffmpeg_message(problem)));
    }
    return decoder;
}

AVStream* find_stream(AVFormatContext& container, int kind) {
    const int index = av_find_best_stream(&container, static_cast<AVMediaType>(kind), -1, -1, nullptr, 0);
    return index < 0 ? nullptr : container.streams[index];
}

double start_of(const AVStream& stream) {
    return stream.start_time == AV_NOPTS_VALUE
               ? 0
               : static_cast<double>(stream.start_time) * av_q2d(stream.time_base);
}

// FFmpeg 7 keeps it with the codec's parameters, FFmpeg 5 with the stream.
const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVCODEC_VERSION_MAJOR >= 61
    const AVPacketSideData* found = av_packet_side_data_get(
        stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
    const std::uint8_t* matrix = found ? found->data : nullptr;
#else
    const std::uint8_t* matrix = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
#endif
    return reinterpret_cast<const std::int32_t*>(matrix);
}

}  // namespace chironomia
