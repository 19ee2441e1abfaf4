// Where a body's hands and forearms are in the body.
#pragma once

#include <vector>

#include "skinning/shape/body_shape.h"

namespace chironomia {

// The deepest place of one part in another.
struct Contact {
    ShapePart part = ShapePart::left_hand;  // a forearm or a hand
    ShapePart in = ShapePart::trunk;
    Overlap overlap{};
    Vec3 place{0};  // on the line of `part` [m, world]
};

// Of hands (fingers included) and forearms in trunk, neck, head, thighs, and in the other arm's upper arm, forearm and
// palm, those that are deeper than `least` [m], one for each pair of parts. Fingers may be in the other hand, where
// clasped fingers are, and a forearm's contact with the other hand counts as that hand's. What both arms do to each
// other is said once, of the left one, unless a right hand is in the left forearm or upper arm, or a right forearm in
// the left upper arm.
std::vector<Contact> contacts_of(const BodyShape& shape, const JointPlaces& joints, float least);

}  // namespace chironomia
