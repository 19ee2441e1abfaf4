// Motions on an avatar, one after the other, each with what there is to say about it before it is shown.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "core/shard.h"
#include "skinning/fit/fit_report.h"
#include "skinning/motion/motion_file.h"
#include "study/clip/avatars.h"

namespace chironomia::study {

struct FitJob {
    std::vector<std::filesystem::path> motions;  // files, folders of OpenPose, or folders of any of these
    MotionHints hints{};
    std::filesystem::path avatar = kDefaultAvatar;  // a file, or the name of a bundled avatar
    std::optional<double> fps{};                    // of the fit; otherwise the motion's own
    bool upper_body = false;
    Shard shard{};          // which part of the motions is judged; all parts together are what one run judges
    bool pictures = false;  // strips of the motion over the avatar
    bool quiet = false;
};

// A frame of the avatar with the motion's skeleton over it.
struct OverlayPicture {
    std::size_t frame = 0;  // of the fit
    std::vector<std::byte> png;
};

struct FittedClip {
    std::string name;   // of the file, below the folder that was given
    std::string error;  // why it could not be read or fitted; then the rest is empty
    FitReport report{};
    Judgement judgement{};
    std::vector<OverlayPicture> strip{};
};

struct FittedClips {
    std::vector<FittedClip> clips;
    std::vector<std::string> left_out;  // files that hold a face alone, by name
    double shoulder_pixels = 0;         // the avatar's shoulder width in a frame of 1280 x 720, scene "upper"

    std::size_t count(Verdict verdict) const;
    std::size_t broken() const;
};

// Strips are made for so many clips at most: more make a page too heavy for a browser.
inline constexpr std::size_t kMostStrips = 60;

// A clip that cannot be read or fitted is kept with its message and "do not show". Throws Error if the avatar
// is none, or there is no motion to judge; Interrupted if the user stops it.
FittedClips fit_clips(const FitJob& job);

// What to_json of the report says, and errors in pixels of a frame of 1280 x 720.
Json to_json(const FittedClip& clip, double shoulder_pixels);
Json to_json(const FittedClips& fitted);

}  // namespace chironomia::study
