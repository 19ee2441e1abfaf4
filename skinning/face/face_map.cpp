#include "skinning/face/face_map.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/text.h"
#include "skinning/face/look_angle.h"

namespace chironomia {
namespace {

constexpr float kHint = 0.25f;                     // a unit whose shapes are all weaker is not shown
constexpr float kUsualLook = float(30 * kDegree);  // of a look shape that cannot be measured
constexpr float kStill = 1e-6f;                    // of a vertex that a morph leaves where it is [m]
constexpr float kOnEye = 0.5f;                     // of the weight of a vertex of an eyeball

struct NamedShape {
    std::string name;
    ShapeMeaning meaning;
    std::vector<MorphShare> morphs;
};

// Which morphs (M) move anything: files list morphs of meshes that others show.
std::vector<bool> moving_morphs(const Avatar& avatar) {
    std::vector<bool> moves(avatar.morph_names.size());
    for (const Surface& surface : avatar.surfaces) {
        for (size_t m = 0; m < surface.morphs.size(); ++m) {
            const auto still = [](const Vec3& move) { return length(move) < kStill; };
            if (!std::ranges::all_of(surface.morphs[m].moves, still))
                moves[static_cast<size_t>(surface.first_morph_weight) + m] = true;
        }
    }
    return moves;
}

// "eyeUpperClose_25_L" on the way to "eyeUpperClose_L".
bool is_in_between(const std::string& name, const std::vector<std::string>& names) {
    const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
    for (size_t sign = name.find('_'); sign != std::string::npos; sign = name.find('_', sign + 1)) {
        const auto first = name.begin() + std::ptrdiff_t(sign) + 1, last = std::find(first, name.end(), '_');
        if (last - first != 2 || !std::all_of(first, last, is_digit)) continue;
        const std::string whole = name.substr(0, sign) + std::string(last, name.end());
        if (std::ranges::find(names, whole) != names.end()) return true;
    }
    return false;
}

// Morphs of one name in several meshes are one shape.
std::vector<NamedShape> shapes_of(const Avatar& avatar) {
    std::vector<NamedShape> shapes;
    std::map<std::string, size_t> place_of;
    const std::vector<bool> moves = moving_morphs(avatar);
    for (size_t m = 0; m < avatar.morph_names.size(); ++m) {
        const std::string& name = avatar.morph_names[m];
        if (!moves[m] || is_in_between(name, avatar.morph_names)) continue;
        const auto [place, is_new] = place_of.emplace(name, shapes.size());
        if (is_new) shapes.push_back({.name = name, .meaning = read_shape_name(name), .morphs = {}});
        shapes[place->second].morphs.push_back({.morph = static_cast<int>(m)});
    }
    for (const Expression& expression : avatar.expressions) {
        NamedShape shape{
            .name = expression.name, .meaning = read_expression_name(expression.name), .morphs = {}};
        for (const ExpressionBind& bind : expression.binds)
            if (moves[static_cast<size_t>(bind.morph)])
                shape.morphs.push_back({.morph = bind.morph, .weight = bind.weight});
        if (!shape.morphs.empty()) shapes.push_back(std::move(shape));
    }
    std::erase_if(shapes, [](const NamedShape& shape) { return !shape.meaning.is_known(); });
    return shapes;
}

bool covers(FaceSide side, FaceSide wanted) {
    return side == FaceSide::both || side == wanted;
}

float share_of(const NamedShape& shape, int unit) {
    for (const UnitShare& share : shape.meaning.units) {
        if (share.unit == unit) return share.weight;
    }
    return 0;
}

// The shapes of the first family that shows the unit on this side.
std::vector<const NamedShape*> best_shapes(const std::vector<NamedShape>& shapes,
                                           const FaceChannel& channel) {
    std::vector<const NamedShape*> found;
    for (const NamedShape& shape : shapes) {
        // A jaw that goes sideways has to know where.
        if (channel.unit == 30 && shape.meaning.side == FaceSide::both) continue;
        if (share_of(shape, channel.unit) <= 0 || !covers(shape.meaning.side, channel.side)) continue;
        found.push_back(&shape);
    }
    if (found.empty()) return found;
    const auto family = (*std::min_element(found.begin(), found.end(), [](const auto* a, const auto* b) {
                            return a->meaning.family < b->meaning.family;
                        }))->meaning.family;
    std::erase_if(found, [&](const NamedShape* shape) { return shape->meaning.family != family; });
    const std::vector<const NamedShape*> all = found;
    std::erase_if(found, [&](const NamedShape* shape) {
        return shape->meaning.side == FaceSide::both &&
               std::any_of(all.begin(), all.end(), [&](const NamedShape* other) {
                   return other->meaning.side != FaceSide::both && other->meaning.key == shape->meaning.key;
               });
    });
    const bool shown = std::any_of(found.begin(), found.end(), [&](const NamedShape* shape) {
        return share_of(*shape, channel.unit) >= kHint;
    });
    if (!shown) found.clear();
    return found;
}

void add_unit(FaceMap& map, const std::vector<NamedShape>& shapes, int unit) {
    std::vector<const NamedShape*> used;
    for (const FaceSide side : {FaceSide::left, FaceSide::right}) {
        for (const NamedShape* shape : best_shapes(shapes, {.unit = unit, .side = side})) {
            if (std::find(used.begin(), used.end(), shape) != used.end()) continue;
            used.push_back(shape);
            map.units.push_back({.unit = unit,
                                 .side = shape->meaning.side,
                                 .weight = share_of(*shape, unit),
                                 .shape = shape->name,
                                 .family = shape->meaning.family,
                                 .morphs = shape->morphs});
        }
    }
}

// The surfaces whose morph a weight moves, each with that morph.
struct MovedSurface {
    const Surface& surface;
    const Morph& morph;
};
std::vector<MovedSurface> moved_by(const Avatar& avatar, int weight) {
    std::vector<MovedSurface> moved;
    for (const Surface& surface : avatar.surfaces) {
        const int index = weight - surface.first_morph_weight;
        if (index < 0 || index >= static_cast<int>(surface.morphs.size())) continue;
        const Morph& morph = surface.morphs[static_cast<size_t>(index)];
        if (!morph.vertices.empty()) moved.push_back({surface, morph});
    }
    return moved;
}

bool moves_eyeball(const Avatar& avatar, const MovedSurface& moved, const FaceJoints& joints) {
    if (turn_of_morph(moved.surface, moved.morph)) return true;
    if (joints.eyes[0] < 0) return false;
    const std::vector<float> weights =
        weights_on(avatar, moved.surface, {joints.eyes.begin(), joints.eyes.end()});
    size_t on_eye = 0;
    for (const std::uint32_t v : moved.morph.vertices) on_eye += weights[v] > kOnEye ? 1 : 0;
    return 2 * on_eye > moved.morph.vertices.size();
}

LookShape look_shape(const Avatar& avatar, const NamedShape& shape, const FaceJoints& joints) {
    LookShape look{.side = shape.meaning.side, .look = shape.meaning.look, .shape = shape.name};
    for (MorphShare share : shape.morphs) {
        for (const MovedSurface& moved : moved_by(avatar, share.morph)) {
            const auto turn = turn_of_morph(moved.surface, moved.morph);
            if (turn) look.whole = std::max(look.whole, *turn * share.weight);
            share.eyeball = share.eyeball || moves_eyeball(avatar, moved, joints);
        }
        // Eyes that joints turn must not be turned again.
        if (!(share.eyeball && joints.eyes[0] >= 0)) look.morphs.push_back(share);
    }
    if (look.whole == 0) look.whole = kUsualLook;
    return look;
}

// Of several families that look the same way, the first.
void add_looks(FaceMap& map, const Avatar& avatar, const std::vector<NamedShape>& shapes) {
    for (const NamedShape& shape : shapes) {
        if (shape.meaning.look == Look::none) continue;
        const bool better = std::any_of(shapes.begin(), shapes.end(), [&](const NamedShape& other) {
            return other.meaning.look != Look::none && other.meaning.family < shape.meaning.family;
        });
        if (better) continue;
        LookShape look = look_shape(avatar, shape, map.joints);
        if (!look.morphs.empty()) map.looks.push_back(std::move(look));
    }
    map.lids_look = std::any_of(map.looks.begin(), map.looks.end(), [](const LookShape& look) {
        return look.look == Look::down && std::any_of(look.morphs.begin(), look.morphs.end(),
                                                      [](const MorphShare& share) { return !share.eyeball; });
    });
}

bool has_unit(const FaceMap& map, int unit) {
    return std::any_of(map.units.begin(), map.units.end(),
                       [&](const UnitShape& shape) { return shape.unit == unit; });
}

std::string joint_name(const Avatar& avatar, int joint) {
    return format("joint {}", avatar.skeleton.joints[static_cast<size_t>(joint)].name);
}

}  // namespace

FaceMap map_face(const Avatar& avatar) {
    FaceMap map{.joints = find_face_joints(avatar), .morphs = avatar.morph_names.size()};
    const std::vector<NamedShape> shapes = shapes_of(avatar);
    for (const int unit : known_action_units()) add_unit(map, shapes, unit);
    add_looks(map, avatar, shapes);
    map.lips_close = has_unit(map, 8);
    map.jaw_drops = !has_unit(map, 26) && map.joints.jaw >= 0;
    map.jaw_opens_lips = !has_unit(map, 25) && map.joints.jaw >= 0;
    map.lids_close = !has_unit(map, 45) && map.joints.upper_lids[0] >= 0;
    return map;
}

std::vector<std::string> shown_by(const FaceMap& map, const Avatar& avatar, const FaceChannel& channel) {
    std::vector<std::string> names;
    for (const UnitShape& shape : map.units) {
        const bool meant = channel.side == FaceSide::both || covers(shape.side, channel.side);
        if (shape.unit == channel.unit && meant) names.push_back(shape.shape);
    }
    if (channel.unit == 8 && !map.lips_close) return shown_by(map, avatar, {.unit = 26});
    const bool jaw = (channel.unit == 26 && map.jaw_drops) || (channel.unit == 25 && map.jaw_opens_lips);
    if (jaw) names.push_back(joint_name(avatar, map.joints.jaw));
    if (channel.unit == 45 && map.lids_close) {
        for (const auto& lids : {map.joints.upper_lids, map.joints.lower_lids}) {
            for (const int lid : lids) names.push_back(joint_name(avatar, lid));
        }
    }
    return names;
}

bool turns_eyes(const FaceMap& map) {
    if (map.joints.eyes[0] >= 0) return true;
    return std::any_of(map.looks.begin(), map.looks.end(), [](const LookShape& look) {
        return std::any_of(look.morphs.begin(), look.morphs.end(),
                           [](const MorphShare& share) { return share.eyeball; });
    });
}

}  // namespace chironomia
