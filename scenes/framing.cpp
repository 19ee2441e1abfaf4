#include "scenes/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace chironomia {
namespace {

constexpr float kMargin = 0.04f;  // of the picture, free on each side

// A leg whose bone lies so far off the vertical does not stand; ours [rad].
constexpr float kSits = 50 * kPi / 180;

struct LegJoints {
    HumanJoint thigh, shin, foot;
};
constexpr LegJoints kLegs[] = {
    {HumanJoint::left_upper_leg, HumanJoint::left_lower_leg, HumanJoint::left_foot},
    {HumanJoint::right_upper_leg, HumanJoint::right_lower_leg, HumanJoint::right_foot}};

// From joint to joint in the rest pose [m, world]; 0 where one of them is missing.
Vec3 rest_bone(const Avatar& avatar, HumanJoint from, HumanJoint to) {
    if (!avatar.humanoid.has(from) || !avatar.humanoid.has(to)) return Vec3(0);
    const std::vector<Mat4> world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    const auto at = [&](HumanJoint part) {
        return origin(world[static_cast<size_t>(avatar.humanoid[part])]);
    };
    return at(to) - at(from);
}

Bounds figure_bounds(const Avatar& avatar) {
    return bounds_of(figure_of(avatar, rest_mesh(avatar)));
}

// Straightens the legs of a rest pose that sits, and lifts it until its soles are where they were: the figure will be
// shown standing there. None for others.
std::optional<Avatar> standing_rest(const Avatar& avatar) {
    const Vec3 down(0, -1, 0);
    const auto sits = [&](const LegJoints& leg) {
        const Vec3 thigh = rest_bone(avatar, leg.thigh, leg.shin);
        return length(thigh) > 0 && angle_between(thigh, down) > kSits;
    };
    if (std::ranges::none_of(kLegs, sits)) return std::nullopt;
    Avatar standing = avatar;
    for (const LegJoints& leg : kLegs) {
        if (!sits(leg)) continue;
        for (const auto& [from, to] : {std::pair(leg.thigh, leg.shin), std::pair(leg.shin, leg.foot)}) {
            const Vec3 bone = rest_bone(standing, from, to);
            if (!(length(bone) > 0)) continue;
            const auto joint = static_cast<size_t>(avatar.humanoid[from]);
            const Quat turn =
                rotation_of(world_from_joints(standing.skeleton, rest_transforms(standing.skeleton))[joint]);
            Quat& rest = standing.skeleton.joints[joint].rest.rotation;
            rest = normalize(rest * conjugate(turn) * turn_between(bone, down) * turn);
        }
    }
    const float lift = figure_bounds(avatar).low.y - figure_bounds(standing).low.y;
    for (Joint& joint : standing.skeleton.joints)
        if (joint.parent < 0) joint.rest.translation.y += lift;
    return standing;
}

// Joint places at rest, by human part.
class RestJoints {
  public:
    explicit RestJoints(const Avatar& avatar)
        : map_(avatar.humanoid),
          world_(world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton))) {}

    std::optional<Vec3> at(HumanJoint part) const {
        if (!map_.has(part)) return std::nullopt;
        return origin(world_[static_cast<size_t>(map_[part])]);
    }
    std::optional<Vec3> between(HumanJoint left) const {
        const auto a = at(left), b = at(mirrored(left));
        if (!a || !b) return std::nullopt;
        return (*a + *b) * 0.5f;
    }
    // Mean over both sides of the distance from one part to the next.
    std::optional<float> bone(HumanJoint from, HumanJoint to) const {
        const auto a = at(from), b = at(to), c = at(mirrored(from)), d = at(mirrored(to));
        if (!a || !b || !c || !d) return std::nullopt;
        return (distance(*a, *b) + distance(*c, *d)) / 2;
    }

  private:
    const HumanoidMap& map_;
    std::vector<Mat4> world_;
};

// The highest vertex near the axis of the head, so that a raised hand does not count.
float top_of_head(const PosedMesh& mesh, const Bounds& bounds, const std::optional<Vec3>& head) {
    if (!head) return bounds.high.y;
    const float reach = 0.15f * (bounds.high.y - bounds.low.y);
    float top = head->y;
    for (const PosedSurface& surface : mesh.surfaces) {
        for (const Vec3& p : surface.positions) {
            if (std::hypot(p.x - head->x, p.z - head->z) < reach) top = std::max(top, p.y);
        }
    }
    return top;
}

// Whether a joint is `head` or below it.
std::vector<bool> joints_of_head(const Avatar& avatar) {
    const int head = avatar.humanoid[HumanJoint::head];
    std::vector<bool> of_head;
    for (size_t j = 0; j < avatar.skeleton.joints.size(); ++j) {
        const int parent = avatar.skeleton.joints[j].parent;
        of_head.push_back(static_cast<int>(j) == head ||
                          (parent >= 0 && of_head[static_cast<size_t>(parent)]));
    }
    return of_head;
}

// Whether a vertex moves with the head: more of its weight is there than elsewhere.
bool is_of_head(const Avatar& avatar, const Surface& surface, size_t vertex,
                const std::vector<bool>& of_head) {
    if (surface.skin < 0) return surface.joint >= 0 && of_head[static_cast<size_t>(surface.joint)];
    const Skin& skin = avatar.skins[static_cast<size_t>(surface.skin)];
    float weight = 0;
    for (size_t i = surface.first_influence[vertex]; i < surface.first_influence[vertex + 1]; ++i) {
        const Influence& influence = surface.influences[i];
        if (of_head[static_cast<size_t>(skin.joints[influence.joint])]) weight += influence.weight;
    }
    return weight > 0.5f;
}

// Sets what the head fills, with its hair and what it wears; nothing of an avatar without a head.
void measure_head(const Avatar& avatar, const PosedMesh& mesh, FigureMeasures& figure) {
    if (!avatar.humanoid.has(HumanJoint::head)) return;
    const std::vector<bool> of_head = joints_of_head(avatar);
    const Vec3 left = cross(Vec3(0, 1, 0), figure.forward);
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        const std::vector<Vec3>& positions = mesh.surfaces[s].positions;
        for (size_t v = 0; v < positions.size(); ++v) {
            if (!is_of_head(avatar, avatar.surfaces[s], v, of_head)) continue;
            const Vec3 offset = positions[v] - figure.middle;
            figure.top = std::max(figure.top, positions[v].y);
            figure.head_side = std::max(figure.head_side, std::abs(dot(offset, left)));
            figure.head_front = std::max(figure.head_front, dot(offset, figure.forward));
        }
    }
}

Vec3 facing_of(const RestJoints& joints) {
    const auto left = joints.at(HumanJoint::left_upper_arm), right = joints.at(HumanJoint::right_upper_arm);
    if (!left || !right) return {0, 0, 1};
    const Vec3 sideways(left->x - right->x, 0, left->z - right->z);
    if (length(sideways) < 1e-6f) return {0, 0, 1};
    return normalize(cross(sideways, Vec3(0, 1, 0)));
}

// The room in the axes of a figure: to its left, up, forward, from its middle on the floor.
struct Room {
    float half_width = 0;  // [m]
    float bottom = 0;      // of the body, above the floor [m]
    float top = 0;
    float front_bottom = 0;  // of the hands before the body
    float front_top = 0;
    float back = 0;   // behind the middle, negative [m]
    float front = 0;  // before it
};

Room room_of_body(const FigureMeasures& figure, Framing framing) {
    const float height = figure.top - figure.floor;
    const float shoulders = figure.shoulders - figure.floor;
    const float hips = figure.hips - figure.floor;
    const float arm = figure.upper_arm + figure.forearm + figure.hand;
    const float elbow_room =
        figure.shoulder_width / 2 + figure.upper_arm + 0.5f * (figure.forearm + figure.hand);
    const float chest = 0.08f * height;  // half the depth of a body
    switch (framing) {
        case Framing::box:
            return room_of_body(figure, Framing::full);
        case Framing::upper:
            return {.half_width = elbow_room,
                    .bottom = hips - 0.5f * (figure.hips - figure.knees),
                    .top = 1.04f * height,
                    .front_bottom = hips,
                    .front_top = height,
                    .back = -chest,
                    .front = 0.6f * arm};
        case Framing::full: {
            const float reach = std::max(1.03f * height, shoulders + arm);
            return {.half_width = elbow_room,
                    .bottom = 0,
                    .top = reach,
                    .front_bottom = 0,
                    .front_top = height,
                    .back = -chest,
                    .front = 0.3f * arm};
        }
        case Framing::head:
            return {.half_width = 0.62f * figure.shoulder_width,
                    .bottom = shoulders - 0.05f * height,
                    .top = 1.03f * height,
                    .front_bottom = shoulders,
                    .front_top = height,
                    .back = -chest,
                    .front = chest};
    }
    return {};
}

// A head of the size of a person's lies in the room of the body; that of a cartoon figure may be wider and nearer to
// the camera than the hands.
Room room_in_figure(const FigureMeasures& figure, Framing framing) {
    const float spared =
        0.02f * (figure.top - figure.floor);  // a nose before the room, which the margin holds
    Room room = room_of_body(figure, framing);
    if (figure.head_side > room.half_width + spared) room.half_width = figure.head_side;
    if (figure.head_front > room.front + spared) room.front = figure.head_front;
    return room;
}

// What lies in a plane, a line or a point is seen from a distance all the same.
std::array<Vec3, 8> corners_of(const Bounds& box) {
    const Vec3 half = (box.high - box.low) * 0.5f;
    const float largest = std::max({half.x, half.y, half.z});
    const Vec3 room = largest > 0 ? glm::max(half, Vec3(1e-3f * largest)) : Vec3(0.5f);
    std::array<Vec3, 8> corners;
    for (size_t i = 0; i < corners.size(); ++i) {
        corners[i] =
            (box.low + box.high) * 0.5f + room * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    }
    return corners;
}

// The upright box around `box` where its figure is put and turned by `turn`.
Bounds turned(const Bounds& box, const FigureMeasures& figure, const Placement& place, float turn) {
    Bounds around{.low = Vec3(std::numeric_limits<float>::max()),
                  .high = Vec3(-std::numeric_limits<float>::max())};
    const Quat rotation = glm::angleAxis(turn, Vec3(0, 1, 0));
    const Vec3 foot(figure.middle.x, figure.floor, figure.middle.z);
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                          i & 4 ? box.high.z : box.low.z);
        const Vec3 there = Vec3(place.x, 0, place.z) + rotation * (corner - foot);
        around = {.low = glm::min(around.low, there), .high = glm::max(around.high, there)};
    }
    return around;
}

}  // namespace

FigureMeasures measure_figure(const Avatar& at_rest) {
    const std::optional<Avatar> standing = standing_rest(at_rest);
    const Avatar& avatar = standing ? *standing : at_rest;
    const RestJoints joints(avatar);
    const PosedMesh mesh = rest_mesh(avatar);
    const PosedMesh alone = figure_of(avatar, mesh);
    const Bounds bounds = bounds_of(alone);
    const float height = std::max(bounds.high.y - bounds.low.y, 1e-3f);
    const auto height_of = [&](const std::optional<Vec3>& place, float otherwise) {
        return place ? place->y : bounds.low.y + otherwise * height;
    };

    using enum HumanJoint;
    FigureMeasures figure{.forward = facing_of(joints), .floor = bounds.low.y};
    figure.top = top_of_head(alone, bounds, joints.at(head));
    // Shares of the height of an adult where a joint is missing.
    figure.head = height_of(joints.at(head) ? joints.at(head) : joints.at(neck), 0.88f);
    figure.shoulders = height_of(joints.between(left_upper_arm), 0.81f);
    figure.hips = height_of(joints.between(left_upper_leg), 0.52f);
    figure.knees = height_of(joints.between(left_lower_leg), 0.28f);
    figure.shoulder_width = joints.bone(left_upper_arm, right_upper_arm).value_or(0.21f * height);
    figure.upper_arm = joints.bone(left_upper_arm, left_lower_arm).value_or(0.17f * height);
    figure.forearm = joints.bone(left_lower_arm, left_hand).value_or(0.15f * height);
    // From the wrist to the tip of a finger is twice the way to its knuckle.
    figure.hand = 2 * joints.bone(left_hand, left_middle_1).value_or(0.055f * height);
    const Vec3 centre = (bounds.low + bounds.high) * 0.5f;
    figure.middle = joints.between(left_upper_arm).value_or(joints.at(hips).value_or(centre));
    figure.middle.y = figure.floor;
    measure_head(avatar, mesh, figure);
    return figure;
}

std::array<Vec3, 8> room_of(const FigureMeasures& figure, Framing framing) {
    if (framing == Framing::box && figure.room) return corners_of(*figure.room);
    const Room room = room_in_figure(figure, framing);
    const Vec3 left = cross(Vec3(0, 1, 0), figure.forward);
    std::array<Vec3, 8> corners;
    for (size_t i = 0; i < corners.size(); ++i) {
        const bool ahead = (i & 4) != 0;
        const float bottom = ahead ? room.front_bottom : room.bottom;
        const float top = ahead ? room.front_top : room.top;
        corners[i] = figure.middle + left * (i & 1 ? room.half_width : -room.half_width) +
                     Vec3(0, i & 2 ? top : bottom, 0) + figure.forward * (ahead ? room.front : room.back);
    }
    return corners;
}

FigureMeasures placed(FigureMeasures figure, const Placement& place) {
    const float own_heading = std::atan2(figure.forward.x, figure.forward.z);
    if (figure.room) figure.room = turned(*figure.room, figure, place, place.heading - own_heading);
    for (float* height : {&figure.top, &figure.head, &figure.shoulders, &figure.hips, &figure.knees}) {
        *height -= figure.floor;
    }
    figure.floor = 0;
    figure.forward = {std::sin(place.heading), 0, std::cos(place.heading)};
    figure.middle = {place.x, 0, place.z};
    return figure;
}

Camera frame_figures(std::span<const FigureMeasures> figures, const Vec3& front, const Shot& shot,
                     RenderSize size) {
    std::vector<Vec3> corners;
    for (const FigureMeasures& figure : figures) {
        const auto room = room_of(figure, shot.framing);
        corners.insert(corners.end(), room.begin(), room.end());
    }
    const Vec3 left = cross(Vec3(0, 1, 0), front);
    const Vec3 level = std::cos(shot.yaw) * front + std::sin(shot.yaw) * left;
    const Vec3 back = std::cos(shot.pitch) * level + Vec3(0, std::sin(shot.pitch), 0);
    const Vec3 right = normalize(cross(Vec3(0, 1, 0), back));
    const Vec3 up = cross(back, right);

    Vec3 target(0);
    for (const Vec3& corner : corners) target += corner / static_cast<float>(corners.size());
    const float tangent_y = std::tan(shot.fov_y / 2) * (1 - 2 * kMargin);
    const float tangent_x = tangent_y * static_cast<float>(size.width) / static_cast<float>(size.height);
    // Move the target until the room sits in the middle of the picture: its near side looks larger.
    float away = 0;
    for (int step = 0; step < 8; ++step) {
        float above = 0, below = 0, to_left = 0, to_right = 0;
        for (const Vec3& corner : corners) {
            const Vec3 offset = corner - target;
            const float near = dot(offset, back);
            above = std::max(above, dot(offset, up) / tangent_y + near);
            below = std::max(below, -dot(offset, up) / tangent_y + near);
            to_left = std::max(to_left, -dot(offset, right) / tangent_x + near);
            to_right = std::max(to_right, dot(offset, right) / tangent_x + near);
        }
        target += up * (0.5f * (above - below) * tangent_y);
        target += right * (0.5f * (to_right - to_left) * tangent_x);
        away = std::max({(above + below) / 2, (to_left + to_right) / 2});
    }
    away /= shot.zoom;
    return {.eye = target + back * away,
            .target = target,
            .fov_y = shot.fov_y,
            .near = 0.1f * away,
            .far = 5 * away};
}

}  // namespace chironomia
