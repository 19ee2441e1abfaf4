// The properties of a study's videos. For check.cpp alone.
#pragma once

#include <map>
#include <optional>

#include "raster/ffmpeg/clip_info.h"
#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia::study {

// What was seen of a video.
struct SeenVideo {
    std::optional<ClipInfo> info;  // none: it cannot be read
    std::string fault;             // why
};

inline constexpr double kSameLoudness = 1;  // [LU]

// One for each video of the key, in its order.
std::vector<SeenVideo> see_videos(const StudyRecord& study);

Proof check_videos_whole(const StudyRecord& study, const std::vector<SeenVideo>& seen);
Proof check_no_names_in_videos(const StudyRecord& study);
Proof check_no_tags(const StudyRecord& study, const std::vector<SeenVideo>& seen);
Proof check_same_kind(const StudyRecord& study, const std::vector<SeenVideo>& seen);
Proof check_same_length(const StudyRecord& study, const std::vector<SeenVideo>& seen);
Proof check_same_size(const StudyRecord& study);
// The padding that makes videos equal in size is empty, and the files hold nothing else beside pictures and sounds.
Proof check_padding(const StudyRecord& study);
Proof check_same_sound(const StudyRecord& study, const std::vector<SeenVideo>& seen);
// EBU R 128, to within kSameLoudness.
Proof check_same_loudness(const StudyRecord& study);
Proof check_in_sync(const StudyRecord& study, const std::vector<SeenVideo>& seen);

}  // namespace chironomia::study
