// From the renderer's pixels to what video encoders take: BT.709 luma and chroma, limited range, 4:2:0.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/render/frame.h"

namespace chironomia {

// Where the three planes lie; rows may be padded.
struct I420Planes {
    std::uint8_t* y = nullptr;   // (H, W) in [16, 235]
    std::uint8_t* cb = nullptr;  // (H / 2, W / 2) in [16, 240], 128 is grey
    std::uint8_t* cr = nullptr;  // (H / 2, W / 2)
    std::ptrdiff_t y_stride = 0;
    std::ptrdiff_t cb_stride = 0;
    std::ptrdiff_t cr_stride = 0;
};

// Fills the planes with the picture; alpha is ignored. Both sides of `frame` must be even.
// Y' = 16 + 219 (0.2126 R' + 0.7152 G' + 0.0722 B'), Cb = 128 + 224 (B' - Y') / 1.8556,
// Cr = 128 + 224 (R' - Y') / 1.5748, with R', G', B' and the Y' of the differences in [0, 1]
// (ITU-R BT.709-6, items 3.2 to 3.4); one chroma sample is the mean of 2 x 2 pixels, at their centre.
// Integer arithmetic, within 1 of the exact value.
void convert_to_i420(const Frame& frame, const I420Planes& planes);

}  // namespace chironomia
