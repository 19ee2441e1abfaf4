#include "skinning/motion/picture/mediapipe_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/picture/person_tracker.h"
#include "skinning/motion/points/keypoint_data.h"
#include "skinning/motion/points/keypoint_json.h"

namespace chironomia {
namespace {

constexpr size_t kPose = 33, kHand = 21;

struct MediaPipePart {
    const char* name;   // in messages
    const char* snake;  // keys
    const char* camel;
    size_t points;
    const char* web = "";  // of the Tasks of JavaScript, where the results of other tasks are called alike
};
using Parts = std::array<MediaPipePart, 3>;  // pose, left hand, right hand; wrists of the pose are 15 and 16

constexpr Parts kPicture = {{{"pose_landmarks", "pose_landmarks", "poseLandmarks", kPose, "landmarks"},
                             {"left_hand_landmarks", "left_hand_landmarks", "leftHandLandmarks", kHand},
                             {"right_hand_landmarks", "right_hand_landmarks", "rightHandLandmarks", kHand}}};
constexpr Parts kWorld = {
    {{"pose_world_landmarks", "pose_world_landmarks", "poseWorldLandmarks", kPose, "worldLandmarks"},
     {"left_hand_world_landmarks", "left_hand_world_landmarks", "leftHandWorldLandmarks", kHand},
     {"right_hand_world_landmarks", "right_hand_world_landmarks", "rightHandWorldLandmarks", kHand}}};

const Json& frames_of(const Json& json) {
    static const Json none = Json::array();
    if (json.is_array()) return json;
    const auto frames = json.is_object() ? json.find("frames") : json.end();
    return json.is_object() && frames != json.end() && frames->is_array() ? *frames : none;
}

const Json* find_part(const Json& frame, const MediaPipePart& part) {
    if (!frame.is_object()) return nullptr;
    for (const char* key : {part.snake, part.camel, part.web}) {
        const auto found = frame.find(key);
        if (found != frame.end()) return &*found;
    }
    return nullptr;
}

bool is_list_of_people(const Json& first) {
    return first.is_array() && !first.empty() && !first[0].is_number() && !first[0].is_null();
}

// The names of JavaScript say nothing of a pose where points alone stand under them.
bool has_part(const Json& frames, const MediaPipePart& part) {
    return std::any_of(frames.begin(), frames.end(), [&](const Json& frame) {
        const Json* list = find_part(frame, part);
        if (!list || frame.contains(part.snake) || frame.contains(part.camel)) return list != nullptr;
        return list->is_array() && !list->empty() && is_list_of_people(list->at(0)) &&
               list->at(0).size() == part.points;
    });
}

struct MediaPipePoint {
    glm::dvec3 place{0};
    double confidence = 0;
};

std::vector<PersonPoint> points_in_picture(const Json& person) {
    constexpr float kFarthestShare = 1e4f;  // ours, of the picture's sides
    std::vector<PersonPoint> points(kPose);
    if (!person.is_array()) return points;
    for (size_t k = 0; k < std::min(kPose, person.size()); ++k) {
        const Json& point = person[k];
        const auto number = [&](size_t column, const char* name) {
            const bool is_there = point.is_array() ? column < point.size() : point.contains(name);
            const Json value = !is_there ? Json() : point.is_array() ? point[column] : point[name];
            return value.is_number() ? value.get<float>() : std::nanf("");
        };
        const Vec2 place(number(0, "x"), number(1, "y"));
        const float visibility = number(3, "visibility");
        if (!(glm::length(place) < kFarthestShare)) continue;
        points[k] = {.place = place, .confidence = std::isnan(visibility) ? 1 : visibility};
    }
    return points;
}

// Which of the people of each frame is shown. Places in space are around everybody's own hips, so those in the picture
// say who is who; without them it is the first of each frame.
struct ShownPeople {
    std::vector<std::optional<size_t>> of_frames;  // nothing: nobody, or the person is hidden
    std::vector<std::string> notes;
};

ShownPeople choose_people(const Json& frames) {
    ShownPeople shown{.of_frames = std::vector<std::optional<size_t>>(frames.size(), 0), .notes = {}};
    size_t crowded = 0;
    const bool is_in_picture = has_part(frames, kPicture[0]);
    PersonTracker tracker;
    for (size_t t = 0; t < frames.size(); ++t) {
        const Json* list = find_part(frames[t], is_in_picture ? kPicture[0] : kWorld[0]);
        const bool is_of_people =
            list && list->is_array() && !list->empty() && is_list_of_people(list->at(0));
        if (!is_of_people) continue;
        crowded += list->size() > 1;
        if (!is_in_picture) continue;
        std::vector<std::vector<PersonPoint>> people;
        for (const Json& person : *list) people.push_back(points_in_picture(person));
        shown.of_frames[t] = tracker.choose(people, kPose);
    }
    shown.notes = tracker.notes();
    if (crowded > 0 && !is_in_picture)
        shown.notes.push_back(format("several people in {} frames; the first of each is taken", crowded));
    return shown;
}

// Reads one kind of landmarks, frame by frame.
class PartsReader {
  public:
    PartsReader(const Json& frames, const Parts& parts, const std::string& where, const ShownPeople& people)
        : frames_(frames),
          parts_(parts),
          where_(where),
          people_(people),
          has_hands_(has_part(frames, parts[1]) || has_part(frames, parts[2])) {}

    // (T, 33) or, with hands, (T, 75).
    std::vector<std::vector<MediaPipePoint>> read() {
        std::vector<std::vector<MediaPipePoint>> all;
        for (t_ = 0; t_ < frames_.size(); ++t_) {
            if (!frames_[t_].is_object() && !frames_[t_].is_null())
                refuse(format("a frame is {}; an object with landmarks is expected", text_of(frames_[t_])));
            all.emplace_back();
            for (size_t p = 0; p < (has_hands_ ? 3 : 1); ++p) append(parts_[p], all.back());
        }
        return all;
    }

  private:
    static std::string text_of(const Json& json) {
        return json.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
    }

    [[noreturn]] void refuse(const std::string& message) const {
        throw Error(format("{}: frame {}: {}", where_, t_, message));
    }

    void append(const MediaPipePart& part, std::vector<MediaPipePoint>& points) {
        const Json* list = find_part(frames_[t_], part);
        if (list && list->is_object() && list->contains("landmark")) list = &list->at("landmark");
        if (list && list->is_array() && !list->empty() && is_list_of_people(list->at(0))) {
            const auto person = people_.of_frames[t_];
            list = person && *person < list->size() ? &list->at(*person) : nullptr;
        }
        if (!list || list->is_null() || list->empty()) {
            points.resize(points.size() + part.points);
            return;
        }
        if (!list->is_array() || list->size() != part.points) {
            refuse(format("{} has {} points; {} are expected", part.name, list->is_array() ? list->size() : 0,
                          part.points));
        }
        for (const Json& point : *list) points.push_back(read_point(point, part));
    }

    // Hands are sure as a whole: their points have no visibility of their own, or 0.
    MediaPipePoint read_point(const Json& point, const MediaPipePart& part) const {
        const bool hand = part.points == kHand;
        std::array<double, 4> values = {0, 0, 0, 1};
        if (point.is_array() && point.size() >= 3 && point.size() <= 4) {
            for (size_t i = 0; i < point.size(); ++i) values[i] = number(point[i], part);
        } else if (point.is_object() && point.contains("x") && point.contains("y")) {
            values = {number(point["x"], part), number(point["y"], part),
                      point.contains("z") ? number(point["z"], part) : 0,
                      point.contains("visibility") ? number(point["visibility"], part) : 1};
        } else {
            refuse(format("{} has a point {}; x, y and z are expected", part.name, text_of(point)));
        }
        return {.place = {values[0], values[1], values[2]}, .confidence = hand ? 1 : values[3]};
    }

    double number(const Json& value, const MediaPipePart& part) const {
        if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
        if (!value.is_number())
            refuse(format("{} holds {}; a number is expected", part.name, text_of(value)));
        return value.get<double>();
    }

    const Json& frames_;
    const Parts& parts_;
    const std::string& where_;
    bool has_hands_;
    const ShownPeople& people_;
    size_t t_ = 0;
};

// Hands around their own middles go to the wrists of the pose, or are missing where it is.
void set_hands_to_wrists(std::vector<MediaPipePoint>& points) {
    if (points.size() == kPose) return;
    for (const size_t side : {0, 1}) {
        const MediaPipePoint& wrist = points[15 + side];
        const auto hand = points.begin() + static_cast<std::ptrdiff_t>(kPose + side * kHand);
        const glm::dvec3 off = wrist.place - hand->place;
        for (auto point = hand; point != hand + kHand; ++point) {
            point->place += off;
            if (wrist.confidence == 0) point->confidence = 0;
        }
    }
}

KeypointData data_of(const std::vector<std::vector<MediaPipePoint>>& frames, const Json& json,
                     const std::string& where) {
    KeypointData data;
    data.where = where;
    data.fps = rate_in(json, where);
    data.frames = frames.size();
    data.points = frames.empty() ? 0 : frames[0].size();
    for (const auto& points : frames) {
        for (const auto& [place, confidence] : points) {
            data.places.insert(data.places.end(), {place.x, place.y, place.z});
            data.confidence.push_back(confidence);
        }
    }
    take_frame_times(data, frames_of(json));
    return data;
}

KeypointData picture_data(const Json& json, std::vector<std::vector<MediaPipePoint>> frames,
                          const std::string& where) {
    for (auto& points : frames) {
        for (MediaPipePoint& point : points) point.place.z = 0;
    }
    KeypointData data = data_of(frames, json, where);
    data.picture = true;
    data.size = picture_size_in(json);
    return data;
}

}  // namespace

bool holds_mediapipe(const Json& json) {
    const Json& frames = frames_of(json);
    return has_part(frames, kPicture[0]) || has_part(frames, kWorld[0]);
}

Motion motion_of_mediapipe(const Json& json, const std::string& where, std::optional<double> fps) {
    const Json& frames = frames_of(json);
    std::optional<Motion> space, picture;
    const ShownPeople people = choose_people(frames);
    if (has_part(frames, kWorld[0])) {
        PartsReader reader(frames, kWorld, where, people);
        auto points = reader.read();
        for (auto& frame : points) set_hands_to_wrists(frame);
        KeypointData data = data_of(points, json, where);
        data.in_space = true;
        space = name_keypoints(std::move(data), fps, {});
    }
    if (has_part(frames, kPicture[0])) {
        PartsReader reader(frames, kPicture, where, people);
        KeypointData data = picture_data(json, reader.read(), where);
        data.known_order = true;
        picture = name_keypoints(std::move(data), fps, {});
    }
    Motion motion = space ? std::move(*space) : std::move(*picture);
    if (space && picture) motion.picture = std::move(picture->picture);
    motion.notes.insert(motion.notes.end(), people.notes.begin(), people.notes.end());
    return motion;
}

}  // namespace chironomia
