#include "raster/ffmpeg/film_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
}

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/demuxer.h"
#include "raster/ffmpeg/picture_decoder.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// Quarter turns clockwise that the file asks players for.
int quarter_turns(const AVStream& stream, const fs::path& file) {
    const std::int32_t* matrix = display_matrix(stream);
    if (matrix == nullptr) return 0;
    const double turn = -av_display_rotation_get(matrix) / 90;
    const double nearest = std::round(turn);
    if (!(std::abs(turn - nearest) < 0.01)) {
        throw Error(
            format("{}: is to be shown turned by {:.1f} degrees, which are no quarter turns; turn it with "
                   "another program",
                   file.string(), 90 * turn));
    }
    return (static_cast<int>(nearest) % 4 + 4) % 4;
}

Frame turned(const Frame& frame) {
    Frame result{.width = frame.height, .height = frame.width, .rgba = {}};
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const auto from = frame.rgba.begin() +
                              (static_cast<std::ptrdiff_t>(frame.height - 1 - x) * frame.width + y) * 4;
            result.rgba.insert(result.rgba.end(), from, from + 4);
        }
    }
    return result;
}

Frame in_the_middle(const Frame& picture, const RenderSize& size) {
    if (picture.width == size.width && picture.height == size.height) return picture;
    Frame frame{.width = size.width, .height = size.height, .rgba = {}};
    for (int pixel = 0; pixel < size.width * size.height; ++pixel)
        frame.rgba.insert(frame.rgba.end(), {0, 0, 0, 255});
    const int left = (size.width - picture.width) / 2, top = (size.height - picture.height) / 2;
    for (int y = 0; y < picture.height; ++y) {
        const auto row = picture.rgba.begin() + static_cast<std::ptrdiff_t>(y) * picture.width * 4;
        std::copy(row, row + picture.width * 4,
                  frame.rgba.begin() + (static_cast<std::ptrdiff_t>(top + y) * size.width + left) * 4);
    }
    return frame;
}

}  // namespace

struct FilmReader::Parts {
    Parts(const fs::path& file, const FilmSpec& wanted);

    void read_ahead();
    RenderSize fitting(const AVFrame& picture) const;
    Frame to_frame(const AVFrame& picture);
    double time_of(const AVFrame& picture) const;

    FilmSpec spec;
    PictureDecoder decoder;
    double seconds = 0;
    double zero = 0;  // of the times of the file, where seconds begin [s]
    int turns = 0;
    std::size_t made = 0;
    Owned<AVFrame> shown = make_av_frame();
    double shown_at = 0;
    std::optional<double> ahead_at;  // of the picture that the decoder holds; nothing after the last
    std::optional<Frame> made_of_shown;
};

FilmReader::Parts::Parts(const fs::path& file, const FilmSpec& wanted) : spec(wanted), decoder(file) {
    const AVStream* sound = find_stream(decoder.container(), AVMEDIA_TYPE_AUDIO);
    zero = start_of(sound != nullptr ? *sound : decoder.stream());
    turns = quarter_turns(decoder.stream(), file);
    const PictureInfo pictures = read_clip_info(file).picture.value();  // and the file is whole
    seconds = start_of(decoder.stream()) + pictures.duration_s - zero;
    read_ahead();
    if (!ahead_at) decoder.fail("it has no pictures");
}

double FilmReader::Parts::time_of(const AVFrame& picture) const {
    if (picture.best_effort_timestamp == AV_NOPTS_VALUE) decoder.fail("a picture without a time");
    return static_cast<double>(picture.best_effort_timestamp) * av_q2d(decoder.stream().time_base) - zero;
}

void FilmReader::Parts::read_ahead() {
    ahead_at.reset();
    if (decoder.next()) ahead_at = time_of(decoder.picture());
}

// As large as the picture fits when it stands upright, before it is turned.
RenderSize FilmReader::Parts::fitting(const AVFrame& picture) const {
    AVRational pixel = av_guess_sample_aspect_ratio(
        &decoder.container(), const_cast<AVStream*>(&decoder.stream()), const_cast<AVFrame*>(&picture));
    if (pixel.num <= 0 || pixel.den <= 0) pixel = {1, 1};
    const double width = picture.width * av_q2d(pixel), height = picture.height;
    const bool lies = turns % 2 == 1;
    const double room_across = lies ? spec.size.height : spec.size.width;
    const double room_down = lies ? spec.size.width : spec.size.height;
    const double scale = std::min(room_across / width, room_down / height);
    return {.width = std::max(1, static_cast<int>(std::lround(scale * width))),
            .height = std::max(1, static_cast<int>(std::lround(scale * height)))};
}

Frame FilmReader::Parts::to_frame(const AVFrame& picture) {
    const RenderSize size = fitting(picture);
    const Owned<SwsContext> scaler = make_scaler(picture, size.width, size.height);
    if (!scaler) decoder.fail("unknown pixel format");
    Frame frame = scaled(picture, *scaler, size.width, size.height);
    for (int i = 0; i < turns; ++i) frame = turned(frame);
    for (std::size_t i = 3; i < frame.rgba.size(); i += 4) frame.rgba[i] = 255;
    return in_the_middle(frame, spec.size);
}

FilmReader::FilmReader(const fs::path& file, const FilmSpec& spec)
    : parts_(std::make_unique<Parts>(file, spec)) {}
FilmReader::~FilmReader() = default;
FilmReader::FilmReader(FilmReader&&) noexcept = default;

Frame FilmReader::next() {
    Parts& parts = *parts_;
    const double wanted = parts.spec.begin + parts.spec.fps.seconds(parts.made++);
    const bool is_first = parts.shown->width == 0;
    for (bool first = is_first; parts.ahead_at; first = false) {
        // Times in a file are rounded to its clock.
        const bool nearer = std::abs(*parts.ahead_at - wanted) < std::abs(parts.shown_at - wanted) - 1e-6;
        if (!first && !nearer) break;
        parts.decoder.move_to(*parts.shown);
        parts.shown_at = *parts.ahead_at;
        parts.made_of_shown.reset();
        parts.read_ahead();
    }
    if (!parts.made_of_shown) parts.made_of_shown = parts.to_frame(*parts.shown);
    return *parts.made_of_shown;
}

double FilmReader::seconds() const {
    return parts_->seconds;
}

}  // namespace chironomia
