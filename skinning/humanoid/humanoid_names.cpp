#include "skinning/humanoid/humanoid_names.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/text.h"

namespace chironomia {
namespace {

// The words of every rig, in lower case, without side, numbers and what surrounds them.
const std::map<std::string, Role, std::less<>> kWords = {
    // VRM, Mixamo, Ready Player Me, HumanIK, MotionBuilder, CMU
    {"hips", Role::hips},
    {"spine", Role::spine},
    {"chest", Role::spine},
    {"upperchest", Role::spine},
    {"neck", Role::neck},
    {"head", Role::head},
    {"jaw", Role::jaw},
    {"eye", Role::eye},
    {"shoulder", Role::shoulder},
    {"arm", Role::arm},
    {"upperarm", Role::upper_arm},
    {"forearm", Role::lower_arm},
    {"lowerarm", Role::lower_arm},
    {"hand", Role::hand},
    {"upleg", Role::upper_leg},
    {"upperleg", Role::upper_leg},
    {"leg", Role::leg},
    {"lowerleg", Role::lower_leg},
    {"foot", Role::foot},
    {"toe", Role::toes},
    {"toes", Role::toes},
    {"thumb", Role::thumb},
    {"index", Role::index},
    {"middle", Role::middle},
    {"ring", Role::ring},
    {"pinky", Role::little},
    {"little", Role::little},
    {"lowerback", Role::spine},
    // Unreal, Rigify, Biped, Valve
    {"pelvis", Role::hips},
    {"clavicle", Role::clavicle},
    {"thigh", Role::upper_leg},
    {"calf", Role::lower_leg},
    {"shin", Role::lower_leg},
    {"ball", Role::toes},
    {"finger", Role::finger},
    // SMPL, SMPL-X, VRChat, Poser, Daz, MocapNET, Character Creator
    {"collar", Role::clavicle},
    {"elbow", Role::lower_arm},
    {"wrist", Role::hand},
    {"hip", Role::hip},
    {"knee", Role::lower_leg},
    {"ankle", Role::ankle},
    {"abdomen", Role::spine},
    {"abdomenlower", Role::spine},
    {"abdomenupper", Role::spine},
    {"chestlower", Role::spine},
    {"chestupper", Role::spine},
    {"lowerchest", Role::spine},
    {"waist", Role::spine},
    {"torso", Role::spine},
    {"necklower", Role::neck},
    {"neckupper", Role::neck},
    {"necktwist", Role::neck},
    {"shldr", Role::upper_arm},
    {"mid", Role::middle},
    {"jawroot", Role::jaw},
    {"lowerjaw", Role::jaw},
    {"eyeball", Role::eye},
    {"eyesmplhf", Role::eye},
    // MetaHuman: "FACIAL_L_Eye"; VRoid: "J_Adj_L_FaceEye"
    {"facialeye", Role::eye},
    {"facialjaw", Role::jaw},
    {"adjfaceeye", Role::eye},
    // others met in the world
    {"uparm", Role::upper_arm},
    {"loarm", Role::lower_arm},
    {"lowarm", Role::lower_arm},
    {"loleg", Role::lower_leg},
    {"lowleg", Role::lower_leg},
    {"armupper", Role::upper_arm},
    {"armlower", Role::lower_arm},
    {"legupper", Role::upper_leg},
    {"leglower", Role::lower_leg},
    {"collarbone", Role::clavicle},
    {"clav", Role::clavicle},
    {"humerus", Role::upper_arm},
    {"femur", Role::upper_leg},
    {"tibia", Role::lower_leg},
    {"lowerspine", Role::spine},
    {"upperspine", Role::spine},
    {"thorax", Role::spine},
    {"thumbfinger", Role::thumb},
    // Xsens MVN: the bones of each finger by their anatomy; the other metacarpals lie in the palm.
    {"firstmc", Role::thumb},
    {"firstpp", Role::thumb},
    {"firstdp", Role::thumb},
    {"secondpp", Role::index},
    {"secondmp", Role::index},
    {"seconddp", Role::index},
    {"thirdpp", Role::middle},
    {"thirdmp", Role::middle},
    {"thirddp", Role::middle},
    {"fourthpp", Role::ring},
    {"fourthmp", Role::ring},
    {"fourthdp", Role::ring},
    {"fifthpp", Role::little},
    {"fifthmp", Role::little},
    {"fifthdp", Role::little},
    {"indexfinger", Role::index},
    {"middlefinger", Role::middle},
    {"ringfinger", Role::ring},
    {"littlefinger", Role::little},
    {"pinkyfinger", Role::little},
    {"pinkie", Role::little},
    // OptiTrack Motive
    {"ab", Role::spine},
    {"uarm", Role::upper_arm},
    {"farm", Role::lower_arm},
    // BEAT: "RHandT1", "LHandI2"
    {"handt", Role::thumb},
    {"handi", Role::index},
    {"handm", Role::middle},
    {"handr", Role::ring},
    {"handp", Role::little},
    {"fist", Role::hand},
    {"idx", Role::index},
    {"lit", Role::little},
    // MikuMikuDance
    {"\u4e0a\u534a\u8eab", Role::spine},
    {"\u9996", Role::neck},
    {"\u982d", Role::head},
    {"\u76ee", Role::eye},
    {"\u80a9", Role::clavicle},
    {"\u8155", Role::upper_arm},
    {"\u3072\u3058", Role::lower_arm},
    {"\u624b\u9996", Role::hand},
    {"\u8db3", Role::upper_leg},
    {"\u3072\u3056", Role::lower_leg},
    {"\u8db3\u9996", Role::ankle},
    {"\u3064\u307e\u5148", Role::toes},
    {"\u89aa\u6307", Role::thumb},
    {"\u4eba\u6307", Role::index},
    {"\u4e2d\u6307", Role::middle},
    {"\u85ac\u6307", Role::ring},
    {"\u5c0f\u6307", Role::little},
};

// Words that say nothing about the part: the names of rigs, of kinds of joints, of places along a finger.
constexpr std::array kNoise = {
    "mixamorig", "bip",      "biped",    "valve",        "j",      "b",       "c",     "f",         "m",
    "def",       "org",      "cc",       "base",         "bone",   "jnt",     "joint", "jt",        "bind",
    "sk",        "skin",     "skeleton", "armature",     "rig",    "metarig", "bend",  "character", "human",
    "actor",     "proximal", "distal",   "intermediate", "medial", "avatar",  "body",  "root",      "fng",
    "fin",
};

// Words of joints that only help others.
constexpr std::array kHelpers = {
    "end",        "nub",    "site",   "null",   "tip",    "twist",      "roll",       "ik",     "pole",
    "target",     "helper", "ctrl",   "attach", "socket", "weapon",     "prop",       "lid",    "eyelid",
    "brow",       "lash",   "muscle", "pivot",  "palm",   "metacarpal", "metatarsal", "carpal", "in",
    "corrective", "fix",    "offset", "share",  "volume", "mch",
};

enum class Kind { other, lower, upper, digit };

Kind kind_of(char c) {
    if (c >= '0' && c <= '9') return Kind::digit;
    if (c >= 'A' && c <= 'Z') return Kind::upper;
    if ((c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80) return Kind::lower;
    return Kind::other;
}

// "mixamorig:LeftUpLeg" without the part before the last colon or bar.
std::string_view without_namespace(std::string_view name) {
    const size_t mark = name.find_last_of(":|");
    return mark == std::string_view::npos ? name : name.substr(mark + 1);
}

// Runs of letters and of digits; a capital begins a new one: "LHipJoint01" is L, Hip, Joint, 01.
std::vector<std::string> name_parts_of(std::string_view name) {
    std::vector<std::string> words;
    Kind before = Kind::other;
    for (size_t i = 0; i < name.size(); ++i) {
        const Kind kind = kind_of(name[i]);
        const Kind next = i + 1 < name.size() ? kind_of(name[i + 1]) : Kind::other;
        const bool both_letters = kind != Kind::digit && before != Kind::digit;
        const bool capital = kind == Kind::upper && (before != Kind::upper || next == Kind::lower);
        const bool begins = before == Kind::other || !(kind == before || both_letters) || capital;
        if (kind != Kind::other) {
            if (begins) words.emplace_back();
            words.back() += name[i];
        }
        before = kind;
    }
    for (std::string& word : words) word = to_lower(word);
    return words;
}

// Japanese rigs number their fingers with full-width digits.
std::string with_plain_digits(std::string_view name) {
    static constexpr std::string_view kLead = "\xEF\xBC";
    std::string plain;
    for (size_t i = 0; i < name.size(); ++i) {
        const bool digit = name.substr(i).starts_with(kLead) && i + 2 < name.size() &&
                           static_cast<unsigned char>(name[i + 2]) - 0x90u < 10;
        plain += digit ? static_cast<char>('0' + (static_cast<unsigned char>(name[i + 2]) - 0x90)) : name[i];
        if (digit) i += 2;
    }
    return plain;
}

template <typename List>
bool contains(const List& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

struct SidePrefix {
    std::string_view text;
    Side side;
};
constexpr std::array kSidePrefixes = {SidePrefix{"left", Side::left},   SidePrefix{"right", Side::right},
                                      SidePrefix{"l", Side::left},      SidePrefix{"r", Side::right},
                                      SidePrefix{"\u5de6", Side::left}, SidePrefix{"\u53f3", Side::right}};

Side side_of(std::string_view word) {
    if (word == "l" || word == "lf" || word == "lft" || word == "left") return Side::left;
    if (word == "r" || word == "rt" || word == "rgt" || word == "right") return Side::right;
    return Side::none;
}

std::optional<Role> role_of(std::string_view word) {
    const auto known = kWords.find(word);
    if (known != kWords.end()) return known->second;
    // "LeftHandThumb1": the finger of the hand.
    if (word.starts_with("hand") && word.size() > 4) return role_of(word.substr(4));
    return std::nullopt;
}

// "LeftThumbMetacarpal" (VRM 1.0, OpenXR) and "RightFinger1Metacarpal" (Rokoko).
bool is_thumb(std::string_view word, const std::vector<std::string>& numbers) {
    return role_of(word) == Role::thumb || (word == "finger" && numbers == std::vector<std::string>{"1"});
}

// The letter behind a word that counts the joints of a chain: "spineA", "spineB", "fngMidC".
bool counts_a_chain(std::string_view part, std::string_view word) {
    if (part.size() != 1 || part.front() < 'a' || part.front() > 'e') return false;
    const auto role = role_of(word);
    return role &&
           (*role == Role::spine || *role == Role::neck || (*role >= Role::thumb && *role <= Role::little));
}

// A side that is grown together with the word: "lhand", "rightthigh".
NameReading with_side_in_word(std::string_view word) {
    for (const SidePrefix& prefix : kSidePrefixes) {
        if (!word.starts_with(prefix.text)) continue;
        if (const auto role = role_of(word.substr(prefix.text.size()))) return {*role, prefix.side, {}};
    }
    return {};
}

// One side's pelvis and hip-joint bones carry the upper leg, but are none.
Role with_side_judged(Role role, Side side) {
    if (role == Role::hip && side == Side::none) return Role::hips;
    if (role == Role::hips && side != Side::none) return Role::none;
    return role;
}

}  // namespace

NameReading read_joint_name(std::string_view name) {
    std::string word;
    NameReading reading;
    bool hip_joint = false, twist = false;
    if (name.starts_with("__")) return {};  // MakeHuman's helpers between two joints: "__UpLeg_L"
    reading.is_original = without_namespace(name).starts_with("ORG-");
    for (const std::string& part : name_parts_of(with_plain_digits(without_namespace(name)))) {
        if (kind_of(part.front()) == Kind::digit) {
            if (!word.empty()) reading.numbers.push_back(part);
        } else if (reading.side == Side::none && side_of(part) != Side::none) {
            reading.side = side_of(part);
        } else if (part == "metacarpal" && is_thumb(word, reading.numbers)) {
            continue;  // the first joint that moves; other metacarpals lie in the palm
        } else if (word == "hand" && reading.side != Side::none && kWords.contains(word + part)) {
            word += part;
        } else if (contains(kHelpers, part)) {
            if (part != "twist") return {};
            twist = true;
        } else if (counts_a_chain(part, word)) {
            continue;
        } else if (contains(kNoise, part)) {
            hip_joint = hip_joint || (part == "joint" && word == "hip");
        } else {
            word += part;
        }
    }
    if (hip_joint && reading.side != Side::none) return {};
    if (word.size() == 5 && word.starts_with("hand") && reading.numbers.empty())
        return {};  // BEAT's metacarpals
    // Character Creator's neck is named for its twist; every other twist joint helps.
    if (twist && !(word == "neck" && reading.side == Side::none)) return {};

    if (const auto role = role_of(word)) {
        reading.role = *role;
    } else {
        const NameReading grown = with_side_in_word(word);
        reading.role = grown.role;
        if (grown.side != Side::none) reading.side = grown.side;
    }
    reading.role = with_side_judged(reading.role, reading.side);
    return reading;
}

}  // namespace chironomia
