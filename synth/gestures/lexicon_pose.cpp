#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.h"
#include "synth/body/agent_body.h"
#include "synth/gestures/lexicon_parts.h"
#include "synth/gestures/pose_arm.h"
#include "synth/gestures/sectors.h"

namespace chironomia {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};
// What an arm may ask for as a number: somewhat beyond the outermost sectors [arm lengths].
constexpr BendRange kSpace[] = {{-0.7, 1.3}, {-0.6, 1.6}, {-0.5, 1.1}};
constexpr BendRange kWeights = {0.01, 100};
constexpr BendRange kSwivel = {0, 1.57};     // [rad]
constexpr BendRange kRadius = {0.005, 0.5};  // [arm lengths]
constexpr BendRange kTurns = {0.1, 10};

const std::map<std::string, GesturePhase> kPhases = {{"preparation", GesturePhase::preparation},
                                                     {"pre-stroke-hold", GesturePhase::pre_stroke_hold},
                                                     {"stroke", GesturePhase::stroke},
                                                     {"post-stroke-hold", GesturePhase::post_stroke_hold}};
const std::map<std::string, Touch> kTouches = [] {
    std::map<std::string, Touch> named;
    for (const std::string_view name : kTouchNames) named.emplace(name, *touch_named(name));
    return named;
}();
const std::map<std::string, Speed> kSpeeds = {
    {"slow", Speed::slow}, {"normal", Speed::normal}, {"fast", Speed::fast}};

float read_within(const JsonValue& value, const BendRange& range) {
    return static_cast<float>(value.number(range.least, range.most));
}

// One of several things that are mixed: "up" or 0.4, and how much of it.
struct Part {
    JsonValue thing;
    std::string name;  // "" of a number
    float weight = 1;
};

// `"up"`, `["up", "in"]` or `{"up": 2, "in": 1}`, of words among `words`; where `numbers` is given also
// numbers.
std::vector<Part> parts_of(const JsonValue& value, const std::vector<std::string>& words, bool numbers) {
    std::vector<Part> parts;
    if (value.json().is_object()) {
        value.allow_only(words);
        for (const auto& [name, weight] : value.json().items()) {
            const JsonValue share = value.at(name);
            parts.push_back({.thing = share, .name = name, .weight = read_within(share, kWeights)});
        }
        if (parts.empty()) value.refuse("is empty; name something in it");
        return parts;
    }
    const std::vector<JsonValue> things =
        value.json().is_array() ? value.items(1) : std::vector<JsonValue>{value};
    for (const JsonValue& thing : things) {
        const bool is_number = numbers && thing.json().is_number();
        parts.push_back({.thing = thing, .name = is_number ? "" : thing.choice(words)});
    }
    return parts;
}

float read_coordinate(const JsonValue& value, int axis) {
    std::vector<std::string> words;
    for (const SectorName& sector : sectors_along(axis)) {
        words.emplace_back(sector.name);
        words.emplace_back(sector.word);
    }
    float sum = 0, weights = 0;
    for (const Part& part : parts_of(value, words, true)) {
        float place = 0;
        if (part.name.empty()) place = read_within(part.thing, kSpace[axis]);
        for (const SectorName& sector : sectors_along(axis))
            if (part.name == sector.name || part.name == sector.word) place = sector.place;
        sum += part.weight * place;
        weights += part.weight;
    }
    return sum / weights;
}

Vec3 read_direction(const JsonValue& value) {
    std::vector<std::string> words;
    for (const DirectionName& direction : directions()) words.emplace_back(direction.name);
    Vec3 sum{0};
    for (const Part& part : parts_of(value, words, false))
        for (const DirectionName& direction : directions())
            if (part.name == direction.name) sum += part.weight * direction.towards;
    if (length(sum) < 1e-3f)
        value.refuse(format("is {}, which points nowhere; leave out opposites", value.shown()));
    return normalize(sum);
}

// What is left out of `wrist` is as in the pose before.
Vec3 read_wrist(const JsonValue& value, const std::optional<ArmPose>& before) {
    check_keys(value, "wrist");
    Vec3 wrist = before ? before->wrist : Vec3(0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto coordinate = before ? value.find(kAxes[axis]) : value.at(kAxes[axis]);
        if (coordinate) wrist[axis] = read_coordinate(*coordinate, axis);
    }
    return wrist;
}

std::size_t read_shape_name(const JsonValue& value, const std::vector<HandShape>& shapes) {
    std::vector<std::string> ids;
    for (const HandShape& shape : shapes) ids.push_back(shape.id);
    const std::string chosen = value.choice(ids);
    std::size_t index = 0;
    while (shapes[index].id != chosen) ++index;
    return index;
}

WristPath read_path(const JsonValue& value) {
    check_keys(value, "path");
    WristPath path;
    if (value.at("shape").choice({"line", "circle"}) == "line") {
        if (value.json().size() > 1)
            value.refuse("is a line, which has no radius, turns or axis; remove them");
        return path;
    }
    path.shape = WristShape::circle;
    path.radius = read_within(value.at("radius"), kRadius);
    if (const auto turns = value.find("turns")) path.turns = read_within(*turns, kTurns);
    if (const auto axis = value.find("axis")) path.axis = read_direction(*axis);
    return path;
}

// An arm of gesture space reaches the pose, and its forearm and wrist turn so far.
void check_posable(const JsonValue& value, const ArmPose& pose) {
    const ArmTarget target = target_of(pose, ArmSide::right);
    const ArmTurns turns = solve_arm(target, ArmSide::right);
    if (!turns.reached) {
        value.refuse(format(
            "has its wrist at x {:.2f}, y {:.2f}, z {:.2f}, where no arm reaches; bring it nearer to the "
            "shoulder at x 0.33, y 0.51, z 0, or further off if it is at the shoulder",
            pose.wrist.x, pose.wrist.y, pose.wrist.z));
    }
    if (turns.clamped) {
        value.refuse(format(
            "turns the hand {:.0f} degrees further than forearm and wrist go (twist {:.0f}, flexion "
            "{:.0f}, deviation {:.0f}); turn palm or fingers, move the wrist, or give another swivel than "
            "{:.2f}",
            glm::degrees(turns.hand_residual), glm::degrees(turns.angles.twist),
            glm::degrees(turns.angles.flexion), glm::degrees(turns.angles.deviation), pose.swivel));
    }
}

// What a pose leaves out is as in the one before; but a swivel that is left out follows a wrist that is
// given.
ArmPose read_arm(const JsonValue& value, const std::optional<ArmPose>& before, const PoseReader& reader) {
    check_keys(value, "arm");
    const auto given = [&](std::string_view key) { return before ? value.find(key) : value.at(key); };
    ArmPose pose = before.value_or(ArmPose{});
    pose.fixed = reader.fixed;
    if (const auto wrist = given("wrist")) {
        pose.wrist = read_wrist(*wrist, before);
        pose.swivel = usual_swivel(pose.wrist);
    }
    if (const auto palm = given("palm")) pose.palm = read_direction(*palm);
    if (const auto fingers = given("fingers")) pose.fingers = read_direction(*fingers);
    if (const auto shape = given("shape")) pose.shape = read_shape_name(*shape, reader.shapes);
    if (const auto fixed = value.find("fixed")) pose.fixed = read_fixed(*fixed);
    if (const auto swivel = value.find("swivel")) pose.swivel = read_within(*swivel, kSwivel);
    if (const auto touches = value.find("touches")) pose.touches = read_meaning(*touches, kTouches);

    const Vec3 across = pose.fingers - pose.palm * dot(pose.fingers, pose.palm);
    if (length(across) < 0.2f) {
        value.refuse(
            "has its fingers pointing where its palm faces, or the opposite way; let them point "
            "across, such as palm \"up\" and fingers \"front\"");
    }
    pose.fingers = normalize(across);
    check_posable(value, pose);
    return pose;
}

}  // namespace

FixedFeatures read_fixed(const JsonValue& value) {
    FixedFeatures fixed;
    for (const JsonValue& feature : value.items(0)) {
        const std::string name =
            feature.choice({"wrist", "wrist_x", "wrist_y", "wrist_z", "palm", "shape", "swivel"});
        const bool whole = name == "wrist";
        fixed.wrist_x |= whole || name == "wrist_x";
        fixed.wrist_y |= whole || name == "wrist_y";
        fixed.wrist_z |= whole || name == "wrist_z";
        fixed.palm |= name == "palm";
        fixed.shape |= name == "shape";
        fixed.swivel |= name == "swivel";
    }
    return fixed;
}

KeyPose PoseReader::read_pose(const JsonValue& value, const KeyPose* before) const {
    check_keys(value, "gestures[].poses[]");
    const auto arm_before = [&](bool left) {
        return !before ? std::nullopt : left ? before->left : before->right;
    };
    KeyPose pose;
    pose.phase = read_meaning(value.at("phase"), kPhases);
    if (const auto speed = value.find("speed")) pose.speed = read_meaning(*speed, kSpeeds);
    if (const auto path = value.find("path")) pose.path = read_path(*path);
    pose.right = arm_before(false);
    pose.left = arm_before(true);

    const auto arm = value.find("arm"), right = value.find("right"), left = value.find("left");
    if (arm && (right || left)) value.refuse("has \"arm\" beside \"right\" or \"left\"; write either");
    if (hands == GestureHands::either && (right || left)) {
        value.refuse(
            "distinguishes right from left in a gesture for either hand; write \"arm\", or \"hands\": \"both\"");
    }
    if (arm) pose.right = read_arm(*arm, pose.right, *this);
    if (arm && hands == GestureHands::both) pose.left = read_arm(*arm, pose.left, *this);
    if (right) pose.right = read_arm(*right, pose.right, *this);
    if (left) pose.left = read_arm(*left, pose.left, *this);
    if (!pose.right || (hands == GestureHands::both && !pose.left)) {
        value.refuse(
            hands == GestureHands::both
                ? "is the first pose and lacks an arm; add \"arm\" for both alike, or \"right\" and \"left\""
                : "is the first pose and lacks its arm; add \"arm\"");
    }
    return pose;
}

std::vector<KeyPose> PoseReader::read(const JsonValue& list) const {
    std::vector<KeyPose> poses;
    for (const JsonValue& value : list.items(2)) {
        poses.push_back(read_pose(value, poses.empty() ? nullptr : &poses.back()));
        const GesturePhase phase = poses.back().phase;
        const JsonValue place = value.at("phase");
        if (poses.size() == 1 && phase != GesturePhase::preparation) {
            place.refuse(
                format("is \"{}\" in the first pose; a gesture begins with its preparation", name_of(phase)));
        }
        if (poses.size() > 1 && phase < poses[poses.size() - 2].phase) {
            place.refuse(
                format("is \"{}\" after \"{}\"; put the phases in the order preparation, "
                       "pre-stroke-hold, stroke, post-stroke-hold",
                       name_of(phase), name_of(poses[poses.size() - 2].phase)));
        }
    }
    for (const KeyPose& pose : poses)
        if (pose.phase == GesturePhase::stroke) return poses;
    list.refuse("has no pose of phase \"stroke\"; add the one in which the meaning is shown");
}

}  // namespace chironomia
