// Swaps left and right.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/degrade/degradations.h"
#include "skinning/humanoid/humanoid_map.h"

namespace chironomia {
namespace {

// The mirror image in the plane x = 0.
Quat mirror(const Quat& turn) {
    return {turn.w, turn.x, -turn.y, -turn.z};
}

Vec3 mirror(const Vec3& place) {
    return {-place.x, place.y, place.z};
}

// A skeleton at rest, and which of its joints are each other's mirror images.
struct Sides {
    std::vector<Quat> rest;         // world_from_joint in the rest pose
    std::vector<Vec3> places;       // in the rest pose
    std::vector<std::size_t> pair;  // the joint on the other side, or the joint itself
    std::vector<Quat> asymmetry;    // turns a joint's rest pose to the mirror image of its partner's
};

// For a joint without a known name: among the children of its parent's partner, the joint nearest to its mirror
// image.
std::size_t nearest_image(const Skeleton& skeleton, const Sides& sides, std::size_t joint) {
    const int parent = skeleton.joints[joint].parent;
    const int wanted = parent < 0 ? -1 : static_cast<int>(sides.pair[static_cast<std::size_t>(parent)]);
    const Vec3 middle = parent < 0 ? Vec3(0) : sides.places[static_cast<std::size_t>(parent)];
    const Vec3 other = wanted < 0 ? Vec3(0) : sides.places[static_cast<std::size_t>(wanted)];
    std::size_t nearest = joint;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        if (skeleton.joints[j].parent != wanted) continue;
        const float apart = distance(mirror(sides.places[joint] - middle), sides.places[j] - other);
        if (apart >= least) continue;
        least = apart;
        nearest = j;
    }
    return nearest;
}

void pair_joints(const Skeleton& skeleton, Sides& sides) {
    const HumanoidMap map = find_humanoid(skeleton).map;
    const std::size_t count = skeleton.joints.size();
    std::vector<std::optional<std::size_t>> named(count);
    for (int part = 0; part < kHumanJoints; ++part) {
        const auto joint = static_cast<HumanJoint>(part);
        if (map.has(joint) && map.has(mirrored(joint)))
            named[static_cast<std::size_t>(map[joint])] = static_cast<std::size_t>(map[mirrored(joint)]);
    }
    sides.pair.resize(count);
    for (std::size_t j = 0; j < count; ++j)
        sides.pair[j] = named[j] ? *named[j] : nearest_image(skeleton, sides, j);
    // Two joints may have the same partner. The one that is not its partner's partner is paired with itself.
    for (std::size_t j = 0; j < count; ++j)
        if (sides.pair[sides.pair[j]] != j) sides.pair[j] = j;
}

// From a joint to the middle of its children in the rest pose; nothing at the end of a chain.
std::vector<Vec3> bones_of(const Skeleton& skeleton, const std::vector<Vec3>& places) {
    std::vector<Vec3> bones(places.size(), Vec3(0));
    std::vector<int> children(places.size(), 0);
    for (std::size_t j = 0; j < places.size(); ++j) {
        if (skeleton.joints[j].parent < 0) continue;
        const auto parent = static_cast<std::size_t>(skeleton.joints[j].parent);
        bones[parent] += places[j] - places[parent];
        ++children[parent];
    }
    // A fork has no single direction, so only joints with one child count.
    for (std::size_t j = 0; j < places.size(); ++j)
        if (children[j] != 1) bones[j] = Vec3(0);
    return bones;
}

Sides sides_of(const Skeleton& skeleton) {
    Sides sides;
    for (const Mat4& joint : world_from_joints(skeleton, rest_transforms(skeleton))) {
        sides.rest.push_back(rotation_of(joint));
        sides.places.push_back(origin(joint));
    }
    pair_joints(skeleton, sides);
    const std::vector<Vec3> bones = bones_of(skeleton, sides.places);
    for (std::size_t j = 0; j < bones.size(); ++j) {
        const std::size_t other = sides.pair[j];
        const bool known = other != j && length(bones[j]) > 1e-6f && length(bones[other]) > 1e-6f;
        const int parent = skeleton.joints[j].parent;
        sides.asymmetry.push_back(known        ? turn_between(bones[j], mirror(bones[other]))
                                  : parent < 0 ? kNoTurn
                                               : sides.asymmetry[static_cast<std::size_t>(parent)]);
    }
    return sides;
}

// Turns each joint from its rest pose by the mirror image of its partner's turn, in world axes.
void mirror_joints(JointTrack& track) {
    const std::vector<Joint>& joints = track.skeleton.joints;
    const Sides sides = sides_of(track.skeleton);
    const std::size_t count = joints.size();
    const auto parent_rest = [&](std::size_t j) {
        return joints[j].parent < 0 ? kNoTurn : sides.rest[static_cast<std::size_t>(joints[j].parent)];
    };
    std::vector<Quat> world(count), turned(count);
    std::vector<Vec3> moved(count);
    for (std::size_t first = 0; first < track.turns.size(); first += count) {
        for (std::size_t j = 0; j < count; ++j) {
            const auto parent = static_cast<std::size_t>(std::max(0, joints[j].parent));
            const Quat& local = track.turns[first + j];
            world[j] = joints[j].parent < 0 ? local : world[parent] * local;
            moved[j] = mirror(parent_rest(j) * (track.translations[first + j] - joints[j].rest.translation));
        }
        for (std::size_t j = 0; j < count; ++j) {
            const std::size_t other = sides.pair[j];
            turned[j] =
                mirror(world[other] * conjugate(sides.rest[other])) * sides.asymmetry[j] * sides.rest[j];
            const int parent = joints[j].parent;
            track.turns[first + j] = normalize(
                parent < 0 ? turned[j] : conjugate(turned[static_cast<std::size_t>(parent)]) * turned[j]);
            track.translations[first + j] =
                joints[j].rest.translation + conjugate(parent_rest(j)) * moved[other];
        }
    }
}

// The point on the other side of the face, of OpenPose's 70 points.
int mirrored_face_point(int point) {
    constexpr std::pair<int, int> kEyesAndLips[] = {{36, 45}, {37, 44}, {38, 43}, {39, 42}, {40, 47},
                                                    {41, 46}, {48, 54}, {49, 53}, {50, 52}, {55, 59},
                                                    {56, 58}, {60, 64}, {61, 63}, {65, 67}, {68, 69}};
    if (point <= 16) return 16 - point;
    if (point <= 26) return 43 - point;
    if (point >= 31 && point <= 35) return 66 - point;
    for (const auto& [a, b] : kEyesAndLips) {
        if (point == a) return b;
        if (point == b) return a;
    }
    return point;
}

std::string mirrored_name(const std::string& name) {
    if (const auto landmark = landmark_named(name)) return std::string(name_of(mirrored(*landmark)));
    if (!is_face_point(name)) return name;
    const auto point = parse_integer(std::string_view(name).substr(std::string_view("face_").size()));
    return format("face_{}", mirrored_face_point(static_cast<int>(*point)));
}

template <typename Track>
void mirror_points(Track& track, float middle) {
    for (auto& place : track.points) place.x = 2 * middle - place.x;
    for (std::string& name : track.names) name = mirrored_name(name);
}

// The middle of all seen points of a clip, left to right.
float middle_of(const PictureTrack& track) {
    double sum = 0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        if (track.confidence[i] <= 0) continue;
        sum += static_cast<double>(track.points[i].x);
        ++seen;
    }
    return static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, seen)));
}

void mirror_face(FaceTrack& face) {
    for (FaceChannel& channel : face.channels) {
        if (channel.side == FaceSide::both) continue;
        channel.side = channel.side == FaceSide::left ? FaceSide::right : FaceSide::left;
    }
    for (Quat& head : face.head) head = mirror(head);
    for (Gaze& gaze : face.gaze)
        gaze = {.left = {-gaze.right.x, gaze.right.y}, .right = {-gaze.left.x, gaze.left.y}};
}

// "right phase" of "left phase"; names without a side stay.
std::string with_other_side(const std::string& name) {
    for (const auto& [side, other] : {std::pair{"left ", "right "}, {"right ", "left "}})
        if (name.starts_with(side)) return other + name.substr(std::string_view(side).size());
    return name;
}

}  // namespace

Motion mirrored(Motion motion) {
    if (motion.joints) mirror_joints(*motion.joints);
    if (motion.keypoints) mirror_points(*motion.keypoints, 0);
    if (motion.picture) mirror_points(*motion.picture, middle_of(*motion.picture));
    if (motion.face) mirror_face(*motion.face);
    for (LabelTrack& track : motion.labels) track.name = with_other_side(track.name);
    return motion;
}

}  // namespace chironomia
