#include "skinning/motion/points/point_naming.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/files/json.h"
#include "core/text.h"
#include "skinning/body/body_proportions.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/body/odd_arrangement.h"

namespace chironomia {
namespace {

constexpr double kAtHips = 0.1;       // ours: hips may lie so far from MediaPipe's origin [m]
constexpr double kFarthest = 1e9;     // [the file's unit]; what is not nearer is no place
constexpr size_t kFewestFrames = 10;  // ours: fewer may show a body in any posture

std::string known_layouts(bool picture) {
    std::vector<std::string> names;
    for (const KeypointLayout& layout : picture_layouts()) {
        if (picture) names.emplace_back(layout.name);
    }
    for (const KeypointLayout& layout : keypoint_layouts()) names.emplace_back(layout.name);
    return join(names);
}

PointNaming naming_of(const KeypointLayout& layout, std::string how) {
    PointNaming naming{.names = {}, .zero_is_missing = layout.zero_is_missing, .how = std::move(how)};
    for (const LayoutPoint& point : layout.points) naming.names.push_back(point.name());
    return naming;
}

class TrackMaker {
  public:
    TrackMaker(const KeypointData& data, const PointNaming& naming) : data_(data), naming_(naming) {}

    KeypointTrack run() {
        std::vector<size_t> kept;
        for (size_t k = 0; k < data_.points; ++k) {
            if (naming_.names[k].empty()) continue;
            kept.push_back(k);
            track_.names.push_back(naming_.names[k]);
        }
        for (size_t t = 0; t < data_.frames; ++t) {
            for (const size_t k : kept) append(t, k);
            if (kept.size() > 2) drop_empty_frame(kept.size());
        }
        if (std::all_of(track_.confidence.begin(), track_.confidence.end(), [](float c) { return c == 0; })) {
            throw Error(format("{}: every point of every frame is missing", data_.where));
        }
        return std::move(track_);
    }

  private:
    std::string place_name(size_t t, size_t k) const {
        return format("frame {}, point \"{}\"", t, data_.names.empty() ? naming_.names[k] : data_.names[k]);
    }

    void append(size_t t, size_t k) {
        const size_t i = t * data_.points + k;
        const glm::dvec3 place(data_.places[3 * i], data_.places[3 * i + 1], data_.places[3 * i + 2]);
        const double confidence = confidence_of(t, k, place);
        if (confidence > 0 && !(glm::length(place) < kFarthest)) {
            throw Error(format(
                "{}: {}: the place ({}, {}, {}) is no place; set the confidence of missing points to 0",
                data_.where, place_name(t, k), place.x, place.y, place.z));
        }
        track_.points.push_back(confidence > 0 ? Vec3(place) : Vec3(0));
        track_.confidence.push_back(static_cast<float>(confidence));
    }

    // A frame whose points all lie at the origin was filled with zeros, as nobody was seen, be one of them a pelvis.
    void drop_empty_frame(size_t points) {
        const auto begin = track_.points.end() - static_cast<std::ptrdiff_t>(points);
        if (std::any_of(begin, track_.points.end(), [](const Vec3& place) { return place != Vec3(0); }))
            return;
        std::fill(track_.confidence.end() - static_cast<std::ptrdiff_t>(points), track_.confidence.end(),
                  0.0f);
    }

    double confidence_of(size_t t, size_t k, const glm::dvec3& place) const {
        const bool zero = place == glm::dvec3(0) && naming_.zero_is_missing &&
                          (data_.picture || naming_.names[k] != name_of(Landmark::pelvis));
        if (zero) return 0;
        if (data_.confidence.empty()) return glm::any(glm::isnan(place)) ? 0 : 1;
        const double confidence = data_.confidence[t * data_.points + k];
        if (std::isnan(confidence)) return 0;
        if (confidence < 0 || confidence > kMostConfidence) {
            throw Error(format(
                "{}: {}: the confidence {} does not lie between 0 and 1, as most do; set it to 0 where "
                "the point is missing, or divide all by their scale",
                data_.where, place_name(t, k), confidence));
        }
        return std::min(confidence, 1.0);
    }

    const KeypointData& data_;
    const PointNaming& naming_;
    KeypointTrack track_;
};

// The layout of a picture, or all layouts of so many points in space.
std::vector<KeypointLayout> layouts_by_count(const KeypointData& data) {
    std::vector<KeypointLayout> fitting;
    for (const KeypointLayout& layout : picture_layouts()) {
        if (data.picture && layout.points.size() == data.points) return {layout};
    }
    for (const KeypointLayout& layout : keypoint_layouts()) {
        if (layout.points.size() != data.points) continue;
        // What lifts points into space reads those of detectors in the order of Human3.6M; detectors give their own.
        const bool own =
            data.picture && !layout.name.starts_with("Human") && !layout.name.starts_with("Kinect");
        fitting.insert(own ? fitting.begin() : fitting.end(), layout);
    }
    return fitting;
}

[[noreturn]] void refuse_order(const KeypointData& data, const std::vector<KeypointLayout>& layouts,
                               const std::string& what) {
    std::vector<std::string> names;
    for (const KeypointLayout& layout : layouts) names.emplace_back(layout.name);
    throw Error(
        format("{}: {} points without names are by their number those of {}, but {}; name the points with "
               "--names",
               data.where, data.points, join(names, " or "), what));
}

// How odd a body the points of a picture make under these names, if enough is seen of it. Shares of width and height
// are judged in the usual shapes of pictures.
std::optional<double> oddness_in_picture(const KeypointData& data, PointNaming naming) {
    naming.zero_is_missing = true;
    KeypointTrack track = TrackMaker(data, naming).run();
    const bool are_shares = std::all_of(track.points.begin(), track.points.end(), [](const Vec3& point) {
        return std::abs(point.x) <= 2 && std::abs(point.y) <= 2;
    });
    std::optional<double> least;
    for (const float wide : {1.0f, 16.0f / 9, 9.0f / 16}) {
        if (wide != 1 && !are_shares) continue;
        KeypointTrack shaped = track;
        for (Vec3& point : shaped.points) point.x *= wide;
        const auto places = implausible_places(shaped), bones = implausible_bones(shaped, Seen::in_picture);
        if (places && bones) least = std::min(least.value_or(*places + *bones), *places + *bones);
    }
    return least;
}

// Of the layouts with so many points the usual one of pictures, unless another makes much more of a body.
PointNaming name_picture_by_count(const KeypointData& data, const std::vector<KeypointLayout>& layouts) {
    std::optional<PointNaming> best;
    double least = 0;
    for (const KeypointLayout& layout : layouts) {
        PointNaming naming = naming_of(layout, format("picture: {}, by the number of points", layout.name));
        const std::optional<double> odd = oddness_in_picture(data, naming);
        if (best && (!odd || *odd > std::min(least - kClearlyLessOdd, kTooOddInPicture))) continue;
        if (best) naming.how += " and by where they lie";
        best = std::move(naming);
        least = odd.value_or(0);
    }
    if (least > kTooOddInPicture && !data.known_order && data.frames >= kFewestFrames) {
        refuse_order(
            data, layouts,
            "they do not lie as those of a body in a picture (the nose above the shoulders, these above the "
            "hips, eyes near the nose, bones as long as an adult's): the points have another order, or they are no places");
    }
    return *best;
}

// Bones to points that nobody filled say nothing.
KeypointTrack without_zeros(const KeypointData& data, PointNaming naming) {
    naming.zero_is_missing = true;
    return TrackMaker(data, naming).run();
}

// How far points in space are from a body under their names; nothing: too little is seen to know.
struct BodyOdds {
    std::optional<double> bones{}, places{};

    bool are_too_odd() const {
        return bones.value_or(0) >= kTooOdd || places.value_or(0) >= kTooOddArrangement;
    }

    std::string what() const {
        if (bones.value_or(0) >= kTooOdd) {
            return format(
                "{:.0f} % of their bones are much longer or shorter than those of a body, or change their "
                "lengths",
                100 * *bones);
        }
        return format(
            "{:.0f} % of their parts are far from their neighbours, on the wrong side of them, or longer on one "
            "side of the body",
            100 * places.value_or(0));
    }
};

BodyOdds odds_of(const KeypointData& data, const PointNaming& naming) {
    const KeypointTrack track = without_zeros(data, naming);
    return {.bones = implausible_bones(track), .places = odd_arrangement(track)};
}

// Numbers that are called like points may be turns or velocities of joints.
void refuse_odd_body(const KeypointData& data, const PointNaming& naming) {
    if (data.picture || data.in_space || data.known_order || data.names.empty()) return;
    BodyOdds odds = odds_of(data, naming);
    // Turns of joints that do not move are 0 as well.
    if (!odds.bones && !naming.zero_is_missing)
        odds.bones = implausible_bones(TrackMaker(data, naming).run());
    if (!odds.are_too_odd()) return;
    throw Error(format(
        "{}: the points by their names make no body: {}; give places, not turns or velocities, or name "
        "the points with --names",
        data.where, odds.what()));
}

// Of the layouts with so many points the one whose bones are those of a body.
PointNaming name_by_count(const KeypointData& data) {
    const std::vector<KeypointLayout> layouts = layouts_by_count(data);
    if (layouts.empty()) {
        throw Error(
            format("{}: {} points without names; known by their number are {}; name the points with --names",
                   data.where, data.points, known_layouts(data.picture)));
    }
    if (data.picture) return name_picture_by_count(data, layouts);
    if (data.in_space)
        return naming_of(layouts[0], format("keypoints: {}, by the number of points", layouts[0].name));
    std::optional<PointNaming> best;
    double least = 0;
    for (const KeypointLayout& layout : layouts) {
        PointNaming naming = naming_of(layout, format("keypoints: {}, by the number of points", layout.name));
        const std::optional<double> odd = implausible_bones(without_zeros(data, naming));
        if (layouts.size() > 1 && !odd) continue;
        if (best && odd.value_or(0) >= least) continue;
        least = odd.value_or(0);
        best = std::move(naming);
    }
    const BodyOdds odds = best ? odds_of(data, *best) : BodyOdds();
    if (!odds.bones && !odds.places)
        refuse_order(data, layouts, "too few arms, legs, shoulders and hips are seen to know which");
    if (odds.are_too_odd())
        refuse_order(data, layouts, odds.what() + ": the points have another order, or they are no places");
    return *best;
}

std::optional<std::string> name_in(const KeypointLayout& layout, std::string_view name) {
    for (const LayoutPoint& point : layout.points) {
        if (to_lower(point.theirs) == to_lower(name)) return point.name();
    }
    return std::nullopt;
}

// The layout all of whose points have these names, or nothing.
std::optional<PointNaming> name_by_layout(const KeypointData& data) {
    std::vector<KeypointLayout> layouts = keypoint_layouts();
    if (data.picture) layouts.insert(layouts.begin(), picture_layouts().begin(), picture_layouts().end());
    for (const KeypointLayout& layout : layouts) {
        if (layout.points.size() != data.points) continue;
        PointNaming naming{.names = {}, .zero_is_missing = layout.zero_is_missing, .how = ""};
        for (const std::string& theirs : data.names) {
            auto ours = name_in(layout, theirs);
            if (!ours) break;
            naming.names.push_back(std::move(*ours));
        }
        naming.how = format("keypoints: {}, by their names", layout.name);
        if (naming.names.size() == data.points) return naming;
    }
    return std::nullopt;
}

// "left_foot" is the ankle unless the file has an ankle, too; then it is the toe.
std::optional<Landmark> foot_or_ankle(const KeypointData& data, std::optional<Landmark> landmark,
                                      std::string_view name) {
    const bool foot = to_lower(name).find("foot") != std::string::npos;
    if (!foot || (landmark != Landmark::left_ankle && landmark != Landmark::right_ankle)) return landmark;
    const bool has_ankle = std::any_of(data.names.begin(), data.names.end(), [&](const std::string& other) {
        return other != name && landmark_spelled(other) == landmark;
    });
    if (!has_ankle) return landmark;
    return landmark == Landmark::left_ankle ? Landmark::left_toe : Landmark::right_toe;
}

// Points of a face are only known in pictures.
std::string spelled_name(const KeypointData& data, const std::string& name) {
    if (data.picture && is_face_point(name)) return name;
    const auto landmark = foot_or_ankle(data, landmark_spelled(name), name);
    return landmark ? std::string(name_of(*landmark)) : "";
}

// What Apple's Vision writes for the points of VNHumanBodyPoseObservation: words of joints for points of a detector.
// Its "head_joint" is the nose, its neck the middle between the shoulders.
constexpr std::array<std::pair<std::string_view, Landmark>, 19> kAppleVision = {{
    {"head_joint", Landmark::nose},
    {"left_eye_joint", Landmark::left_eye},
    {"right_eye_joint", Landmark::right_eye},
    {"left_ear_joint", Landmark::left_ear},
    {"right_ear_joint", Landmark::right_ear},
    {"neck_1_joint", Landmark::thorax},
    {"left_shoulder_1_joint", Landmark::left_shoulder},
    {"right_shoulder_1_joint", Landmark::right_shoulder},
    {"left_forearm_joint", Landmark::left_elbow},
    {"right_forearm_joint", Landmark::right_elbow},
    {"left_hand_joint", Landmark::left_wrist},
    {"right_hand_joint", Landmark::right_wrist},
    {"root", Landmark::pelvis},
    {"left_upLeg_joint", Landmark::left_hip},
    {"right_upLeg_joint", Landmark::right_hip},
    {"left_leg_joint", Landmark::left_knee},
    {"right_leg_joint", Landmark::right_knee},
    {"left_foot_joint", Landmark::left_ankle},
    {"right_foot_joint", Landmark::right_ankle},
}};

// Some or all of Vision's points and no others, in any order. ARKit has the same words for the joints of its skeleton,
// but always an arm_joint, too.
std::optional<PointNaming> name_by_apple_vision(const KeypointData& data) {
    if (!data.picture) return std::nullopt;
    PointNaming naming{.names = {}, .how = "picture: Apple Vision, by its names"};
    for (const std::string& name : data.names) {
        const auto known = std::find_if(kAppleVision.begin(), kAppleVision.end(),
                                        [&](const auto& each) { return each.first == name; });
        if (known == kAppleVision.end()) return std::nullopt;
        naming.names.emplace_back(name_of(known->second));
    }
    return naming;
}

// Points that are called like joints ("LeftArm", "LeftForeArm") mean other places than those of detectors: the shoulder
// of a rig is the inner end of the clavicle.
PointNaming name_by_spelling(const KeypointData& data) {
    PointNaming naming{.names = {}, .how = "keypoints: by their names"};
    for (const std::string& name : data.names) naming.names.push_back(spelled_name(data, name));
    const auto knows = [&](std::string_view name) {
        return std::find(naming.names.begin(), naming.names.end(), name) != naming.names.end();
    };
    if (knows("left_elbow") || knows("right_elbow")) return naming;
    std::vector<std::string> joints = names_of_joints(data.names);
    if (!joints.empty()) naming = {.names = std::move(joints), .how = "keypoints: joints, by their names"};
    return naming;
}

std::vector<std::string> landmark_names() {
    std::vector<std::string> names;
    for (int i = 0; i < kLandmarks; ++i) names.emplace_back(name_of(static_cast<Landmark>(i)));
    return names;
}

Landmark mapped_landmark(const std::string& ours, const std::string& theirs, const std::string& where) {
    if (const auto landmark = landmark_named(ours)) return *landmark;
    const auto near = nearest_name(ours, landmark_names());
    throw Error(format("{}: \"{}\" is mapped to \"{}\", which is no point{}", where, theirs, ours,
                       near ? format("; did you mean \"{}\"?", *near)
                            : "; points are called like \"nose\", \"left_wrist\" or \"right_index_1\""));
}

// Their name -> our name, or "" to drop it.
std::map<std::string, std::string> read_name_map(const std::filesystem::path& file) {
    const Json json = read_json(file);
    if (!json.is_object())
        throw Error(format("{}: a name map is an object {{\"their name\": \"our name\"}}", file.string()));
    std::map<std::string, std::string> map;
    for (const auto& [theirs, ours] : json.items()) {
        if (!ours.is_null() && !ours.is_string()) {
            throw Error(format("{}: \"{}\" is mapped to {}; a name or null is expected", file.string(),
                               theirs, ours.dump()));
        }
        const bool drops = ours.is_null() || ours == "-";
        map[theirs] =
            drops ? std::string()
                  : std::string(name_of(mapped_landmark(ours.get<std::string>(), theirs, file.string())));
    }
    return map;
}

// The map first, the spelling for all names that it leaves out.
PointNaming name_by_map(const KeypointData& data, const std::filesystem::path& file) {
    const auto map = read_name_map(file);
    PointNaming naming = name_by_spelling(data);
    naming.how = format("keypoints: by the name map {}", file.filename().string());
    for (size_t k = 0; k < data.names.size(); ++k) {
        const auto entry = map.find(data.names[k]);
        if (entry != map.end()) naming.names[k] = entry->second;
    }
    return naming;
}

// MediaPipe lists its landmarks in space, in metres from the middle of the hips, and in the picture, as shares of its
// sides with y down and a depth. Both have three numbers. Those are in the picture whose hips lie elsewhere and most of
// whose points lie inside of it.
bool are_shares(const KeypointData& data, size_t left_hip, size_t right_hip) {
    size_t frames = 0, elsewhere = 0, points = 0, inside = 0;
    for (size_t t = 0; t < data.frames; ++t) {
        const auto at = [&](size_t k) {
            const double* place = &data.places[3 * (t * data.points + k)];
            return glm::dvec2(place[0], place[1]);
        };
        const glm::dvec2 middle = 0.5 * (at(left_hip) + at(right_hip));
        if (!(glm::length(middle) < kFarthest) || middle == glm::dvec2(0)) continue;
        ++frames;
        elsewhere += glm::length(middle) > kAtHips;
        for (size_t k = 0; k < data.points; ++k) {
            const glm::dvec2 place = at(k);
            ++points;
            inside += place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1;
        }
    }
    return frames > 0 && 10 * elsewhere >= 9 * frames && 2 * inside >= points;
}

void take_shares_for_picture(KeypointData& data) {
    std::vector<std::string> names;
    for (const KeypointLayout& layout : keypoint_layouts()) {
        if (!layout.name.starts_with("MediaPipe") || layout.points.size() != data.points) continue;
        for (const LayoutPoint& point : layout.points) names.push_back(point.name());
    }
    if (!data.names.empty()) {
        const auto layout = name_by_layout(data);
        names = layout && layout->how.starts_with("keypoints: MediaPipe") ? layout->names
                                                                          : std::vector<std::string>();
    }
    const auto column = [&](std::string_view name) {
        return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const size_t left = column("left_hip"), right = column("right_hip");
    if (data.picture || data.in_space || left >= names.size() || right >= names.size() ||
        !are_shares(data, left, right))
        return;
    data.picture = true;
    for (size_t i = 2; i < data.places.size(); i += 3) data.places[i] = 0;
    data.notes.emplace_back(
        "picture: landmarks of MediaPipe in shares of its width and height, as the hips are not their origin");
}

// Whether the names are but numbers, which may have a word before them ("landmark_0"), and count up from 0 or 1.
bool are_numbers(const std::vector<std::string>& names) {
    if (names.empty() || names[0].empty()) return false;
    const size_t word = names[0].size() - 1;
    const auto first = parse_integer(names[0].substr(word));
    if (!first || *first > 1 || (word > 0 && parse_integer(names[0].substr(word - 1, 1)))) return false;
    for (size_t k = 0; k < names.size(); ++k) {
        if (names[k] != format("{}{}", names[0].substr(0, word), *first + static_cast<long long>(k)))
            return false;
    }
    return true;
}

// Names that say no more than the order, and a prefix that all have as FreeMoCap's "body_nose", are left out.
void simplify_names(std::vector<std::string>& names) {
    if (are_numbers(names) && !is_face_point(names[0])) return names.clear();
    const std::string_view prefix = "body_";
    const auto has_prefix = [&](const std::string& name) { return name.starts_with(prefix); };
    if (!std::ranges::all_of(names, has_prefix)) return;
    for (std::string& name : names) name.erase(0, prefix.size());
}

PointNaming choose_naming(KeypointData& data, const std::filesystem::path& name_map) {
    if (!data.ours.empty()) return {.names = data.ours, .how = ""};
    if (data.names.empty() && name_map.empty()) return name_by_count(data);
    for (size_t k = 0; data.names.size() < data.points; ++k) data.names.push_back(format("{}", k));
    if (!name_map.empty()) return name_by_map(data, name_map);
    if (const auto layout = name_by_layout(data)) return *layout;
    if (const auto vision = name_by_apple_vision(data)) return *vision;
    return name_by_spelling(data);
}

// No two points may be the same, and some must be known.
void check_naming(const KeypointData& data, const PointNaming& naming) {
    std::map<std::string, size_t> seen;
    for (size_t k = 0; k < data.points; ++k) {
        if (naming.names[k].empty()) continue;
        const auto [earlier, added] = seen.emplace(naming.names[k], k);
        if (added) continue;
        throw Error(
            format("{}: the points \"{}\" and \"{}\" both mean {}; give them different names with --names",
                   data.where, data.names[earlier->second], data.names[k], naming.names[k]));
    }
    if (seen.size() >= 3) return;
    throw Error(format("{}: {} of the {} points are known by their names ({}); name them with --names",
                       data.where, seen.size(), data.points, join(data.names).substr(0, 200)));
}

}  // namespace

KeypointTrack track_of(const KeypointData& data, const PointNaming& naming) {
    return TrackMaker(data, naming).run();
}

PointNaming find_naming(KeypointData& data, const std::filesystem::path& name_map) {
    if (name_map.empty() && data.ours.empty()) simplify_names(data.names);
    take_shares_for_picture(data);
    PointNaming naming = choose_naming(data, name_map);
    check_naming(data, naming);
    refuse_odd_body(data, naming);
    return naming;
}

}  // namespace chironomia
