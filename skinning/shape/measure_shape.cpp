#include "skinning/shape/measure_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/body/rest.h"
#include "core/quantile.h"
#include "skinning/body/body_plan.h"
#include "skinning/face_region/head_scan.h"

namespace chironomia {
namespace {

// Ours, chosen by how near the capsules come to the surfaces of the bundled avatars (tests/skinning/shape).
struct MeasureTuning {
    static constexpr float kSpacing = 0.02f;     // of the points on a large triangle [m]
    static constexpr double kOutermost = 0.03;   // share of the points on either side that does not count
    static constexpr size_t kFewest = 8;         // points of which a size is taken
    static constexpr int kTrunkSlices = 11;      // from the hip joints to the shoulders
    static constexpr int kHeadSlices = 6;        // from the chin to the crown
    static constexpr float kMiddle = 0.6f;       // of the half width, in which the depth is taken
    static constexpr float kShoulderTop = 0.6f;  // of a slice's radius, that it keeps from the shoulders
    static constexpr float kPalmStart = 0.15f;   // of the way to the knuckles
};

using Points = std::vector<Vec3>;

// The part whose volume a joint's surface belongs to: eyes and jaw are of the head, clavicles of the trunk.
HumanJoint volume_of(HumanJoint part) {
    using enum HumanJoint;
    switch (part) {
        case jaw:
        case left_eye:
        case right_eye:
            return head;
        case left_shoulder:
        case right_shoulder:
            return upper_chest;
        default:
            return part;
    }
}

// The surface's points by the part that moves them most.
class SkinPoints {
  public:
    SkinPoints(const Avatar& avatar, const PosedMesh& mesh) : owners_(owners_of(avatar)) {
        for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
            const Surface& surface = avatar.surfaces[s];
            if (surface.figure == 0 && !is_hair(avatar, surface))
                add(avatar, surface, mesh.surfaces[s].positions);
        }
    }

    const Points& of(HumanJoint part) const { return points_[index_of(part)]; }

  private:
    // Joints without a name belong to the part above them, such as twist joints; those above the hips to none.
    static std::vector<std::optional<HumanJoint>> owners_of(const Avatar& avatar) {
        const auto& joints = avatar.skeleton.joints;
        std::vector<std::optional<HumanJoint>> owners(joints.size());
        for (int i = 0; i < kHumanJoints; ++i) {
            const auto part = static_cast<HumanJoint>(i);
            if (avatar.humanoid.has(part))
                owners[static_cast<size_t>(avatar.humanoid[part])] = volume_of(part);
        }
        for (size_t j = 0; j < joints.size(); ++j) {
            if (!owners[j] && joints[j].parent >= 0)
                owners[j] = owners[static_cast<size_t>(joints[j].parent)];
        }
        return owners;
    }

    std::vector<std::optional<HumanJoint>> owners_of_vertices(const Avatar& avatar,
                                                              const Surface& surface) const {
        const std::optional<HumanJoint> whole =
            surface.joint < 0 ? std::nullopt : owners_[static_cast<size_t>(surface.joint)];
        std::vector<std::optional<HumanJoint>> owners(surface.positions.size(), whole);
        if (surface.skin < 0) return owners;
        const Skin& skin = avatar.skins[static_cast<size_t>(surface.skin)];
        for (size_t v = 0; v < owners.size(); ++v) {
            float most = 0;
            for (size_t i = surface.first_influence[v]; i < surface.first_influence[v + 1]; ++i) {
                const Influence& influence = surface.influences[i];
                if (influence.weight <= most) continue;
                most = influence.weight;
                owners[v] = owners_[static_cast<size_t>(skin.joints[influence.joint])];
            }
        }
        return owners;
    }

    // The middle of each triangle, or a grid of middles where it is large.
    void add(const Avatar& avatar, const Surface& surface, const std::vector<Vec3>& positions) {
        const auto owners = owners_of_vertices(avatar, surface);
        for (size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
            const std::array<size_t, 3> v = {surface.triangles[t], surface.triangles[t + 1],
                                             surface.triangles[t + 2]};
            const Vec3 corner = positions[v[0]], a = positions[v[1]] - corner, b = positions[v[2]] - corner;
            const float longest = std::max({length(a), length(b), length(a - b)});
            const int n = std::clamp(static_cast<int>(std::ceil(longest / MeasureTuning::kSpacing)), 1, 64);
            for (int i = 0; i < n; ++i) {
                for (int k = 0; i + k < n; ++k) {
                    const float x = (static_cast<float>(i) + 1.0f / 3) / static_cast<float>(n),
                                y = (static_cast<float>(k) + 1.0f / 3) / static_cast<float>(n);
                    const size_t nearest = x > 0.5f ? 1 : y > 0.5f ? 2 : 0;
                    if (const auto owner = owners[v[nearest]])
                        points_[index_of(*owner)].push_back(corner + x * a + y * b);
                }
            }
        }
    }

    std::vector<std::optional<HumanJoint>> owners_;  // (J)
    std::array<Points, kHumanJoints> points_;
};

// From where to where points reach along a direction.
struct Extent {
    float low = 0, high = 0;  // [m]

    float middle() const { return 0.5f * (low + high); }
    float half() const { return 0.5f * (high - low); }
};

Extent extent_of(const Points& points, const Vec3& direction) {
    std::vector<float> along;
    for (const Vec3& point : points) along.push_back(dot(point, direction));
    return {quantile(along, MeasureTuning::kOutermost), quantile(along, 1 - MeasureTuning::kOutermost)};
}

template <typename Keeps>
Points kept(const Points& points, Keeps keeps) {
    Points found;
    std::copy_if(points.begin(), points.end(), std::back_inserter(found), keeps);
    return found;
}

// A bone at rest, with the surface around it.
struct BoneAtRest {
    ShapePart part;
    int joint;
    Vec3 from, to;
};

class ShapeMeasure {
  public:
    ShapeMeasure(const Avatar& avatar, const PostureRig& rig) : rig_(rig), skin_(avatar, rest_mesh(avatar)) {}

    BodyShape measure() {
        measure_trunk();
        measure_neck();
        measure_head();
        for (size_t side = 0; side < 2; ++side) measure_side(side);
        return std::move(shape_);
    }

  private:
    bool has(HumanJoint part) const { return rig_.parts.has(part); }
    int joint(HumanJoint part) const { return rig_.parts[part]; }
    Vec3 at(HumanJoint part) const { return rig_.rest.places[static_cast<size_t>(joint(part))]; }

    void add(ShapePart part, int joint, const Capsule& world) {
        const Quat from_world = conjugate(rig_.rest.turns[static_cast<size_t>(joint)]);
        const Vec3& origin = rig_.rest.places[static_cast<size_t>(joint)];
        shape_.capsules.push_back({.part = part,
                                   .joint = joint,
                                   .place = {.from = from_world * (world.from - origin),
                                             .to = from_world * (world.to - origin),
                                             .radius = world.radius}});
    }

    // A capsule across a slice of points, along the longer of its width and its depth.
    std::optional<Capsule> across(const Points& slice, float height, float widest) const {
        if (slice.size() < MeasureTuning::kFewest) return std::nullopt;
        const Extent width = extent_of(slice, {1, 0, 0});
        const float half_width = std::min(width.half(), widest);
        const Points middle = kept(slice, [&](const Vec3& point) {
            return std::abs(point.x - width.middle()) < MeasureTuning::kMiddle * half_width;
        });
        if (middle.size() < MeasureTuning::kFewest) return std::nullopt;
        const Extent depth = extent_of(middle, {0, 0, 1});
        const float radius = std::min(half_width, depth.half());
        const Vec3 centre(width.middle(), height, depth.middle());
        const Vec3 end =
            half_width > depth.half() ? Vec3(half_width - radius, 0, 0) : Vec3(0, 0, depth.half() - radius);
        return Capsule{centre - end, centre + end, radius};
    }

    // The joint of the trunk that moves most of a slice.
    int carrier_of(float low, float high) const {
        using enum HumanJoint;
        int carrier = joint(hips);
        size_t most = 0;
        for (const HumanJoint part : {hips, spine, chest, upper_chest}) {
            if (!has(part)) continue;
            const auto count = static_cast<size_t>(
                std::count_if(skin_.of(part).begin(), skin_.of(part).end(),
                              [&](const Vec3& point) { return point.y > low && point.y < high; }));
            if (count <= most) continue;
            most = count;
            carrier = joint(part);
        }
        return carrier;
    }

    void measure_trunk() {
        using enum HumanJoint;
        if (!has(left_upper_leg) || !has(right_upper_leg)) return;
        Points points;
        for (const HumanJoint part : {hips, spine, chest, upper_chest})
            points.insert(points.end(), skin_.of(part).begin(), skin_.of(part).end());
        const float bottom = 0.5f * (at(left_upper_leg).y + at(right_upper_leg).y);
        const float top = 0.5f * (at(left_upper_arm).y + at(right_upper_arm).y);
        const float widest = 0.5f * std::abs(at(left_upper_arm).x - at(right_upper_arm).x);
        const float step = (top - bottom) / MeasureTuning::kTrunkSlices;
        for (int i = 0; i <= MeasureTuning::kTrunkSlices; ++i) {
            const float height = bottom + step * static_cast<float>(i);
            const Points slice =
                kept(points, [&](const Vec3& p) { return std::abs(p.y - height) < 0.5f * step; });
            const auto capsule = across(slice, height, widest);
            if (!capsule) continue;
            if (height + MeasureTuning::kShoulderTop * capsule->radius > top) continue;
            add(ShapePart::trunk, carrier_of(height - step, height + step), *capsule);
        }
        measure_shoulders(points, top);
    }

    // What lies between both shoulder joints.
    void measure_shoulders(const Points& points, float top) {
        using enum HumanJoint;
        const Vec3 left = at(left_upper_arm), right = at(right_upper_arm);
        const float half = 0.5f * std::abs(left.x - right.x);
        const Points slice = kept(points, [&](const Vec3& p) {
            const float out = std::abs(p.x - 0.5f * (left.x + right.x));
            return std::abs(p.y - top) < 0.15f * half && out > 0.5f * half && out < 0.9f * half;
        });
        if (slice.size() < MeasureTuning::kFewest) return;
        const Extent depth = extent_of(slice, {0, 0, 1});
        const Vec3 to_middle(0, 0, depth.middle() - 0.5f * (left.z + right.z));
        const Vec3 inward = (right - left) * (depth.half() / (2 * half));
        add(ShapePart::trunk, carrier_of(top - 0.2f * half, top + 0.1f * half),
            {left + inward + to_middle, right - inward + to_middle, depth.half()});
    }

    void measure_neck() {
        using enum HumanJoint;
        if (has(neck) && has(head))
            measure_limb({ShapePart::neck, joint(neck), at(neck), at(head)}, skin_.of(neck));
    }

    void measure_head() {
        using enum HumanJoint;
        const Points& points = skin_.of(head);
        if (!has(head) || points.size() < MeasureTuning::kFewest) return;
        // Few points lie on the crown, which nothing stands out of.
        Extent tall = extent_of(points, {0, 1, 0});
        for (const Vec3& point : points) tall.high = std::max(tall.high, point.y);
        const float step = (tall.high - tall.low) / MeasureTuning::kHeadSlices;
        for (int i = 0; i < MeasureTuning::kHeadSlices; ++i) {
            const float height = tall.low + step * (static_cast<float>(i) + 0.5f);
            const Points slice =
                kept(points, [&](const Vec3& p) { return std::abs(p.y - height) < 0.5f * step; });
            auto capsule = across(slice, height, tall.half());
            if (!capsule) continue;
            // The crown and the chin are round: what would stand out above or below is lowered or raised.
            const float lift = std::max(0.0f, tall.low - (height - capsule->radius)) -
                               std::max(0.0f, height + capsule->radius - tall.high);
            const Vec3 move(0, std::clamp(lift, -capsule->radius, capsule->radius), 0);
            add(ShapePart::head, joint(head), {capsule->from + move, capsule->to + move, capsule->radius});
        }
    }

    // Two capsules along a bone, each in the middle of the surface that is beside it.
    void measure_limb(const BoneAtRest& bone, const Points& points) {
        const float whole = distance(bone.from, bone.to);
        if (whole < 1e-4f) return;
        const Vec3 along = (bone.to - bone.from) / whole;
        const Vec3 helper = std::abs(along.y) < 0.8f ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
        const Vec3 u = normalize(cross(along, helper)), v = cross(along, u);
        for (const float half : {0.0f, 0.5f}) {
            const Points beside = kept(points, [&](const Vec3& p) {
                const float share = dot(p - bone.from, along) / whole;
                return share > half + 0.05f && share < half + 0.5f;
            });
            if (beside.size() < MeasureTuning::kFewest) continue;
            const Extent width = extent_of(beside, u), depth = extent_of(beside, v);
            const Vec3 middle =
                u * (width.middle() - dot(bone.from, u)) + v * (depth.middle() - dot(bone.from, v));
            add(bone.part, bone.joint,
                {bone.from + along * (half * whole) + middle,
                 bone.from + along * ((half + 0.5f) * whole) + middle, 0.5f * (width.half() + depth.half())});
        }
    }

    void measure_side(size_t side) {
        const LimbParts &arm = kArms[side], &leg = kLegs[side];
        const auto part = [side](ShapePart left) {
            constexpr int kToRight =
                static_cast<int>(ShapePart::right_hand) - static_cast<int>(ShapePart::left_hand);
            return side == 0 ? left : static_cast<ShapePart>(static_cast<int>(left) + kToRight);
        };
        measure_limb({part(ShapePart::left_upper_arm), joint(arm.upper), at(arm.upper), at(arm.lower)},
                     skin_.of(arm.upper));
        if (has(leg.upper) && has(leg.lower))
            measure_limb({part(ShapePart::left_thigh), joint(leg.upper), at(leg.upper), at(leg.lower)},
                         skin_.of(leg.upper));
        if (!has(arm.end)) return;
        // The joints of the forearm turn about its length alone, so that the first carries all of it.
        measure_limb({part(ShapePart::left_forearm), joint(arm.lower), at(arm.lower), at(arm.end)},
                     skin_.of(arm.lower));
        measure_palm(side, part(ShapePart::left_hand));
        for (int finger = 1; finger < kFingers; ++finger)
            measure_finger(static_cast<int>(side), finger, part(ShapePart::left_fingers));
    }

    void measure_palm(size_t side, ShapePart part) {
        const LimbParts& arm = kArms[side];
        const Points& points = skin_.of(arm.end);
        const Quat rest_from_tpose = conjugate(rig_.rest.tpose_of_rest[index_of(arm.end)]);
        const Vec3 along = rest_from_tpose * tpose_direction(arm.end),
                   normal = rest_from_tpose * Vec3(0, 1, 0), over = cross(along, normal), wrist = at(arm.end);
        if (points.size() < MeasureTuning::kFewest) return;
        const HumanJoint knuckle = finger_part(static_cast<int>(side), 2, 0);
        const float end = has(knuckle) ? dot(at(knuckle) - wrist, along)
                                       : 0.55f * (extent_of(points, along).high - dot(wrist, along));
        const float start = MeasureTuning::kPalmStart * end;
        // The thumb is not of the palm.
        const Points palm = kept(points, [&](const Vec3& p) {
            const float share = dot(p - wrist, along) / end;
            return share > 0.4f && share < 1;
        });
        if (palm.size() < MeasureTuning::kFewest) return;
        const Extent thick = extent_of(palm, normal), wide = extent_of(palm, over);
        const float radius = std::min(thick.half(), wide.half());
        const Vec3 middle = wrist + normal * (thick.middle() - dot(wrist, normal)) +
                            over * (wide.middle() - dot(wrist, over));
        for (const float beside : {-1.0f, 0.0f, 1.0f}) {
            const Vec3 aside = over * (beside * (wide.half() - radius));
            add(part, joint(arm.end),
                {middle + along * start + 0.4f * aside, middle + along * end + aside, radius});
        }
    }

    void measure_finger(int side, int finger, ShapePart part) {
        const std::array<HumanJoint, 3> bones = {finger_part(side, finger, 0), finger_part(side, finger, 1),
                                                 finger_part(side, finger, 2)};
        if (!has(bones[0]) || !has(bones[1]) || !has(bones[2])) return;
        const Vec3 outer = at(bones[2]) - at(bones[1]);
        const Points& points = skin_.of(bones[1]);
        if (points.size() < MeasureTuning::kFewest || length(outer) < 1e-4f) return;
        std::vector<float> radii;
        for (const Vec3& point : points)
            radii.push_back(length(cross(point - at(bones[1]), normalize(outer))));
        const float radius = median(std::move(radii));
        add(part, joint(bones[0]), {at(bones[0]), at(bones[1]), radius});
        // The last bone is a little shorter than the one before.
        add(part, joint(bones[1]), {at(bones[1]), at(bones[2]) + 0.7f * outer, radius});
    }

    const PostureRig& rig_;
    SkinPoints skin_;
    BodyShape shape_;
};

}  // namespace

BodyShape measure_shape(const Avatar& avatar, const PostureRig& rig) {
    return ShapeMeasure(avatar, rig).measure();
}

}  // namespace chironomia
