#include "skinning/motion/points/smpl.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/body_proportions.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/body/odd_arrangement.h"

namespace chironomia {
namespace {

constexpr double kMostTurn = 1e3;         // beyond it a file is damaged [rad]
constexpr double kMostPlace = 1e6;        // the same [m]
constexpr double kSameRateOfSmpl = 0.01;  // ours; 29.97 and 30 are the same
constexpr float kAllRound = 6.5f;         // a turn and a little, for rounding [rad]

struct ModelJoint {
    std::string_view name;
    int parent;
    Vec3 offset;  // of an adult in T-pose, who faces +z [m]
};

// The 22 joints of SMPL's trunk, arms and legs. The proportions are ours: carrying turns over needs no more than a rest
// pose.
constexpr std::array<ModelJoint, 22> kBody = {{
    {"pelvis", -1, {0, 0.93f, 0}},
    {"left_hip", 0, {0.09f, -0.07f, 0}},
    {"right_hip", 0, {-0.09f, -0.07f, 0}},
    {"spine1", 0, {0, 0.11f, -0.01f}},
    {"left_knee", 1, {0.01f, -0.4f, 0}},
    {"right_knee", 2, {-0.01f, -0.4f, 0}},
    {"spine2", 3, {0, 0.13f, 0}},
    {"left_ankle", 4, {0, -0.4f, -0.02f}},
    {"right_ankle", 5, {0, -0.4f, -0.02f}},
    {"spine3", 6, {0, 0.06f, 0.01f}},
    {"left_foot", 7, {0.02f, -0.04f, 0.13f}},
    {"right_foot", 8, {-0.02f, -0.04f, 0.13f}},
    {"neck", 9, {0, 0.2f, -0.02f}},
    {"left_collar", 9, {0.06f, 0.11f, -0.01f}},
    {"right_collar", 9, {-0.06f, 0.11f, -0.01f}},
    {"head", 12, {0, 0.1f, 0.02f}},
    {"left_shoulder", 13, {0.11f, 0.04f, -0.01f}},
    {"right_shoulder", 14, {-0.11f, 0.04f, -0.01f}},
    {"left_elbow", 16, {0.26f, 0, 0}},
    {"right_elbow", 17, {-0.26f, 0, 0}},
    {"left_wrist", 18, {0.25f, 0, 0}},
    {"right_wrist", 19, {-0.25f, 0, 0}},
}};

constexpr std::array<ModelJoint, 2> kSmplHands = {{
    {"left_hand", 20, {0.085f, -0.01f, 0}},
    {"right_hand", 21, {-0.085f, -0.01f, 0}},
}};

constexpr std::array<ModelJoint, 3> kFace = {{
    {"jaw", 15, {0, -0.01f, 0.02f}},
    {"left_eye", 15, {0.032f, 0.06f, 0.07f}},
    {"right_eye", 15, {-0.032f, 0.06f, 0.07f}},
}};

// Of a left hand, palm down: where the first joint lies, and the bones behind it.
struct ModelFinger {
    std::string_view name;
    Vec3 root, bone;
};
constexpr std::array<ModelFinger, 5> kFingers = {{
    {"index", {0.095f, 0, 0.025f}, {0.034f, 0, 0.001f}},
    {"middle", {0.1f, 0, 0.002f}, {0.037f, 0, 0}},
    {"pinky", {0.078f, -0.004f, -0.042f}, {0.024f, 0, -0.003f}},
    {"ring", {0.09f, 0, -0.021f}, {0.033f, 0, -0.002f}},
    {"thumb", {0.03f, -0.012f, 0.028f}, {0.026f, -0.004f, 0.024f}},
}};

void append_hand(Skeleton& skeleton, std::string_view side, int wrist) {
    const Vec3 mirror(side == "left" ? 1.0f : -1.0f, 1, 1);
    for (const ModelFinger& finger : kFingers) {
        for (int i = 1; i <= 3; ++i) {
            const int above = i == 1 ? wrist : static_cast<int>(skeleton.joints.size()) - 1;
            skeleton.joints.push_back({format("{}_{}{}", side, finger.name, i),
                                       above,
                                       {.translation = mirror * (i == 1 ? finger.root : finger.bone)}});
        }
    }
}

Skeleton skeleton_of(size_t joints) {
    Skeleton skeleton;
    const auto append = [&](const auto& list) {
        for (const auto& [name, parent, offset] : list)
            skeleton.joints.push_back({std::string(name), parent, {.translation = offset}});
    };
    append(kBody);
    if (joints == 24) append(kSmplHands);
    if (joints == 55) append(kFace);
    if (joints < 52) return skeleton;
    append_hand(skeleton, "left", 20);
    append_hand(skeleton, "right", 21);
    return skeleton;
}

std::string_view model_of(size_t joints) {
    return joints == 55 ? "SMPL-X" : joints == 52 ? "SMPL-H" : "SMPL";
}

const NumpyArray* find_named_array(const std::vector<NumpyArray>& arrays,
                                   std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        for (const NumpyArray& array : arrays) {
            if (to_lower(array.name) == name) return &array;
        }
    }
    return nullptr;
}

// Turns of one part of a body, where files name each by itself: its first joint of SMPL-X, and how many it has.
struct PosePart {
    std::string_view name;
    size_t first, count;
};
constexpr std::array<PosePart, 12> kPoseParts = {{
    {"global_orient", 0, 1},
    {"root_orient", 0, 1},
    {"body_pose", 1, 21},
    {"pose_body", 1, 21},
    {"jaw_pose", 22, 1},
    {"pose_jaw", 22, 1},
    {"leye_pose", 23, 1},
    {"reye_pose", 24, 1},
    {"pose_eye", 23, 2},
    {"left_hand_pose", 25, 15},
    {"right_hand_pose", 40, 15},
    {"pose_hand", 25, 30},
}};

bool has_pose_parts(const std::vector<NumpyArray>& arrays) {
    return find_named_array(arrays, {"global_orient", "root_orient"}) &&
           find_named_array(arrays, {"body_pose", "pose_body"});
}

// The turns of all joints in one array, as AMASS calls them; or by other names, which places may have as well.
const NumpyArray* find_poses(const std::vector<NumpyArray>& arrays) {
    if (const NumpyArray* poses = find_named_array(arrays, {"poses", "smpl_poses"})) return poses;
    if (has_pose_parts(arrays)) return nullptr;
    const NumpyArray* other =
        find_named_array(arrays, {"fullpose", "smpl_pose", "thetas", "theta", "pose_aa", "pose"});
    return other && are_turns(*other) ? other : nullptr;
}

// (..., 3, 3) rotation matrices as turns about axes, others as they are.
NumpyArray as_turns(const NumpyArray& array, const std::string& where) {
    const std::vector<size_t>& shape = array.shape;
    if (shape.size() < 3 || shape.back() != 3 || shape[shape.size() - 2] != 3) return array;
    NumpyArray turns = array;
    turns.shape.pop_back();
    turns.numbers.clear();
    for (size_t i = 0; i + 9 <= array.numbers.size(); i += 9) {
        const double* x = array.numbers.data() + i;
        const Mat3 rotation(x[0], x[3], x[6], x[1], x[4], x[7], x[2], x[5], x[8]);  // by columns
        const Mat3 square = glm::transpose(rotation) * rotation;
        for (int c = 0; c < 3; ++c) {
            if (length(square[c] - Mat3(1)[c]) < 0.01f) continue;
            throw Error(
                format("{}: {}: frame {} is no rotation matrix; (T, J, 3) is read as turns about axes", where,
                       describe(array), i * shape[0] / array.numbers.size()));
        }
        const Quat turn = glm::normalize(glm::quat_cast(rotation));
        const float angle = glm::angle(turn);
        const Vec3 about = angle < 1e-8f ? Vec3(0) : glm::axis(turn) * angle;
        turns.numbers.insert(turns.numbers.end(), {about.x, about.y, about.z});
    }
    return turns;
}

// The parts in one array. Hands and face that the file does not have are at rest if it has any of them; there are none
// otherwise.
NumpyArray joined_parts(const std::vector<NumpyArray>& arrays, const std::string& where) {
    const NumpyArray& root = *find_named_array(arrays, {"global_orient", "root_orient"});
    const size_t frames = root.shape.empty() ? 0 : root.shape[0];
    std::vector<std::pair<NumpyArray, PosePart>> parts;
    size_t joints = 22;
    for (PosePart part : kPoseParts) {
        const NumpyArray* named = find_named_array(arrays, {part.name});
        if (!named) continue;
        NumpyArray array = as_turns(*named, where);
        if (part.first == 1 && array.numbers.size() == frames * 69) {  // of SMPL, whose hands are joints
            part.count = 23;
            joints = 24;
        }
        if (array.shape.empty() || array.shape[0] != frames ||
            array.numbers.size() != frames * 3 * part.count) {
            throw Error(format(
                "{}: {} does not fit {}: turns about axes, (T, {}), or rotation matrices, (T, {}, 3, 3), are "
                "read; store hands without principal components",
                where, describe(*named), describe(root), 3 * part.count, part.count));
        }
        if (part.first >= 22 && joints == 24) continue;
        if (part.first >= 22) joints = 55;
        parts.emplace_back(std::move(array), part);
    }
    NumpyArray poses{
        .name = "poses", .type = root.type, .shape = {frames, 3 * joints}, .numbers = {}, .texts = {}};
    poses.numbers.assign(frames * 3 * joints, 0);
    for (const auto& [array, part] : parts) {
        for (size_t t = 0; t < frames; ++t) {
            std::copy_n(array.numbers.begin() + std::ptrdiff_t(t * 3 * part.count), 3 * part.count,
                        poses.numbers.begin() + std::ptrdiff_t(3 * (t * joints + part.first)));
        }
    }
    return poses;
}

// How many joints `poses` turns; 0 if it has no such shape.
size_t joints_in(const NumpyArray& poses) {
    const std::vector<size_t>& shape = poses.shape;
    const bool nested = shape.size() == 3 && shape[2] == 3;
    if (!nested && shape.size() != 2) return 0;
    const size_t width = nested ? 3 * shape[1] : shape[1];
    return width == 165 || width == 156 || width == 72 || width == 66 ? width / 3 : 0;
}

// Its first 22 joints, as if the numbers were places.
KeypointTrack taken_for_places(const NumpyArray& poses, size_t joints) {
    KeypointTrack track;
    for (const ModelJoint& joint : kBody) {
        const auto landmark = landmark_spelled(joint.name);
        track.names.emplace_back(landmark ? name_of(*landmark) : "");
    }
    for (size_t t = 0; t < poses.shape[0]; ++t) {
        for (size_t j = 0; j < kBody.size(); ++j) {
            const double* x = poses.numbers.data() + 3 * (t * joints + j);
            track.points.push_back({float(x[0]), float(x[1]), float(x[2])});
            track.confidence.push_back(glm::any(glm::isnan(track.points.back())) ? 0.0f : 1.0f);
        }
    }
    return track;
}

// The 22 joints as other programs list them: legs before the trunk (LaFAN1), or the trunk before arms and legs (most
// hierarchies), from the left or from the right.
constexpr std::array<size_t, 22> kLegsFirst = {0, 1,  4,  7,  10, 2,  5,  8,  11, 3,  6,
                                               9, 12, 15, 13, 16, 18, 20, 14, 17, 19, 21};
constexpr std::array<size_t, 22> kTrunkFirst = {0,  3,  6,  9, 12, 15, 13, 16, 18, 20, 14,
                                                17, 19, 21, 1, 4,  7,  10, 2,  5,  8,  11};

// Whether the numbers are places of a body in one of these orders.
bool is_body_in_other_order(const KeypointTrack& places) {
    for (const auto& order : {kLegsFirst, kTrunkFirst}) {
        for (const bool right_first : {false, true}) {
            KeypointTrack track = places;
            for (size_t j = 0; j < order.size(); ++j) {
                const std::string& name = places.names[order[j]];
                const auto landmark = right_first ? landmark_named(name) : std::nullopt;
                track.names[j] = landmark ? std::string(name_of(mirrored(*landmark))) : name;
            }
            if (implausible_bones(track).value_or(1) < kTooOdd &&
                odd_arrangement(track).value_or(1) < kTooOddArrangement)
                return true;
        }
    }
    return false;
}

const std::initializer_list<std::string_view> kRateNames = {"mocap_frame_rate", "mocap_framerate", "fps",
                                                            "frame_rate", "framerate"};

// Where arrays of one file give different rates, the first of them is taken.
std::optional<std::string> note_of_other_rate(const std::vector<NumpyArray>& arrays) {
    const NumpyArray* rate = find_named_array(arrays, kRateNames);
    if (!rate || rate->numbers.size() != 1) return std::nullopt;
    for (const std::string_view name : kRateNames) {
        const NumpyArray* other = find_named_array(arrays, {name});
        if (!other || other->numbers.size() != 1) continue;
        if (std::abs(other->numbers[0] - rate->numbers[0]) <= kSameRateOfSmpl * rate->numbers[0]) continue;
        return format(
            "rates: {} is {:.6g} and {} is {:.6g} frames/s; {} counts; set --motion-fps if it is wrong",
            rate->name, rate->numbers[0], other->name, other->numbers[0], rate->name);
    }
    return std::nullopt;
}

double rate_of(const std::vector<NumpyArray>& arrays, const std::string& where, std::optional<double> fps) {
    if (fps) return *fps;
    const NumpyArray* array = find_named_array(arrays, kRateNames);
    std::optional<double> rate;
    if (array && array->numbers.size() == 1) rate = array->numbers[0];
    if (array && array->texts.size() == 1) rate = parse_number(array->texts[0]);
    if (!rate) throw Error(format("{}: the file does not give its rate; set it with --motion-fps", where));
    if (!(*rate > 0 && std::isfinite(*rate))) {
        throw Error(format("{}: {} is {}; it must be above 0, or set the rate with --motion-fps", where,
                           array->name, *rate));
    }
    return *rate;
}

// Of AIST++, whose bodies and places are larger by it.
double scaling_of(const std::vector<NumpyArray>& arrays, const std::string& where) {
    const NumpyArray* scaling = find_named_array(arrays, {"smpl_scaling"});
    if (!scaling) return 1;
    if (scaling->numbers.size() == 1 && scaling->numbers[0] > 0 && std::isfinite(scaling->numbers[0]))
        return scaling->numbers[0];
    throw Error(format("{}: {} is {}; it must be one number above 0, by which places are divided", where,
                       describe(*scaling),
                       scaling->numbers.empty() ? "none" : format("{}", scaling->numbers[0])));
}

// Three numbers, all below `most`.
Vec3 triple(const NumpyArray& array, size_t index, double most, const std::string& place) {
    const double* x = array.numbers.data() + 3 * index;
    if (std::abs(x[0]) < most && std::abs(x[1]) < most && std::abs(x[2]) < most)
        return {float(x[0]), float(x[1]), float(x[2])};
    throw Error(
        format("{}: ({}, {}, {}) is none; the file is damaged, get it again", place, x[0], x[1], x[2]));
}

Quat turn_about(const Vec3& axis) {
    const float angle = length(axis);
    return angle < 1e-8f ? kNoTurn : glm::angleAxis(angle, axis / angle);
}

std::vector<std::string> left_out(const std::vector<NumpyArray>& arrays) {
    std::vector<std::string> notes;
    if (find_named_array(arrays, {"betas"}))
        notes.emplace_back("betas: the shape of the body is not used, the avatar has its own");
    if (find_named_array(arrays, {"expressions", "expression"})) {
        notes.emplace_back(
            "expressions: left out, only the model itself defines what they look like; give the face with "
            "--face");
    }
    return notes;
}

}  // namespace

bool are_turns(const NumpyArray& array) {
    const size_t joints = joints_in(array);
    if (joints == 0 || array.numbers.empty()) return false;
    const KeypointTrack places = taken_for_places(array, joints);
    const bool near = std::all_of(places.points.begin(), places.points.end(),
                                  [](const Vec3& turn) { return !(length(turn) > kAllRound); });
    return near && implausible_bones(places).value_or(0) >= kTooOdd &&
           count_rigid_pairs(places) < kFewestBones && !is_body_in_other_order(places);
}

bool holds_smpl(const std::vector<NumpyArray>& arrays) {
    const NumpyArray* poses = find_poses(arrays);
    if (!poses) return has_pose_parts(arrays);
    const bool is_body =
        find_named_array(arrays, {"betas", "trans", "transl", "smpl_trans", "expressions", "gender", "model",
                                  "mocap_frame_rate", "mocap_framerate"}) != nullptr;
    return joints_in(*poses) > 0 && (is_body || are_turns(*poses));
}

Motion motion_of_smpl(const std::vector<NumpyArray>& arrays, const std::string& where,
                      std::optional<double> fps) {
    const NumpyArray* whole = find_poses(arrays);
    const NumpyArray poses = whole ? *whole : joined_parts(arrays, where);
    const size_t frames = poses.shape[0], count = joints_in(poses);
    if (frames == 0 || poses.numbers.empty())
        throw Error(format("{}: {} holds no turns; there is nothing to show", where, describe(poses)));
    const NumpyArray* trans = find_named_array(arrays, {"trans", "transl", "smpl_trans"});
    const double scaling = scaling_of(arrays, where);
    if (trans && (trans->shape != std::vector<size_t>{frames, 3} || trans->numbers.empty())) {
        throw Error(
            format("{}: {} does not fit {}; (T, 3) is expected", where, describe(*trans), describe(poses)));
    }
    Motion motion{.source = where,
                  .fps = rate_of(arrays, where, fps),
                  .frames = frames,
                  .joints = JointTrack{.skeleton = skeleton_of(count), .turns = {}, .translations = {}},
                  .keypoints = {},
                  .notes = {format("{}: turns of {} joints, on a body of average proportions",
                                   model_of(count), count)}};
    JointTrack& track = *motion.joints;
    for (size_t t = 0; t < frames; ++t) {
        for (size_t j = 0; j < count; ++j) {
            const Joint& joint = track.skeleton.joints[j];
            track.turns.push_back(
                turn_about(triple(poses, t * count + j, kMostTurn,
                                  format("{}: frame {}: the turn of {}", where, t, joint.name))));
            track.translations.push_back(joint.rest.translation);
        }
        if (!trans) continue;
        track.translations[t * count] +=
            triple(*trans, t, kMostPlace, format("{}: frame {}: the place of the pelvis", where, t)) /
            float(scaling);
    }
    for (std::string& note : left_out(arrays)) motion.notes.push_back(std::move(note));
    motion.notes.push_back(format("rate: {:.6g} frames/s{}", motion.fps, fps ? ", set by hand" : ""));
    if (auto note = fps ? std::nullopt : note_of_other_rate(arrays)) motion.notes.push_back(std::move(*note));
    return motion;
}

}  // namespace chironomia
