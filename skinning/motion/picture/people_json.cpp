#include "skinning/motion/picture/people_json.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/picture/person_tracker.h"
#include "skinning/motion/points/even_frames.h"
#include "skinning/motion/points/keypoint_json.h"

namespace chironomia {
namespace {

constexpr double kSurest = 6;            // AlphaPose, of COCO's points; beyond 1 a point is sure
constexpr double kFarthestPixel = 1e7;   // [px or the file's unit]
constexpr std::size_t kBodyOfCoco = 17;  // come first in every layout of COCO

const Json* find_people_list(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? &*found : nullptr;
}

bool is_result_of_people(const Json& json) {
    return json.is_object() && json.contains("image_id") && find_people_list(json, "keypoints");
}

bool is_frame_of_people(const Json& json) {
    return find_people_list(json, "instances") && json.contains("frame_id");
}

// Of one picture what Ultralytics calls a result: {"keypoints": {"x": [...], "y": [...], "visible": [...]}} for each
// person.
bool is_list_of_detections(const Json& json) {
    const auto is_detection = [](const Json& each) {
        return each.is_object() && each.contains("keypoints") && find_people_list(each["keypoints"], "x");
    };
    return json.is_array() && std::all_of(json.begin(), json.end(), is_detection);
}

// An annotation of COCO that marks where somebody is, and no points.
bool is_box(const Json& json) {
    if (!json.is_object() || !json.contains("image_id") || !json.contains("category_id")) return false;
    const Json* points = find_people_list(json, "keypoints");
    return !points || points->empty();
}

// What somebody marked in pictures, in COCO's form.
const Json* find_annotations(const Json& json) {
    return json.is_object() && json.contains("images") ? find_people_list(json, "annotations") : nullptr;
}

const Json& people_list(const Json& json) {
    if (const Json* annotations = find_annotations(json)) return *annotations;
    const Json* inner = find_people_list(json, "instance_info");
    return inner ? *inner : json;
}

std::string text_of_people(const Json& json) {
    return json.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
}

// "clip_000012.jpg" is 12; nothing where no digits stand at the end.
std::optional<std::size_t> picture_number(const Json& id) {
    if (id.is_number_unsigned()) return id.get<std::size_t>();
    if (!id.is_string()) return std::nullopt;
    std::string name = id.get<std::string>();
    if (const std::size_t dot = name.find_last_of('.'); dot != std::string::npos) name.resize(dot);
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    if (digits >= name.size() || name.size() - digits > 12) return std::nullopt;
    return static_cast<std::size_t>(std::stoull(name.substr(digits)));
}

struct SeenPerson {
    std::vector<glm::dvec3> places;  // (K)
    std::vector<double> confidence;  // (K)
};

struct SeenFrame {
    std::string name;  // as in the file, for messages
    std::optional<std::size_t> number;
    std::vector<SeenPerson> people;
    std::optional<double> time{};  // in the file's unit
};

class PeopleReader {
  public:
    explicit PeopleReader(std::string where) : where_(std::move(where)) {}

    std::vector<SeenFrame> read(const Json& list) {
        for (const Json& entry : list) {
            if (is_list_of_detections(entry)) {
                SeenFrame& frame = frame_of(frames_.size());
                for (const Json& detection : entry)
                    frame.people.push_back(read_detection(detection["keypoints"]));
            } else if (is_box(entry)) {
                frame_of(entry["image_id"]);
            } else if (is_result_of_people(entry)) {
                SeenFrame& frame = frame_of(entry["image_id"]);
                frame.people.push_back(read_row(entry["keypoints"]));
                frame.time = time_in(entry);
            } else if (is_frame_of_people(entry)) {
                SeenFrame& frame = frame_of(entry["frame_id"]);
                for (const Json& person : entry["instances"]) frame.people.push_back(read_person(person));
                frame.time = time_in(entry);
            } else {
                name_ = text_of_people(entry);
                refuse(
                    "is neither a result with \"image_id\" and \"keypoints\" nor a frame with \"frame_id\" and "
                    "\"instances\"; get the file again");
            }
        }
        return std::move(frames_);
    }

    bool in_space() const { return columns_ == 3; }

  private:
    [[noreturn]] void refuse(const std::string& message) const {
        throw Error(format("{}: frame {}: {}", where_, name_, message));
    }

    SeenFrame& frame_of(const Json& id) {
        name_ = text_of_people(id);
        const auto [entry, added] = index_.emplace(name_, frames_.size());
        if (added) frames_.push_back({.name = name_, .number = picture_number(id), .people = {}});
        return frames_[entry->second];
    }

    double number(const Json& json, double least, double most) const {
        const double number = json.is_number() ? json.get<double>() : std::nan("");
        if (!(number >= least && number <= most))
            refuse(format("{} stands where a number from {} to {} is expected; get the file again",
                          text_of_people(json), least, most));
        return number;
    }

    void expect_points(std::size_t points, std::size_t columns) {
        if (points_ == 0) {
            points_ = points;
            columns_ = columns;
        }
        if (points == points_ && columns == columns_ && points > 0) return;
        refuse(format(
            "a person has {} points of {} numbers, {} of {} are expected; all people must have the same "
            "points",
            points, columns, points_, columns_));
    }

    // x, y, confidence of all points.
    SeenPerson read_row(const Json& row) {
        if (row.size() % 3 != 0)
            refuse(
                format("\"keypoints\" has {} numbers; x, y and confidence of each point are "
                       "expected",
                       row.size()));
        expect_points(row.size() / 3, 2);
        SeenPerson person;
        for (std::size_t i = 0; i < row.size(); i += 3) {
            if (row[i].is_null() && row[i + 1].is_null()) {  // NaN
                person.places.emplace_back(0);
                person.confidence.push_back(0);
                continue;
            }
            person.places.emplace_back(number(row[i], -kFarthestPixel, kFarthestPixel),
                                       number(row[i + 1], -kFarthestPixel, kFarthestPixel), 0);
            person.confidence.push_back(std::min(number(row[i + 2], 0, kSurest), 1.0));
        }
        return person;
    }

    SeenPerson read_detection(const Json& points) {
        const Json &x = points["x"], *y = find_people_list(points, "y"),
                   *sure = find_people_list(points, "visible");
        if (!y || y->size() != x.size() || (sure && sure->size() != x.size()))
            refuse(format("its \"keypoints\" are {}; as many x as y are expected", text_of_people(points)));
        expect_points(x.size(), 2);
        SeenPerson person;
        for (std::size_t k = 0; k < x.size(); ++k) {
            person.places.emplace_back(number(x[k], -kFarthestPixel, kFarthestPixel),
                                       number((*y)[k], -kFarthestPixel, kFarthestPixel), 0);
            person.confidence.push_back(sure ? std::min(number((*sure)[k], 0, kSurest), 1.0) : 1);
        }
        return person;
    }

    SeenPerson read_person(const Json& json) {
        const Json* points = find_people_list(json, "keypoints");
        if (!points || points->empty())
            refuse(format("{} has no \"keypoints\"; get the file again", text_of_people(json)));
        const Json* scores = find_people_list(json, "keypoint_scores");
        if (scores && scores->size() != points->size())
            refuse(format("{} \"keypoint_scores\" for {} \"keypoints\"; get the file again", scores->size(),
                          points->size()));
        SeenPerson person;
        for (std::size_t k = 0; k < points->size(); ++k) {
            const Json& point = (*points)[k];
            const std::size_t columns = point.is_array() ? point.size() : 0;
            if (columns != 2 && columns != 3)
                refuse(
                    format("point {} is {}; x and y are expected, or x, y and z", k, text_of_people(point)));
            expect_points(points->size(), columns);
            const auto coordinate = [&](std::size_t axis) {
                return axis < columns ? number(point[axis], -kFarthestPixel, kFarthestPixel) : 0;
            };
            person.places.emplace_back(coordinate(0), coordinate(1), coordinate(2));
            person.confidence.push_back(scores ? std::min(number((*scores)[k], 0, kSurest), 1.0) : 1.0);
        }
        return person;
    }

    std::string where_;
    std::string name_;  // of the frame that is read
    std::size_t points_ = 0, columns_ = 0;
    std::vector<SeenFrame> frames_;
    std::map<std::string, std::size_t> index_;
};

// In the order of their numbers, with an empty frame for each number that is left out.
std::vector<SeenFrame> in_order_of_numbers(std::vector<SeenFrame> frames, const std::string& where,
                                           KeypointData& data) {
    std::set<std::size_t> numbers;
    for (const SeenFrame& frame : frames) {
        if (frame.number) numbers.insert(*frame.number);
    }
    if (numbers.size() < frames.size()) {
        data.notes.push_back(
            "frames: in the order of the file, as the names of the pictures do not number them");
        return frames;
    }
    const std::size_t first = *numbers.begin();
    const std::size_t count =
        count_numbered({.held = frames.size(), .first = first, .last = *numbers.rbegin()}, where, "a file");
    std::vector<SeenFrame> ordered(count);
    for (SeenFrame& frame : frames) ordered[*frame.number - first] = std::move(frame);
    if (count > frames.size()) data.notes.push_back(format("{} frames are left out", count - frames.size()));
    const bool has_times = std::any_of(ordered.begin(), ordered.end(),
                                       [](const SeenFrame& frame) { return frame.time.has_value(); });
    if (!has_times) note_first_number(data, static_cast<double>(first));
    return ordered;
}

std::vector<PersonPoint> picture_points(const SeenPerson& person) {
    std::vector<PersonPoint> points;
    for (std::size_t k = 0; k < person.places.size(); ++k)
        points.push_back({Vec2(person.places[k]), static_cast<float>(person.confidence[k])});
    return points;
}

// Those of frames that are left out lie evenly between their neighbours'. Empty: not all frames have one, or they do
// not advance.
std::vector<double> times_of(const std::vector<SeenFrame>& frames) {
    std::vector<double> times;
    size_t missing = 0;
    for (const SeenFrame& frame : frames) {
        if (!frame.time && !frame.name.empty()) return {};
        missing += !frame.time;
        if (!frame.time) continue;
        const double last = times.empty() ? 0 : times.back();
        if (!times.empty() && !(*frame.time > last)) return {};
        const double step = (*frame.time - last) / static_cast<double>(missing + 1);
        for (size_t i = 1; missing > 0; --missing, ++i) times.push_back(last + static_cast<double>(i) * step);
        times.push_back(*frame.time);
    }
    return times;
}

// What a file of annotations says of all pictures: how large they are, and how its points are called.
void take_annotated(KeypointData& data, const Json& json) {
    constexpr double kLargest = 65536;  // [px]
    if (!find_annotations(json)) return;
    const Json& images = json["images"];
    const auto side = [&](const char* name) {
        const bool is_there = images.is_array() && !images.empty() && images[0].is_object() &&
                              images[0].contains(name) && images[0][name].is_number();
        return is_there ? std::clamp(images[0][name].get<double>(), 0.0, kLargest) : 0;
    };
    if (side("width") >= 1 && side("height") >= 1) data.size = Vec2(side("width"), side("height"));
    const Json* categories = find_people_list(json, "categories");
    if (!categories || categories->empty()) return;
    const Json* names = find_people_list(categories->front(), "keypoints");
    if (!names || names->size() != data.points) return;
    if (std::all_of(names->begin(), names->end(), [](const Json& name) { return name.is_string(); }))
        data.names = names->get<std::vector<std::string>>();
}

void take_person(KeypointData& data, const SeenPerson* person) {
    for (std::size_t k = 0; k < data.points; ++k) {
        const glm::dvec3 place = person ? person->places[k] : glm::dvec3(0);
        data.places.insert(data.places.end(), {place.x, place.y, place.z});
        data.confidence.push_back(person ? person->confidence[k] : 0);
    }
}

}  // namespace

bool holds_people(const Json& json) {
    const Json& list = people_list(json);
    if (!list.is_array()) return false;
    return std::any_of(list.begin(), list.end(), [](const Json& entry) {
        return is_result_of_people(entry) || is_frame_of_people(entry) ||
               (is_list_of_detections(entry) && !entry.empty());
    });
}

KeypointData people_of_json(const Json& json, const std::string& where) {
    PeopleReader reader(where);
    std::vector<SeenFrame> frames = reader.read(people_list(json));
    KeypointData data;
    data.where = where;
    for (const SeenFrame& frame : frames) {
        if (!frame.people.empty()) data.points = frame.people[0].places.size();
    }
    if (data.points == 0)
        throw Error(format("{}: nobody is seen in any of its {} frames", where, frames.size()));
    frames = in_order_of_numbers(std::move(frames), where, data);
    data.frames = frames.size();
    data.picture = !reader.in_space();
    data.known_order = true;
    take_annotated(data, json);
    PersonTracker tracker;
    for (const SeenFrame& frame : frames) {
        std::vector<std::vector<PersonPoint>> people;
        for (const SeenPerson& person : frame.people) people.push_back(picture_points(person));
        const auto chosen = tracker.choose(people, std::min(data.points, kBodyOfCoco));
        take_person(data, chosen ? &frame.people[*chosen] : nullptr);
    }
    even_out_times(data, times_of(frames), [&](size_t t) { return format("{}: frame {}: ", where, t); });
    data.notes.push_back(format("people of a detector: {} points, {} frames", data.points, data.frames));
    for (std::string& note : tracker.notes()) data.notes.push_back(std::move(note));
    return data;
}

}  // namespace chironomia
