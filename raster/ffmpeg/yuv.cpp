#include "raster/ffmpeg/yuv.h"

#include <bit>
#include <cassert>
#include <cstring>
#include <vector>

namespace chironomia {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels are taken as R in the lowest byte");

// Several versions in one binary; the machine picks the widest at load time. Sanitizers cannot instrument the
// pick, and need no speed.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define CHIRONOMIA_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define CHIRONOMIA_VECTORISED
#endif

constexpr double kRed = 0.2126;
constexpr double kGreen = 0.7152;
constexpr double kBlue = 0.0722;

constexpr int kLumaBits = 16;
constexpr int kChromaBits = 18;  // two more: the sum of four pixels

constexpr int luma_weight(double share) {
    return static_cast<int>(share * 219 / 255 * (1 << kLumaBits) + 0.5);
}

constexpr int chroma_weight(double share) {
    const double exact = share * 224 / 255 * (1 << (kChromaBits - 2));
    return static_cast<int>(exact < 0 ? exact - 0.5 : exact + 0.5);
}

constexpr int kYRed = luma_weight(kRed), kYGreen = luma_weight(kGreen), kYBlue = luma_weight(kBlue);
constexpr int kCbRed = chroma_weight(-kRed / 1.8556), kCbGreen = chroma_weight(-kGreen / 1.8556);
constexpr int kCbBlue = -kCbRed - kCbGreen;  // grey is exactly 128
constexpr int kCrGreen = chroma_weight(-kGreen / 1.5748), kCrBlue = chroma_weight(-kBlue / 1.5748);
constexpr int kCrRed = -kCrGreen - kCrBlue;

constexpr int kYOffset = (16 << kLumaBits) + (1 << (kLumaBits - 1));
constexpr int kChromaOffset = (128 << kChromaBits) + (1 << (kChromaBits - 1));

CHIRONOMIA_VECTORISED
void convert_luma(const std::uint32_t* __restrict pixels, int count, std::uint8_t* __restrict y) {
    for (int i = 0; i < count; ++i) {
        const int red = static_cast<int>(pixels[i] & 255);
        const int green = static_cast<int>(pixels[i] >> 8 & 255);
        const int blue = static_cast<int>(pixels[i] >> 16 & 255);
        y[i] = static_cast<std::uint8_t>((kYOffset + kYRed * red + kYGreen * green + kYBlue * blue) >>
                                         kLumaBits);
    }
}

// The sums of vertical pairs in two rows: red in the low, blue in the high half of one array, green in the other.
CHIRONOMIA_VECTORISED
void add_rows(const std::uint32_t* __restrict upper, int count, std::uint32_t* __restrict red_blue,
              std::uint32_t* __restrict green) {
    const std::uint32_t* lower = upper + count;
    for (int i = 0; i < count; ++i) {
        red_blue[i] = (upper[i] & 0xff00ff) + (lower[i] & 0xff00ff);
        green[i] = (upper[i] >> 8 & 255) + (lower[i] >> 8 & 255);
    }
}

// `red_blue` (2 * count), and behind it as many greens.
CHIRONOMIA_VECTORISED
void convert_chroma(const std::uint32_t* __restrict red_blue, int count, std::uint8_t* __restrict cb,
                    std::uint8_t* __restrict cr) {
    const std::uint32_t* greens = red_blue + 2 * count;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t pair = red_blue[2 * i] + red_blue[2 * i + 1];
        const int red = static_cast<int>(pair & 0xffff);
        const int blue = static_cast<int>(pair >> 16);
        const int green = static_cast<int>(greens[2 * i] + greens[2 * i + 1]);
        cb[i] = static_cast<std::uint8_t>(
            (kChromaOffset + kCbRed * red + kCbGreen * green + kCbBlue * blue) >> kChromaBits);
        cr[i] = static_cast<std::uint8_t>(
            (kChromaOffset + kCrRed * red + kCrGreen * green + kCrBlue * blue) >> kChromaBits);
    }
}

}  // namespace

void convert_to_i420(const Frame& frame, const I420Planes& planes) {
    assert(frame.width % 2 == 0 && frame.height % 2 == 0);
    const size_t width = static_cast<size_t>(frame.width);
    std::vector<std::uint32_t> rows(2 * width), sums(2 * width);
    for (int row = 0; row < frame.height; row += 2) {
        std::memcpy(rows.data(), &frame.rgba[static_cast<size_t>(row) * width * 4], 2 * width * 4);
        convert_luma(rows.data(), frame.width, planes.y + row * planes.y_stride);
        convert_luma(rows.data() + width, frame.width, planes.y + (row + 1) * planes.y_stride);
        add_rows(rows.data(), frame.width, sums.data(), sums.data() + width);
        convert_chroma(sums.data(), frame.width / 2, planes.cb + row / 2 * planes.cb_stride,
                       planes.cr + row / 2 * planes.cr_stride);
    }
}

}  // namespace chironomia
