// The videos of a study: the list of them, how each is recorded, and the results.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json_value.h"
#include "study/build/composition.h"
#include "study/clip/clip.h"
#include "study/design/design.h"
#include "study/plan/plan.h"

namespace chironomia::study {

// One video that some page shows.
struct VideoWish {
    std::size_t clip = 0;
    std::vector<std::size_t> conditions;  // 1, or 2 that share the picture: left and right
    std::optional<CheckNotice> notice{};  // an instruction in it

    auto operator<=>(const VideoWish&) const = default;
};

struct Video {
    VideoWish shows;
    std::size_t motion = 0;  // the clip whose motion it shows
    std::size_t speech = 0;  // the clip whose sound it has
    ClipJob job;             // but for `out` and `threads`
    std::string recipe;      // SHA-256 of all that decides its bytes
    std::string token;       // its public name
};

struct RecordedVideo {
    std::filesystem::path file;
    ClipResult result;
    std::string sha256;
};

// How each wish is recorded. All videos of a clip last as long as the longest of its motions. In a study with
// mismatched conditions no clip lasts longer than the clip with which it is mismatched. Throws Error if a motion cannot
// be read, if some conditions of a clip show a face of their motion and others have none to show, or if a clip
// has no other that it could be mismatched with.
std::vector<Video> list_videos(const Plan& plan, const std::vector<VideoWish>& wishes, std::uint64_t seed,
                               const ClipMaker& maker);

// Those that are recorded, since two of one recipe are the same video: the first of each.
std::vector<Video> distinct_videos(const std::vector<Video>& videos);

// Which of distinct videos are not in a folder of recordings, whole and unchanged; as indices. The folder may be
// missing.
std::vector<std::size_t> list_missing(const std::vector<Video>& distinct,
                                      const std::filesystem::path& folder);

struct RecordingOptions {
    // holds the videos by their recipes; what is whole in it is not recorded again
    std::filesystem::path folder;
    std::filesystem::path performed{};    // the folder of performed files, which notes leave out; empty: none
    std::filesystem::path plan_folder{};  // that notes leave out, too
    int jobs = 1;
    bool quiet = false;
};

struct Recordings {
    std::vector<RecordedVideo> videos;  // one for each of the given ones
    std::size_t recorded = 0;           // how many had to be recorded now
};

// Each video appears in the folder by a rename, and then its note, so that other processes may record into it at the
// same time. Throws Error if a video cannot be recorded, Interrupted if the user stops it; what is finished by then
// stays.
Recordings record_videos(const std::vector<Video>& videos, const RecordingOptions& options,
                         const ClipMaker& maker);

// The file of a video with that recipe in a folder of recordings, and the note that says it is whole.
std::filesystem::path recording_file(const std::filesystem::path& folder, const Video& video);
std::filesystem::path recording_note(const std::filesystem::path& folder, const Video& video);

// The warnings of one of recordings.json, or of a recording's note. Throws Error if they are no list of texts.
std::vector<std::string> warnings_of_note(const JsonValue& note);

}  // namespace chironomia::study
