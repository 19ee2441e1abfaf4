#include "skinning/sketch/stick_points.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/quantile.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/lift/body_scale.h"

namespace chironomia {
namespace {

using enum Landmark;

// An adult of 1.72 m in a T-pose who faces +z, left side: the lengths are those of
// skinning/lift/body_scale.h.
struct RestPlace {
    Landmark landmark;
    Vec3 place;
};
constexpr float kHip = 0.93f, kShoulder = 1.43f;
const RestPlace kRest[] = {
    {pelvis, {0, kHip, 0}},
    {spine, {0, 1.05f, 0}},
    {chest, {0, 1.17f, 0}},
    {upper_chest, {0, 1.3f, 0}},
    {thorax, {0, kShoulder, 0}},
    {neck, {0, 1.46f, 0}},
    {head, {0, 1.56f, 0}},
    {head_top, {0, 1.72f, 0}},
    {nose, {0, 1.58f, 0.1f}},
    {jaw, {0, 1.53f, 0.04f}},
    {left_eye, {0.032f, 1.62f, 0.08f}},
    {left_eye_inner, {0.02f, 1.62f, 0.085f}},
    {left_eye_outer, {0.045f, 1.62f, 0.07f}},
    {left_ear, {0.075f, 1.59f, 0}},
    {left_mouth, {0.025f, 1.54f, 0.09f}},
    {left_collar, {0.03f, 1.42f, 0}},
    {left_shoulder, {0.18f, kShoulder, 0}},
    {left_elbow, {0.465f, kShoulder, 0}},
    {left_wrist, {0.72f, kShoulder, 0}},
    {left_hand, {0.79f, kShoulder, 0}},
    {left_hip, {0.105f, kHip, 0}},
    {left_knee, {0.105f, 0.5f, 0}},
    {left_ankle, {0.105f, 0.08f, 0}},
    {left_heel, {0.105f, 0.02f, -0.05f}},
    {left_toe, {0.105f, 0.02f, 0.16f}},
    {left_small_toe, {0.14f, 0.02f, 0.13f}},
};

// An adult in metres, from the lengths above, for the size of others.
struct UsualLength {
    Landmark from, to;
    float length;
};
const UsualLength kUsual[] = {
    {left_shoulder, right_shoulder, 0.36f}, {left_shoulder, left_elbow, 0.285f},
    {right_shoulder, right_elbow, 0.285f},  {left_elbow, left_wrist, 0.255f},
    {right_elbow, right_wrist, 0.255f},     {left_hip, left_knee, 0.43f},
    {right_hip, right_knee, 0.43f},         {left_knee, left_ankle, 0.42f},
    {right_knee, right_ankle, 0.42f},       {left_shoulder, left_hip, 0.506f},
    {right_shoulder, right_hip, 0.506f},
};

constexpr size_t at(Landmark landmark) {
    return static_cast<size_t>(landmark);
}

bool is_between(Landmark landmark, Landmark first, Landmark last) {
    return at(landmark) >= at(first) && at(landmark) <= at(last);
}

bool is_left(Landmark landmark) {
    return name_of(landmark).starts_with("left_");
}

Vec3 finger_rest(size_t index) {
    const auto finger = static_cast<float>(index / 4), bone = static_cast<float>(index % 4);
    if (finger == 0) return {0.75f + 0.028f * bone, kShoulder, 0.03f + 0.02f * bone};
    return {0.805f + 0.028f * bone, kShoulder, 0.03f - 0.02f * (finger - 1)};
}

Vec3 rest_of(Landmark landmark) {
    const Landmark left = is_left(landmark) ? landmark : mirrored(landmark);
    Vec3 place = left >= left_thumb_1 ? finger_rest(at(left) - at(left_thumb_1)) : Vec3(0);
    for (const RestPlace& rest : kRest) {
        if (rest.landmark == left) place = rest.place;
    }
    return left == landmark ? place : Vec3(-place.x, place.y, place.z);
}

StickKind kind_of(Landmark landmark) {
    const bool left = is_left(landmark);
    if (landmark >= left_thumb_1) return left ? StickKind::left_hand : StickKind::right_hand;
    if (is_between(landmark, left_hip, right_small_toe))
        return left ? StickKind::left_leg : StickKind::right_leg;
    if (is_between(landmark, left_collar, right_hand))
        return left ? StickKind::left_arm : StickKind::right_arm;
    if (is_between(landmark, nose, right_mouth)) return StickKind::face;
    return StickKind::trunk;
}

// The parts that a camera is set up by, whether the motion has them or not.
constexpr std::pair<HumanJoint, Landmark> kParts[] = {
    {HumanJoint::hips, pelvis},
    {HumanJoint::neck, thorax},
    {HumanJoint::head, head},
    {HumanJoint::left_upper_arm, left_shoulder},
    {HumanJoint::left_lower_arm, left_elbow},
    {HumanJoint::left_hand, left_wrist},
    {HumanJoint::left_upper_leg, left_hip},
    {HumanJoint::left_lower_leg, left_knee},
    {HumanJoint::left_foot, left_ankle},
    {HumanJoint::left_toes, left_toe},
    {HumanJoint::right_upper_arm, right_shoulder},
    {HumanJoint::right_lower_arm, right_elbow},
    {HumanJoint::right_hand, right_wrist},
    {HumanJoint::right_upper_leg, right_hip},
    {HumanJoint::right_lower_leg, right_knee},
    {HumanJoint::right_foot, right_ankle},
    {HumanJoint::right_toes, right_toe},
};

// The number of a point of OpenPose's face, "face_17", or nothing.
std::optional<int> face_point(std::string_view name) {
    constexpr std::string_view kBegin = "face_";
    if (!name.starts_with(kBegin)) return std::nullopt;
    int number = 0;
    const auto [end, error] = std::from_chars(name.data() + kBegin.size(), name.data() + name.size(), number);
    if (error != std::errc() || end != name.data() + name.size() || number < 0 || number > 69)
        return std::nullopt;
    return number;
}

Vec3 face_rest(int number) {
    const float angle = 2 * kPi * static_cast<float>(number) / 70;
    return {0.05f * std::cos(angle), 1.6f + 0.06f * std::sin(angle), 0.09f};
}

// Lines of OpenPose's 70 points of a face: jaw, brows, nose, eyes, lips; 68 and 69 are the pupils.
struct FaceLine {
    int first, last;
    bool closed;
};
constexpr size_t kChin = 8;
constexpr FaceLine kFaceLines[] = {{0, 16, false},  {17, 21, false}, {22, 26, false},
                                   {27, 30, false}, {31, 35, false}, {36, 41, true},
                                   {42, 47, true},  {48, 59, true},  {60, 67, true}};

// A track's points, by what they are; tracks in space and in a picture alike.
struct SeenPoints {
    const std::vector<std::string>& names;
    const std::vector<float>& confidence;
    std::vector<Vec3> places;  // (T, K)
    size_t frames;
};

class Sketcher {
  public:
    explicit Sketcher(const SeenPoints& track) : track_(track) {
        for (size_t k = 0; k < track.names.size(); ++k) {
            const auto landmark = landmark_named(track.names[k]);
            if (landmark && !sources_[at(*landmark)] && ever_seen(k)) sources_[at(*landmark)] = k;
            const auto number = face_point(track.names[k]);
            if (number && ever_seen(k)) faces_[static_cast<size_t>(*number)] = k;
        }
    }

    bool has(Landmark landmark) const { return sources_[at(landmark)].has_value(); }

    StickSketch sketch() {
        add_points();
        add_trunk();
        add_sides();
        add_face();
        add_places();
        for (const auto& [part, landmark] : kParts)
            result_.parts[part] = static_cast<int>(*points_[at(landmark)]);
        if (!has(head))
            result_.parts[HumanJoint::head] = static_cast<int>(*points_[at(has(nose) ? nose : thorax)]);
        return std::move(result_);
    }

  private:
    bool ever_seen(size_t k) const {
        for (size_t t = 0; t < track_.frames; ++t) {
            if (track_.confidence[t * track_.names.size() + k] >= kSeen) return true;
        }
        return false;
    }

    // Where the motion has no middle of the shoulders or the hips, lines meet there all the same.
    bool is_middle(Landmark landmark) const {
        if (has(landmark)) return false;
        if (landmark == thorax) return !has(neck) && has(left_shoulder) && has(right_shoulder);
        return landmark == pelvis && has(left_hip) && has(right_hip);
    }
    bool is_drawn(Landmark landmark) const { return has(landmark) || is_middle(landmark); }

    void add_points() {
        for (int i = 0; i < kLandmarks; ++i) {
            const auto landmark = static_cast<Landmark>(i);
            const bool needed = landmark == head_top ||
                                std::any_of(std::begin(kParts), std::end(kParts),
                                            [&](const auto& part) { return part.second == landmark; });
            if (!is_drawn(landmark) && !needed) continue;
            points_[at(landmark)] = result_.points.size();
            result_.points.push_back({.name = std::string(name_of(landmark)),
                                      .kind = kind_of(landmark),
                                      .rest = rest_of(landmark),
                                      .dot = has(landmark),
                                      .foot = is_between(landmark, left_ankle, right_small_toe)});
        }
        for (size_t i = 0; i < faces_.size(); ++i) {
            if (!faces_[i]) continue;
            face_points_[i] = result_.points.size();
            result_.points.push_back({.name = track_.names[*faces_[i]],
                                      .kind = StickKind::face,
                                      .rest = face_rest(static_cast<int>(i)),
                                      .dot = i == kChin || i >= 68});
        }
    }

    // Joins those of a row that the motion has.
    void chain(std::initializer_list<Landmark> row, std::optional<StickKind> kind = {}) {
        std::optional<Landmark> before;
        for (const Landmark landmark : row) {
            if (!is_drawn(landmark)) continue;
            if (before) {
                result_.lines.push_back({.from = *points_[at(*before)],
                                         .to = *points_[at(landmark)],
                                         .kind = kind.value_or(kind_of(landmark))});
            }
            before = landmark;
        }
    }

    void add_trunk() {
        chain({pelvis, spine, chest, upper_chest, thorax, neck}, StickKind::trunk);
        const Landmark top = has(neck) ? neck : is_drawn(thorax) ? thorax : upper_chest;
        if (has(head)) {
            chain({top, head, head_top}, StickKind::trunk);
        } else {
            chain({top, nose, head_top}, StickKind::trunk);
            if (has(nose)) result_.points[*points_[at(nose)]].kind = StickKind::trunk;
        }
        if (face_points_[kChin] && is_drawn(top))
            result_.lines.push_back({*points_[at(top)], *face_points_[kChin], StickKind::trunk});
    }

    void add_sides() {
        for (const bool left : {true, false}) {
            const auto side = [left](Landmark landmark) { return left ? landmark : mirrored(landmark); };
            const Landmark root = is_drawn(thorax) ? thorax : has(upper_chest) ? upper_chest : neck;
            chain({root, side(left_collar), side(left_shoulder), side(left_elbow), side(left_wrist)});
            chain({pelvis, side(left_hip), side(left_knee), side(left_ankle), side(left_toe)});
            chain({side(left_ankle), side(left_heel)});
            chain({side(left_ankle), side(left_small_toe)});
            bool fingers = false;
            for (size_t first = at(left_thumb_1); first <= at(left_little_1); first += 4) {
                const auto bone = [&](size_t i) { return side(static_cast<Landmark>(first + i)); };
                chain({side(left_wrist), bone(0), bone(1), bone(2), bone(3)});
                for (size_t i = 0; i < 4; ++i) fingers = fingers || has(bone(i));
            }
            if (!fingers) chain({side(left_wrist), side(left_hand)});
        }
    }

    void add_face() {
        chain({nose, left_eye_inner, left_eye, left_eye_outer, left_ear});
        chain({nose, right_eye_inner, right_eye, right_eye_outer, right_ear});
        chain({left_mouth, right_mouth});
        for (const FaceLine& line : kFaceLines) {
            for (int i = line.first; i <= line.last; ++i) {
                const auto here = face_points_[static_cast<size_t>(i)];
                if (i == line.last && !line.closed) break;
                const auto next = face_points_[static_cast<size_t>(i == line.last ? line.first : i + 1)];
                if (here && next) result_.lines.push_back({*here, *next, StickKind::face});
            }
        }
    }

    void add_places() {
        result_.frames = track_.frames;
        result_.places.assign(track_.frames * result_.points.size(), Vec3(0));
        result_.seen.assign(result_.places.size(), false);
        for (int i = 0; i < kLandmarks; ++i) {
            const auto landmark = static_cast<Landmark>(i);
            if (has(landmark)) copy(*sources_[at(landmark)], *points_[at(landmark)]);
        }
        for (size_t i = 0; i < faces_.size(); ++i) {
            if (faces_[i]) copy(*faces_[i], *face_points_[i]);
        }
        if (is_middle(thorax)) set_middle(thorax, left_shoulder);
        if (is_middle(pelvis)) set_middle(pelvis, left_hip);
    }

    void copy(size_t source, size_t point) {
        for (size_t t = 0; t < track_.frames; ++t) {
            const size_t from = t * track_.names.size() + source, to = t * result_.points.size() + point;
            if (track_.confidence[from] < kSeen) continue;
            result_.places[to] = track_.places[from];
            result_.seen[to] = true;
        }
    }

    void set_middle(Landmark middle, Landmark left) {
        const size_t a = *points_[at(left)], b = *points_[at(mirrored(left))];
        for (size_t t = 0; t < track_.frames; ++t) {
            const size_t to = t * result_.points.size() + *points_[at(middle)];
            result_.seen[to] = result_.sees(t, a) && result_.sees(t, b);
            if (result_.seen[to]) result_.places[to] = (result_.place(t, a) + result_.place(t, b)) * 0.5f;
        }
    }

    const SeenPoints& track_;
    std::array<std::optional<size_t>, kLandmarks> sources_{};
    std::array<std::optional<size_t>, 70> faces_{};
    std::array<std::optional<size_t>, kLandmarks> points_{};
    std::array<std::optional<size_t>, 70> face_points_{};
    StickSketch result_;
};

StickSketch sketch_points(const SeenPoints& track, const std::string& source) {
    Sketcher sketcher(track);
    for (const Landmark shoulder : {left_shoulder, right_shoulder}) {
        if (sketcher.has(shoulder)) continue;
        throw Error(
            format("{}: {} is not seen in any of its {} frames; both shoulders are needed to place a stick "
                   "figure, choose a motion that has them",
                   source, name_of(shoulder), track.frames));
    }
    return sketcher.sketch();
}

// The person's size against an adult's: of all bones together, each at its median length.
float size_of(const StickSketch& sketch) {
    double sum = 0, usual_sum = 0;
    for (const auto& [from, to, usual] : kUsual) {
        const auto find = [&](Landmark landmark) {
            const auto& points = sketch.points;
            return static_cast<size_t>(
                std::find_if(points.begin(), points.end(),
                             [&](const StickPoint& point) { return point.name == name_of(landmark); }) -
                points.begin());
        };
        const size_t a = find(from), b = find(to);
        std::vector<float> lengths;
        for (size_t t = 0; t < sketch.frames; ++t) {
            if (sketch.sees(t, a) && sketch.sees(t, b))
                lengths.push_back(distance(sketch.place(t, a), sketch.place(t, b)));
        }
        if (lengths.empty()) continue;
        sum += static_cast<double>(median(std::move(lengths)));
        usual_sum += static_cast<double>(usual);
    }
    return sum > 0 ? static_cast<float>(sum / usual_sum) : 1;
}

// What gestures lies before what does not; the arms one before the other.
float layer_of(StickKind kind) {
    switch (kind) {
        case StickKind::left_arm:
            return 0.03f;
        case StickKind::right_arm:
            return 0.04f;
        case StickKind::left_hand:
        case StickKind::right_hand:
            return 0.05f;
        case StickKind::face:
            return 0.02f;
        default:
            return 0;
    }
}

}  // namespace

void prefer_outline(StickSketch& sketch) {
    const auto find = [&](std::string_view name) {
        const auto found = std::find_if(sketch.points.begin(), sketch.points.end(),
                                        [&](const StickPoint& point) { return point.name == name; });
        return static_cast<size_t>(found - sketch.points.begin());
    };
    const size_t chin = find(format("face_{}", kChin));
    if (chin == sketch.points.size()) return;
    for (const Landmark landmark : {nose, left_eye, right_eye, left_ear, right_ear}) {
        const size_t point = find(name_of(landmark));
        for (size_t t = 0; point < sketch.points.size() && t < sketch.frames; ++t) {
            if (sketch.sees(t, chin)) sketch.seen[t * sketch.points.size() + point] = false;
        }
    }
}

void keep_nose_and_eyes(StickSketch& sketch) {
    for (size_t p = 0; p < sketch.points.size(); ++p) {
        const StickPoint& point = sketch.points[p];
        const bool kept = point.name == name_of(nose) || point.name == name_of(left_eye) ||
                          point.name == name_of(right_eye);
        if (point.kind != StickKind::face || kept) continue;
        for (size_t t = 0; t < sketch.frames; ++t) sketch.seen[t * sketch.points.size() + p] = false;
    }
}

StickSketch sketch_keypoints(const Motion& motion) {
    const KeypointTrack& track = *motion.keypoints;
    const SeenPoints points{.names = track.names,
                            .confidence = track.confidence,
                            .places = track.points,
                            .frames = motion.frames};
    StickSketch sketch = sketch_points(points, motion.source);
    sketch.size = size_of(sketch);
    for (StickPoint& point : sketch.points) point.rest *= sketch.size;
    return sketch;
}

StickSketch sketch_picture(const Motion& motion) {
    const PictureTrack& track = *motion.picture;
    // Only its scale and its middle are used, so nothing needs to be smoothed or bridged.
    const CleanPicture seen =
        clean_picture(track, motion.frames, {.fps = motion.fps, .longest_bridge = 0, .cutoff = 0});
    const PinholeCamera camera =
        find_body_scale(seen.body, PinholeCamera().distance, centre_of(seen.body, Vec2(0))).camera;
    SeenPoints points{
        .names = track.names, .confidence = track.confidence, .places = {}, .frames = motion.frames};
    for (const Vec2& point : track.points) points.places.emplace_back(camera.place(point, 0));
    StickSketch sketch = sketch_points(points, motion.source);
    for (size_t i = 0; i < sketch.places.size(); ++i)
        sketch.places[i].z = layer_of(sketch.points[i % sketch.points.size()].kind);
    return sketch;
}

}  // namespace chironomia
