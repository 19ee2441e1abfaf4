#include "skinning/fit/keypoint_ik.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "core/body/ik.h"
#include "core/quantile.h"
#include "skinning/body/body_plan.h"
#include "skinning/fit/shoulder_rhythm.h"
#include "skinning/lift/limb_roll.h"

namespace chironomia {
namespace {

using enum Landmark;

constexpr float kDefaultSwivel = 0.35f;  // of an arm whose elbow is not given [radians]
constexpr float kShortest = 0.005f;      // [m]; shorter differences of points have no direction
// Ours: the sine of the angle between where a face looks and the line of its ears.
constexpr float kFlattestFace = 0.1f;
constexpr float kLeastReach = 1e-5f;    // [m] of an avatar's limb
constexpr float kClavicleShare = 0.5f;  // of the slope of the shoulder line
constexpr float kGirdleMoves = 0.01f;   // ours: 4 mm, above rounding and below what any girdle does

Landmark finger_point(int arm, int finger, int point) {
    const Landmark first = arm == 0 ? left_thumb_1 : right_thumb_1;
    return static_cast<Landmark>(static_cast<int>(first) + finger * 4 + point);
}

// The turn that brings +x to `left` and the plane of +x and +y to that of `left` and `up`; `left` is exact.
std::optional<Quat> frame_left_up(const Vec3& left, const Vec3& up) {
    const Vec3 forward = cross(left, up);
    if (length(left) < kShortest || length(forward) <= 1e-3f * length(left) * length(up)) return std::nullopt;
    const Vec3 x = normalize(left);
    const Vec3 z = normalize(forward);
    return normalize(glm::quat_cast(Mat3(x, cross(z, x), z)));
}

// The same with `up` exact.
std::optional<Quat> frame_up_left(const Vec3& up, const Vec3& left) {
    const Vec3 forward = cross(left, up);
    if (length(up) < kShortest || length(forward) <= 1e-3f * length(left) * length(up)) return std::nullopt;
    const Vec3 y = normalize(up);
    const Vec3 z = normalize(forward);
    return normalize(glm::quat_cast(Mat3(cross(y, z), y, z)));
}

// The turn that brings direction `from` to `along` and, about it, direction `from_side` as near to `side` as
// it goes.
Quat turn_with_side(const Vec3& from, const Vec3& from_side, const Vec3& along, const Vec3& side) {
    const auto frame = [](const Vec3& a, const Vec3& b) {
        const Vec3 x = normalize(a);
        const Vec3 z = normalize(cross(x, b));
        return Mat3(x, cross(z, x), z);
    };
    return normalize(glm::quat_cast(frame(along, side) * glm::transpose(frame(from, from_side))));
}

float rest_length(const PostureRig& rig, HumanJoint a, HumanJoint b) {
    if (!rig.parts.has(a) || !rig.parts.has(b)) return 0;
    return distance(rig.rest.places[size_t(rig.parts[a])], rig.rest.places[size_t(rig.parts[b])]);
}

Vec3 rest_middle(const PostureRig& rig, HumanJoint left, HumanJoint right) {
    return 0.5f * (rig.rest.places[size_t(rig.parts[left])] + rig.rest.places[size_t(rig.parts[right])]);
}

// What is the same in every frame.
struct Body {
    const LandmarkTrack& landmarks;
    const PostureRig& rig;
    float arm_scale = 1;          // avatar / source
    float leg_scale = 1;          // avatar / source
    Vec3 trunk{0, 1, 0};          // from the avatar's hip joints to its shoulder joints at rest [m]
    bool girdle_is_seen = false;  // the source's own shoulders move against its neck
    std::array<bool, 4> has_limb{};
};

// What one frame hands to the next.
struct Memory {
    Vec3 across{1, 0, 0};                      // from the right shoulder to the left
    Quat shoulders = kNoTurn, hips = kNoTurn;  // frames of their lines and the trunk
    std::array<std::optional<LimbCourse>, 4> courses;
};

// The limbs in the order of SolvedFrame::reached.
const LimbParts& parts_of(size_t limb) {
    return limb < 2 ? kArms[limb] : kLegs[limb - 2];
}
const LimbLandmarks& points_of(size_t limb) {
    return limb < 2 ? kArmLandmarks[limb] : kLegLandmarks[limb - 2];
}
LimbHinge hinge_of(size_t limb) {
    return limb < 2 ? arm_hinge(limb == 0) : leg_hinge();
}

// Whether the distance of a shoulder from the neck changes, by more than kGirdleMoves of the shoulder width in nine
// tenths of the frames; that of a rigid trunk does not. What has no neck, or has it between the shoulders, has no
// girdle.
bool moves_girdle(const LandmarkTrack& landmarks) {
    if (!landmarks.has(neck)) return false;
    std::vector<float> widths;
    std::array<std::vector<float>, 2> ways;
    for (size_t t = 0; t < landmarks.points.size(); ++t) {
        const Vec3 left = landmarks.at(t, left_shoulder), right = landmarks.at(t, right_shoulder);
        if (distance(landmarks.at(t, neck), 0.5f * (left + right)) < kShortest) return false;
        widths.push_back(distance(left, right));
        ways[0].push_back(distance(left, landmarks.at(t, neck)));
        ways[1].push_back(distance(right, landmarks.at(t, neck)));
    }
    const float width = quantile(widths, 0.5);
    return std::any_of(ways.begin(), ways.end(), [&](const std::vector<float>& way) {
        return quantile(way, 0.95) - quantile(way, 0.05) > kGirdleMoves * width;
    });
}

Body measure(const LandmarkTrack& landmarks, const PostureRig& rig) {
    Body body{.landmarks = landmarks, .rig = rig, .girdle_is_seen = moves_girdle(landmarks)};
    const BodyTrack track = body_track(landmarks);
    const auto rest_limb = [&](const LimbParts& limb) {
        return rest_length(rig, limb.upper, limb.lower) + rest_length(rig, limb.lower, limb.end);
    };
    if (arm_length(track) > 0) body.arm_scale = rest_limb(kArms[0]) / arm_length(track);
    if (leg_length(track) > 0) body.leg_scale = rest_limb(kLegs[0]) / leg_length(track);
    const bool legs = rig.parts.has(kLegs[0].upper) && rig.parts.has(kLegs[1].upper);
    const Vec3 pelvis = legs ? rest_middle(rig, kLegs[0].upper, kLegs[1].upper)
                             : rig.rest.places[size_t(rig.parts[HumanJoint::hips])];
    body.trunk = rest_middle(rig, kArms[0].upper, kArms[1].upper) - pelvis;
    for (size_t limb = 0; limb < 4; ++limb) {
        const LimbLandmarks& points = points_of(limb);
        body.has_limb[limb] = landmarks.has(points.root) && landmarks.has(points.end) &&
                              rig.parts.has(parts_of(limb).end) && (limb < 2 || landmarks.has(points.mid));
    }
    return body;
}

class FrameSolver {
  public:
    FrameSolver(const Body& body, size_t frame, const Memory& before)
        : body_(body), frame_(frame), memory_(before) {}

    // All but what hangs on the roll of the limbs.
    void solve_directions() {
        solved_.reached.fill(true);
        posture().pelvis = has(pelvis) ? at(pelvis) : Vec3(0);
        solve_trunk();
        solve_head();
        solve_clavicles();
        const PosedSkeleton trunk = pose_skeleton(body_.rig, posture(), {});
        for (size_t limb = 0; limb < 4; ++limb) {
            if (body_.has_limb[limb])
                solved_.reached[limb] = solve_course(limb, place(trunk, parts_of(limb).upper));
        }
    }

    // Where a limb points; bones of length 0 if no frame so far shows it.
    LimbCourse course(size_t limb) const {
        return memory_.courses[limb].value_or(LimbCourse{.base = base_of(limb)});
    }

    // The rest, with the turn of each limb's upper bone.
    SolvedFrame solve_turns(const std::array<Quat, 4>& uppers) {
        for (size_t limb = 0; limb < 4; ++limb) {
            if (!body_.has_limb[limb] || !memory_.courses[limb]) continue;
            const LimbParts& parts = parts_of(limb);
            const Quat& upper = uppers[limb];
            posture()[parts.upper] = upper;
            posture()[parts.lower] = normalize(
                turn_between(upper * tpose_direction(parts.lower), memory_.courses[limb]->lower) * upper);
            if (limb >= 2) solve_foot(limb - 2);
        }
        for (size_t side = 0; side < 2; ++side) {
            if (!body_.has_limb[side]) continue;
            solve_hand(side);
            solve_fingers(side);
        }
        LimitedPosture limited = limit_posture(posture());
        solved_.posture = std::move(limited.posture);
        solved_.limited = limited.passed;
        return std::move(solved_);
    }

    const Memory& memory() const { return memory_; }

  private:
    bool has(Landmark landmark) const { return body_.landmarks.has(landmark); }
    Vec3 at(Landmark landmark) const { return body_.landmarks.at(frame_, landmark); }
    Posture& posture() { return solved_.posture; }
    Vec3 place(const PosedSkeleton& posed, HumanJoint part) const {
        return posed.places[size_t(body_.rig.parts[part])];
    }

    void solve_trunk() {
        // Shoulders that change sides meet in one place on the way; there they lie as before.
        const Vec3 seen = at(left_shoulder) - at(right_shoulder);
        if (length(seen) >= kShortest) memory_.across = seen;
        const Vec3& across = memory_.across;
        const Vec3 up = has(pelvis) ? at(thorax) - at(pelvis) : Vec3(0, 1, 0);
        // The trunk of the avatar slants a little at rest, as anybody's does.
        const Quat slant = turn_between(body_.trunk, {0, 1, 0});
        const auto level = [&](const Vec3& left, Quat& before) {
            before = frame_up_left(up, left).value_or(before);
            return normalize(before * slant);
        };
        const Quat shoulders = level(across, memory_.shoulders);
        posture().hips =
            has(left_hip) && has(right_hip) ? level(at(left_hip) - at(right_hip), memory_.hips) : kNoTurn;
        // Part of the slope of the shoulder line bends the spine, the rest lifts the clavicles.
        const float slope =
            std::asin(std::clamp(dot(normalize(across), shoulders * Vec3(0, 1, 0)), -1.0f, 1.0f));
        const Quat bent = shoulders * glm::angleAxis((1 - kClavicleShare) * slope, Vec3(0, 0, 1));
        for (int i = 1; i <= 3; ++i) posture().spine.push_back(slerp(posture().hips, bent, float(i) / 3));
        shoulders_ = bent;
    }

    // The turn of the head that eyes, ears and nose show. A level head has its eyes a little above the ears
    // and its nose a little below (8 and 14 degrees). SMPL-X has no ears; its eyes lie 40 degrees above the joint that
    // nods (the bones of skinning/motion/points/smpl.cpp).
    std::optional<Quat> face_turn() const {
        const bool ears = has(left_ear) && has(right_ear);
        const bool eyes = has(left_eye) && has(right_eye);
        if (!(ears && (eyes || has(nose))) && !(eyes && has(head))) return std::nullopt;
        const Vec3 left = ears ? at(left_ear) - at(right_ear) : at(left_eye) - at(right_eye);
        const Vec3 middle = ears ? 0.5f * (at(left_ear) + at(right_ear)) : at(head);
        Vec3 forward(0);
        const auto add = [&](const Vec3& point, float pitch) {
            const Vec3 ahead = point - middle;
            if (length(ahead) < kShortest) return;
            // Turning about the ear line brings the point's direction level.
            forward += glm::angleAxis(pitch, normalize(left)) * normalize(ahead);
        };
        if (length(left) < kShortest) return std::nullopt;
        if (eyes) add(0.5f * (at(left_eye) + at(right_eye)), (ears ? 8 : 40) * kPi / 180);
        if (ears && has(nose)) add(at(nose), -14 * kPi / 180);
        const Vec3 up = cross(forward, left);
        // A flat face, whose nose lies between its ears, does not show where it looks.
        if (length(up) < kFlattestFace * length(forward) * length(left)) return std::nullopt;
        return frame_left_up(left, up);
    }

    // Without a face: the line from neck to head, which stands upright in a level head; the nose shows the
    // heading.
    std::optional<Quat> skull_turn() const {
        const Landmark top = has(head_top) ? head_top : head;
        if (!has(top)) return std::nullopt;
        const Vec3 base = has(neck) ? at(neck) : at(thorax);
        // The joint that nods lies in front of the neck's root.
        const Quat lean = top == head ? glm::angleAxis(-20 * kPi / 180, Vec3(1, 0, 0)) : kNoTurn;
        Vec3 left = shoulders_ * Vec3(1, 0, 0);
        if (has(nose) && top == head_top) left = cross(at(top) - base, at(nose) - 0.5f * (base + at(top)));
        const auto turn = frame_up_left(at(top) - base, left);
        if (!turn) return std::nullopt;
        return *turn * lean;
    }

    void solve_head() {
        auto turn = face_turn();
        if (!turn) turn = skull_turn();
        if (!turn) return;
        posture().neck = {slerp(shoulders_, *turn, 0.5f), *turn};
    }

    // How high the source's arm is raised against the trunk: 0 hangs, pi points up [radians]; none if it is not seen.
    std::optional<float> elevation_of(size_t side) const {
        const LimbLandmarks& points = kArmLandmarks[side];
        const Landmark end = has(points.mid) ? points.mid : points.end;
        if (!has(end)) return std::nullopt;
        const Vec3 arm = at(end) - at(points.root);
        if (length(arm) < kShortest) return std::nullopt;
        return angle_between(arm, shoulders_ * Vec3(0, -1, 0));
    }

    // How far the arms lift the middle between the shoulders [m]. One raised arm lifts its own shoulder alone, by twice
    // as much, for then the line between them slopes.
    float lift_of_shoulders() const {
        float lift = 0;
        if (body_.girdle_is_seen) return lift;
        for (size_t side = 0; side < 2; ++side) {
            const auto elevation = elevation_of(side);
            const float clavicle = rest_length(body_.rig, kArms[side].base, kArms[side].upper);
            if (elevation) lift += 0.5f * clavicle * std::sin(clavicle_elevation(*elevation));
        }
        return lift;
    }

    // Brings each shoulder joint to where the source's lies, seen from the middle between them, and that middle to
    // where raised arms lift it.
    void solve_clavicles() {
        const PostureRig& rig = body_.rig;
        if (!rig.parts.has(kArms[0].base) || !rig.parts.has(kArms[1].base)) return;
        const Vec3 rest_centre = rest_middle(rig, kArms[0].upper, kArms[1].upper);
        const Vec3 direction = normalize(memory_.across);
        const Vec3 lift = shoulders_ * Vec3(0, lift_of_shoulders(), 0);
        for (const LimbParts& arm : kArms) {
            const Vec3 clavicle = rig.rest.places[size_t(rig.parts[arm.base])] - rest_centre;
            const Vec3 shoulder = rig.rest.places[size_t(rig.parts[arm.upper])] - rest_centre;
            const Vec3 target = arm.side * length(shoulder) * direction + lift;
            const Vec3 now = shoulders_ * (shoulder - clavicle);
            const Vec3 wanted = target - shoulders_ * clavicle;
            if (length(now) < kShortest || length(wanted) < kShortest) continue;
            posture()[arm.base] = turn_between(now, wanted) * shoulders_;
        }
    }

    const Quat& base_of(size_t limb) const { return limb < 2 ? shoulders_ : solved_.posture.hips; }

    float scale_of(size_t limb) const { return limb < 2 ? body_.arm_scale : body_.leg_scale; }

    // Where the middle joint should bend to. A knee that noise puts behind its leg is mirrored to the front: forward
    // for a leg that hangs, and up for one that is raised forward.
    Vec3 pole_of(size_t limb, const SwivelCircle& circle, const Vec3& root) const {
        const LimbLandmarks& points = points_of(limb);
        const Vec3 pole = root + scale_of(limb) * (at(points.mid) - at(points.root));
        if (limb < 2) return pole;
        const Vec3 along = normalize(circle.tip - root);
        const Vec3 front = cross(along, solved_.posture.hips * Vec3(1, 0, 0));
        const float behind = -dot(pole - circle.centre, front);
        if (behind <= 0 || length(front) < 0.1f) return pole;
        return pole + 2 * behind / dot(front, front) * front;
    }

    // Where the end lies in the root there is no way to reach it; the limb stays as it was, against the trunk.
    bool hold_course(size_t limb) {
        if (!memory_.courses[limb]) return false;
        LimbCourse& held = *memory_.courses[limb];
        const Quat carried = base_of(limb) * conjugate(held.base);
        held = {.base = base_of(limb), .upper = carried * held.upper, .lower = carried * held.lower};
        return false;
    }

    // Upper and lower bone of a limb, so that its end comes to the source's scaled place. Returns the reach.
    bool solve_course(size_t limb, const Vec3& root) {
        const PostureRig& rig = body_.rig;
        const LimbParts& parts = parts_of(limb);
        const LimbLandmarks& points = points_of(limb);
        const Vec3 to_end = at(points.end) - at(points.root);
        const float first = rest_length(rig, parts.upper, parts.lower);
        const float second = rest_length(rig, parts.lower, parts.end);
        if (first <= 0 || second <= 0) return false;
        const Vec3 target = root + scale_of(limb) * to_end;
        if (length(to_end) < kShortest || distance(target, root) < kLeastReach) return hold_course(limb);
        const SwivelCircle circle = swivel_circle({.root = root,
                                                   .target = target,
                                                   .first = first,
                                                   .second = second,
                                                   .outward = shoulders_ * Vec3(parts.side, 0, 0)});
        float swivel = kDefaultSwivel;
        if (has(points.mid)) swivel = swivel_towards(circle, pole_of(limb, circle, root));
        const Vec3 mid = bend_at(circle, swivel);
        memory_.courses[limb] = {.base = base_of(limb), .upper = mid - root, .lower = circle.tip - mid};
        return circle.reached;
    }

    // Where a point lies from the wrist, in the avatar's own hand in the T-pose.
    std::optional<Vec3> own_knuckle(size_t side, int finger) const {
        const PostureRig& rig = body_.rig;
        const HumanJoint part = finger_part(int(side), finger, 0);
        if (!rig.parts.has(part)) return std::nullopt;
        return rig.rest.tpose_of_rest[index_of(kArms[side].end)] *
               (rig.rest.places[size_t(rig.parts[part])] -
                rig.rest.places[size_t(rig.parts[kArms[side].end])]);
    }

    // How the hand lies along its length, and across from the little finger to the index.
    struct Palm {
        Vec3 along{0};
        Vec3 across{0};
    };

    Palm source_palm(size_t side) const {
        const Landmark index = finger_point(int(side), 1, 0);
        const Landmark middle = finger_point(int(side), 2, 0);
        const Landmark little = finger_point(int(side), 4, 0);
        const Landmark hand = side == 0 ? left_hand : right_hand;
        const Vec3 wrist = at(kArmLandmarks[side].end);
        if (has(index) && has(little)) {
            return {0.5f * (at(index) + at(little)) - wrist, at(index) - at(little)};
        }
        for (const Landmark point : {middle, hand, index}) {
            if (has(point)) return {.along = at(point) - wrist};
        }
        return {};
    }

    Palm own_palm(size_t side) const {
        const auto index = own_knuckle(side, 1);
        const auto little = own_knuckle(side, 4);
        if (!index || !little || length(cross(*index, *little)) <= 1e-3f * length(*index) * length(*little))
            return {tpose_direction(kArms[side].end), {0, 0, 1}};
        return {0.5f * (*index + *little), *index - *little};
    }

    void solve_hand(size_t side) {
        const LimbParts& arm = kArms[side];
        const auto& forearm = posture()[arm.lower];
        const Palm palm = source_palm(side);
        if (!forearm || length(palm.along) < kShortest) return;
        if (length(cross(normalize(palm.along), palm.across)) < kShortest) {
            posture()[arm.end] =
                normalize(turn_between(*forearm * tpose_direction(arm.end), palm.along) * *forearm);
            return;
        }
        const Palm own = own_palm(side);
        posture()[arm.end] = turn_with_side(own.along, own.across, palm.along, palm.across);
    }

    void solve_fingers(size_t side) {
        const auto& hand = posture()[kArms[side].end];
        if (!hand) return;
        for (int finger = 0; finger < kFingers; ++finger) {
            Quat before = *hand;
            for (int bone = 0; bone < kFingerBones; ++bone) {
                const Landmark here = finger_point(int(side), finger, bone);
                const Landmark next = finger_point(int(side), finger, bone + 1);
                if (!has(here) || !has(next)) break;
                const Vec3 direction = at(next) - at(here);
                const HumanJoint part = finger_part(int(side), finger, bone);
                if (length(direction) > 1e-4f) {
                    before = normalize(turn_between(before * tpose_direction(part), direction) * before);
                }
                posture()[part] = before;
            }
        }
    }

    void solve_foot(size_t side) {
        const LimbParts& leg = kLegs[side];
        const auto& shin = posture()[leg.lower];
        const Landmark toe = side == 0 ? left_toe : right_toe;
        const Landmark heel = side == 0 ? left_heel : right_heel;
        const Landmark ankle = kLegLandmarks[side].end;
        if (!shin || !has(toe)) return;
        const bool sole = has(heel);
        const Vec3 direction = at(toe) - at(sole ? heel : ankle);
        // From the ankle the toe lies forward and down. The avatar's own foot gives how far down.
        Vec3 level(0, 0, 1);
        const HumanJoint toes = *tip_of(leg.end);
        if (!sole && body_.rig.parts.has(toes)) {
            level = body_.rig.rest.tpose_of_rest[index_of(leg.end)] *
                    (body_.rig.rest.places[size_t(body_.rig.parts[toes])] -
                     body_.rig.rest.places[size_t(body_.rig.parts[leg.end])]);
        }
        if (length(direction) < kShortest || length(level) < kShortest) return;
        const Vec3 across = *shin * Vec3(1, 0, 0);
        if (length(cross(normalize(direction), across)) < 0.1f) return;
        posture()[leg.end] = turn_with_side(level, {1, 0, 0}, direction, across);
    }

    const Body& body_;
    size_t frame_;
    Memory memory_;
    Quat shoulders_ = kNoTurn;
    SolvedFrame solved_;
};

void show(BodyTrack& track, const LandmarkTrack& landmarks, HumanJoint part, Landmark landmark) {
    if (!landmarks.has(landmark)) return;
    track.known.set(index_of(part));
    for (size_t t = 0; t < track.places.size(); ++t) {
        track.places[t][index_of(part)] = landmarks.at(t, landmark);
    }
}

}  // namespace

BodyTrack body_track(const LandmarkTrack& landmarks) {
    BodyTrack track;
    track.places.resize(landmarks.points.size());
    show(track, landmarks, HumanJoint::hips, pelvis);
    show(track, landmarks, HumanJoint::neck, neck);
    show(track, landmarks, HumanJoint::head, head);
    for (size_t side = 0; side < 2; ++side) {
        show(track, landmarks, kArms[side].upper, kArmLandmarks[side].root);
        show(track, landmarks, kArms[side].lower, kArmLandmarks[side].mid);
        show(track, landmarks, kArms[side].end, kArmLandmarks[side].end);
        show(track, landmarks, kLegs[side].upper, kLegLandmarks[side].root);
        show(track, landmarks, kLegs[side].lower, kLegLandmarks[side].mid);
        show(track, landmarks, kLegs[side].end, kLegLandmarks[side].end);
        show(track, landmarks, *tip_of(kLegs[side].end), side == 0 ? left_toe : right_toe);
        for (int finger = 0; finger < kFingers; ++finger) {
            for (int bone = 0; bone < kFingerBones; ++bone) {
                show(track, landmarks, finger_part(int(side), finger, bone),
                     finger_point(int(side), finger, bone));
            }
        }
    }
    return track;
}

std::vector<SolvedFrame> solve_keypoints(const LandmarkTrack& landmarks, const PostureRig& rig, double fps) {
    assert(landmarks.has(left_shoulder) && landmarks.has(right_shoulder));
    const Body body = measure(landmarks, rig);
    std::vector<FrameSolver> solvers;
    Memory memory;
    for (size_t t = 0; t < landmarks.points.size(); ++t) {
        solvers.emplace_back(body, t, memory).solve_directions();
        memory = solvers.back().memory();
    }
    std::vector<std::array<Quat, 4>> uppers(solvers.size());
    for (size_t limb = 0; limb < 4; ++limb) {
        if (!body.has_limb[limb]) continue;
        std::vector<LimbCourse> courses;
        for (const FrameSolver& solver : solvers) courses.push_back(solver.course(limb));
        const std::vector<Quat> turns = roll_limb(courses, hinge_of(limb), fps);
        for (size_t t = 0; t < turns.size(); ++t) uppers[t][limb] = turns[t];
    }
    std::vector<SolvedFrame> frames;
    for (size_t t = 0; t < solvers.size(); ++t) frames.push_back(solvers[t].solve_turns(uppers[t]));
    return frames;
}

}  // namespace chironomia
