#include "study/clip/cue.h"

#include <algorithm>
#include <cmath>

#include "core/quantile.h"

namespace chironomia::study {
namespace {

// Ours, by eye and ear.
constexpr double kBlock = 0.01;         // [s]
constexpr double kBegins = -25;         // against the loud parts [dB]
constexpr double kEnds = -35;           // the same
constexpr double kSilence = -60;        // of full scale [dB]
constexpr std::size_t kLeastOn = 3;     // [blocks]
constexpr std::size_t kLongPause = 30;  // [blocks]
constexpr double kRise = 0.12;          // [s]
constexpr double kFall = 0.25;          // [s]

// The level of each block, the last one whole or not [dB of full scale].
std::vector<double> levels_of(const Audio& voice) {
    std::vector<double> levels;
    const auto begin_of = [&](std::size_t block) {
        const auto sample = std::llround(static_cast<double>(block) * kBlock * voice.rate);
        return std::min(static_cast<std::size_t>(sample), voice.length());
    };
    for (std::size_t block = 0; begin_of(block) < voice.length(); ++block) {
        const std::size_t begin = begin_of(block), end = begin_of(block + 1);
        double power = 0;
        for (std::size_t i = begin * static_cast<std::size_t>(voice.channels);
             i < end * static_cast<std::size_t>(voice.channels); ++i) {
            power += static_cast<double>(voice.samples[i]) * voice.samples[i];
        }
        power /= static_cast<double>((end - begin) * static_cast<std::size_t>(voice.channels));
        levels.push_back(10 * std::log10(std::max(power, 1e-12)));
    }
    return levels;
}

// Whether somebody speaks, in each block.
std::vector<bool> speech_in(const std::vector<double>& levels) {
    if (levels.empty()) return {};
    const double loud = quantile(levels, 0.95);
    const double begins = std::max(loud + kBegins, kSilence), ends = std::max(loud + kEnds, kSilence);
    std::vector<bool> speaks(levels.size(), false);
    bool on = false;
    std::size_t above = 0, below = 0;  // blocks in a row
    for (std::size_t i = 0; i < levels.size(); ++i) {
        above = levels[i] > begins ? above + 1 : 0;
        below = levels[i] <= ends ? below + 1 : 0;
        if (!on && above == kLeastOn) {
            on = true;
            speaks[i - 1] = speaks[i - 2] = true;
        } else if (on && below == kLongPause) {
            on = false;
        }
        speaks[i] = on;
    }
    return speaks;
}

}  // namespace

std::vector<float> cue_strengths(const Audio& voice, const Rate& fps, std::size_t frames) {
    const std::vector<bool> speaks = speech_in(levels_of(voice));
    std::vector<float> shown;
    double strength = 0;
    std::size_t block = 0;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const auto until = static_cast<std::size_t>(fps.seconds(frame) / kBlock + 1e-6);
        for (; block < until; ++block) {
            const bool on = block < speaks.size() && speaks[block];
            strength = std::clamp(strength + (on ? kBlock / kRise : -kBlock / kFall), 0.0, 1.0);
        }
        shown.push_back(static_cast<float>(strength));
    }
    return shown;
}

void draw_cue(Frame& frame, const Vec2& place, float strength) {
    if (strength <= 0) return;
    // A line with round ends, in shares of the height; amber stands out from clothes and backdrops alike.
    const auto height = static_cast<float>(frame.height);
    const float half_length = 0.075f * height, radius = 0.007f * height, softness = 0.003f * height + 0.5f;
    constexpr float kColour[] = {255, 178, 72};  // sRGB
    const float reach = half_length + radius + softness;
    const auto clamped = [](float value, int most) {
        return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(most)));
    };
    const int bottom = clamped(place.y + radius + softness + 1, frame.height);
    const int right = clamped(place.x + reach + 1, frame.width);
    for (int y = clamped(place.y - radius - softness, frame.height); y < bottom; ++y) {
        for (int x = clamped(place.x - reach, frame.width); x < right; ++x) {
            const Vec2 offset(static_cast<float>(x) + 0.5f - place.x, static_cast<float>(y) + 0.5f - place.y);
            const float beyond = std::max(0.0f, std::abs(offset.x) - half_length);
            const float from_edge = std::sqrt(beyond * beyond + offset.y * offset.y) - radius;
            const float opacity = strength * std::clamp(0.5f - from_edge / (2 * softness), 0.0f, 1.0f);
            std::uint8_t* pixel =
                frame.rgba.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                     static_cast<std::size_t>(x)) *
                                        4;
            for (int i = 0; i < 3; ++i) {
                const float under = pixel[i];
                pixel[i] = static_cast<std::uint8_t>(under + opacity * (kColour[i] - under) + 0.5f);
            }
        }
    }
}

}  // namespace chironomia::study
