#include "study/clip/notice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/sound.h"
#include "raster/images/text_line.h"
#include "study/clip/loudness.h"
#include "synth/speech/speak.h"

namespace chironomia::study {
namespace {

constexpr double kLargestLetters = 1.0 / 14, kSmallestLetters = 1.0 / 36;  // of the height of the picture
constexpr double kWidest = 0.86, kHighest = 0.7;                           // a plate, of the picture
constexpr double kPadding = 0.9, kCorner = 0.5;                            // of the height of the letters
constexpr double kPlateGrey = 250, kPlateOpacity = 0.97, kInkGrey = 20;

struct Lines {
    std::vector<std::string> texts;
    int letters = 0;  // height [px]
    int width = 0;    // of the longest [px]
};

// As many words in a line as there is room for.
Lines broken(const std::string& text, int letters, int room) {
    Lines lines{.texts = {}, .letters = letters};
    for (const std::string_view paragraph : split(text, '\n')) {
        std::string line;
        for (const std::string_view word : split_words(paragraph)) {
            const std::string longer = line.empty() ? std::string(word) : format("{} {}", line, word);
            if (line.empty() || text_width(longer, letters) <= room) {
                line = longer;
                continue;
            }
            lines.texts.push_back(std::exchange(line, std::string(word)));
        }
        lines.texts.push_back(line);
    }
    for (const std::string& line : lines.texts)
        if (!line.empty()) lines.width = std::max(lines.width, text_width(line, letters));
    return lines;
}

int line_height(const Lines& lines) {
    return lines.letters * 3 / 2;
}

RenderSize plate_size(const Lines& lines) {
    const int padding = 2 * static_cast<int>(std::lround(kPadding * lines.letters));
    return {.width = lines.width + padding,
            .height = line_height(lines) * static_cast<int>(lines.texts.size()) + padding};
}

// In the largest letters that leave something of the picture.
Lines fitting_lines(const std::string& text, const RenderSize& size) {
    const auto share = [&](double part) { return static_cast<int>(std::lround(part * size.height)); };
    const int widest = static_cast<int>(kWidest * size.width);
    const int smallest = std::max(8, share(kSmallestLetters));
    for (int letters = std::max(smallest, share(kLargestLetters)); letters >= smallest; letters -= 1) {
        const int room = widest - 2 * static_cast<int>(std::lround(kPadding * letters));
        const Lines lines = broken(text, letters, room);
        const RenderSize plate = plate_size(lines);
        if (plate.width <= widest && plate.height <= share(kHighest)) return lines;
    }
    throw Error(format(
        "notice \"{}\": does not fit into a picture of {} x {} in letters of {} pixels; write less, or "
        "make the picture larger",
        text, size.width, size.height, smallest));
}

// How much of a pixel lies in the plate with its round corners.
double inside(const RenderSize& size, double corner, int x, int y) {
    const double dx = std::max({corner - (x + 0.5), x + 0.5 - (size.width - corner), 0.0});
    const double dy = std::max({corner - (y + 0.5), y + 0.5 - (size.height - corner), 0.0});
    return std::clamp(corner + 0.5 - std::hypot(dx, dy), 0.0, 1.0);
}

std::uint8_t mix(double a, double b, double share) {
    return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}

void write_line(Frame& plate, const Frame& line, int left, int top) {
    for (int y = 0; y < line.height; ++y) {
        for (int x = 0; x < line.width && left + x < plate.width; ++x) {
            const double ink = line.rgba[static_cast<std::size_t>(y * line.width + x) * 4 + 3] / 255.0;
            std::uint8_t* pixel =
                &plate.rgba[static_cast<std::size_t>((top + y) * plate.width + left + x) * 4];
            for (int i = 0; i < 3; ++i) pixel[i] = mix(pixel[i], kInkGrey, ink);
            pixel[3] = mix(pixel[3], 255, ink);
        }
    }
}

Frame draw_plate(const Lines& lines) {
    const RenderSize size = plate_size(lines);
    Frame plate{.width = size.width, .height = size.height, .rgba = {}};
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            plate.rgba.insert(plate.rgba.end(), 3, static_cast<std::uint8_t>(kPlateGrey));
            plate.rgba.push_back(mix(0, 255, kPlateOpacity * inside(size, kCorner * lines.letters, x, y)));
        }
    }
    int top = static_cast<int>(std::lround(kPadding * lines.letters));
    for (const std::string& text : lines.texts) {
        if (!text.empty()) {
            const Frame line = draw_text_line(text, lines.letters);
            write_line(plate, line, (plate.width - line.width) / 2, top);
        }
        top += line_height(lines);
    }
    return plate;
}

// Where a sound is made quieter, in samples: `gain` from `first` to `last`, with fades to 1 before and after.
struct Dip {
    double first = 0;
    double last = 0;
    double fade = 0;
    double gain = 1;
};

double gain_at(double sample, const Dip& dip) {
    const double away = std::max({dip.first - sample, sample - dip.last, 0.0}) / dip.fade;
    if (away >= 1) return 1;
    return dip.gain + (1 - dip.gain) * (0.5 - 0.5 * std::cos(std::numbers::pi * away));
}

Audio voice_within(const SpokenNotice& spoken, double seconds) {
    Audio voice = speak(spoken.text, spoken.language);
    if (spoken.at + voice.duration() <= seconds) return voice;
    throw Error(format(
        "spoken notice \"{}\": lasts {:.3f} s from {:.3f} s on, but the clip lasts {:.3f} s; begin "
        "earlier or say less (of a plan: \"instruction\" of \"checks\", or its \"kinds\" as [\"text\"])",
        spoken.text, voice.duration(), spoken.at, seconds));
}

}  // namespace

void require_notice_fits(const SpokenNotice& spoken, double seconds) {
    voice_within(spoken, seconds);
}

void require_notice_fits(const std::string& text, const RenderSize& size) {
    fitting_lines(text, size);
}

NoticePlate::NoticePlate(const Notice& notice, const RenderSize& size, const Rate& fps, std::size_t frames) {
    if (split_words(notice.text).empty()) throw Error("notice: has no text; write what is to be read");
    const double end = notice.to.value_or(fps.seconds(frames));
    first_ = static_cast<std::size_t>(std::llround(notice.from * fps.per_second()));
    last_ = static_cast<std::size_t>(std::llround(end * fps.per_second()));
    const double seconds = fps.seconds(frames);
    if (notice.from < seconds && end <= seconds && first_ >= last_) {
        throw Error(format(
            "notice \"{}\": is to be seen from {:.3f} s to {:.3f} s, and no frame of the clip lies there, "
            "which lasts {:.3f} s at {} frames per second; choose a longer time",
            notice.text, notice.from, end, fps.seconds(frames), to_text(fps)));
    }
    if (last_ > frames || first_ >= last_) {
        throw Error(
            format("notice \"{}\": is to be seen from {:.3f} s to {:.3f} s of a clip that lasts {:.3f} s; "
                   "choose times within it",
                   notice.text, notice.from, end, fps.seconds(frames)));
    }
    plate_ = draw_plate(fitting_lines(notice.text, size));
}

void NoticePlate::draw_on(Frame& frame, std::size_t index) const {
    if (index < first_ || index >= last_) return;
    const int left = (frame.width - plate_.width) / 2, top = (frame.height - plate_.height) / 2;
    for (int y = 0; y < plate_.height; ++y) {
        for (int x = 0; x < plate_.width; ++x) {
            const std::uint8_t* ink = &plate_.rgba[static_cast<std::size_t>(y * plate_.width + x) * 4];
            std::uint8_t* pixel =
                &frame.rgba[static_cast<std::size_t>((top + y) * frame.width + left + x) * 4];
            for (int i = 0; i < 3; ++i) pixel[i] = mix(pixel[i], ink[i], ink[3] / 255.0);
        }
    }
}

Audio speak_over(const Audio& sound, const SpokenNotice& spoken) {
    constexpr double kQuieter = 0.1;  // 20 dB
    constexpr double kFade = 0.3;     // [s]
    const Audio voice = resample(voice_within(spoken, sound.duration()), sound.rate);
    const double loudness = measure_loudness(sound).integrated.value_or(kBroadcastLoudness);
    const Audio instruction = normalize_loudness(voice, loudness).sound;
    Audio result = sound;
    const auto channels = static_cast<std::size_t>(sound.channels);
    const auto first = static_cast<std::size_t>(std::llround(spoken.at * sound.rate));
    const std::size_t last = std::min(sound.length(), first + instruction.length());
    const Dip dip{.first = static_cast<double>(first),
                  .last = static_cast<double>(last),
                  .fade = kFade * sound.rate,
                  .gain = kQuieter};
    for (std::size_t i = 0; i < sound.length(); ++i) {
        const auto gain = static_cast<float>(gain_at(static_cast<double>(i), dip));
        const float said = i >= first && i < last ? instruction.samples[i - first] : 0;
        for (std::size_t c = 0; c < channels; ++c) {
            float& sample = result.samples[i * channels + c];
            sample = sample * gain + said;
        }
    }
    return result;
}

}  // namespace chironomia::study
