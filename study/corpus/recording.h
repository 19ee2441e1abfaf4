// One person of a recording, in the columns that a corpus has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/corpus/manifest.h"

namespace chironomia::study {

inline constexpr double kLooseEnd = 1;  // [s] by which what was recorded together may differ at its end

// What a tracker wrote of a face or a point, T frames of `width` columns.
struct TrackedValues {
    double fps = 0;
    std::size_t width = 0;
    std::vector<float> values;          // (T, width)
    std::vector<std::uint8_t> success;  // (T) 0: it was not found
    std::vector<float> confidence;      // (T) in [0, 1]
    double first_time = 0;              // as in Motion [s]
    std::vector<std::string> notes;     // of the reader, each a sentence

    std::size_t frames() const { return success.size(); }  // T
    double seconds() const { return static_cast<double>(frames()) / fps; }
};

// Throw Error as read_motion() does, and if there are no units that the corpus has, no head or no gaze.
TrackedValues read_talk_face(const std::filesystem::path& file);  // AU1, 2, 4, 5, 6, 7, pose_Rx, Ry, Rz
TrackedValues read_dyad_face(const std::filesystem::path& file);  // as DyadPerson::face

// How long a face or a pose lasts beside the sound that was recorded with it.
struct RecordedEnds {
    double first_time = 0;  // what the file of the face or the pose calls the time of its first frame [s]
    double seen = 0;        // [s]
    double heard = 0;       // [s]
};

// A face or a pose is taken to begin with its sound.
// Throws Error if it begins late by the times of its own file, and ends with the sound only by these: `file` lacks
// the frames at the beginning, and all of it would come too early.
void refuse_late_beginning(const std::filesystem::path& file, const RecordedEnds& ends);
// Says that they end at different times, of less than a second: a wrong rate does so, too.
std::optional<std::string> note_of_ends(std::string_view what, const RecordedEnds& ends);

// The voice of a talk at IpuRecord::kSpeechRate, S samples.
struct RecordedVoice {
    std::vector<float> f0;        // (S) [Hz]; 0 where it is not voiced
    std::vector<float> strength;  // (S) in [0, 1]
    std::vector<float> quality;   // (S, IpuRecord::kVoice)

    std::size_t samples() const { return f0.size(); }  // S
    double seconds() const { return static_cast<double>(samples()) / IpuRecord::kSpeechRate; }
};

// Throws Error as the readers of sounds and of openSMILE's tables do, and if two tables have other rates than
// 100 Hz or are not equally long.
RecordedVoice read_talk_voice(const RecordedPerson& person);

// (T, DyadPerson::kSpeech) at DyadRecord::kFps for all whole frames.
std::vector<float> read_dyad_voice(const RecordedPerson& person);

// A shot: the frames [first, last) of a face.
struct VideoShot {
    std::size_t first = 0;
    std::size_t last = 0;
};

// The shots of a table of PySceneDetect ("Start Time (seconds)", "End Time (seconds)"), or of one with
// start_frame and end_frame, from 0, the end being the frame behind the last; all of the face without a file.
// Throws Error with the line if a shot ends before it starts, they overlap, or lie behind the face.
std::vector<VideoShot> read_shots(const std::filesystem::path& file, const TrackedValues& face);

// The frames of a shot as they were tracked.
TrackedValues frames_of(const TrackedValues& face, const VideoShot& shot);
// Smoothed by a median of `window` frames and bridged by lines (Fares 2023, section 4.1), or nothing if no frame
// has a face.
std::optional<TrackedValues> smoothed(const TrackedValues& face, std::size_t window = 7);
// `frames` frames at `fps` from `start` [s] on, on the line between the frames before and behind each time,
// the last one going on. One is bridged if either of these is.
struct FrameGrid {
    double start = 0;
    double fps = 25;
    std::size_t frames = 0;
};
TrackedValues resampled(const TrackedValues& face, const FrameGrid& grid);

// Part of the frames that were seen, in [0, 1].
double success_of(const TrackedValues& face);

}  // namespace chironomia::study
