// What a clip holds, as far as a study or a player could notice: streams, exact lengths, and every tag.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/render/rate.h"

namespace chironomia {

struct ClipTag {
    std::string place;  // "file", "stream 0"
    std::string key;
    std::string value;

    bool operator==(const ClipTag&) const = default;
};

struct PictureInfo {
    std::string codec;         // "h264"
    std::string profile;       // "High"; empty if the codec has none
    std::string pixel_format;  // "yuv420p"
    std::string colours;       // matrix: "bt709"; "unknown" if the file does not say
    std::string transfer;      // as above
    std::string primaries;     // as above
    std::string setup;         // SHA-256 of the decoder's setup data, which depends on the encoder's settings
    int width = 0;             // [px]
    int height = 0;
    std::string pixel_shape = "1:1";  // width to height of a pixel
    double turn_deg = 0;              // by which players turn the pictures, clockwise, 0 to 360
    bool is_mirrored = false;         // by players, besides
    Rate fps;
    bool constant_rate = false;  // every frame lasts equally long
    size_t frames = 0;
    std::vector<double> times_s;  // (frames) when each is shown, counted from the first
    double start_s = 0;
    double duration_s = 0;
};

struct SoundInfo {
    std::string codec;
    std::string hash;  // SHA-256 of all that is heard, and when
    int rate = 0;      // [Hz]
    int channels = 0;
    double start_s = 0;
    double duration_s = 0;
};

struct ClipInfo {
    std::string container;  // "mov,mp4,m4a,3gp,3g2,mj2"
    double duration_s = 0;  // of what lasts longest
    size_t bytes = 0;
    bool index_first = false;  // MP4: a player can start before the whole file is there
    std::optional<PictureInfo> picture;
    std::optional<SoundInfo> sound;
    std::vector<ClipTag> tags;          // all of them, of the file and of every stream
    std::vector<std::string> tracks{};  // what each stream is: "audio", "subtitle", "video", ...; ascending
};

// Throws Error if the file is missing, holds neither pictures nor sound, or is damaged or cut off.
ClipInfo read_clip_info(const std::filesystem::path& file);

}  // namespace chironomia
