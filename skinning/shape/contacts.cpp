#include "skinning/shape/contacts.h"

namespace chironomia {
namespace {

using enum ShapePart;

constexpr size_t kParts = static_cast<size_t>(right_thigh) + 1;

bool is_right(ShapePart part) {
    return part >= right_upper_arm;
}

// The name that a contact goes by: fingers are of the hand.
ShapePart reported(ShapePart part) {
    return part == left_fingers ? left_hand : part == right_fingers ? right_hand : part;
}

bool is_palm(ShapePart part) {
    return part == left_hand || part == right_hand;
}

bool is_forearm(ShapePart part) {
    return part == left_forearm || part == right_forearm;
}

bool is_fingers(ShapePart part) {
    return part == left_fingers || part == right_fingers;
}

bool is_upper_arm(ShapePart part) {
    return part == left_upper_arm || part == right_upper_arm;
}

bool is_of_arm(ShapePart part) {
    return is_upper_arm(part) || is_forearm(part) || is_palm(part) || is_fingers(part);
}

// Whether a place of `part` in `in` is looked for.
bool may_touch(ShapePart part, ShapePart in) {
    if (!is_of_arm(part) || is_upper_arm(part)) return false;
    if (!is_of_arm(in)) return true;
    if (is_right(part) == is_right(in) || is_fingers(part) || is_fingers(in)) return false;
    if (is_upper_arm(in)) return true;
    if (is_forearm(in)) return is_palm(part) || !is_right(part);
    return is_palm(part) && !is_right(part);
}

// Whether two capsules are too far apart for an overlap deeper than `least`.
bool is_far(const Capsule& a, const Capsule& b, float least) {
    const float reach =
        0.5f * (distance(a.from, a.to) + distance(b.from, b.to)) + a.radius + b.radius - least;
    const Vec3 between = 0.5f * (a.from + a.to - b.from - b.to);
    return dot(between, between) > reach * reach;
}

}  // namespace

std::vector<Contact> contacts_of(const BodyShape& shape, const JointPlaces& joints, float least) {
    std::vector<Capsule> capsules;
    capsules.reserve(shape.capsules.size());
    for (const ShapeCapsule& capsule : shape.capsules) capsules.push_back(placed(capsule, joints));
    std::vector<Contact> contacts;
    std::vector<int> known(kParts * kParts, -1);  // index into `contacts`
    for (size_t a = 0; a < capsules.size(); ++a) {
        const ShapePart part = shape.capsules[a].part;
        for (size_t b = 0; b < capsules.size(); ++b) {
            const ShapePart in = shape.capsules[b].part;
            if (!may_touch(part, in) || is_far(capsules[a], capsules[b], least)) continue;
            const Overlap overlap = overlap_of(capsules[a], capsules[b]);
            if (overlap.depth <= least) continue;
            int& index = known[static_cast<size_t>(reported(part)) * kParts + static_cast<size_t>(in)];
            if (index < 0) {
                index = static_cast<int>(contacts.size());
                contacts.push_back({.part = reported(part), .in = in, .overlap = {.depth = least}});
            }
            Contact& contact = contacts[static_cast<size_t>(index)];
            if (overlap.depth <= contact.overlap.depth) continue;
            contact.overlap = overlap;
            contact.place = glm::mix(capsules[a].from, capsules[a].to, overlap.along);
        }
    }
    return contacts;
}

}  // namespace chironomia
