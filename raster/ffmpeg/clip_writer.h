// Writes a clip frame by frame: MP4 (H.264 High, yuv420p, and AAC) or WebM (VP9 and Opus), by the file's
// ending.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/audio.h"
#include "core/render/frame.h"
#include "core/render/rate.h"
#include "core/render/renderer.h"

namespace chironomia {

struct ClipSpec {
    RenderSize size = {};  // both sides even
    Rate fps = {};
    int crf = 18;                     // 0 (lossless) to 51 (worst), on x264's scale; mapped for VP9
    std::string preset = "veryfast";  // of x264; VP9 has no use for it
};

// Same frames, same sound, same spec: same bytes, whatever the number of processors and the speed of the
// caller. Nothing in the file names a tool, a time or a source. Rate and colours (BT.709, limited range) are
// stated, the index comes first, and 48 kHz sound is in exact time with the picture.
// The file appears under its name when finish() returns; without finish() nothing stays.
class ClipWriter {
  public:
    // Throws Error if the ending is unknown, a side is odd or not in [16, 8192], the preset or crf is
    // unknown, the sound is empty or has an unusual channel layout, or the file cannot be written.
    ClipWriter(const std::filesystem::path& file, const ClipSpec& spec, const std::optional<Audio>& sound);
    ~ClipWriter();
    ClipWriter(ClipWriter&&) noexcept;

    // Alpha is ignored. Throws Error if the frame has another size than the clip, or the disk is full.
    void write(const Frame& frame);

    // Throws Error if there was no frame, or if picture and sound end more than one frame apart
    // (match_lengths in clip_length.h avoids it), or the disk is full.
    void finish();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

std::string ffmpeg_version();  // "5.1.9-0+deb12u1"

}  // namespace chironomia
