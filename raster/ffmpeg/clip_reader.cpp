#include "raster/ffmpeg/clip_reader.h"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/frame.h>
}

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/picture_decoder.h"

namespace chironomia {

struct ClipReader::Parts {
    explicit Parts(const std::filesystem::path& clip) : decoder(clip) {}

    Frame to_frame();

    PictureDecoder decoder;
    Owned<SwsContext> scaler;
    int width = 0;
    int height = 0;
    int pixel_format = -1;
};

Frame ClipReader::Parts::to_frame() {
    const AVFrame& picture = decoder.picture();
    if (!scaler) {
        width = picture.width;
        height = picture.height;
        pixel_format = picture.format;
        scaler = make_scaler(picture);
        if (!scaler) decoder.fail("unknown pixel format");
    }
    if (picture.width != width || picture.height != height || picture.format != pixel_format) {
        throw Error(format("{}: frame {} is {} x {}, those before are {} x {}; make them equal",
                           decoder.file().string(), decoder.number(), picture.width, picture.height, width,
                           height));
    }
    return scaled(picture, *scaler, width, height);
}

ClipReader::ClipReader(const std::filesystem::path& file) : parts_(std::make_unique<Parts>(file)) {}
ClipReader::~ClipReader() = default;
ClipReader::ClipReader(ClipReader&&) noexcept = default;

std::optional<Frame> ClipReader::next() {
    PictureDecoder& decoder = parts_->decoder;
    if (decoder.next()) return parts_->to_frame();
    if (decoder.number() < decoder.stream().nb_frames)
        decoder.fail(format("it should have {} frames", decoder.stream().nb_frames));
    return std::nullopt;
}

}  // namespace chironomia
