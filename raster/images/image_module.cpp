#include "raster/images/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>

#include "core/error.h"
#include "core/render/srgb.h"
#include "core/text.h"
#include "raster/images/text_module.h"

namespace chironomia {
namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr int kLargestSide = 16384;         // [px]
constexpr size_t kLargestImage = 1u << 26;  // [px] 8192 x 8192

const char* format_name(ImageKind kind) {
    return kind == ImageKind::png ? "png" : "openexr";
}

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::min(1.0, std::max(0.0, value))));
}

std::vector<std::uint8_t> without_alpha(const Frame& frame) {
    std::vector<std::uint8_t> rgb(frame.rgba.size() / 4 * 3);
    for (size_t i = 0, j = 0; j < rgb.size(); i += 4, j += 3) {
        rgb[j] = frame.rgba[i];
        rgb[j + 1] = frame.rgba[i + 1];
        rgb[j + 2] = frame.rgba[i + 2];
    }
    return rgb;
}

// Linear and multiplied by alpha, as EXR wants it.
std::vector<float> linear_pixels(const Frame& frame, int channels) {
    std::array<double, 256> linear;
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = linear_from_srgb(static_cast<double>(i) / 255);
    std::vector<float> pixels;
    pixels.reserve(frame.rgba.size() / 4 * static_cast<size_t>(channels));
    for (size_t i = 0; i < frame.rgba.size(); i += 4) {
        const double alpha = frame.rgba[i + 3] / 255.0;
        for (size_t k = 0; k < 3; ++k)
            pixels.push_back(static_cast<float>(linear[frame.rgba[i + k]] * alpha));
        if (channels == 4) pixels.push_back(static_cast<float>(alpha));
    }
    return pixels;
}

ImageSpec make_spec(const Frame& frame, ImageKind kind, int channels) {
    ImageSpec spec(frame.width, frame.height, channels,
                   kind == ImageKind::png ? TypeDesc::UINT8 : TypeDesc::HALF);
    if (kind == ImageKind::png) {
        // The fastest deflate on differences to the pixel at the left.
        spec.attribute("png:compressionLevel", 1);
        spec.attribute("png:filter", 16);
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);
    } else {
        spec.attribute("compression", "zip");
        spec.attribute("oiio:ColorSpace", "Linear");
        spec.attribute("DateTime", "");  // else the clock's
    }
    return spec;
}

// OpenImageIO notes its own attributes as text. A PNG is a signature and chunks: 4 bytes of length, 4 of
// name, content, 4 of check sum.
std::vector<std::byte> without_notes(const std::vector<unsigned char>& png) {
    constexpr std::array<std::string_view, 6> kKept = {"IHDR", "IDAT", "IEND", "sRGB", "gAMA", "cHRM"};
    std::vector<std::byte> kept;
    kept.reserve(png.size());
    const auto keep = [&](size_t begin, size_t end) {
        const auto* bytes = reinterpret_cast<const std::byte*>(png.data());
        kept.insert(kept.end(), bytes + begin, bytes + end);
    };
    keep(0, 8);
    for (size_t chunk = 8; chunk + 12 <= png.size();) {
        size_t length = 0;
        for (size_t i = 0; i < 4; ++i) length = length << 8 | png[chunk + i];
        const std::string_view name(reinterpret_cast<const char*>(&png[chunk + 4]), 4);
        if (std::find(kKept.begin(), kKept.end(), name) != kKept.end()) keep(chunk, chunk + length + 12);
        chunk += length + 12;
    }
    return kept;
}

[[noreturn]] void refuse_encoding(const std::string& name, const std::string& problem) {
    throw Error(format("{}: the image cannot be encoded ({}); report this", name, problem));
}

std::vector<std::byte> encode(const Frame& frame, ImageKind kind, const std::string& name) {
    const int channels = frame.is_opaque() ? 3 : 4;
    const ImageSpec spec = make_spec(frame, kind, channels);
    const std::unique_ptr<ImageOutput> output = ImageOutput::create(format_name(kind));
    if (!output) refuse_encoding(name, OIIO::geterror());
    output->threads(1);
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    if (!output->set_ioproxy(&sink) || !output->open(name, spec)) refuse_encoding(name, output->geterror());
    bool written = false;
    if (kind == ImageKind::exr) {
        written = output->write_image(TypeDesc::FLOAT, linear_pixels(frame, channels).data());
    } else if (channels == 3) {
        written = output->write_image(TypeDesc::UINT8, without_alpha(frame).data());
    } else {
        written = output->write_image(TypeDesc::UINT8, frame.rgba.data());
    }
    if (!written || !output->close()) refuse_encoding(name, output->geterror());
    if (kind == ImageKind::png) return without_notes(bytes);
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    return {begin, begin + bytes.size()};
}

[[noreturn]] void refuse_decoding(const std::string& name) {
    throw Error(format("{}: the image is damaged or cut off; write it again", name));
}

void expect_size(const ImageSpec& spec, const std::string& name) {
    const bool sides =
        spec.width > 0 && spec.height > 0 && spec.width <= kLargestSide && spec.height <= kLargestSide;
    if (!sides || static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) > kLargestImage) {
        throw Error(format("{}: the image is {} x {}, at most {} px are supported; make it smaller", name,
                           spec.width, spec.height, kLargestImage));
    }
    if (spec.nchannels < 1 || spec.nchannels > 4 || spec.depth > 1 || spec.deep) {
        throw Error(
            format("{}: the image has {} channels and depth {}, 1 to 4 flat channels are supported; "
                   "convert it to RGBA",
                   name, spec.nchannels, spec.depth));
    }
}

// OpenEXR makes room for what an attribute claims to hold, up to 2 GB, before it looks for it. A header is attributes,
// each a name and a type that end by 0, a length in 4 bytes and its content, and ends by 0; files of several parts have
// several headers, and end them by 0.
void expect_true_lengths(std::span<const std::byte> exr, const std::string& name) {
    constexpr size_t kFirst = 8;  // after magic number and version
    size_t at = kFirst;
    const auto next = [&] {
        if (at >= exr.size()) refuse_decoding(name);
        return std::to_integer<std::uint32_t>(exr[at++]);
    };
    const auto skip_text = [&] {
        while (next() != 0) {
        }
    };
    const bool has_parts = exr.size() > kFirst && (std::to_integer<int>(exr[5]) & 0x10) != 0;
    do {
        while (next() != 0) {
            skip_text();
            skip_text();
            std::uint32_t length = 0;
            for (int shift = 0; shift < 32; shift += 8) length |= next() << shift;
            if (length > exr.size() - at) refuse_decoding(name);
            at += length;
        }
    } while (has_parts && at < exr.size() && exr[at] != std::byte{0});
}

// Grey is repeated; a missing alpha is 1. Returns (H, W, 4).
template <typename T>
std::vector<T> to_rgba(const std::vector<T>& pixels, int channels, T opaque) {
    if (channels == 4) return pixels;
    const size_t count = pixels.size() / static_cast<size_t>(channels);
    const bool grey = channels <= 2;
    std::vector<T> rgba(count * 4);
    for (size_t i = 0; i < count; ++i) {
        const T* pixel = &pixels[i * static_cast<size_t>(channels)];
        for (size_t k = 0; k < 3; ++k) rgba[4 * i + k] = pixel[grey ? 0 : k];
        rgba[4 * i + 3] = channels == 2 ? pixel[1] : opaque;
    }
    return rgba;
}

template <typename T>
std::vector<T> read_rgba(ImageInput& input, TypeDesc type, T opaque, const std::string& name) {
    const ImageSpec& spec = input.spec();
    std::vector<T> pixels(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                          static_cast<size_t>(spec.nchannels));
    if (!input.read_image(0, 0, 0, spec.nchannels, type, pixels.data())) refuse_decoding(name);
    return to_rgba(pixels, spec.nchannels, opaque);
}

std::vector<std::uint8_t> srgb_pixels(const std::vector<float>& linear, int width, const std::string& name) {
    std::vector<std::uint8_t> rgba(linear.size());
    for (size_t i = 0; i < linear.size(); i += 4) {
        const double alpha = linear[i + 3];
        for (size_t k = 0; k < 4; ++k) {
            if (!std::isfinite(linear[i + k])) {
                const size_t pixel = i / 4;
                throw Error(format("{}: pixel ({}, {}) is {}, no finite number; write it again", name,
                                   pixel % static_cast<size_t>(width), pixel / static_cast<size_t>(width),
                                   linear[i + k]));
            }
            const double colour = alpha > 0 ? linear[i + k] / alpha : 0;
            rgba[i + k] = to_byte(k == 3 ? alpha : srgb_from_linear(colour));
        }
    }
    return rgba;
}

Frame decode(std::span<const std::byte> bytes, ImageKind kind, const std::string& name) {
    OIIO::Filesystem::IOMemReader source(const_cast<std::byte*>(bytes.data()), bytes.size());
    if (kind == ImageKind::exr) expect_true_lengths(bytes, name);
    const std::unique_ptr<ImageInput> input = ImageInput::create(format_name(kind));
    if (!input) refuse_decoding(name);
    input->threads(1);
    ImageSpec spec, wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&source) || !input->open(name, spec, wish)) refuse_decoding(name);
    expect_size(spec, name);
    Frame frame{spec.width, spec.height, {}};
    if (kind == ImageKind::png) {
        frame.rgba = read_rgba<std::uint8_t>(*input, TypeDesc::UINT8, 255, name);
    } else {
        frame.rgba = srgb_pixels(read_rgba<float>(*input, TypeDesc::FLOAT, 1.0f, name), spec.width, name);
    }
    return frame;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) ImageModule chironomia_image_module_2() {
    // Calls come from as many threads as the caller wants; OpenImageIO starts none of its own.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    return {.encode = encode, .decode = decode, .text_width = width_of_text, .draw_text = draw_text};
}

}  // namespace chironomia
