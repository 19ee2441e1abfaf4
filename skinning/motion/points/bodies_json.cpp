#include "skinning/motion/points/bodies_json.h"

#include <algorithm>
#include <array>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/points/keypoint_json.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPanoptic = {
    "thorax",      "nose",       "pelvis",         "left_shoulder", "left_elbow",  "left_wrist", "left_hip",
    "left_knee",   "left_ankle", "right_shoulder", "right_elbow",   "right_wrist", "right_hip",  "right_knee",
    "right_ankle", "left_eye",   "left_ear",       "right_eye",     "right_ear"};

const Json* find_list(const Json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() && found->is_array() ? &*found : nullptr;
}

// x, y, z and confidence of all joints in a row; empty: another form.
std::vector<double> row_of(const Json& body) {
    std::vector<double> row;
    const auto add = [&](const Json& numbers) {
        for (const Json& number : numbers)
            row.push_back(number.is_number() ? number.get<double>() : std::nan(""));
    };
    if (const Json* joints = find_list(body, "joints19")) {
        add(*joints);
        for (size_t i = 3; i < row.size(); i += 4) row[i] = std::clamp(row[i], 0.0, 1.0);
    } else if (const Json* places = find_list(body, "joint_positions")) {
        for (const Json& place : *places) {
            if (!place.is_array() || place.size() != 3) return {};
            add(place);
            row.push_back(1);
        }
    }
    return row;
}

// Without a number a body is known by its place in the list of its frame.
std::string id_of(const Json& body, size_t place) {
    for (const char* key : {"body_id", "id"}) {
        if (body.is_object() && body.contains(key)) return body[key].dump();
    }
    return format("at place {}", place);
}

// Fills in the frames, for the names that `data` has.
KeypointData take_bodies(KeypointData data, const Json& frames) {
    data.points = data.names.size();
    std::optional<std::string> first;
    size_t others = 0;
    for (const Json& frame : frames) {
        const Json* bodies = find_list(frame, "bodies");
        std::vector<double> row(4 * data.points, 0);
        for (size_t i = 0; bodies && i < bodies->size(); ++i) {
            const Json& body = (*bodies)[i];
            const std::string id = id_of(body, i);
            if (!first) first = id;
            if (id != *first) {
                ++others;
                continue;
            }
            row = row_of(body);
            if (row.size() != 4 * data.points)
                throw Error(
                    format("{}: frame {}: a body has no \"joint_positions\" or \"joints19\" of {} joints; "
                           "get the file again",
                           data.where, data.frames, data.points));
        }
        for (size_t i = 0; i < row.size(); i += 4) {
            data.places.insert(data.places.end(), {row[i], row[i + 1], row[i + 2]});
            data.confidence.push_back(row[i + 3]);
        }
        ++data.frames;
    }
    data.notes.push_back(format("bodies: {} joints, {} frames", data.points, data.frames));
    if (others > 0)
        data.notes.push_back(
            format("several people: the body {} is taken, as it comes first; {} times there is another",
                   *first, others));
    take_frame_times(data, frames);
    return data;
}

// In the order of their numbers, which all have as many digits.
std::vector<fs::path> panoptic_files(const fs::path& folder) {
    std::set<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("body3DScene_") && name.ends_with(".json")) files.insert(entry.path());
    }
    return {files.begin(), files.end()};
}

}  // namespace

bool holds_bodies(const Json& json) {
    const Json* frames = find_list(json, "frames");
    return frames &&
           std::ranges::any_of(*frames, [](const Json& frame) { return find_list(frame, "bodies"); });
}

KeypointData bodies_of_json(const Json& json, const std::string& where) {
    KeypointData data{.where = where, .names = names_in(json, where), .fps = rate_in(json, where)};
    if (data.names.empty())
        throw Error(
            format("{}: its bodies have no \"joint_names\"; write it with offline_processor of Azure Kinect",
                   where));
    return take_bodies(std::move(data), *find_list(json, "frames"));
}

bool is_panoptic_folder(const fs::path& folder) {
    return !panoptic_files(folder).empty();
}

KeypointData read_panoptic(const fs::path& folder) {
    KeypointData data{.where = folder.string(), .companions = panoptic_files(folder)};
    data.names.assign(kPanoptic.begin(), kPanoptic.end());
    data.ours = data.names;
    Json frames = Json::array();
    for (const fs::path& file : data.companions) {
        Json frame = read_json(file);
        if (frame.is_object() && frame.contains("univTime")) frame["time"] = Json(frame["univTime"]);
        frames.push_back(std::move(frame));
    }
    return take_bodies(std::move(data), frames);
}

}  // namespace chironomia
