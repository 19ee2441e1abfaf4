#include "skinning/covers/mitts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/text.h"
#include "skinning/covers/cover.h"
#include "skinning/face_region/head_scan.h"

namespace chironomia {
namespace {

// Along the hand, from the wrist to the fingertips.
constexpr float kFullFrom = 0.32f;  // the mitt has its full width
constexpr float kEnd = 0.72f;       // and ends, as a loosely closed hand does

constexpr int kMittRings = 28;
constexpr int kMittAround = 36;

// A hand in the rest pose.
struct Hand {
    int joint = -1;
    Vec3 wrist{0};   // [m, world]
    Vec3 length{0};  // unit, to the fingertips
    Vec3 width{0};   // unit, across the palm
    Vec3 thickness{0};
    float reach = 0;  // from the wrist to the fingertips [m]
    std::vector<std::vector<float>> weights;
};

// The places that `keeps` keeps of all vertices with their weight of the hand, seen from the wrist.
template <typename Keeps>
std::vector<Vec3> places_of(const PosedMesh& rest, const Hand& hand, Keeps keeps) {
    std::vector<Vec3> places;
    for (size_t s = 0; s < rest.surfaces.size(); ++s) {
        for (size_t v = 0; v < hand.weights[s].size(); ++v) {
            const Vec3 from = rest.surfaces[s].positions[v] - hand.wrist;
            if (keeps(hand.weights[s][v], from)) places.push_back(from);
        }
    }
    return places;
}

// The value below which `share` of them lie.
float quantile(std::vector<float> values, float share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(share * static_cast<float>(values.size() - 1))];
}

Vec3 mean_of(const std::vector<Vec3>& places) {
    Vec3 sum(0);
    for (const Vec3& place : places) sum += place;
    return places.empty() ? sum : sum / static_cast<float>(places.size());
}

// The direction across `length` in which the places spread most.
Vec3 widest_across(const std::vector<Vec3>& places, const Vec3& length) {
    const Vec3 helper = std::abs(length.y) < 0.8f ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 x = normalize(cross(length, helper)), y = cross(length, x);
    const Vec3 mean = mean_of(places);
    float xx = 0, xy = 0, yy = 0;
    for (const Vec3& place : places) {
        const float a = dot(place - mean, x), b = dot(place - mean, y);
        xx += a * a;
        xy += a * b;
        yy += b * b;
    }
    const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
    return std::cos(angle) * x + std::sin(angle) * y;
}

Hand measure_hand(const Avatar& avatar, const PosedMesh& rest, HumanJoint part) {
    Hand hand{.joint = avatar.humanoid[part], .weights = {}};
    if (hand.joint < 0) {
        throw Error(
            format("{}: has no joint for its {}, so its hands cannot be hidden; choose --hands motion "
                   "or relaxed, or another avatar",
                   avatar.source, part == HumanJoint::left_hand ? "left hand" : "right hand"));
    }
    const auto joints = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    hand.wrist = origin(joints[static_cast<size_t>(hand.joint)]);
    hand.weights = weights_below(avatar, {hand.joint});
    const auto places = places_of(rest, hand, [](float weight, const Vec3&) { return weight > 0.5f; });
    const Vec3 middle = mean_of(places);
    if (places.size() < 4 || dot(middle, middle) < 1e-8f) {
        throw Error(
            format("{}: its hand joint \"{}\" carries no surface, so its hands cannot be hidden; choose "
                   "--hands motion or relaxed, or another avatar",
                   avatar.source, avatar.skeleton.joints[static_cast<size_t>(hand.joint)].name));
    }
    hand.length = normalize(middle);
    std::vector<float> reaches;
    for (const Vec3& place : places) reaches.push_back(dot(place, hand.length));
    hand.reach = quantile(reaches, 1);
    std::vector<Vec3> palm;
    for (const Vec3& place : places) {
        if (dot(place, hand.length) < 0.6f * hand.reach) palm.push_back(place);
    }
    hand.width = widest_across(palm.size() > 3 ? palm : places, hand.length);
    hand.thickness = cross(hand.length, hand.width);
    return hand;
}

// The sizes of a mitt [m].
struct MittShape {
    float wrist = 0;       // radius
    Vec2 palm{0};          // half width and half thickness
    Vec3 wrist_middle{0};  // off the line from the wrist along the hand
    Vec3 palm_middle{0};
};

Vec3 off_line(const Hand& hand, const Vec3& place) {
    return place - hand.length * dot(place, hand.length);
}

MittShape shape_of(const PosedMesh& rest, const Hand& hand) {
    const auto between = [&](float first, float last) {
        return places_of(rest, hand, [&](float weight, const Vec3& from) {
            const float at = dot(from, hand.length) / hand.reach;
            return weight > 0.02f && at > first && at < last &&
                   length(off_line(hand, from)) < 0.6f * hand.reach;
        });
    };
    const auto wrist = between(-0.1f, 0.1f), palm = between(0.15f, 0.55f);
    MittShape shape;
    shape.wrist_middle = off_line(hand, mean_of(wrist));
    shape.palm_middle = off_line(hand, mean_of(palm));
    std::vector<float> radii, widths, thicknesses;
    for (const Vec3& place : wrist) radii.push_back(length(off_line(hand, place) - shape.wrist_middle));
    for (const Vec3& place : palm) {
        const Vec3 from = place - shape.palm_middle;
        widths.push_back(std::abs(dot(from, hand.width)));
        thicknesses.push_back(std::abs(dot(from, hand.thickness)));
    }
    shape.wrist = std::clamp(1.06f * quantile(radii, 0.97f), 0.12f * hand.reach, 0.3f * hand.reach);
    shape.palm = {std::clamp(1.1f * quantile(widths, 0.85f), shape.wrist, 0.36f * hand.reach),
                  std::clamp(1.3f * quantile(thicknesses, 0.9f), 0.8f * shape.wrist, 0.3f * hand.reach)};
    return shape;
}

// A ring of the mitt: how far along the hand, and half its width and thickness.
struct Ring {
    float along = 0;  // [m]
    Vec2 half{0};
};

// Evenly spaced in angle at both round ends; `place` in [0, 1].
Ring ring_at(const Hand& hand, const MittShape& shape, float place) {
    const float full = kFullFrom * hand.reach, end = kEnd * hand.reach;
    if (place < 0.25f) {
        const float angle = place / 0.25f * kPi / 2;
        return {-shape.wrist * std::cos(angle), Vec2(shape.wrist * std::sin(angle))};
    }
    if (place < 0.5f) {
        const float way = (place - 0.25f) / 0.25f;
        return {way * full, glm::mix(Vec2(shape.wrist), shape.palm, glm::smoothstep(0.0f, 1.0f, way))};
    }
    const float angle = (place - 0.5f) / 0.5f * kPi / 2;
    return {full + (end - full) * std::sin(angle), shape.palm * std::cos(angle)};
}

Cover mitt_for(const Hand& hand, const MittShape& shape, const std::string& name) {
    Cover mitt{.name = name, .joint = hand.joint, .positions = {}, .triangles = {}};
    const auto middle_at = [&](float along) {
        const float way = glm::smoothstep(0.0f, kFullFrom * hand.reach, along);
        return hand.wrist + hand.length * along + glm::mix(shape.wrist_middle, shape.palm_middle, way);
    };
    // Both tips, then the rings between them.
    const Ring first = ring_at(hand, shape, 0), last = ring_at(hand, shape, 1);
    mitt.positions = {middle_at(first.along), middle_at(last.along)};
    for (int r = 1; r < kMittRings; ++r) {
        const Ring ring = ring_at(hand, shape, static_cast<float>(r) / kMittRings);
        for (int a = 0; a < kMittAround; ++a) {
            const float angle = 2 * kPi * static_cast<float>(a) / kMittAround;
            mitt.positions.push_back(middle_at(ring.along) + hand.width * (ring.half.x * std::cos(angle)) +
                                     hand.thickness * (ring.half.y * std::sin(angle)));
        }
    }
    const auto vertex = [](int ring, int around) {
        return static_cast<std::uint32_t>(2 + (ring - 1) * kMittAround + around % kMittAround);
    };
    for (int a = 0; a < kMittAround; ++a) {
        mitt.triangles.insert(mitt.triangles.end(), {0u, vertex(1, a + 1), vertex(1, a)});
        mitt.triangles.insert(mitt.triangles.end(),
                              {1u, vertex(kMittRings - 1, a), vertex(kMittRings - 1, a + 1)});
        for (int r = 1; r + 1 < kMittRings; ++r) {
            mitt.triangles.insert(mitt.triangles.end(),
                                  {vertex(r, a), vertex(r, a + 1), vertex(r + 1, a + 1), vertex(r, a),
                                   vertex(r + 1, a + 1), vertex(r + 1, a)});
        }
    }
    return mitt;
}

}  // namespace

Avatar with_mitts(Avatar avatar) {
    const PosedMesh rest = rest_mesh(avatar);
    std::vector<Cover> mitts;
    for (const HumanJoint part : {HumanJoint::left_hand, HumanJoint::right_hand}) {
        const Hand hand = measure_hand(avatar, rest, part);
        mitts.push_back(
            mitt_for(hand, shape_of(rest, hand), part == HumanJoint::left_hand ? "left mitt" : "right mitt"));
        for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
            std::vector<char> hidden;
            for (const float weight : hand.weights[s]) hidden.push_back(weight > 0.5f);
            leave_out(avatar.surfaces[s], hidden);
        }
    }
    for (const Cover& mitt : mitts) add_cover(avatar, mitt);
    return avatar;
}

}  // namespace chironomia
