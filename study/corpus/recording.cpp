#include "study/corpus/recording.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/motion/motion_file.h"
#include "skinning/signal/late_beginning.h"
#include "synth/corpus/face_features.h"
#include "synth/features/contour.h"
#include "synth/features/opensmile_csv.h"
#include "synth/features/pitch.h"
#include "synth/features/speech_features.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr std::array kTalkUnits = IpuRecord::kUnitNumbers;
constexpr std::array kDyadUnits = {1, 2, 4, 6, 12};
constexpr double kLeastPitch = 50, kMostPitch = 550;  // [Hz]

void need_units(const FaceTrack& face, std::span<const int> units, const std::string& where) {
    std::vector<std::string> missing;
    for (const int unit : units) {
        const auto is_unit = [unit](const FaceChannel& channel) { return channel.unit == unit; };
        if (std::none_of(face.channels.begin(), face.channels.end(), is_unit))
            missing.push_back(format("AU{:02}_r", unit));
    }
    if (missing.empty()) return;
    throw Error(
        format("{}: it has no {}, which the corpus needs; let the tracker write them", where, join(missing)));
}

// The face of a file, with the head.
Motion read_face(const fs::path& file, std::span<const int> units) {
    Motion motion = read_motion(file);
    if (!motion.face) throw Error(format("{}: it holds no face", file.string()));
    need_units(*motion.face, units, file.string());
    if (motion.face->head.empty())
        throw Error(format("{}: it has no pose_Rx, pose_Ry, pose_Rz, which the corpus needs", file.string()));
    return motion;
}

TrackedValues empty_face(const Motion& motion, std::size_t width) {
    TrackedValues face{.fps = motion.fps, .width = width, .first_time = motion.first_time};
    face.values.resize(motion.frames * width);
    face.confidence = motion.face->confidence;
    face.confidence.resize(motion.frames, 1);
    for (const float sure : face.confidence) face.success.push_back(sure > 0);
    face.notes = motion.notes;
    return face;
}

void put(TrackedValues& face, std::size_t frame, std::size_t column, std::span<const float> values) {
    std::copy(values.begin(), values.end(),
              face.values.begin() + static_cast<std::ptrdiff_t>(frame * face.width + column));
}

// A table of openSMILE at the rate of the records.
FeatureTrack read_table(const fs::path& file, OpenSmileSet set) {
    FeatureTrack track = read_opensmile(file, set);
    if (std::abs(track.rate - IpuRecord::kSpeechRate) > 1e-3 * IpuRecord::kSpeechRate) {
        throw Error(format("{}: it has {} frames/s, talks have {}; set openSMILE's frame step to 0.01 s",
                           file.string(), track.rate, IpuRecord::kSpeechRate));
    }
    return track;
}

RecordedVoice voice_of_tables(const RecordedPerson& person) {
    const FeatureTrack speech = read_table(person.speech, OpenSmileSet::speech);
    FeatureTrack quality = read_table(person.voice, OpenSmileSet::voice);
    constexpr std::size_t kLoose = 10;  // samples: openSMILE's windows end at different times
    const std::size_t samples = std::min(speech.frames(), quality.frames());
    if (std::max(speech.frames(), quality.frames()) - samples > kLoose) {
        throw Error(format("{}: it has {} frames, {} has {}; both must come out of one sound",
                           person.speech.string(), speech.frames(), person.voice.string(), quality.frames()));
    }
    RecordedVoice voice;
    for (std::size_t s = 0; s < samples; ++s) {
        const float f0 = speech.at(s)[0];
        voice.f0.push_back(f0 >= kLeastPitch && f0 <= kMostPitch ? f0 : 0);
        voice.strength.push_back(std::clamp(speech.at(s)[2], 0.0f, 1.0f));
    }
    quality.values.resize(samples * IpuRecord::kVoice);
    voice.quality = std::move(quality.values);
    return voice;
}

// Reads the table of shots row by row.
class ShotTable {
  public:
    ShotTable(const fs::path& file, const TrackedValues& face)
        : text_(without_timecodes(read_text(file))),
          table_(parse_csv_table(text_, file.string())),
          face_(face) {
        const auto seconds = columns({"start time (seconds)", "end time (seconds)"});
        const auto frames = columns({"start_frame", "end_frame"});
        if (!seconds && !frames) {
            throw Error(
                format("{}: there are neither \"Start Time (seconds)\" and \"End Time (seconds)\" nor "
                       "start_frame and end_frame",
                       table_.where));
        }
        scale_ = seconds ? face.fps : 1;
        columns_ = seconds ? *seconds : *frames;
    }

    std::vector<VideoShot> run() const {
        std::vector<VideoShot> shots;
        for (const CsvRow& row : table_.rows) {
            const VideoShot shot{.first = frame_in(row, 0),
                                 .last = std::min(frame_in(row, 1), face_.frames())};
            if (shot.last <= shot.first || (!shots.empty() && shot.first < shots.back().last)) {
                throw Error(format(
                    "{}the shot has the frames {} to {} of {}; shots must follow one another within the face",
                    table_.at(row), shot.first, frame_in(row, 1), face_.frames()));
            }
            shots.push_back(shot);
        }
        return shots;
    }

  private:
    // PySceneDetect puts the times of all cuts before the header.
    static std::string without_timecodes(const std::string& text) {
        return text.starts_with("Timecode List") ? "#" + text : text;
    }

    std::optional<std::array<std::size_t, 2>> columns(const std::array<std::string_view, 2>& names) const {
        const auto first = find_column(table_, {names[0]}), last = find_column(table_, {names[1]});
        if (!first || !last) return std::nullopt;
        return std::array{*first, *last};
    }

    std::size_t frame_in(const CsvRow& row, std::size_t side) const {
        constexpr double kMost = 1e9;
        const double value = number_in(table_, row, columns_[side]) * scale_;
        if (!(value >= 0 && value < kMost)) {
            throw Error(format("{}column \"{}\": {} is no time in a video", table_.at(row),
                               table_.columns[columns_[side]], row.cells[columns_[side]]));
        }
        return static_cast<std::size_t>(std::lround(value));
    }

    std::string text_;
    CsvTable table_;
    const TrackedValues& face_;
    std::array<std::size_t, 2> columns_{};
    double scale_ = 1;  // frames for a unit of the columns
};

}  // namespace

TrackedValues read_talk_face(const fs::path& file) {
    const Motion motion = read_face(file, kTalkUnits);
    TrackedValues face = empty_face(motion, IpuRecord::kUnits + IpuRecord::kAngles);
    const std::vector<float> units = intensities_of(*motion.face, motion.frames, kTalkUnits);
    for (std::size_t t = 0; t < motion.frames; ++t) {
        const Vec3 head = openface_angles(motion.face->head[t]);
        put(face, t, 0, std::span(units).subspan(t * kTalkUnits.size(), kTalkUnits.size()));
        put(face, t, IpuRecord::kUnits, std::array{head.x, head.y, head.z});
    }
    return face;
}

TrackedValues read_dyad_face(const fs::path& file) {
    const Motion motion = read_face(file, kDyadUnits);
    if (motion.face->gaze.empty())
        throw Error(
            format("{}: it has no gaze_angle_x, gaze_angle_y, which the corpus needs", file.string()));
    TrackedValues face = empty_face(motion, DyadPerson::kFace);
    const std::vector<float> units = intensities_of(*motion.face, motion.frames, kDyadUnits);
    for (std::size_t t = 0; t < motion.frames; ++t) {
        const Vec3 head = openface_angles(motion.face->head[t]);
        const Vec2 gaze = openface_gaze(motion.face->gaze[t], motion.face->head[t]);
        put(face, t, 0, std::array{gaze.x, gaze.y, head.x, head.y, head.z});
        put(face, t, 5, std::span(units).subspan(t * kDyadUnits.size(), kDyadUnits.size()));
    }
    return face;
}

void refuse_late_beginning(const fs::path& file, const RecordedEnds& ends) {
    const auto& [first, seen, heard] = ends;
    if (!late_beginning(first) || std::abs(first + seen - heard) >= std::abs(seen - heard)) return;
    throw Error(format(
        "{}: its first frame is at {:.2f} s and its last one at {:.2f} s, where the sound of {:.2f} s ends; taken "
        "from second 0 on all would come {:.2f} s too early. Keep the frames before it (empty, or with "
        "success 0), or cut sound and words there",
        file.string(), first, first + seen, heard, first));
}

std::optional<std::string> note_of_ends(std::string_view what, const RecordedEnds& ends) {
    constexpr double kNoticed = 0.2;  // [s] ours
    if (std::abs(ends.seen - ends.heard) < kNoticed) return std::nullopt;
    return format(
        "{} lasts {:.2f} s and its sound {:.2f} s; what is over at the end is cut off, so they must begin "
        "together and have the right rates",
        what, ends.seen, ends.heard);
}

RecordedVoice read_talk_voice(const RecordedPerson& person) {
    if (person.audio.empty()) return voice_of_tables(person);
    const Audio sound = read_audio(person.audio);
    PitchTrack pitch = find_pitch(sound);
    return {.f0 = std::move(pitch.f0),
            .strength = std::move(pitch.strength),
            .quality = voice_quality(sound).values};
}

std::vector<float> read_dyad_voice(const RecordedPerson& person) {
    const FeatureTrack speech = person.audio.empty() ? read_opensmile(person.speech, OpenSmileSet::speech)
                                                     : speech_features(read_audio(person.audio));
    const double seconds = static_cast<double>(speech.frames()) / speech.rate;
    const auto frames = static_cast<std::size_t>(seconds * DyadRecord::kFps + 1e-6);
    return speech_at(speech, DyadRecord::kFps, frames).values;
}

std::vector<VideoShot> read_shots(const fs::path& file, const TrackedValues& face) {
    if (file.empty()) return {{.first = 0, .last = face.frames()}};
    return ShotTable(file, face).run();
}

TrackedValues frames_of(const TrackedValues& face, const VideoShot& shot) {
    const auto cut = [](const auto& values, std::size_t first, std::size_t last) {
        using Values = std::decay_t<decltype(values)>;
        return Values(values.begin() + static_cast<std::ptrdiff_t>(first),
                      values.begin() + static_cast<std::ptrdiff_t>(last));
    };
    return {.fps = face.fps,
            .width = face.width,
            .values = cut(face.values, shot.first * face.width, shot.last * face.width),
            .success = cut(face.success, shot.first, shot.last),
            .confidence = cut(face.confidence, shot.first, shot.last)};
}

std::optional<TrackedValues> smoothed(const TrackedValues& face, std::size_t window) {
    auto values =
        smooth_and_bridge({.values = face.values, .width = face.width, .success = face.success}, window);
    if (!values) return std::nullopt;
    TrackedValues result = face;
    result.values = std::move(*values);
    return result;
}

TrackedValues resampled(const TrackedValues& face, const FrameGrid& grid) {
    TrackedValues result{.fps = grid.fps, .width = face.width};
    const std::size_t end = face.frames() - 1;
    for (std::size_t t = 0; t < grid.frames; ++t) {
        const double place = (grid.start + static_cast<double>(t) / grid.fps) * face.fps;
        const std::size_t before = std::min(static_cast<std::size_t>(std::max(place, 0.0)), end);
        const std::size_t behind = std::min(before + 1, end);
        const double part = std::clamp(place - static_cast<double>(before), 0.0, 1.0);
        const auto mixed = [&](float a, float b) { return static_cast<float>(a + part * (b - a)); };
        for (std::size_t c = 0; c < face.width; ++c)
            result.values.push_back(
                mixed(face.values[before * face.width + c], face.values[behind * face.width + c]));
        constexpr double kNoPart = 1e-3;  // of a frame
        const bool first = part > 1 - kNoPart || face.success[before] != 0;
        const bool second = part < kNoPart || face.success[behind] != 0;
        result.success.push_back(first && second);
        result.confidence.push_back(mixed(face.confidence[before], face.confidence[behind]));
    }
    return result;
}

double success_of(const TrackedValues& face) {
    const auto seen = std::count(face.success.begin(), face.success.end(), 1);
    return static_cast<double>(seen) / static_cast<double>(face.frames());
}

}  // namespace chironomia::study
