// What the name of a morph says: the action units it shows, its side, or where it makes an eye look.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/body/face.h"

namespace chironomia {

// Whose words a name is made of. Where an avatar could show a unit in several, the first of these does.
enum class NameFamily {
    facs,        // "AU12_L", "FACS_AU12", "AU_12_left", "AU_12_LipCornerPuller", "lipCornerPuller_L"
    arkit,       // ARKit's 52: "mouthSmileLeft", "mouthSmile_L"
    other,       // faceshift, Mixamo, Character Creator, Daz (h_expressions), VRoid, MakeHuman, MMD
    expression,  // VRM: "happy", "blinkLeft"; a whole expression that stands for its most typical unit
};

// Where a shape makes an eye look; in and out as seen from the nose.
enum class Look { none, up, down, in, out, left, right };

// How much of a shape shows a unit at its full intensity (5), in (0, 1].
struct UnitShare {
    int unit = 0;
    float weight = 1;
};

struct ShapeMeaning {
    NameFamily family = NameFamily::other;
    std::string key{};  // the words without prefix and side, in lower case: two sides of a shape share it
    FaceSide side = FaceSide::both;
    Look look = Look::none;
    std::vector<UnitShare> units{};  // empty: nothing known, or a look

    bool is_known() const { return !units.empty() || look != Look::none; }
};

// Upper and lower case, "_", "-", "." and spaces do not matter, nor do words before those that are known
// ("Face.M_F00_", "h_expressions.", "AK_44_"). Sides are "left", "right", "L", "R" as a word of their own, or
// the last letters. `units` is empty and `look` none for a name that is not known.
ShapeMeaning read_shape_name(std::string_view name);

// The same for an expression of a VRM file.
ShapeMeaning read_expression_name(std::string_view name);

}  // namespace chironomia
