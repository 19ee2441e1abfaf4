#include "tests/skinning/shape/mesh_depth.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/body/rest.h"
#include "skinning/face_region/head_scan.h"

namespace chironomia::testing {
namespace {

constexpr float kPiece = 1e-4f;      // of the surface of an arm [m^2]
constexpr int kDirections = 40;      // in which a triangle may be seen
constexpr int kSeenFrom = 3;         // of them, if it is
constexpr float kAroundBox = 0.02f;  // that a body's part may stand out of the box of its own points [m]

MeshRegion region_of(HumanJoint part) {
    using enum HumanJoint;
    const auto within = [&](HumanJoint first, HumanJoint last) { return part >= first && part <= last; };
    if (part == left_upper_arm) return MeshRegion::left_upper_arm;
    if (part == left_lower_arm) return MeshRegion::left_forearm;
    if (part == right_upper_arm) return MeshRegion::right_upper_arm;
    if (part == right_lower_arm) return MeshRegion::right_forearm;
    const std::string_view name = name_of(part);
    const auto has = [&](std::string_view word) { return name.find(word) != std::string_view::npos; };
    if (has("hand") || has("thumb") || has("index") || has("middle") || has("ring") || has("little"))
        return name.starts_with("left") ? MeshRegion::left_hand : MeshRegion::right_hand;
    if (has("leg") || has("foot") || has("toe")) return MeshRegion::legs;
    if (part == neck || part == head || part == jaw || within(left_eye, right_eye)) return MeshRegion::head;
    return MeshRegion::trunk;
}

// The region of each joint of the skeleton; joints without a name go along with what carries them.
std::vector<MeshRegion> regions_of_joints(const Avatar& avatar) {
    std::vector<MeshRegion> regions(avatar.skeleton.joints.size(), MeshRegion::other);
    for (int i = 0; i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (avatar.humanoid.has(part))
            regions[static_cast<std::size_t>(avatar.humanoid[part])] = region_of(part);
    }
    for (std::size_t j = 0; j < regions.size(); ++j) {
        const int parent = avatar.skeleton.joints[j].parent;
        if (regions[j] == MeshRegion::other && parent >= 0)
            regions[j] = regions[static_cast<std::size_t>(parent)];
    }
    return regions;
}

// The joint that moves each vertex most.
std::vector<int> joints_of(const Avatar& avatar, const Surface& surface) {
    std::vector<int> joints(surface.positions.size(), surface.joint);
    if (surface.skin < 0) return joints;
    for (std::size_t v = 0; v < joints.size(); ++v) {
        float most = 0;
        for (std::size_t i = surface.first_influence[v]; i < surface.first_influence[v + 1]; ++i) {
            if (surface.influences[i].weight <= most) continue;
            most = surface.influences[i].weight;
            joints[v] =
                avatar.skins[static_cast<std::size_t>(surface.skin)].joints[surface.influences[i].joint];
        }
    }
    return joints;
}

bool is_solid(const Avatar& avatar, const Surface& surface) {
    if (surface.figure != 0 || is_hair(avatar, surface)) return false;
    if (surface.material < 0) return true;
    const Material& material = avatar.materials[static_cast<std::size_t>(surface.material)];
    return material.alpha_mode == AlphaMode::opaque && !material.in_mouth;
}

constexpr std::array<std::array<MeshRegion, 3>, 2> kArmRegions = {
    {{MeshRegion::left_upper_arm, MeshRegion::left_forearm, MeshRegion::left_hand},
     {MeshRegion::right_upper_arm, MeshRegion::right_forearm, MeshRegion::right_hand}}};

bool is_hand(MeshRegion region) {
    return region == MeshRegion::left_hand || region == MeshRegion::right_hand;
}

bool is_of_arm(MeshRegion region, std::size_t side) {
    const auto& arm = kArmRegions[side];
    return std::find(arm.begin(), arm.end(), region) != arm.end();
}

Vec3 middle_of(const Triangle& t, std::span<const Vec3> points) {
    return (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0f;
}

Vec3 area_of(const Triangle& t, std::span<const Vec3> points) {
    return 0.5f * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

// Evenly over the sphere, on a golden spiral.
std::vector<Vec3> directions() {
    std::vector<Vec3> all;
    for (int i = 0; i < kDirections; ++i) {
        const float up = 1 - (2 * static_cast<float>(i) + 1) / kDirections, out = std::sqrt(1 - up * up);
        const float around = 2.3999632f * static_cast<float>(i);
        all.emplace_back(out * std::cos(around), up, out * std::sin(around));
    }
    return all;
}

// Those whose front is seen from far away in some directions.
std::vector<Triangle> seen_of(std::vector<Triangle> triangles, std::span<const Vec3> points) {
    const WindingSolid whole(triangles, points);
    const std::vector<Vec3> all = directions();
    std::erase_if(triangles, [&](const Triangle& t) {
        const Vec3 middle = middle_of(t, points), area = area_of(t, points);
        int seen = 0;
        for (size_t i = 0; i < all.size() && seen < kSeenFrom; ++i)
            seen += dot(area, all[i]) > 0 && !whole.is_met(middle, all[i]) ? 1 : 0;
        return seen < kSeenFrom;
    });
    return triangles;
}

}  // namespace

std::string_view name_of(MeshRegion region) {
    constexpr std::array<std::string_view, 10> kNames = {
        "other",     "trunk",           "head",          "legs",      "left upper arm", "left forearm",
        "left hand", "right upper arm", "right forearm", "right hand"};
    return kNames[static_cast<std::size_t>(region)];
}

float depth_of_area(const std::vector<SunkenPiece>& pieces, float area) {
    std::vector<SunkenPiece> deepest = pieces;
    std::sort(deepest.begin(), deepest.end(),
              [](const SunkenPiece& a, const SunkenPiece& b) { return a.depth > b.depth; });
    float sum = 0;
    for (const SunkenPiece& piece : deepest) {
        sum += piece.area;
        if (sum >= area) return piece.depth;
    }
    return 0;
}

MeshDepth::MeshDepth(const Avatar& avatar) {
    const std::vector<MeshRegion> of_joints = regions_of_joints(avatar);
    for (std::size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const Surface& surface = avatar.surfaces[s];
        if (!is_solid(avatar, surface)) continue;
        surfaces_.push_back(s);
        const auto first = static_cast<std::uint32_t>(regions_.size());
        for (const int joint : joints_of(avatar, surface)) {
            joints_.push_back(joint);
            regions_.push_back(joint < 0 ? MeshRegion::other : of_joints[static_cast<std::size_t>(joint)]);
        }
        for (std::size_t i = 0; i + 2 < surface.triangles.size(); i += 3)
            triangles_.push_back({first + surface.triangles[i], first + surface.triangles[i + 1],
                                  first + surface.triangles[i + 2]});
    }
    const std::vector<Vec3> rest = points_of(rest_mesh(avatar));
    triangles_ = seen_of(std::move(triangles_), rest);
    for (const std::size_t side : {0u, 1u}) {
        std::vector<Triangle> others = triangles_;
        std::erase_if(others, [&](const Triangle& t) {
            return std::any_of(t.begin(), t.end(), [&](auto v) { return is_of_arm(regions_[v], side); });
        });
        Obstacle obstacle{.solid = WindingSolid(std::move(others), rest)};
        for (const Triangle& t : obstacle.solid.triangles()) obstacle.regions.push_back(regions_[t[0]]);
        take_pieces(obstacle, side, rest);
        obstacles_.push_back(std::move(obstacle));
    }
}

std::vector<Vec3> MeshDepth::points_of(const PosedMesh& mesh) const {
    std::vector<Vec3> points;
    for (const std::size_t s : surfaces_)
        points.insert(points.end(), mesh.surfaces[s].positions.begin(), mesh.surfaces[s].positions.end());
    return points;
}

// A triangle for each piece, in the order of the mesh.
void MeshDepth::take_pieces(Obstacle& obstacle, std::size_t side, const std::vector<Vec3>& rest) const {
    for (const std::size_t place : {1u, 2u}) {
        const MeshRegion region = kArmRegions[side][place];
        float area = 0;
        for (const Triangle& t : triangles_) {
            if (regions_[t[0]] != region) continue;
            area += length(area_of(t, rest));
            if (area < kPiece) continue;
            obstacle.pieces.push_back({region, t, area});
            area = 0;
        }
    }
}

// Around what each joint moves: nothing outside of all boxes is inside the body.
std::vector<MeshDepth::Box> MeshDepth::boxes_of(const Obstacle& obstacle,
                                                const std::vector<Vec3>& points) const {
    std::map<int, Box> boxes;
    for (const Triangle& t : obstacle.solid.triangles()) {
        for (const auto v : t) {
            const auto [at, is_new] = boxes.try_emplace(joints_[v], Box{points[v], points[v]});
            at->second = {glm::min(at->second.low, points[v]), glm::max(at->second.high, points[v])};
        }
    }
    std::vector<Box> all;
    for (const auto& [joint, box] : boxes)
        all.push_back({box.low - Vec3(kAroundBox), box.high + Vec3(kAroundBox)});
    return all;
}

std::vector<SunkenPiece> MeshDepth::sunken(const PosedMesh& mesh) {
    const std::vector<Vec3> points = points_of(mesh);
    std::vector<SunkenPiece> found;
    for (Obstacle& obstacle : obstacles_) {
        obstacle.solid.move(points);
        const std::vector<Box> boxes = boxes_of(obstacle, points);
        for (const Piece& piece : obstacle.pieces) {
            const Vec3 place = middle_of(piece.triangle, points);
            const bool near = std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
                return glm::all(glm::lessThan(box.low, place)) && glm::all(glm::lessThan(place, box.high));
            });
            if (!near || obstacle.solid.winding_at(place) <= 0.5) continue;
            const auto [depth, triangle] = obstacle.solid.nearest(place);
            const MeshRegion in = obstacle.regions[triangle];
            if (is_hand(piece.region) && is_hand(in)) continue;
            found.push_back({.of = piece.region, .in = in, .depth = depth, .area = piece.area});
        }
    }
    return found;
}

std::vector<NearPiece> MeshDepth::near(const PosedMesh& mesh, float most) {
    const std::vector<Vec3> points = points_of(mesh);
    std::vector<NearPiece> found;
    for (Obstacle& obstacle : obstacles_) {
        obstacle.solid.move(points);
        for (const Piece& piece : obstacle.pieces) {
            if (!is_hand(piece.region)) continue;
            const Vec3 place = middle_of(piece.triangle, points);
            const auto [apart, triangle] = obstacle.solid.nearest(place);
            if (apart > most) continue;
            const float gap = obstacle.solid.winding_at(place) > 0.5 ? -apart : apart;
            found.push_back({piece.region, obstacle.regions[triangle], gap, piece.area, place});
        }
    }
    return found;
}

}  // namespace chironomia::testing
