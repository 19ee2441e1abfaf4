// Whether a viewer sees a difference: colours in CIELAB, after the eye's own blur.
#pragma once

#include <array>
#include <cstddef>

#include "core/render/frame.h"

namespace chironomia {

// CIE 1976 L*a*b* of linear sRGB in [0, 1], before white of D65 (IEC 61966-2-1; CIE 15:2004, 8.2.1).
std::array<double, 3> cielab(const std::array<double, 3>& linear_rgb);

// Counts the pixels that a viewer who just resolves a pixel can distinguish: both frames are blurred in linear
// light by the binomial kernel 1 4 6 4 1 (a deviation of 1 px, the blur of an eye for which a pixel is a
// minute of arc), and a pixel counts where their CIELAB colours are more than 2.3 apart, a just noticeable
// difference (Mahy, Van Eycken, Oosterlinck, "Evaluation of Uniform Color Spaces Developed after the Adoption
// of CIELAB and CIELUV", Color Research and Application 19(2), 1994). The order, eye then colour, is that of
// Zhang and Wandell's S-CIELAB (1997). A frame that is not opaque is looked at over black and over white, and
// the larger number counts. Both frames have the same size. OpenImageIO's compare_Yee is no choice: in
// version 2.4 it passes black against grey.
size_t count_visible_differences(const Frame& a, const Frame& b);

}  // namespace chironomia
