#include "skinning/humanoid/humanoid_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "core/text.h"
#include "skinning/humanoid/humanoid_names.h"
#include "skinning/humanoid/humanoid_shape.h"
#include "skinning/humanoid/joint_tree.h"

namespace chironomia {
namespace {

constexpr std::array kSides = {Side::left, Side::right};

// A Rigify rig has "ORG-" joints beside its "DEF-" joints. They are parts of the body only where the DEF joints form no
// valid body.
enum class Originals { left_out, read };

// The length of what all names begin with, up to a separator: "Subject1_".
size_t shared_prefix(const Skeleton& skeleton) {
    if (skeleton.joints.size() < 2) return 0;
    std::string_view shared = skeleton.joints.front().name;
    for (const Joint& joint : skeleton.joints) {
        const auto differs = std::ranges::mismatch(shared, joint.name).in1;
        shared = shared.substr(0, static_cast<size_t>(differs - shared.begin()));
    }
    const size_t separator = shared.find_last_of("_:.- ");
    return separator == std::string_view::npos ? 0 : separator + 1;
}

// Whether a joint repeats its parent, as FBX loaders write it: it has the name and the place of its parent.
bool repeats_parent(const Skeleton& skeleton, size_t joint) {
    const Joint& child = skeleton.joints[joint];
    return child.parent >= 0 && child.rest.translation == Vec3(0) &&
           child.name == skeleton.joints[static_cast<size_t>(child.parent)].name;
}

class NameGuess {
  public:
    NameGuess(const Skeleton& skeleton, const std::vector<bool>& joints, Originals originals)
        : tree_(skeleton, joints) {
        const size_t shared = shared_prefix(skeleton);
        for (size_t j = 0; j < skeleton.joints.size(); ++j) {
            NameReading reading = read_joint_name(std::string_view(skeleton.joints[j].name).substr(shared));
            // Eyeballs and a jaw may be meshes that hang from the head.
            const bool of_face = reading.role == Role::eye || reading.role == Role::jaw;
            const bool left_out =
                (reading.is_original && originals == Originals::left_out) || repeats_parent(skeleton, j);
            readings_.push_back(
                (tree_.is_joint(static_cast<int>(j)) || of_face) && !left_out ? reading : NameReading{});
        }
    }

    HumanoidMap find();
    // With eyes and jaw below the head of a body that was found otherwise, where names say them.
    HumanoidMap with_face(const HumanoidMap& body);

  private:
    // The joints of a role and side, nearest to the root first.
    std::vector<int> all(Role role, Side side) const;
    int first(Role role, Side side) const;
    int first_below(Role role, Side side, int above) const;
    bool is_below(int joint, int above) const {
        return joint >= 0 && above >= 0 && tree_.is_below(joint, above);
    }

    void find_arm(Side side);
    void find_leg(Side side);
    void find_fingers(Side side);
    void find_middle();
    void find_face();
    void drop_misplaced_parts();
    int best_head(int chest) const;
    int hips_above(int trunk) const;

    JointTree tree_;
    std::vector<NameReading> readings_;
    HumanoidMap map_;
};

std::vector<int> NameGuess::all(Role role, Side side) const {
    std::vector<int> joints;
    for (size_t j = 0; j < readings_.size(); ++j) {
        if (readings_[j].role == role && readings_[j].side == side) joints.push_back(static_cast<int>(j));
    }
    std::stable_sort(joints.begin(), joints.end(),
                     [&](int a, int b) { return tree_.depth(a) < tree_.depth(b); });
    return joints;
}

int NameGuess::first(Role role, Side side) const {
    const std::vector<int> joints = all(role, side);
    return joints.empty() ? -1 : joints.front();
}

int NameGuess::first_below(Role role, Side side, int above) const {
    for (const int joint : all(role, side)) {
        if (is_below(joint, above)) return joint;
    }
    return -1;
}

void NameGuess::find_arm(Side side) {
    int upper = first(Role::upper_arm, side);
    int lower = first(Role::lower_arm, side);
    int hand = first(Role::hand, side);
    const std::vector<int> arms = all(Role::arm, side), shoulders = all(Role::shoulder, side);
    if (upper < 0 && !arms.empty()) {
        upper = arms.front();
        // A chain of joints that are all called "arm": upper, lower, hand.
        if (lower < 0 && arms.size() > 1) lower = arms[1];
        if (hand < 0 && arms.size() > 2 && is_below(arms[2], lower)) hand = arms[2];
    }
    if (lower < 0 && !arms.empty() && is_below(arms.front(), upper)) lower = arms.front();
    if (upper < 0 && !shoulders.empty()) upper = shoulders.back();
    int clavicle = first(Role::clavicle, side);
    if (clavicle < 0 && !shoulders.empty() && is_below(upper, shoulders.front()))
        clavicle = shoulders.front();

    map_[on_side(HumanJoint::left_shoulder, side)] = clavicle;
    map_[on_side(HumanJoint::left_upper_arm, side)] = upper;
    map_[on_side(HumanJoint::left_lower_arm, side)] = lower;
    map_[on_side(HumanJoint::left_hand, side)] = hand;
}

void NameGuess::find_leg(Side side) {
    int upper = first(Role::upper_leg, side);
    int lower = first(Role::lower_leg, side);
    int foot = first(Role::ankle, side);
    int toes = first(Role::toes, side);
    const std::vector<int> legs = all(Role::leg, side), hips = all(Role::hip, side),
                           feet = all(Role::foot, side);
    const bool legs_alone = upper < 0 && lower < 0 && hips.empty();
    if (upper < 0 && !hips.empty()) upper = hips.back();
    if (upper < 0 && !legs.empty()) upper = legs.front();
    for (const int leg : legs) {
        if (lower < 0 && is_below(leg, upper)) lower = leg;
    }
    if (!feet.empty()) {
        // SMPL's foot hangs from the ankle and stands for the toes.
        if (foot < 0) {
            foot = feet.front();
        } else if (toes < 0 && is_below(feet.front(), foot)) {
            toes = feet.front();
        }
    }
    // A chain of joints that are all called "leg": upper, lower, foot, toes.
    if (legs_alone && foot < 0 && legs.size() > 2) foot = legs[2];
    if (legs_alone && toes < 0 && legs.size() > 3 && is_below(legs[3], foot)) toes = legs[3];

    map_[on_side(HumanJoint::left_upper_leg, side)] = upper;
    map_[on_side(HumanJoint::left_lower_leg, side)] = lower;
    map_[on_side(HumanJoint::left_foot, side)] = foot;
    map_[on_side(HumanJoint::left_toes, side)] = toes;
}

// "Finger1Proximal" and "finger1-2" have the number 1; -1 if there is none.
int number_of_finger(const NameReading& reading) {
    return reading.numbers.empty() ? -1 : reading.numbers.front().front() - '0';
}

void NameGuess::find_fingers(Side side) {
    static constexpr std::array kFingers = {Role::thumb, Role::index, Role::middle, Role::ring, Role::little};
    static constexpr std::array kFirst = {HumanJoint::left_thumb_1, HumanJoint::left_index_1,
                                          HumanJoint::left_middle_1, HumanJoint::left_ring_1,
                                          HumanJoint::left_little_1};
    const int hand = map_[on_side(HumanJoint::left_hand, side)];
    const std::vector<int> numbered = all(Role::finger, side);
    const auto number = [&](int joint) { return number_of_finger(readings_[static_cast<size_t>(joint)]); };
    // 3ds Max counts from the thumb, 0; Rokoko and MakeHuman from 1. Beside a thumb with a name 1 is the index finger.
    const bool from_zero = !all(Role::thumb, side).empty() ||
                           std::ranges::any_of(numbered, [&](int joint) { return number(joint) == 0; });
    for (size_t f = 0; f < kFingers.size(); ++f) {
        std::vector<int> joints = all(kFingers[f], side);
        for (const int joint : numbered) {
            if (number(joint) == static_cast<int>(f) + (from_zero ? 0 : 1)) joints.push_back(joint);
        }
        // Of the joints 0 to 3 the first lies in the palm (Talking With Hands, Oculus).
        const bool from_palm = joints.size() > 3 && readings_[static_cast<size_t>(joints.front())].numbers ==
                                                        std::vector<std::string>{"0"};
        int above = hand;
        int part = 0;
        for (const int joint : std::span(joints).subspan(from_palm ? 1 : 0)) {
            if (part == 3 || !is_below(joint, above)) continue;
            map_[on_side(static_cast<HumanJoint>(static_cast<int>(kFirst[f]) + part), side)] = joint;
            above = joint;
            ++part;
        }
    }
}

// Of several joints called "head" the one nearest to the arms: others are meshes or ends.
int NameGuess::best_head(int chest) const {
    int best = -1, best_depth = -1;
    for (const int head : all(Role::head, Side::none)) {
        const int shared = tree_.shared_ancestor(head, chest);
        const int depth = shared < 0 ? -1 : tree_.depth(shared);
        if (shared >= 0 && head != shared && depth > best_depth) {
            best = head;
            best_depth = depth;
        }
    }
    return best;
}

// The hips: where legs and trunk meet, or a joint above that is named so.
int NameGuess::hips_above(int trunk) const {
    int meeting = trunk;
    bool has_legs = false;
    for (const Side side : kSides) {
        const int leg = map_[on_side(HumanJoint::left_upper_leg, side)];
        if (leg < 0) continue;
        meeting = tree_.shared_ancestor(meeting, leg);
        has_legs = true;
        if (meeting < 0) return -1;
    }
    for (int joint = meeting; joint >= 0; joint = tree_.parent(joint)) {
        if (readings_[static_cast<size_t>(joint)].role == Role::hips && joint != trunk) return joint;
    }
    if (has_legs) return meeting;
    // A figure without legs: the joint under its spine, or the lowest joint of its spine.
    int lowest = trunk;
    for (int joint = trunk; joint >= 0; joint = tree_.parent(joint)) {
        if (readings_[static_cast<size_t>(joint)].role == Role::spine) lowest = joint;
    }
    const int below = tree_.parent(lowest);
    return below >= 0 && tree_.is_joint(below) ? below : lowest;
}

void NameGuess::find_middle() {
    const int left = map_[HumanJoint::left_upper_arm], right = map_[HumanJoint::right_upper_arm];
    if (left < 0 || right < 0) return;
    int chest = tree_.shared_ancestor(left, right);
    if (chest < 0) return;

    std::vector<int> necks;
    for (const int neck : all(Role::neck, Side::none)) {
        if (tree_.shared_ancestor(neck, chest) >= 0) necks.push_back(neck);
    }
    int head = best_head(chest);
    // Rigify counts neck and head among the spine: its joints above the arms.
    if (head < 0 && necks.empty()) {
        for (const int spine : all(Role::spine, Side::none)) {
            if (is_below(spine, chest)) necks.push_back(spine);
        }
    }
    // A chain of joints that are all called "neck" ends in the head.
    if (head < 0 && necks.size() > 1 && is_below(necks.back(), necks.front())) {
        head = necks.back();
        necks.pop_back();
    }
    const int top = head >= 0 ? head : necks.empty() ? -1 : necks.front();
    if (top >= 0) chest = tree_.shared_ancestor(chest, top);
    if (chest < 0 || chest == top) return;
    map_[HumanJoint::head] = head;
    for (const int neck : necks) {
        if (is_below(neck, chest) && (head < 0 || is_below(head, neck))) {
            map_[HumanJoint::neck] = neck;
            break;
        }
    }
    if (head >= 0 && !map_.has(HumanJoint::neck)) {
        const std::vector<int> between = tree_.path(chest, tree_.parent(head));
        if (!between.empty()) map_[HumanJoint::neck] = between.front();
    }
    map_[HumanJoint::hips] = hips_above(chest);
    if (map_.has(HumanJoint::hips)) spread_spine(map_, tree_, chest);
}

void NameGuess::find_face() {
    const int head = map_[HumanJoint::head];
    map_[HumanJoint::jaw] = first_below(Role::jaw, Side::none, head);
    map_[HumanJoint::left_eye] = first_below(Role::eye, Side::left, head);
    map_[HumanJoint::right_eye] = first_below(Role::eye, Side::right, head);
}

HumanoidMap NameGuess::with_face(const HumanoidMap& body) {
    map_ = body;
    find_face();
    for (const HumanJoint part : {HumanJoint::jaw, HumanJoint::left_eye, HumanJoint::right_eye})
        if (!map_.has(part)) map_[part] = body[part];
    return map_;
}

HumanoidMap NameGuess::find() {
    for (const Side side : kSides) {
        find_arm(side);
        find_leg(side);
    }
    find_middle();
    find_face();
    for (const Side side : kSides) find_fingers(side);
    drop_misplaced_parts();
    return map_;
}

// The joint of a part must be a descendant of the joint of the part above it, and not the same joint.
void NameGuess::drop_misplaced_parts() {
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        if (!map_.has(part) || part == HumanJoint::hips) continue;
        std::optional<HumanJoint> above = parent_of(part);
        while (above && !map_.has(*above)) above = parent_of(*above);
        if (above && !is_below(map_[part], map_[*above])) map_[part] = -1;
    }
}

std::vector<std::string> missing_parts(const HumanoidMap& map, const std::vector<HumanJoint>& parts) {
    std::vector<std::string> missing;
    for (const HumanJoint part : parts) {
        if (!map.has(part)) missing.emplace_back(name_of(part));
    }
    return missing;
}

// What a body cannot do without, and is not there.
std::vector<std::string> missing_essentials(const HumanoidMap& map) {
    std::vector<std::string> missing =
        missing_parts(map, {HumanJoint::hips, HumanJoint::left_upper_arm, HumanJoint::left_lower_arm,
                            HumanJoint::right_upper_arm, HumanJoint::right_lower_arm});
    if (!map.has(HumanJoint::neck) && !map.has(HumanJoint::head)) missing.emplace_back("head");
    return missing;
}

Vec3 place(const std::vector<Mat4>& world, int joint) {
    return origin(world[static_cast<size_t>(joint)]);
}

// From the hips along the spine.
Vec3 trunk_direction(const std::vector<Mat4>& world, const HumanoidMap& map) {
    const Vec3 shoulders =
        (place(world, map[HumanJoint::left_upper_arm]) + place(world, map[HumanJoint::right_upper_arm])) /
        2.0f;
    return shoulders - place(world, map[HumanJoint::hips]);
}

// From the first joint of a limb to its last one.
Vec3 limb_direction(const std::vector<Mat4>& world, const HumanoidMap& map,
                    const std::array<HumanJoint, 3>& limb) {
    Vec3 sum(0);
    for (const Side side : kSides) {
        const int first = map[on_side(limb[0], side)];
        int last = map[on_side(limb[2], side)];
        if (last < 0) last = map[on_side(limb[1], side)];
        if (first >= 0 && last >= 0) sum += place(world, last) - place(world, first);
    }
    return sum;
}

bool has_length(const Vec3& direction) {
    return length(direction) > 1e-6f;
}

// Why it is no human although every part is there: it stands on four legs. "" if it does not.
std::string four_legs_fault(const Skeleton& skeleton, const HumanoidMap& map) {
    const std::vector<Mat4> world = world_from_joints(skeleton, rest_transforms(skeleton));
    const Vec3 legs = limb_direction(
        world, map, {HumanJoint::left_upper_leg, HumanJoint::left_lower_leg, HumanJoint::left_foot});
    const Vec3 arms = limb_direction(
        world, map, {HumanJoint::left_upper_arm, HumanJoint::left_lower_arm, HumanJoint::left_hand});
    const Vec3 trunk = trunk_direction(world, map);
    if (!has_length(legs) || !has_length(arms) || !has_length(trunk)) return "";
    const float bend = glm::degrees(angle_between(trunk, legs)),
                reach = glm::degrees(angle_between(arms, legs));
    if (bend > 120 || reach > 45) return "";
    return format(
        "it stands on four legs (its spine is at {:.0f} degrees to its hind legs, and its front legs point "
        "the same way); an upright spine over two legs, two arms and a head was sought",
        bend);
}

// Swaps left and right if feet and face say that the names have them wrong.
void check_sides(const Skeleton& skeleton, HumanoidGuess& guess) {
    const std::vector<Mat4> world = world_from_joints(skeleton, rest_transforms(skeleton));
    HumanoidMap& map = guess.map;
    const Vec3 left =
        place(world, map[HumanJoint::left_upper_arm]) - place(world, map[HumanJoint::right_upper_arm]);
    const Vec3 forward = cross(left, trunk_direction(world, map));
    if (!has_length(forward)) return;

    Vec3 seen(0);
    for (const Side side : kSides) {
        const int foot = map[on_side(HumanJoint::left_foot, side)],
                  toes = map[on_side(HumanJoint::left_toes, side)];
        if (foot >= 0 && toes >= 0) seen += place(world, toes) - place(world, foot);
        const int eye = map[on_side(HumanJoint::left_eye, side)];
        if (eye >= 0 && map.has(HumanJoint::head))
            seen += place(world, eye) - place(world, map[HumanJoint::head]);
    }
    const Vec3 up = normalize(trunk_direction(world, map));
    const Vec3 level = seen - up * dot(seen, up);
    if (!has_length(level) || dot(normalize(level), normalize(forward)) > -0.5f) return;

    HumanoidMap swapped;
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        swapped[mirrored(part)] = map[part];
    }
    map = swapped;
    guess.swapped = true;
    guess.notes.emplace_back(
        "its names call the figure's left side right: feet and face point the other way; the sides were "
        "swapped");
}

void add_missing_notes(HumanoidGuess& guess) {
    std::vector<HumanJoint> body;
    for (int p = 0; p < static_cast<int>(HumanJoint::left_thumb_1); ++p)
        body.push_back(static_cast<HumanJoint>(p));
    std::vector<std::string> missing = missing_parts(guess.map, body);
    int fingers = 0;
    for (int p = static_cast<int>(HumanJoint::left_thumb_1); p < kHumanJoints; ++p)
        fingers += guess.map.has(static_cast<HumanJoint>(p)) ? 1 : 0;
    if (fingers < 30) missing.push_back(format("{} of 30 finger joints", 30 - fingers));
    if (!missing.empty()) guess.notes.push_back("missing: " + join(missing));
}

// Whether a part of the middle is played by a joint whose name says left or right, or two limbs' by joints of one side:
// the shape was misread.
bool names_contradict(const Skeleton& skeleton, const HumanoidMap& map) {
    const auto side_of = [&](HumanJoint part) {
        return map.has(part) ? read_joint_name(skeleton.joints[static_cast<size_t>(map[part])].name).side
                             : Side::none;
    };
    using enum HumanJoint;
    for (const HumanJoint part : {spine, chest, upper_chest, neck, head}) {
        if (side_of(part) != Side::none) return true;
    }
    for (const HumanJoint part : {left_upper_arm, left_lower_arm, left_upper_leg, left_lower_leg}) {
        if (side_of(part) != Side::none && side_of(part) == side_of(mirrored(part))) return true;
    }
    return false;
}

HumanoidGuess validated(const Skeleton& skeleton, HumanoidGuess guess) {
    const std::vector<std::string> missing = missing_essentials(guess.map);
    if (!missing.empty()) {
        guess.refusal = format(
            "no joint was found for {}, neither by name nor by shape; two arms, a head and hips "
            "were sought",
            join(missing));
        return guess;
    }
    guess.refusal = four_legs_fault(skeleton, guess.map);
    if (!guess.refusal.empty()) return guess;
    check_sides(skeleton, guess);
    add_missing_notes(guess);
    return guess;
}

}  // namespace

HumanoidGuess find_humanoid(const Skeleton& skeleton, const std::vector<bool>& joints) {
    HumanoidGuess guess{.map = NameGuess(skeleton, joints, Originals::left_out).find(),
                        .notes = {"found by the names of its joints"},
                        .swapped = false,
                        .refusal = {}};
    if (!missing_essentials(guess.map).empty())
        guess.map = NameGuess(skeleton, joints, Originals::read).find();
    if (!missing_essentials(guess.map).empty()) {
        const std::optional<HumanoidMap> shape = find_humanoid_by_shape(skeleton, joints);
        if (shape && !names_contradict(skeleton, *shape)) {
            guess.map = NameGuess(skeleton, joints, Originals::read).with_face(*shape);
            guess.notes = {"found by the shape of its skeleton, because its names say too little"};
        }
    }
    // A body whose limbs are rigid meshes, with a skin somewhere else.
    if (!joints.empty() && !missing_essentials(guess.map).empty()) return find_humanoid(skeleton, {});
    return validated(skeleton, std::move(guess));
}

HumanoidGuess check_humanoid(const Skeleton& skeleton, const HumanoidMap& map) {
    return validated(skeleton, {.map = map, .notes = {"named by the file itself (VRM)"}, .refusal = {}});
}

}  // namespace chironomia
