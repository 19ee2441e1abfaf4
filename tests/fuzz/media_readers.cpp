// Sounds and clips, through FFmpeg, and pictures.
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/clip_reader.h"
#include "raster/images/image_file.h"
#include "tests/fuzz/fuzz_reader.h"

namespace chironomia::testing {
namespace {

constexpr int kMostFrames = 20;  // of a clip: the first show what all do

void read_clip(const FuzzInput& input) {
    const std::filesystem::path file = input.file();
    read_clip_info(file);
    ClipReader reader(file);
    for (int frame = 0; frame < kMostFrames && reader.next(); ++frame) {
    }
}

const AddFuzzReader kSound({"sound", "x.wav", [](const FuzzInput& input) { read_audio(input.file()); }});
const AddFuzzReader kClip({"clip", "x.mp4", read_clip});
const AddFuzzReader kImage({"image", "x.png", [](const FuzzInput& input) { read_image(input.file()); }});

}  // namespace
}  // namespace chironomia::testing
