#include "skinning/gltf/bind_pose.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/text.h"

namespace chironomia {
namespace {

// Ours. Rounding and bones that exporters set straight turn joints by less; a posed head or arm turns by more.
constexpr float kPosed = 3;  // [degrees]

// Ours. A root that is turned by more stands in other axes: it is no pose.
constexpr float kSameAxes = 60;  // [degrees]

constexpr float kSameScale = 0.01f;  // as a share; ours
constexpr float kSameBone = 0.02f;   // ours; of the length of a bone, which no pose changes

float degrees_between(const Mat4& a, const Mat4& b) {
    const Quat turn = inverse(rotation_of(a)) * rotation_of(b);
    return glm::degrees(2 * std::atan2(length(Vec3(turn.x, turn.y, turn.z)), std::abs(turn.w)));
}

float scale_of(const Mat4& matrix) {
    return std::cbrt(std::abs(glm::determinant(Mat3(matrix))));
}

bool mirrors(const Mat4& matrix) {
    return glm::determinant(Mat3(matrix)) <= 0;
}

Transform transform_from(const Mat4& matrix) {
    return {.translation = Vec3(matrix[3]),
            .rotation = rotation_of(matrix),
            .scale = {length(matrix[0]), length(matrix[1]), length(matrix[2])}};
}

struct BoundJoint {
    int joint = 0;  // index into the skeleton
    Mat4 joint_from_mesh;
};

struct BoundSkin {
    std::vector<BoundJoint> joints;  // that move vertices, parents first; not empty
    std::vector<BoundJoint> others;  // whose matrices may hold anything
    std::vector<int> nodes;          // that carry its meshes
};

// A skin without matrices says nothing. All of its joints count as moving where the file has no vertices.
BoundSkin bound_skin(const Avatar& avatar, size_t index) {
    BoundSkin bound;
    const Skin& skin = avatar.skins[index];
    if (std::ranges::all_of(skin.joint_from_mesh, [](const Mat4& m) { return m == Mat4(1); })) return bound;
    std::vector<bool> moves(skin.joints.size(), avatar.surfaces.empty());
    for (const Surface& surface : avatar.surfaces) {
        if (surface.skin != static_cast<int>(index)) continue;
        bound.nodes.push_back(surface.joint);
        for (const Influence& influence : surface.influences) {
            if (influence.weight > 0) moves[influence.joint] = true;
        }
    }
    for (size_t j = 0; j < moves.size(); ++j) {
        (moves[j] ? bound.joints : bound.others).push_back({skin.joints[j], skin.joint_from_mesh[j]});
    }
    std::ranges::stable_sort(bound.joints, {}, &BoundJoint::joint);
    return bound;
}

// The skins that say where their joints were, the one with the most joints first.
std::vector<BoundSkin> bound_skins(const Avatar& avatar) {
    std::vector<BoundSkin> skins;
    for (size_t s = 0; s < avatar.skins.size(); ++s) {
        BoundSkin skin = bound_skin(avatar, s);
        if (!skin.joints.empty()) skins.push_back(std::move(skin));
    }
    std::ranges::stable_sort(skins, std::greater{}, [](const BoundSkin& s) { return s.joints.size(); });
    return skins;
}

// Finds where the joints of skins were when they were bound.
class Binder {
  public:
    explicit Binder(const Skeleton& skeleton)
        : skeleton_(skeleton),
          posed_(world_from_joints(skeleton, rest_transforms(skeleton))),
          bound_(posed_.size()),
          perhaps_(posed_.size()) {}

    // Whether any matrix mirrors, which no turn can describe.
    bool mirrored(const BoundSkin& skin) const {
        return std::ranges::any_of(skin.joints, [&](const BoundJoint& joint) {
            return mirrors(joint.joint_from_mesh) || mirrors(posed_[static_cast<size_t>(joint.joint)]);
        });
    }

    // Whether the joints of a skin are posed against one another.
    bool is_posed(const BoundSkin& skin) const {
        const Mat4 root = world_from_mesh(skin.joints.front());
        return std::ranges::any_of(skin.joints, [&](const BoundJoint& joint) {
            return degrees_between(root, world_from_mesh(joint)) > kPosed;
        });
    }

    void bind(const BoundSkin& skin) {
        const Mat4 mesh = bound_world_from_mesh(skin);
        for (const auto& [joint, joint_from_mesh] : skin.joints) {
            std::optional<Mat4>& world = bound_[static_cast<size_t>(joint)];
            if (!world) world = mesh * inverse(joint_from_mesh);
        }
        for (const auto& [joint, joint_from_mesh] : skin.others) {
            if (!mirrors(joint_from_mesh))
                perhaps_[static_cast<size_t>(joint)] = mesh * inverse(joint_from_mesh);
        }
    }

    BindPose result() const {
        BindPose bind{.skeleton = skeleton_, .note = {}};
        std::vector<Joint>& joints = bind.skeleton.joints;
        std::vector<Mat4> world(joints.size());
        float most = 0;
        size_t most_posed = 0;
        for (size_t j = 0; j < joints.size(); ++j) {
            const Mat4 parent = joints[j].parent < 0 ? Mat4(1) : world[static_cast<size_t>(joints[j].parent)];
            const Mat4 posed = to_matrix(joints[j].rest);
            if (bound_[j]) {
                joints[j].rest = transform_from(inverse(parent) * *bound_[j]);
            } else if (const auto rest = rest_of_other(j)) {
                joints[j].rest = *rest;
            }
            world[j] = parent * to_matrix(joints[j].rest);
            if (const float turned = degrees_between(posed, to_matrix(joints[j].rest)); turned > most) {
                most = turned;
                most_posed = j;
            }
        }
        bind.note = format(
            "its nodes are posed, {} by {:.0f} degrees; the pose in which its skin was bound is its rest pose",
            joints[most_posed].name, most);
        return bind;
    }

  private:
    // Of a joint that moves no vertices, as a head that is a mesh on its joint: its turn, where its matrix leaves it in
    // its place on its parent, which no pose changes.
    std::optional<Transform> rest_of_other(size_t joint) const {
        const auto& [name, parent, rest] = skeleton_.joints[joint];
        if (!perhaps_[joint] || parent < 0) return {};
        const auto above = static_cast<size_t>(parent);
        const std::optional<Mat4>& from = bound_[above] ? bound_[above] : perhaps_[above];
        if (!from) return {};
        Transform bound = transform_from(inverse(*from) * *perhaps_[joint]);
        if (distance(bound.translation, rest.translation) > kSameBone * length(rest.translation)) return {};
        return bound;
    }

    // Where a joint carries the mesh as the nodes stand.
    Mat4 world_from_mesh(const BoundJoint& joint) const {
        return posed_[static_cast<size_t>(joint.joint)] * joint.joint_from_mesh;
    }

    // Where the mesh stood when it was bound: by a joint that another skin bound; else, as its root may be posed as
    // well, by the file's axes, the node above the root or one that carries the mesh, whichever is the nearest to
    // where the root carries it.
    Mat4 bound_world_from_mesh(const BoundSkin& skin) const {
        for (const auto& [joint, joint_from_mesh] : skin.joints) {
            const std::optional<Mat4>& world = bound_[static_cast<size_t>(joint)];
            if (world) return *world * joint_from_mesh;
        }
        const Mat4 carried = world_from_mesh(skin.joints.front());
        std::vector<Mat4> places{Mat4(1)};
        const int above = skeleton_.joints[static_cast<size_t>(skin.joints.front().joint)].parent;
        if (above >= 0) places.push_back(posed_[static_cast<size_t>(above)]);
        for (const int node : skin.nodes) places.push_back(posed_[static_cast<size_t>(node)]);
        Mat4 nearest = carried;
        float least = kSameAxes;
        for (const Mat4& place : places) {
            const float turned = degrees_between(place, carried);
            if (std::abs(scale_of(place) / scale_of(carried) - 1) > kSameScale || turned >= least) continue;
            least = turned;
            nearest = place;
        }
        return nearest;
    }

    const Skeleton& skeleton_;
    std::vector<Mat4> posed_;                   // (J) world_from_joint as the nodes stand
    std::vector<std::optional<Mat4>> bound_;    // (J) world_from_joint as skins were bound
    std::vector<std::optional<Mat4>> perhaps_;  // (J) the same of joints that move no vertices
};

}  // namespace

std::optional<BindPose> bind_pose_of(const Avatar& avatar) {
    const std::vector<BoundSkin> skins = bound_skins(avatar);
    Binder binder(avatar.skeleton);
    if (std::ranges::any_of(skins, [&](const BoundSkin& s) { return binder.mirrored(s); })) return {};
    if (std::ranges::none_of(skins, [&](const BoundSkin& s) { return binder.is_posed(s); })) return {};
    for (const BoundSkin& skin : skins) binder.bind(skin);
    return binder.result();
}

}  // namespace chironomia
