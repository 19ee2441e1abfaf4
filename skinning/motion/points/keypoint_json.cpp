#include "skinning/motion/points/keypoint_json.h"

#include <cmath>
#include <limits>
#include <map>

#include "core/clock_time.h"
#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/points/even_frames.h"

namespace chironomia {
namespace {

const Json* find_key(const Json& object, std::initializer_list<std::string_view> keys) {
    if (!object.is_object()) return nullptr;
    for (const std::string_view key : keys) {
        if (const auto found = object.find(key); found != object.end()) return &*found;
    }
    return nullptr;
}

const Json* find_frames(const Json& json) {
    return json.is_array() ? &json : find_key(json, {"frames", "keypoints", "poses", "data"});
}

// A place and how sure it is; nothing: missing.
struct JsonPoint {
    std::optional<glm::dvec3> place;
    std::optional<double> confidence;
};

class FrameReader {
  public:
    FrameReader(KeypointData& data) : data_(data) {
        for (size_t k = 0; k < data.names.size(); ++k) index_[data.names[k]] = k;
        fixed_ = !data.names.empty();
    }

    void read(const Json& frame) {
        points_.assign(std::max(data_.points, index_.size()), {});
        const Json* listed = find_key(frame, {"keypoints", "landmarks", "landmark", "points", "joints"});
        const Json& points = listed ? *listed : frame;
        if (points.is_array())
            read_list(points);
        else if (points.is_object())
            read_object(points);
        else
            refuse(format("a frame is {}; a list or an object of points is expected", text_of(points)));
        rows_.push_back(std::move(points_));
        ++data_.frames;
    }

    // Lays the rows out; points that came late are missing in the earlier frames.
    void finish() {
        if (!fixed_) {
            data_.names.resize(index_.size());
            for (const auto& [name, k] : index_) data_.names[k] = name;
        }
        if (!data_.names.empty()) data_.points = data_.names.size();
        bool sure = true;
        for (auto& row : rows_) {
            row.resize(data_.points);
            for (const JsonPoint& point : row) {
                sure = sure && point.place && !point.confidence;
                const glm::dvec3 place = point.place.value_or(glm::dvec3(0));
                data_.places.insert(data_.places.end(), {place.x, place.y, place.z});
                data_.confidence.push_back(point.place ? point.confidence.value_or(1) : 0);
            }
        }
        if (sure) data_.confidence.clear();
        data_.picture = deep_ == false;
        data_.unnamed_third = all_unnamed_;
    }

  private:
    static std::string text_of(const Json& json) {
        return json.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
    }

    [[noreturn]] void refuse(const std::string& message) const {
        throw Error(format("{}: frame {}: {}", data_.where, data_.frames, message));
    }

    void read_list(const Json& list) {
        const bool named =
            !list.empty() && list[0].is_object() && find_key(list[0], {"name", "keypoint", "joint"});
        if (named) return read_named_list(list);
        if (data_.frames == 0 && data_.names.empty()) data_.points = list.size();
        const size_t expected = data_.names.empty() ? data_.points : data_.names.size();
        if (list.size() != expected) refuse(format("{} points, {} are expected", list.size(), expected));
        points_.resize(expected);
        for (size_t k = 0; k < list.size(); ++k) points_[k] = read_point(list[k], format("point {}", k));
    }

    void read_named_list(const Json& list) {
        for (const Json& point : list) {
            const Json* name = find_key(point, {"name", "keypoint", "joint"});
            if (!name || !name->is_string()) refuse(format("the point {} has no name", text_of(point)));
            set(name->get<std::string>(), point);
        }
    }

    void read_object(const Json& object) {
        for (const auto& [name, point] : object.items()) {
            const bool point_like = point.is_array() || point.is_object() || point.is_null();
            // Numbers beside the points are the frame's own: its index or its time.
            if (point_like) set(name, point);
        }
    }

    void set(const std::string& name, const Json& point) {
        const auto found = index_.find(name);
        if (found == index_.end() && fixed_) refuse(format("the point \"{}\" is none of the names", name));
        const size_t k =
            found != index_.end() ? found->second : index_.emplace(name, index_.size()).first->second;
        if (k >= points_.size()) points_.resize(k + 1);
        points_[k] = read_point(point, format("point \"{}\"", name));
    }

    // All points have a depth, or none has.
    void note_depth(bool deep, const std::string& name) {
        if (deep_ && *deep_ != deep)
            refuse(format("{} has {} z, others have {}", name, deep ? "a" : "no", deep ? "none" : "one"));
        deep_ = deep;
    }

    JsonPoint read_point(const Json& point, const std::string& name) {
        JsonPoint result;
        if (point.is_null()) return result;
        if (point.is_array()) {
            if (point.size() < 2 || point.size() > 4) {
                refuse(
                    format("{} has {} numbers; x, y, z and perhaps the confidence are expected, or x and y "
                           "in a picture",
                           name, point.size()));
            }
            note_depth(point.size() > 2, name);
            if (point.size() != 3) all_unnamed_ = false;
            result.place = glm::dvec3(number(point[0], name), number(point[1], name),
                                      point.size() > 2 ? number(point[2], name) : 0);
            if (point.size() == 4) result.confidence = number(point[3], name);
            return result;
        }
        const Json* x = find_key(point, {"x"});
        const Json* y = find_key(point, {"y"});
        const Json* z = find_key(point, {"z"});
        if (!x || !y)
            refuse(
                format("{} is {}; x, y and z are expected, or x and y in a picture", name, text_of(point)));
        note_depth(z != nullptr, name);
        all_unnamed_ = false;
        result.place = glm::dvec3(number(*x, name), number(*y, name), z ? number(*z, name) : 0);
        if (const Json* c = find_key(point, kConfidenceNames)) result.confidence = number(*c, name);
        return result;
    }

    // JSON has no NaN; writers put null, or a word that is no JSON at all.
    double number(const Json& value, const std::string& name) const {
        if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
        if (!value.is_number()) refuse(format("{} holds {}; a number is expected", name, text_of(value)));
        return value.get<double>();
    }

    KeypointData& data_;
    std::optional<bool> deep_;
    bool all_unnamed_ = true;  // every point is a list of three numbers
    bool fixed_ = false;       // the names were given; no others may come
    std::map<std::string, size_t> index_;
    std::vector<JsonPoint> points_;             // of the current frame
    std::vector<std::vector<JsonPoint>> rows_;  // of all frames
};

}  // namespace

std::optional<double> time_in(const Json& frame) {
    const Json* time =
        find_key(frame, {"time", "timestamp", "seconds", "time_s", "timestamp_ms", "timestampMs", "time_ms",
                         "timestamp_us", "timestampUs", "timestamp_usec", "time_us", "timestamp_ns"});
    if (!time) return std::nullopt;
    if (time->is_string()) return seconds_of_clock(time->get<std::string_view>());
    return time->is_number() ? std::optional(time->get<double>()) : std::nullopt;
}

void take_frame_times(KeypointData& data, const Json& frames) {
    const auto numbers_of = [&](std::initializer_list<std::string_view> keys) {
        std::vector<double> numbers;
        for (const Json& frame : frames) {
            const Json* number = find_key(frame, keys);
            if (!number || !number->is_number()) return std::vector<double>();
            numbers.push_back(number->get<double>());
        }
        return numbers;
    };
    const auto where = [&](size_t t) { return format("{}: frame {}: ", data.where, t); };
    std::vector<double> times;
    for (const Json& frame : frames) {
        if (const auto time = time_in(frame)) times.push_back(*time);
    }
    if (times.size() < frames.size()) times.clear();
    if (!times.empty() && !data.fps) {
        even_out_times(data, times, where);
    } else {
        fill_missing_numbers(data, numbers_of({"frame", "frame_id", "frame_index"}), where);
    }
}

bool describes_array(const Json& json) {
    if (!json.is_object() || find_frames(json)) return false;
    return find_key(json, {"names", "joints", "keypoint_names", "joint_names", "fps", "frame_rate",
                           "file"}) != nullptr;
}

Vec2 picture_size_in(const Json& json) {
    if (!json.is_object()) return Vec2(0);
    for (const auto& [width, height] :
         {std::pair{"width", "height"}, {"image_width", "image_height"}, {"imageWidth", "imageHeight"}}) {
        if (!json.contains(width) || !json.contains(height)) continue;
        const Json &w = json[width], &h = json[height];
        if (w.is_number() && h.is_number() && w > 0 && h > 0) return Vec2(w.get<double>(), h.get<double>());
    }
    return Vec2(0);
}

std::optional<double> rate_in(const Json& json, const std::string& where) {
    const Json* rate = find_key(json, {"fps", "frame_rate", "framerate"});
    if (!rate) return std::nullopt;
    if (!rate->is_number())
        throw Error(format("{}: the rate is {}; a number is expected", where, rate->dump()));
    return rate->get<double>();
}

std::vector<std::string> names_in(const Json& json, const std::string& where) {
    const Json* list = find_key(json, {"names", "joints", "keypoint_names", "joint_names"});
    if (!list) return {};
    std::vector<std::string> names;
    if (!list->is_array()) throw Error(format("{}: the names are no list", where));
    for (const Json& name : *list) {
        if (!name.is_string())
            throw Error(format("{}: a name is {}; a text is expected", where, name.dump()));
        names.push_back(name.get<std::string>());
    }
    return names;
}

KeypointData keypoints_of_json(const Json& json, const std::string& where) {
    const Json* frames = find_frames(json);
    if (!frames || !frames->is_array()) {
        throw Error(format("{}: no \"frames\" with a list of frames; this is no motion", where));
    }
    KeypointData data;
    data.where = where;
    data.fps = rate_in(json, where);
    data.names = names_in(json, where);
    FrameReader reader(data);
    for (const Json& frame : *frames) reader.read(frame);
    reader.finish();
    data.size = picture_size_in(json);
    take_frame_times(data, *frames);
    data.notes.push_back(format("JSON: {} points", data.points));
    return data;
}

}  // namespace chironomia
