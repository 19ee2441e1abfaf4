#include "skinning/body/keypoint_layout.h"

#include <array>
#include <cassert>
#include <utility>

#include "core/text.h"

namespace chironomia {
namespace {

// In the order of Landmark.
constexpr std::string_view kNames =
    "pelvis spine chest upper_chest thorax neck head head_top nose jaw "
    "left_eye right_eye left_eye_inner right_eye_inner left_eye_outer right_eye_outer "
    "left_ear right_ear left_mouth right_mouth left_collar right_collar left_shoulder right_shoulder "
    "left_elbow right_elbow left_wrist right_wrist left_hand right_hand left_hip right_hip "
    "left_knee right_knee left_ankle right_ankle left_heel right_heel left_toe right_toe "
    "left_small_toe right_small_toe "
    "left_thumb_1 left_thumb_2 left_thumb_3 left_thumb_4 left_index_1 left_index_2 left_index_3 left_index_4 "
    "left_middle_1 left_middle_2 left_middle_3 left_middle_4 left_ring_1 left_ring_2 left_ring_3 left_ring_4 "
    "left_little_1 left_little_2 left_little_3 left_little_4 "
    "right_thumb_1 right_thumb_2 right_thumb_3 right_thumb_4 "
    "right_index_1 right_index_2 right_index_3 right_index_4 "
    "right_middle_1 right_middle_2 right_middle_3 right_middle_4 "
    "right_ring_1 right_ring_2 right_ring_3 right_ring_4 "
    "right_little_1 right_little_2 right_little_3 right_little_4";

// "THEIRS:ours", or "THEIRS:-" for a point that repeats another.
constexpr std::string_view kMediaPipe33 =
    "NOSE:nose LEFT_EYE_INNER:left_eye_inner LEFT_EYE:left_eye LEFT_EYE_OUTER:left_eye_outer "
    "RIGHT_EYE_INNER:right_eye_inner RIGHT_EYE:right_eye RIGHT_EYE_OUTER:right_eye_outer LEFT_EAR:left_ear "
    "RIGHT_EAR:right_ear MOUTH_LEFT:left_mouth MOUTH_RIGHT:right_mouth LEFT_SHOULDER:left_shoulder "
    "RIGHT_SHOULDER:right_shoulder LEFT_ELBOW:left_elbow RIGHT_ELBOW:right_elbow LEFT_WRIST:left_wrist "
    "RIGHT_WRIST:right_wrist LEFT_PINKY:left_little_1 RIGHT_PINKY:right_little_1 LEFT_INDEX:left_index_1 "
    "RIGHT_INDEX:right_index_1 LEFT_THUMB:left_thumb_2 RIGHT_THUMB:right_thumb_2 LEFT_HIP:left_hip "
    "RIGHT_HIP:right_hip LEFT_KNEE:left_knee RIGHT_KNEE:right_knee LEFT_ANKLE:left_ankle "
    "RIGHT_ANKLE:right_ankle LEFT_HEEL:left_heel RIGHT_HEEL:right_heel LEFT_FOOT_INDEX:left_toe "
    "RIGHT_FOOT_INDEX:right_toe";

// The body, then the left and the right hand; what the hands know better is dropped from the body.
constexpr std::string_view kMediaPipe75 =
    "NOSE:nose LEFT_EYE_INNER:left_eye_inner LEFT_EYE:left_eye LEFT_EYE_OUTER:left_eye_outer "
    "RIGHT_EYE_INNER:right_eye_inner RIGHT_EYE:right_eye RIGHT_EYE_OUTER:right_eye_outer LEFT_EAR:left_ear "
    "RIGHT_EAR:right_ear MOUTH_LEFT:left_mouth MOUTH_RIGHT:right_mouth LEFT_SHOULDER:left_shoulder "
    "RIGHT_SHOULDER:right_shoulder LEFT_ELBOW:left_elbow RIGHT_ELBOW:right_elbow LEFT_WRIST:left_wrist "
    "RIGHT_WRIST:right_wrist LEFT_PINKY:- RIGHT_PINKY:- LEFT_INDEX:- RIGHT_INDEX:- LEFT_THUMB:- "
    "RIGHT_THUMB:- LEFT_HIP:left_hip RIGHT_HIP:right_hip LEFT_KNEE:left_knee RIGHT_KNEE:right_knee "
    "LEFT_ANKLE:left_ankle RIGHT_ANKLE:right_ankle LEFT_HEEL:left_heel RIGHT_HEEL:right_heel "
    "LEFT_FOOT_INDEX:left_toe RIGHT_FOOT_INDEX:right_toe "
    "LEFT_HAND_WRIST:- LEFT_HAND_THUMB_CMC:left_thumb_1 LEFT_HAND_THUMB_MCP:left_thumb_2 "
    "LEFT_HAND_THUMB_IP:left_thumb_3 LEFT_HAND_THUMB_TIP:left_thumb_4 "
    "LEFT_HAND_INDEX_FINGER_MCP:left_index_1 LEFT_HAND_INDEX_FINGER_PIP:left_index_2 "
    "LEFT_HAND_INDEX_FINGER_DIP:left_index_3 LEFT_HAND_INDEX_FINGER_TIP:left_index_4 "
    "LEFT_HAND_MIDDLE_FINGER_MCP:left_middle_1 LEFT_HAND_MIDDLE_FINGER_PIP:left_middle_2 "
    "LEFT_HAND_MIDDLE_FINGER_DIP:left_middle_3 LEFT_HAND_MIDDLE_FINGER_TIP:left_middle_4 "
    "LEFT_HAND_RING_FINGER_MCP:left_ring_1 LEFT_HAND_RING_FINGER_PIP:left_ring_2 "
    "LEFT_HAND_RING_FINGER_DIP:left_ring_3 LEFT_HAND_RING_FINGER_TIP:left_ring_4 "
    "LEFT_HAND_PINKY_MCP:left_little_1 LEFT_HAND_PINKY_PIP:left_little_2 "
    "LEFT_HAND_PINKY_DIP:left_little_3 LEFT_HAND_PINKY_TIP:left_little_4 "
    "RIGHT_HAND_WRIST:- RIGHT_HAND_THUMB_CMC:right_thumb_1 RIGHT_HAND_THUMB_MCP:right_thumb_2 "
    "RIGHT_HAND_THUMB_IP:right_thumb_3 RIGHT_HAND_THUMB_TIP:right_thumb_4 "
    "RIGHT_HAND_INDEX_FINGER_MCP:right_index_1 RIGHT_HAND_INDEX_FINGER_PIP:right_index_2 "
    "RIGHT_HAND_INDEX_FINGER_DIP:right_index_3 RIGHT_HAND_INDEX_FINGER_TIP:right_index_4 "
    "RIGHT_HAND_MIDDLE_FINGER_MCP:right_middle_1 RIGHT_HAND_MIDDLE_FINGER_PIP:right_middle_2 "
    "RIGHT_HAND_MIDDLE_FINGER_DIP:right_middle_3 RIGHT_HAND_MIDDLE_FINGER_TIP:right_middle_4 "
    "RIGHT_HAND_RING_FINGER_MCP:right_ring_1 RIGHT_HAND_RING_FINGER_PIP:right_ring_2 "
    "RIGHT_HAND_RING_FINGER_DIP:right_ring_3 RIGHT_HAND_RING_FINGER_TIP:right_ring_4 "
    "RIGHT_HAND_PINKY_MCP:right_little_1 RIGHT_HAND_PINKY_PIP:right_little_2 "
    "RIGHT_HAND_PINKY_DIP:right_little_3 RIGHT_HAND_PINKY_TIP:right_little_4";

constexpr std::string_view kHuman36M17 =
    "Hip:pelvis RHip:right_hip RKnee:right_knee RFoot:right_ankle LHip:left_hip LKnee:left_knee "
    "LFoot:left_ankle Spine:spine Thorax:thorax Neck/Nose:nose Head:head_top LShoulder:left_shoulder "
    "LElbow:left_elbow LWrist:left_wrist RShoulder:right_shoulder RElbow:right_elbow RWrist:right_wrist";

constexpr std::string_view kCoco17 =
    "nose:nose left_eye:left_eye right_eye:right_eye left_ear:left_ear right_ear:right_ear "
    "left_shoulder:left_shoulder right_shoulder:right_shoulder left_elbow:left_elbow "
    "right_elbow:right_elbow left_wrist:left_wrist right_wrist:right_wrist left_hip:left_hip "
    "right_hip:right_hip left_knee:left_knee right_knee:right_knee left_ankle:left_ankle "
    "right_ankle:right_ankle";

constexpr std::string_view kWholeBodyFeet =
    " left_big_toe:left_toe left_small_toe:left_small_toe left_heel:left_heel "
    "right_big_toe:right_toe right_small_toe:right_small_toe right_heel:right_heel ";

constexpr std::string_view kHalpeBody =
    " Head:head_top Neck:thorax Hip:pelvis LBigToe:left_toe RBigToe:right_toe LSmallToe:left_small_toe "
    "RSmallToe:right_small_toe LHeel:left_heel RHeel:right_heel ";

constexpr std::string_view kBody25 =
    "Nose:nose Neck:thorax RShoulder:right_shoulder RElbow:right_elbow RWrist:right_wrist "
    "LShoulder:left_shoulder LElbow:left_elbow LWrist:left_wrist MidHip:pelvis RHip:right_hip "
    "RKnee:right_knee RAnkle:right_ankle LHip:left_hip LKnee:left_knee LAnkle:left_ankle REye:right_eye "
    "LEye:left_eye REar:right_ear LEar:left_ear LBigToe:left_toe LSmallToe:left_small_toe LHeel:left_heel "
    "RBigToe:right_toe RSmallToe:right_small_toe RHeel:right_heel";

constexpr std::string_view kCoco18 =
    "Nose:nose Neck:thorax RShoulder:right_shoulder RElbow:right_elbow RWrist:right_wrist "
    "LShoulder:left_shoulder LElbow:left_elbow LWrist:left_wrist RHip:right_hip RKnee:right_knee "
    "RAnkle:right_ankle LHip:left_hip LKnee:left_knee LAnkle:left_ankle REye:right_eye LEye:left_eye "
    "REar:right_ear LEar:left_ear";

constexpr std::string_view kSmpl22 =
    "pelvis:pelvis left_hip:left_hip right_hip:right_hip spine1:spine left_knee:left_knee "
    "right_knee:right_knee spine2:chest left_ankle:left_ankle right_ankle:right_ankle spine3:upper_chest "
    "left_foot:left_toe right_foot:right_toe neck:neck left_collar:left_collar right_collar:right_collar "
    "head:head left_shoulder:left_shoulder right_shoulder:right_shoulder left_elbow:left_elbow "
    "right_elbow:right_elbow left_wrist:left_wrist right_wrist:right_wrist";

// The joints of Kinect's second version, in the order that NTU RGB+D keeps.
constexpr std::string_view kKinect25 =
    "SpineBase:pelvis SpineMid:chest Neck:neck Head:head ShoulderLeft:left_shoulder ElbowLeft:left_elbow "
    "WristLeft:left_wrist HandLeft:left_hand ShoulderRight:right_shoulder ElbowRight:right_elbow "
    "WristRight:right_wrist HandRight:right_hand HipLeft:left_hip KneeLeft:left_knee AnkleLeft:left_ankle "
    "FootLeft:left_toe HipRight:right_hip KneeRight:right_knee AnkleRight:right_ankle FootRight:right_toe "
    "SpineShoulder:thorax HandTipLeft:left_middle_4 ThumbLeft:left_thumb_4 HandTipRight:right_middle_4 "
    "ThumbRight:right_thumb_4";

constexpr std::string_view kSmplHands = " left_hand:left_hand right_hand:right_hand";

constexpr std::string_view kSmplFace = " jaw:jaw left_eye_smplhf:left_eye right_eye_smplhf:right_eye";

constexpr std::string_view kSmplFingers =
    " left_index1:left_index_1 left_index2:left_index_2 left_index3:left_index_3"
    " left_middle1:left_middle_1 left_middle2:left_middle_2 left_middle3:left_middle_3"
    " left_pinky1:left_little_1 left_pinky2:left_little_2 left_pinky3:left_little_3"
    " left_ring1:left_ring_1 left_ring2:left_ring_2 left_ring3:left_ring_3"
    " left_thumb1:left_thumb_1 left_thumb2:left_thumb_2 left_thumb3:left_thumb_3"
    " right_index1:right_index_1 right_index2:right_index_2 right_index3:right_index_3"
    " right_middle1:right_middle_1 right_middle2:right_middle_2 right_middle3:right_middle_3"
    " right_pinky1:right_little_1 right_pinky2:right_little_2 right_pinky3:right_little_3"
    " right_ring1:right_ring_1 right_ring2:right_ring_2 right_ring3:right_ring_3"
    " right_thumb1:right_thumb_1 right_thumb2:right_thumb_2 right_thumb3:right_thumb_3";

// The roots of the hands repeat the wrists.
constexpr std::string_view kPats52 =
    "Neck:thorax RShoulder:right_shoulder RElbow:right_elbow RWrist:right_wrist "
    "LShoulder:left_shoulder LElbow:left_elbow LWrist:left_wrist Nose:nose REye:right_eye "
    "LEye:left_eye LHandRoot:- LHandThumb1:left_thumb_1 LHandThumb2:left_thumb_2 "
    "LHandThumb3:left_thumb_3 LHandThumb4:left_thumb_4 LHandIndex1:left_index_1 "
    "LHandIndex2:left_index_2 LHandIndex3:left_index_3 LHandIndex4:left_index_4 "
    "LHandMiddle1:left_middle_1 LHandMiddle2:left_middle_2 LHandMiddle3:left_middle_3 "
    "LHandMiddle4:left_middle_4 LHandRing1:left_ring_1 LHandRing2:left_ring_2 LHandRing3:left_ring_3 "
    "LHandRing4:left_ring_4 LHandLittle1:left_little_1 LHandLittle2:left_little_2 "
    "LHandLittle3:left_little_3 LHandLittle4:left_little_4 RHandRoot:- RHandThumb1:right_thumb_1 "
    "RHandThumb2:right_thumb_2 RHandThumb3:right_thumb_3 RHandThumb4:right_thumb_4 "
    "RHandIndex1:right_index_1 RHandIndex2:right_index_2 RHandIndex3:right_index_3 "
    "RHandIndex4:right_index_4 RHandMiddle1:right_middle_1 RHandMiddle2:right_middle_2 "
    "RHandMiddle3:right_middle_3 RHandMiddle4:right_middle_4 RHandRing1:right_ring_1 "
    "RHandRing2:right_ring_2 RHandRing3:right_ring_3 RHandRing4:right_ring_4 "
    "RHandLittle1:right_little_1 RHandLittle2:right_little_2 RHandLittle3:right_little_3 "
    "RHandLittle4:right_little_4";

constexpr std::string_view kPats11 =
    "RShoulder:right_shoulder RElbow:right_elbow RWrist:right_wrist LShoulder:left_shoulder "
    "LElbow:left_elbow LWrist:left_wrist Nose:nose REye:right_eye LEye:left_eye LHandRoot:- "
    "RHandRoot:-";

// Points of OpenPose's face: the contour, the brows, a point of each lid.
constexpr std::string_view kPatsFace15 =
    "face_0:- face_4:- face_8:- face_12:- face_16:- face_17:- face_19:- face_21:- face_22:- face_24:- "
    "face_26:- face_37:- face_41:- face_44:- face_46:-";

const std::vector<std::string_view>& names() {
    static const std::vector<std::string_view> all = split_words(kNames);
    assert(all.size() == kLandmarks);
    return all;
}

void append_points(KeypointLayout& layout, std::string_view table) {
    for (const std::string_view entry : split_words(table)) {
        const size_t colon = entry.find(':');
        const std::string_view ours = entry.substr(colon + 1);
        layout.points.push_back({entry.substr(0, colon), landmark_named(ours)});
        assert(ours == "-" || layout.points.back().ours);
    }
}

KeypointLayout make_layout(std::string_view name, const std::vector<std::string_view>& tables,
                           bool zero_is_missing = false) {
    KeypointLayout layout{.name = name, .points = {}, .zero_is_missing = zero_is_missing};
    for (const std::string_view table : tables) append_points(layout, table);
    return layout;
}

std::string face_points(int count) {
    std::string table;
    for (int i = 0; i < count; ++i) table += format("face_{}:- ", i);
    return table;
}

// The 21 points of a hand, of which the root repeats the wrist.
std::string hand_points(std::string_view side) {
    std::string table = format(" {}_hand_root:-", side);
    for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
        for (int i = 1; i <= 4; ++i) table += format(" {0}_{1}_{2}:{0}_{1}_{2}", side, finger, i);
    }
    return table;
}

// What the middle part of a name may be called, in small letters and without separators.
constexpr std::array<std::pair<std::string_view, std::string_view>, 52> kSpellings = {{
    {"hips", "pelvis"},
    {"hip", "pelvis"},
    {"midhip", "pelvis"},
    {"root", "pelvis"},
    {"hipcenter", "pelvis"},
    {"pelvis", "pelvis"},
    {"spine", "spine"},
    {"spine1", "spine"},
    {"spine2", "chest"},
    {"torso", "chest"},
    {"chest", "chest"},
    {"spine3", "upper_chest"},
    {"upperchest", "upper_chest"},
    {"thorax", "thorax"},
    {"midshoulder", "thorax"},
    {"neck", "neck"},
    {"head", "head"},
    {"headtop", "head_top"},
    {"vertex", "head_top"},
    {"tophead", "head_top"},
    {"nose", "nose"},
    {"jaw", "jaw"},
    {"neck/nose", "nose"},
    {"eye", "eye"},
    {"eyeinner", "eye_inner"},
    {"eyeouter", "eye_outer"},
    {"ear", "ear"},
    {"mouth", "mouth"},
    {"collar", "collar"},
    {"clavicle", "collar"},
    {"shoulder", "shoulder"},
    {"elbow", "elbow"},
    {"wrist", "wrist"},
    {"hand", "hand"},
    {"knee", "knee"},
    {"ankle", "ankle"},
    {"heel", "heel"},
    {"toe", "toe"},
    {"toes", "toe"},
    {"bigtoe", "toe"},
    {"footindex", "toe"},
    {"toebase", "toe"},
    {"toetip", "toe"},
    {"smalltoe", "small_toe"},
    {"littletoe", "small_toe"},
    {"thumb", "thumb_2"},
    {"index", "index_1"},
    {"pinky", "little_1"},
    {"little", "little_1"},
    {"middle", "middle_1"},
    {"ring", "ring_1"},
    {"foot", "ankle"},
}};

// "RWrist", "r_wrist" and "wrist R" all become {"r", "wrist"} or {"wrist", "r"}.
std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words(1);
    for (size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        const bool upper = c >= 'A' && c <= 'Z';
        const bool after_lower = i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z';
        const bool before_lower = i + 1 < name.size() && name[i + 1] >= 'a' && name[i + 1] <= 'z';
        const bool separator = c == '_' || c == ' ' || c == '-' || c == '.' || c == ':';
        if (separator || (upper && (after_lower || before_lower))) {
            if (!words.back().empty()) words.emplace_back();
        }
        if (!separator) words.back() += to_lower(std::string_view(&c, 1));
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

struct SidedName {
    std::string side;  // "left_", "right_" or ""
    std::string stem;  // the other words in one
};

SidedName split_side(std::string_view name) {
    SidedName sided;
    for (const std::string& word : words_of(name)) {
        if (sided.side.empty() && (word == "l" || word == "left")) {
            sided.side = "left_";
        } else if (sided.side.empty() && (word == "r" || word == "right")) {
            sided.side = "right_";
        } else {
            sided.stem += word;
        }
    }
    return sided;
}

// "indexfingerpip" is index_2, "pinky3" little_3, "thumbip" thumb_3.
std::optional<std::string> finger_stem(std::string stem) {
    std::string finger;
    for (const std::string_view name : {"thumb", "index", "middle", "ring", "little", "pinky"}) {
        if (stem.starts_with("hand" + std::string(name))) stem.erase(0, 4);
        if (!stem.starts_with(name)) continue;
        finger = name == "pinky" ? "little" : name;
        stem.erase(0, name.size());
    }
    if (finger.empty()) return std::nullopt;
    if (stem.starts_with("finger")) stem.erase(0, 6);
    const bool thumb = finger == "thumb";
    if (stem == "1" || stem == (thumb ? "cmc" : "mcp")) return finger + "_1";
    if (stem == "2" || stem == (thumb ? "mcp" : "pip")) return finger + "_2";
    if (stem == "3" || stem == (thumb ? "ip" : "dip")) return finger + "_3";
    if (stem == "4" || stem == "tip") return finger + "_4";
    return std::nullopt;
}

std::optional<Landmark> landmark_of_stem(const std::string& side, const std::string& stem) {
    if (!side.empty() && stem == "hip") return landmark_named(side + "hip");
    if (const auto finger = finger_stem(stem)) return landmark_named(side + *finger);
    for (const auto& [theirs, ours] : kSpellings) {
        if (stem == theirs) return landmark_named(side + std::string(ours));
    }
    return std::nullopt;
}

}  // namespace

std::string_view name_of(Landmark landmark) {
    return names()[static_cast<size_t>(landmark)];
}

std::optional<Landmark> landmark_named(std::string_view name) {
    for (size_t i = 0; i < names().size(); ++i) {
        if (names()[i] == name) return static_cast<Landmark>(i);
    }
    return std::nullopt;
}

Landmark mirrored(Landmark landmark) {
    const std::string name(name_of(landmark));
    if (name.starts_with("left_")) return *landmark_named("right_" + name.substr(5));
    if (name.starts_with("right_")) return *landmark_named("left_" + name.substr(6));
    return landmark;
}

std::string LayoutPoint::name() const {
    if (ours) return std::string(name_of(*ours));
    return is_face_point(theirs) ? std::string(theirs) : "";
}

bool is_face_point(std::string_view name) {
    if (!name.starts_with("face_")) return false;
    const auto number = parse_integer(name.substr(5));
    return number && *number >= 0 && *number < kFacePoints && name == format("face_{}", *number);
}

const std::vector<KeypointLayout>& picture_layouts() {
    // The names of points are views into it.
    static const std::string face = face_points(kFacePoints);
    static const std::string face_and_hands = face_points(68) + hand_points("left") + hand_points("right");
    static const std::vector<KeypointLayout> layouts = {
        make_layout("PATS 52", {kPats52}),
        make_layout("PATS 11", {kPats11}),
        make_layout("OpenPose face 70", {face}),
        make_layout("PATS face 15", {kPatsFace15}),
        make_layout("COCO-WholeBody 133", {kCoco17, kWholeBodyFeet, face_and_hands}, true),
        make_layout("Halpe 26", {kCoco17, kHalpeBody}, true),
        make_layout("Halpe 136", {kCoco17, kHalpeBody, face_and_hands}, true),
    };
    return layouts;
}

const std::vector<KeypointLayout>& keypoint_layouts() {
    static const std::vector<KeypointLayout> layouts = {
        make_layout("MediaPipe 33", {kMediaPipe33}),
        make_layout("MediaPipe 75", {kMediaPipe75}, true),
        make_layout("Human3.6M 17", {kHuman36M17}),
        make_layout("COCO 17", {kCoco17}, true),
        make_layout("BODY_25", {kBody25}, true),
        make_layout("Kinect 25", {kKinect25}, true),
        make_layout("COCO 18", {kCoco18}, true),
        make_layout("SMPL 22", {kSmpl22}),
        make_layout("SMPL 24", {kSmpl22, kSmplHands}),
        make_layout("SMPL-H 52", {kSmpl22, kSmplFingers}),
        make_layout("SMPL-X 55", {kSmpl22, kSmplFace, kSmplFingers}),
    };
    return layouts;
}

std::optional<Landmark> landmark_spelled(std::string_view name) {
    if (const auto exact = landmark_named(name)) return exact;
    const SidedName sided = split_side(name);
    if (const auto found = landmark_of_stem(sided.side, sided.stem)) return found;
    // "lwrist": one small letter for the side.
    if (!sided.side.empty() || sided.stem.size() < 2) return std::nullopt;
    if (sided.stem[0] == 'l') return landmark_of_stem("left_", sided.stem.substr(1));
    if (sided.stem[0] == 'r') return landmark_of_stem("right_", sided.stem.substr(1));
    return std::nullopt;
}

}  // namespace chironomia
