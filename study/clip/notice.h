// An instruction to the participant in a clip: burnt into the picture, or spoken over the voice.
#pragma once

#include <optional>
#include <string>

#include "core/audio.h"
#include "core/render/frame.h"
#include "core/render/rate.h"
#include "core/render/renderer.h"

namespace chironomia::study {

// Written on a plate in the middle of the picture.
struct Notice {
    std::string text;            // UTF-8; "\n" begins a new line, long lines are broken
    double from = 0;             // of the clip [s]
    std::optional<double> to{};  // none: to the end [s]
};

// Spoken by a synthetic voice.
struct SpokenNotice {
    std::string text;
    std::string language = "en";  // as in synth/speech/speak.h
    double at = 0;                // of the clip [s]
};

// Throws Error if the text does not fit into a picture of this size in letters that can be read.
void require_notice_fits(const std::string& text, const RenderSize& size);

// Throws Error if the speech does not end within a clip of so many seconds.
void require_notice_fits(const SpokenNotice& spoken, double seconds);

// The plate with its text, drawn once for all frames of a clip.
class NoticePlate {
  public:
    // Throws Error if the text is empty, does not fit into the picture in letters that can be read, or has
    // letters that cannot be drawn (raster/images/text_line.h); or if its time lies outside a clip of so many
    // frames or is shorter than one.
    NoticePlate(const Notice& notice, const RenderSize& size, const Rate& fps, std::size_t frames);

    // Draws it if the frame lies in its time.
    void draw_on(Frame& frame, std::size_t index) const;

  private:
    Frame plate_;
    std::size_t first_ = 0, last_ = 0;  // the frames that show it
};

// The sound with the instruction, as loud as the sound itself is as a whole (-23 LUFS over silence);
// meanwhile the sound is 20 dB quieter, with a fade of 0.3 s before and after. Throws Error if the
// instruction ends after the sound or cannot be spoken.
Audio speak_over(const Audio& sound, const SpokenNotice& spoken);

}  // namespace chironomia::study
