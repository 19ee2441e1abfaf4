#include "raster/ffmpeg/yuv.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "tests/raster/media_support.h"

namespace chironomia {
namespace {

using testing::Colour;
using testing::plain_frame;

struct Yuv {
    double y = 0;
    double cb = 0;
    double cr = 0;
};

struct Planes {
    explicit Planes(const Frame& frame)
        : width(frame.width),
          y(static_cast<size_t>(frame.width * frame.height)),
          cb(y.size() / 4),
          cr(y.size() / 4) {
        convert_to_i420(frame, {.y = y.data(),
                                .cb = cb.data(),
                                .cr = cr.data(),
                                .y_stride = width,
                                .cb_stride = width / 2,
                                .cr_stride = width / 2});
    }

    int width;
    std::vector<std::uint8_t> y, cb, cr;
};

// BT.709 in double precision, written from the definition of the differences rather than from weights.
Yuv exact(double red, double green, double blue) {
    const double luma = (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
    return {16 + 219 * luma, 128 + 224 * (blue / 255 - luma) / 1.8556,
            128 + 224 * (red / 255 - luma) / 1.5748};
}

TEST(ConvertToI420, GivesTheCodesOfTheStandardForPureColours) {
    struct Known {
        Colour colour;
        std::array<int, 3> yuv;
    };
    const std::vector<Known> known = {{{0, 0, 0}, {16, 128, 128}},       {{255, 255, 255}, {235, 128, 128}},
                                      {{255, 0, 0}, {63, 102, 240}},     {{0, 255, 0}, {173, 42, 26}},
                                      {{0, 0, 255}, {32, 240, 118}},     {{255, 255, 0}, {219, 16, 138}},
                                      {{128, 128, 128}, {126, 128, 128}}};
    for (const Known& item : known) {
        const Planes planes(plain_frame({2, 2}, item.colour));
        EXPECT_EQ((std::array<int, 3>{planes.y[0], planes.cb[0], planes.cr[0]}), item.yuv)
            << item.colour.red << " " << item.colour.green << " " << item.colour.blue;
    }
}

TEST(ConvertToI420, StaysWithinOneOfTheExactValue) {
    Random random(1);
    Frame frame = plain_frame({66, 34}, {});  // no multiple of any vector's width
    for (std::uint8_t& value : frame.rgba) value = static_cast<std::uint8_t>(random.below(256));
    const Planes planes(frame);
    const auto pixel = [&](int x, int y) {
        return &frame.rgba[static_cast<size_t>(4 * (y * frame.width + x))];
    };
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const std::uint8_t* p = pixel(x, y);
            ASSERT_NEAR(planes.y[static_cast<size_t>(y * frame.width + x)], exact(p[0], p[1], p[2]).y, 1);
        }
    }
    for (int y = 0; y < frame.height / 2; ++y) {
        for (int x = 0; x < frame.width / 2; ++x) {
            double mean[3] = {};
            for (int i = 0; i < 12; ++i) mean[i % 3] += pixel(2 * x + i / 3 % 2, 2 * y + i / 6)[i % 3] / 4.0;
            const size_t place = static_cast<size_t>(y * frame.width / 2 + x);
            ASSERT_NEAR(planes.cb[place], exact(mean[0], mean[1], mean[2]).cb, 1);
            ASSERT_NEAR(planes.cr[place], exact(mean[0], mean[1], mean[2]).cr, 1);
        }
    }
}

TEST(ConvertToI420, GivesGreyNoColour) {
    for (int level = 0; level < 256; ++level) {
        const Planes planes(plain_frame({2, 2}, {level, level, level}));
        EXPECT_EQ(planes.cb[0], 128) << level;
        EXPECT_EQ(planes.cr[0], 128) << level;
    }
}

TEST(ConvertToI420, LeavesThePaddingOfRowsAlone) {
    std::vector<std::uint8_t> y(2 * 8, 7), cb(4, 7), cr(4, 7);
    convert_to_i420(
        plain_frame({4, 2}, {255, 255, 255}),
        {.y = y.data(), .cb = cb.data(), .cr = cr.data(), .y_stride = 8, .cb_stride = 4, .cr_stride = 4});
    EXPECT_EQ(y, (std::vector<std::uint8_t>{235, 235, 235, 235, 7, 7, 7, 7, 235, 235, 235, 235, 7, 7, 7, 7}));
    EXPECT_EQ(cb, (std::vector<std::uint8_t>{128, 128, 7, 7}));
    EXPECT_EQ(cr, (std::vector<std::uint8_t>{128, 128, 7, 7}));
}

}  // namespace
}  // namespace chironomia
