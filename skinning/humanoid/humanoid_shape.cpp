#include "skinning/humanoid/humanoid_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skinning/humanoid/humanoid_names.h"

namespace chironomia {
namespace {

// Two children of a joint whose chains mirror each other.
struct LimbPair {
    int root = -1;
    std::array<int, 2> limbs{-1, -1};
    float size = 0;  // mean length of both chains from the root, less where their bones differ
};

// The parts of one limb.
struct Limb {
    int first = -1;  // clavicle, if it has one
    int upper = -1;
    int lower = -1;
    int end = -1;  // hand or foot
    int tip = -1;  // toes
};

// By how much two lengths differ, whichever is larger.
float ratio_cost(float a, float b) {
    return a > 1e-9f && b > 1e-9f ? std::abs(std::log(a / b)) : 100.0f;
}

class ShapeGuess {
  public:
    ShapeGuess(const Skeleton& skeleton, const std::vector<bool>& joints) : tree_(skeleton, joints) {
        for (const Mat4& world : world_from_joints(skeleton, rest_transforms(skeleton)))
            places_.push_back(origin(world));
        reaches_.assign(places_.size(), 0);
        for (size_t j = places_.size(); j-- > 0;) {
            const int above = tree_.parent(static_cast<int>(j));
            if (above >= 0 && tree_.is_joint(static_cast<int>(j))) {
                float& reach = reaches_[static_cast<size_t>(above)];
                reach = std::max(reach, bone(static_cast<int>(j)) + reaches_[j]);
            }
        }
    }

    std::optional<HumanoidMap> find();

  private:
    const Vec3& at(int joint) const { return places_[static_cast<size_t>(joint)]; }
    float bone(int joint) const { return distance(at(joint), at(tree_.parent(joint))); }
    float size_of(int limb) const { return bone(limb) + reaches_[static_cast<size_t>(limb)]; }
    float height_of(int joint) const { return dot(at(joint), up_); }
    float lateral(int joint) const { return std::abs(dot(at(joint) - at(legs_.root), side_)); }

    std::vector<int> chain_from(int joint) const;
    float likeness(const std::vector<int>& chain_a, const std::vector<int>& chain_b) const;
    std::vector<LimbPair> pairs() const;
    bool choose_limbs();
    Limb arm_of(int limb) const;
    Limb leg_of(int limb) const;
    int elbow(const std::vector<int>& chain, size_t upper, size_t end) const;
    Vec3 forward_of(const std::array<Limb, 2>& legs) const;
    void find_head();
    void find_fingers(Side side, int hand);

    JointTree tree_;
    std::vector<Vec3> places_;    // in the world
    std::vector<float> reaches_;  // length of the longest chain below each joint
    LimbPair legs_, arms_;
    Vec3 up_{0, 1, 0};
    Vec3 side_{1, 0, 0};  // across the body
    HumanoidMap map_;
};

// From the joint to the end of its longest chain.
std::vector<int> ShapeGuess::chain_from(int joint) const {
    std::vector<int> chain = {joint};
    while (!tree_.children(chain.back()).empty()) {
        const std::vector<int>& children = tree_.children(chain.back());
        chain.push_back(*std::max_element(children.begin(), children.end(),
                                          [&](int a, int b) { return size_of(a) < size_of(b); }));
    }
    return chain;
}

// Of the first three bones of two limbs: 1 where each is as long as the other limb's. A neck and a collar bone may
// reach equally far, but their bones differ.
float ShapeGuess::likeness(const std::vector<int>& chain_a, const std::vector<int>& chain_b) const {
    float likeness = 1;
    for (size_t b = 0; b < 3; ++b) {
        const float difference = ratio_cost(bone(chain_a[b]), bone(chain_b[b]));
        const bool of_no_length = bone(chain_a[b]) <= 1e-9f && bone(chain_b[b]) <= 1e-9f;
        if (!of_no_length) likeness *= std::exp(-std::min(difference, 1.0f));
    }
    return likeness;
}

std::vector<LimbPair> ShapeGuess::pairs() const {
    const float largest = *std::max_element(reaches_.begin(), reaches_.end());
    std::vector<LimbPair> pairs;
    for (size_t root = 0; root < places_.size(); ++root) {
        const std::vector<int>& children = tree_.children(static_cast<int>(root));
        for (size_t a = 0; a < children.size(); ++a) {
            for (size_t b = a + 1; b < children.size(); ++b) {
                const float size_a = size_of(children[a]), size_b = size_of(children[b]);
                const bool large = std::min(size_a, size_b) > 0.15f * largest;
                const bool alike = std::abs(size_a - size_b) < 0.1f * std::max(size_a, size_b);
                const std::vector<int> chain_a = chain_from(children[a]), chain_b = chain_from(children[b]);
                if (!large || !alike || std::min(chain_a.size(), chain_b.size()) < 3) continue;
                pairs.push_back({static_cast<int>(root),
                                 {children[a], children[b]},
                                 likeness(chain_a, chain_b) * (size_a + size_b) / 2});
            }
        }
    }
    return pairs;
}

// Legs hang from a joint, arms from one below it in the tree; the largest limbs win.
bool ShapeGuess::choose_limbs() {
    const std::vector<LimbPair> all = pairs();
    float best = 0;
    for (const LimbPair& legs : all) {
        for (const LimbPair& arms : all) {
            const bool in_leg = std::any_of(legs.limbs.begin(), legs.limbs.end(), [&](int limb) {
                return arms.root == limb || tree_.is_below(arms.root, limb);
            });
            if (!tree_.is_below(arms.root, legs.root) || in_leg) continue;
            const Vec3 trunk = at(arms.root) - at(legs.root);
            const Vec3 feet =
                (at(chain_from(legs.limbs[0]).back()) + at(chain_from(legs.limbs[1]).back())) / 2.0f;
            const bool opposite = length(trunk) > 1e-9f && length(feet - at(legs.root)) > 1e-9f &&
                                  angle_between(trunk, feet - at(legs.root)) > radians(120.0f);
            if (!opposite || legs.size + arms.size <= best) continue;
            best = legs.size + arms.size;
            legs_ = legs;
            arms_ = arms;
        }
    }
    return best > 0;
}

// The joint between `upper` and `end` that halves the limb.
int ShapeGuess::elbow(const std::vector<int>& chain, size_t upper, size_t end) const {
    int best = -1;
    float best_cost = 0;
    for (size_t l = upper + 1; l < end; ++l) {
        const float cost =
            ratio_cost(distance(at(chain[upper]), at(chain[l])), distance(at(chain[l]), at(chain[end])));
        if (best < 0 || cost < best_cost) {
            best = chain[l];
            best_cost = cost;
        }
    }
    return best;
}

Limb ShapeGuess::arm_of(int limb) const {
    const std::vector<int> chain = chain_from(limb);
    // The hand: where fingers begin, else the joint that leaves about a hand's length.
    size_t hand = 0;
    for (size_t h = 2; h < chain.size() && hand == 0; ++h) {
        if (tree_.children(chain[h]).size() >= 3) hand = h;
    }
    const bool has_fingers = hand > 0;
    const float whole = size_of(limb) - bone(limb);
    float best_cost = 0;
    for (size_t h = 2; h < chain.size() && !has_fingers; ++h) {
        const float cost = std::abs(reaches_[static_cast<size_t>(chain[h])] - 0.15f * whole);
        if (hand == 0 || cost < best_cost) {
            hand = h;
            best_cost = cost;
        }
    }
    // Clavicles begin near the middle of the body.
    size_t upper = 0;
    const float reach = distance(at(chain[hand]), at(chain[0]));
    while (hand - upper > 2 && lateral(chain[upper]) < 0.2f * reach) ++upper;
    return {.first = upper > 0 ? chain[0] : -1,
            .upper = chain[upper],
            .lower = elbow(chain, upper, hand),
            .end = chain[hand],
            .tip = -1};
}

Limb ShapeGuess::leg_of(int limb) const {
    const std::vector<int> chain = chain_from(limb);
    float lowest = height_of(chain[0]);
    for (const int joint : chain) lowest = std::min(lowest, height_of(joint));
    const float leg = height_of(chain[0]) - lowest;
    // The foot is the first joint near the ground.
    size_t foot = chain.size() - 1;
    for (size_t f = chain.size(); f-- > 2;) {
        if (height_of(chain[f]) - lowest < 0.18f * leg) foot = f;
    }
    size_t upper = 0;
    while (foot - upper > 2 && lateral(chain[upper]) < 0.06f * leg) ++upper;
    return {.first = -1,
            .upper = chain[upper],
            .lower = elbow(chain, upper, foot),
            .end = chain[foot],
            .tip = foot + 1 < chain.size() ? chain[foot + 1] : -1};
}

// Where the toes point, else where the knees bend to; the world's +z if neither says.
Vec3 ShapeGuess::forward_of(const std::array<Limb, 2>& legs) const {
    const auto level = [&](const Vec3& v) { return v - up_ * dot(v, up_) - side_ * dot(v, side_); };
    Vec3 toes(0), knees(0);
    for (const Limb& leg : legs) {
        if (leg.tip >= 0) toes += level(at(leg.tip) - at(leg.end));
        if (leg.lower >= 0) knees += level(at(leg.lower) - (at(leg.upper) + at(leg.end)) / 2.0f);
    }
    const float enough = 0.01f * legs_.size;
    if (length(toes) > enough) return toes;
    if (length(knees) > enough) return knees;
    return Vec3(0, 0, 1);
}

// The chain beyond the arms that reaches highest: neck first, and the head where it branches into the face.
void ShapeGuess::find_head() {
    std::vector<int> best;
    for (const int child : tree_.children(arms_.root)) {
        if (child == arms_.limbs[0] || child == arms_.limbs[1]) continue;
        const std::vector<int> chain = chain_from(child);
        if (height_of(chain.back()) <= height_of(arms_.root)) continue;
        if (best.empty() || height_of(chain.back()) > height_of(best.back())) best = chain;
    }
    if (best.empty()) return;
    if (best.size() == 1) {
        map_[HumanJoint::head] = best[0];
        return;
    }
    size_t head = 1;
    for (size_t h = best.size(); h-- > 1;) {
        if (tree_.children(best[h]).size() > 1) head = h;
    }
    map_[HumanJoint::neck] = best[0];
    map_[HumanJoint::head] = best[head];
}

// The chains of a hand: the thumb's direction is the odd one out, the others lie side by side.
void ShapeGuess::find_fingers(Side side, int hand) {
    static constexpr std::array kFirst = {HumanJoint::left_thumb_1, HumanJoint::left_index_1,
                                          HumanJoint::left_middle_1, HumanJoint::left_ring_1,
                                          HumanJoint::left_little_1};
    std::vector<std::vector<int>> fingers;
    Vec3 mean(0);
    for (const int child : tree_.children(hand)) {
        std::vector<int> chain = chain_from(child);
        // A metacarpal before the three joints of a finger, seen on four of them or none.
        if (chain.size() < 2) continue;
        if (distance(at(chain.back()), at(chain[0])) < 1e-9f) continue;
        mean += normalize(at(chain.back()) - at(hand));
        fingers.push_back(std::move(chain));
    }
    if (fingers.size() < 4 || fingers.size() > 5) return;
    const auto thumb = std::min_element(fingers.begin(), fingers.end(), [&](const auto& a, const auto& b) {
        return dot(normalize(at(a.back()) - at(hand)), mean) < dot(normalize(at(b.back()) - at(hand)), mean);
    });
    std::iter_swap(fingers.begin(), thumb);
    // Three joints each: where chains are longer, the first of them is in the palm.
    const size_t usual = fingers[0].size();
    for (std::vector<int>& finger : fingers) {
        if (finger.size() > usual && finger.size() > 3) finger.erase(finger.begin());
    }
    const Vec3 thumb_root = at(fingers[0][0]);
    std::sort(fingers.begin() + 1, fingers.end(), [&](const auto& a, const auto& b) {
        return distance(at(a[0]), thumb_root) < distance(at(b[0]), thumb_root);
    });
    for (size_t f = 0; f < fingers.size(); ++f) {
        for (size_t part = 0; part < std::min<size_t>(3, fingers[f].size()); ++part)
            map_[on_side(static_cast<HumanJoint>(static_cast<size_t>(kFirst[f]) + part), side)] =
                fingers[f][part];
    }
}

std::optional<HumanoidMap> ShapeGuess::find() {
    if (places_.empty() || !choose_limbs()) return std::nullopt;
    up_ = normalize(at(arms_.root) - at(legs_.root));
    const Vec3 across = at(chain_from(arms_.limbs[0]).back()) - at(chain_from(arms_.limbs[1]).back());
    const Vec3 level = across - up_ * dot(across, up_);
    if (length(level) < 1e-9f) return std::nullopt;
    side_ = normalize(level);

    std::array<Limb, 2> arms = {arm_of(arms_.limbs[0]), arm_of(arms_.limbs[1])};
    std::array<Limb, 2> legs = {leg_of(legs_.limbs[0]), leg_of(legs_.limbs[1])};
    // The left arm comes first.
    const Vec3 left = cross(up_, forward_of(legs));
    if (dot(at(arms[0].end) - at(arms[1].end), left) < 0) std::swap(arms[0], arms[1]);
    if (dot(at(legs[0].upper) - at(legs[1].upper), left) < 0) std::swap(legs[0], legs[1]);

    map_[HumanJoint::hips] = legs_.root;
    for (size_t s = 0; s < 2; ++s) {
        const Side side = s == 0 ? Side::left : Side::right;
        map_[on_side(HumanJoint::left_shoulder, side)] = arms[s].first;
        map_[on_side(HumanJoint::left_upper_arm, side)] = arms[s].upper;
        map_[on_side(HumanJoint::left_lower_arm, side)] = arms[s].lower;
        map_[on_side(HumanJoint::left_hand, side)] = arms[s].end;
        map_[on_side(HumanJoint::left_upper_leg, side)] = legs[s].upper;
        map_[on_side(HumanJoint::left_lower_leg, side)] = legs[s].lower;
        map_[on_side(HumanJoint::left_foot, side)] = legs[s].end;
        map_[on_side(HumanJoint::left_toes, side)] = legs[s].tip;
        find_fingers(side, arms[s].end);
    }
    find_head();
    spread_spine(map_, tree_, arms_.root);
    return map_;
}

}  // namespace

void spread_spine(HumanoidMap& map, const JointTree& tree, int chest) {
    const std::vector<int> spine = tree.path(map[HumanJoint::hips], chest);
    if (spine.empty()) return;
    map[HumanJoint::spine] = spine.front();
    if (spine.size() == 2) map[HumanJoint::chest] = spine[1];
    if (spine.size() > 2) {
        map[HumanJoint::chest] = spine[spine.size() / 2];
        map[HumanJoint::upper_chest] = spine.back();
    }
}

std::optional<HumanoidMap> find_humanoid_by_shape(const Skeleton& skeleton, const std::vector<bool>& joints) {
    return ShapeGuess(skeleton, joints).find();
}

}  // namespace chironomia
