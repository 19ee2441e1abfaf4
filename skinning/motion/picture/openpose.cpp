#include "skinning/motion/picture/openpose.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/files/json.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/picture/person_tracker.h"
#include "skinning/motion/points/even_frames.h"
#include "skinning/signal/late_beginning.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kEnding = "_keypoints.json";
constexpr std::size_t kHandPoints = 21;

// macOS writes a "._NAME" for a file on a disk of another system.
bool is_of_a_frame(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.ends_with(kEnding) && !name.starts_with('.');
}

// The files by the number in their names.
std::map<std::size_t, fs::path> numbered_files(const fs::path& folder) {
    std::map<std::size_t, fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!is_of_a_frame(entry.path())) continue;
        const std::string name = entry.path().filename().string();
        const std::string stem = name.substr(0, name.size() - kEnding.size());
        const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
        const auto number = parse_number(stem.substr(digits));
        if (!number || *number > 1e12) {
            throw Error(
                format("{}: its name has no frame number before \"{}\"; OpenPose writes names such as "
                       "clip_000000000012{}",
                       entry.path().string(), kEnding, kEnding));
        }
        const auto [place, added] = files.emplace(static_cast<std::size_t>(*number), entry.path());
        if (added) continue;
        throw Error(format("{}: has the same frame number as {}; keep the files of one clip in a folder",
                           entry.path().string(), place->second.string()));
    }
    return files;
}

// The names of one body's points, "" for those that are dropped.
std::vector<std::string> body_names(std::size_t points, const std::string& where) {
    const std::string_view wanted = points == 25 ? "BODY_25" : "COCO 18";
    for (const KeypointLayout& layout : keypoint_layouts()) {
        if (layout.points.size() != points || layout.name != wanted) continue;
        std::vector<std::string> names;
        for (const LayoutPoint& point : layout.points)
            names.emplace_back(point.ours ? name_of(*point.ours) : "");
        return names;
    }
    throw Error(
        format("{}: pose_keypoints_2d has {} points; 25 (BODY_25) or 18 (COCO) are known, run OpenPose with "
               "--model_pose BODY_25",
               where, points));
}

struct OpenPosePart {
    const char* key;
    std::size_t points;                // 0: as many as the first file has
    std::vector<std::string> names{};  // "" for a point that is dropped
};

// Reads frames one after the other and remembers where the person was.
class FolderReader {
  public:
    FolderReader() {
        parts_ = {{"pose_keypoints_2d", 0},
                  {"face_keypoints_2d", kFacePoints, openpose_face_names()},
                  {"hand_left_keypoints_2d", kHandPoints, openpose_hand_names("left")},
                  {"hand_right_keypoints_2d", kHandPoints, openpose_hand_names("right")}};
    }

    void read(const fs::path& file) {
        const std::string where = file.string();
        const Json json = read_json(file);
        const auto people = json.is_object() ? json.find("people") : json.end();
        if (!json.is_object() || people == json.end() || !people->is_array())
            throw Error(format("{}: has no list \"people\"; a frame of OpenPose is expected", where));
        std::vector<std::vector<PersonPoint>> bodies;
        for (const Json& person : *people) bodies.push_back(read_person(person, where));
        const auto chosen = tracker_.choose(bodies, parts_[0].points);
        frames_.push_back(chosen ? bodies[*chosen] : std::vector<PersonPoint>());
    }

    void skip() { frames_.emplace_back(); }

    PictureTrack track() const {
        PictureTrack track;
        std::vector<std::size_t> kept;
        std::size_t index = 0;
        for (const OpenPosePart& part : parts_) {
            for (const std::string& name : part.names) {
                if (!name.empty()) {
                    track.names.push_back(name);
                    kept.push_back(index);
                }
                ++index;
            }
        }
        for (const std::vector<PersonPoint>& frame : frames_) {
            for (const std::size_t k : kept) {
                const PersonPoint point = frame.empty() ? PersonPoint{} : frame[k];
                track.points.push_back(point.place);
                track.confidence.push_back(point.confidence);
            }
        }
        return track;
    }

    const std::string& layout() const { return layout_; }
    const PersonTracker& tracker() const { return tracker_; }

  private:
    std::vector<PersonPoint> read_person(const Json& person, const std::string& where) {
        std::vector<PersonPoint> points;
        for (OpenPosePart& part : parts_) {
            const auto listed = person.find(part.key);
            const bool missing = listed == person.end() || (listed->is_array() && listed->empty());
            if (part.points == 0) learn_body(part, missing ? 0 : listed->size() / 3, where);
            if (missing && part.key != std::string_view("pose_keypoints_2d")) {
                points.resize(points.size() + part.points);
                continue;
            }
            if (missing || !listed->is_array() || listed->size() != 3 * part.points) {
                throw Error(format(
                    "{}: {} has {} numbers, {} are expected (x, y and confidence of {} points); get the "
                    "file again",
                    where, part.key, missing ? 0 : listed->size(), 3 * part.points, part.points));
            }
            for (std::size_t k = 0; k < part.points; ++k)
                points.push_back(read_point(*listed, k, part.key, where));
        }
        return points;
    }

    void learn_body(OpenPosePart& part, std::size_t points, const std::string& where) {
        part.names = body_names(points, where);
        part.points = points;
        layout_ = points == 25 ? "BODY_25" : "COCO-18";
    }

    // 0 0 0 is a point that was not found, and so is a place of NaN, which is null here.
    static PersonPoint read_point(const Json& numbers, std::size_t k, const char* key,
                                  const std::string& where) {
        if (numbers[3 * k].is_null() && numbers[3 * k + 1].is_null()) return {};
        double values[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const Json& number = numbers[3 * k + i];
            values[i] = number.is_number() ? number.get<double>() : std::nan("");
            if (std::isfinite(values[i]) && std::abs(values[i]) < 1e7) continue;
            throw Error(
                format("{}: {}: number {} is {}; a place or a confidence is expected, get the file again",
                       where, key, 3 * k + i, number.dump()));
        }
        if (values[2] < 0 || values[2] > 1.2) {
            throw Error(format("{}: {}: the confidence of point {} is {}; it lies between 0 and 1", where,
                               key, k, values[2]));
        }
        if (values[0] == 0 && values[1] == 0) return {};
        return {.place = Vec2(values[0], values[1]),
                .confidence = static_cast<float>(std::min(values[2], 1.0))};
    }

    std::vector<OpenPosePart> parts_;
    std::vector<std::vector<PersonPoint>> frames_;  // all parts of the person, or empty
    PersonTracker tracker_;
    std::string layout_;
};

}  // namespace

std::vector<std::string> openpose_hand_names(std::string_view side) {
    std::vector<std::string> names = {""};
    for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
        for (int i = 1; i <= 4; ++i) names.push_back(format("{}_{}_{}", side, finger, i));
    }
    return names;
}

std::vector<std::string> openpose_face_names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < kFacePoints; ++i) names.push_back(format("face_{}", i));
    return names;
}

bool is_openpose_folder(const fs::path& folder) {
    if (!fs::is_directory(folder)) return false;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (is_of_a_frame(entry.path())) return true;
    }
    return false;
}

Motion read_openpose(const fs::path& folder, std::optional<double> fps) {
    const std::string where = folder.string();
    const std::map<std::size_t, fs::path> files = numbered_files(folder);
    if (!fps) {
        throw Error(format(
            "{}: OpenPose does not write the frame rate; give that of the video with --motion-fps", where));
    }
    const std::size_t first = files.begin()->first;
    const std::size_t frames = count_numbered(
        {.held = files.size(), .first = first, .last = files.rbegin()->first}, where, "a folder");
    FolderReader reader;
    Motion motion{.source = where,
                  .fps = *fps,
                  .frames = frames,
                  .joints = {},
                  .keypoints = {},
                  .notes = {},
                  .first_time = static_cast<double>(first) / *fps};
    std::size_t next = first;
    for (const auto& [number, file] : files) {
        for (; next < number; ++next) reader.skip();
        reader.read(file);
        motion.companions.push_back(file);
        ++next;
    }
    motion.picture = reader.track();
    const std::vector<float>& sure = motion.picture->confidence;
    if (std::all_of(sure.begin(), sure.end(), [](float c) { return c == 0; }))
        throw Error(format("{}: nobody is seen in any of its {} frames", where, frames));
    motion.notes.push_back(format("OpenPose: {}, {} frames", reader.layout(), frames));
    if (late_beginning_of(motion)) motion.notes.push_back(first_time_note(motion.first_time));
    if (frames > files.size())
        motion.notes.push_back(format("{} frames have no file", frames - files.size()));
    for (std::string& note : reader.tracker().notes()) motion.notes.push_back(std::move(note));
    return motion;
}

}  // namespace chironomia
