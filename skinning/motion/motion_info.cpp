#include "skinning/motion/motion_info.h"

#include <algorithm>
#include <cmath>

#include "core/body/humanoid.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/body/moving_skeleton.h"

namespace chironomia {
namespace {

double rounded(double value, double unit) {
    return std::round(value / unit) * unit;
}

double root_path(const Motion& motion, const JointTrack& track) {
    const size_t count = track.skeleton.joints.size();
    double path = 0;
    for (size_t t = 1; t < motion.frames; ++t) {
        const Vec3 step = track.translations[t * count] - track.translations[(t - 1) * count];
        path += std::hypot(step.x, step.z);
    }
    return path;
}

void add_joints(Json& description, const Motion& motion, const JointTrack& track) {
    Json names = Json::array(), parts = Json::object();
    for (const Joint& joint : track.skeleton.joints) names.push_back(joint.name);
    const HumanoidMap map = find_humanoid(track).map;
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        if (map.has(part)) parts[std::string(name_of(part))] = names[static_cast<size_t>(map[part])];
    }
    description["joints"] = std::move(names);
    description["root_path_m"] = rounded(root_path(motion, track), 0.001);
    description["humanoid"] = std::move(parts);
}

// Points in space or in a picture.
template <typename Track>
void add_keypoints(Json& description, const Motion& motion, const Track& track) {
    const size_t count = track.names.size();
    size_t missing = 0;
    Json mostly = Json::array();
    for (size_t k = 0; k < count; ++k) {
        size_t gaps = 0;
        for (size_t t = 0; t < motion.frames; ++t) gaps += track.confidence[t * count + k] == 0;
        missing += gaps;
        if (2 * gaps > motion.frames) mostly.push_back(track.names[k]);
    }
    description["keypoints"] = track.names;
    description["missing_share"] =
        rounded(static_cast<double>(missing) / static_cast<double>(track.confidence.size()), 1e-4);
    description["mostly_missing"] = std::move(mostly);
}

// The largest turn of the head or an eye from straight ahead.
double most_turn(const std::vector<Quat>& turns) {
    double most = 0;
    for (const Quat& turn : turns) most = std::max(most, double(angle_between(turn, kNoTurn)));
    return glm::degrees(most);
}

double most_gaze(const std::vector<Gaze>& gaze) {
    double most = 0;
    for (const auto& [left, right] : gaze) {
        for (const Vec2& eye : {left, right})
            most = std::max(most, std::acos(std::cos(double(eye.x)) * std::cos(double(eye.y))));
    }
    return glm::degrees(most);
}

void add_face(Json& description, const Motion& motion, const FaceTrack& track) {
    const size_t count = track.channels.size();
    Json units = Json::array();
    for (size_t c = 0; c < count; ++c) {
        float most = 0;
        for (size_t t = 0; t < motion.frames; ++t) most = std::max(most, track.intensities[t * count + c]);
        units.push_back({{"channel", to_text(track.channels[c])},
                         {"name", std::string(name_of_unit(track.channels[c].unit))},
                         {"most", rounded(most, 0.01)}});
    }
    description["face"]["units"] = std::move(units);
    if (!track.head.empty()) description["face"]["head_most_deg"] = rounded(most_turn(track.head), 0.1);
    if (!track.gaze.empty()) description["face"]["gaze_most_deg"] = rounded(most_gaze(track.gaze), 0.1);
    if (track.confidence.empty()) return;
    const auto bridged = std::count(track.confidence.begin(), track.confidence.end(), 0.0f);
    double sum = 0;
    for (const float confidence : track.confidence) sum += double(confidence);
    description["face"]["bridged_frames"] = bridged;
    description["face"]["mean_confidence"] =
        rounded(sum / static_cast<double>(track.confidence.size()), 1e-3);
}

std::string face_text(const Json& face) {
    std::vector<std::string> units, parts;
    for (const Json& unit : face["units"]) {
        units.push_back(format("{} {:.1f}", unit["channel"].get<std::string>(), unit["most"].get<double>()));
    }
    std::string text = labelled_list("face, at most", units);
    if (face.contains("head_most_deg"))
        parts.push_back(format("the head turns up to {:.1f} degrees", face["head_most_deg"].get<double>()));
    if (face.contains("gaze_most_deg"))
        parts.push_back(format("the eyes up to {:.1f}", face["gaze_most_deg"].get<double>()));
    text += labelled_list("head, gaze", parts);
    if (face.contains("bridged_frames")) {
        text += labelled_list(
            "tracking", {format("{} frames bridged", face["bridged_frames"].get<size_t>()),
                         format("confidence {:.2f} on average", face["mean_confidence"].get<double>())});
    }
    return text;
}

std::vector<std::string> strings(const Json& array) {
    return array.get<std::vector<std::string>>();
}

// A face of many numbered points would fill the screen.
std::vector<std::string> without_face_points(std::vector<std::string> names) {
    const auto points = std::erase_if(names, is_face_point);
    if (points > 0) names.push_back(format("{} points of the face", points));
    return names;
}

std::string keypoints_text(std::string_view label, const Json& points) {
    std::string text = labelled_list(label, without_face_points(strings(points["keypoints"])));
    text += labelled_list("missing",
                          {format("{:.1f} % of the places", 100 * points["missing_share"].get<double>())});
    const auto mostly = without_face_points(strings(points["mostly_missing"]));
    if (!mostly.empty()) text += labelled_list("rarely seen", mostly);
    return text;
}

}  // namespace

Json describe_motion(const Motion& motion) {
    Json description;
    description["source"] = motion.source;
    description["fps"] = rounded(motion.fps, 1e-6);
    description["frames"] = motion.frames;
    description["duration_s"] = rounded(duration(motion), 1e-6);
    if (motion.joints) add_joints(description, motion, *motion.joints);
    if (motion.keypoints) add_keypoints(description, motion, *motion.keypoints);
    if (motion.picture) {
        Json& picture = description["picture"] = Json::object();
        add_keypoints(picture, motion, *motion.picture);
        const Vec2 size = motion.picture->size;
        if (size.x > 0) picture["size"] = {size.x, size.y};
        if (motion.picture->focal > 0) picture["focal_px"] = motion.picture->focal;
    }
    if (motion.face) add_face(description, motion, *motion.face);
    for (const LabelTrack& track : motion.labels) description["labels"][track.name] = track.values;
    description["notes"] = motion.notes;
    return description;
}

std::string motion_text(const Json& description) {
    std::string text = labelled_list("motion", {description["source"].get<std::string>()});
    text +=
        labelled_list("length", {format("{} frames at {:.6g} frames/s", description["frames"].get<size_t>(),
                                        description["fps"].get<double>()),
                                 format("{:.3f} s", description["duration_s"].get<double>())});
    if (description.contains("joints")) {
        text += labelled_list("joints",
                              {format("{}, of which {} play a part of a humanoid; the root goes {:.2f} m",
                                      description["joints"].size(), description["humanoid"].size(),
                                      description["root_path_m"].get<double>())});
    }
    if (description.contains("keypoints")) text += keypoints_text("keypoints", description);
    if (description.contains("picture")) text += keypoints_text("picture", description["picture"]);
    if (description.contains("face")) text += face_text(description["face"]);
    if (description.contains("labels")) {
        std::vector<std::string> tracks;
        for (const auto& [name, values] : description["labels"].items())
            tracks.push_back(format("{} ({})", name, values.size()));
        text += labelled_list("labels", tracks);
    }
    std::string_view label = "notes";
    for (const std::string& note : strings(description["notes"])) {
        text += labelled_list(std::exchange(label, ""), {note});
    }
    return text;
}

}  // namespace chironomia
