#include "skinning/lift/lift.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "skinning/lift/hand_lift.h"
#include "skinning/lift/head_lift.h"
#include "skinning/lift/learned_depth.h"
#include "skinning/lift/limb_lift.h"
#include "skinning/lift/trunk_lift.h"
#include "skinning/lift/walking_camera.h"

namespace chironomia {
namespace {

constexpr double kFastestSwing = 5;  // [Hz]
constexpr double kAlike = 0.35;      // share by which each bone's length moves to the mean of both sides
constexpr int kArmRounds = 3;        // frequent postures hardly change after these
constexpr double kEarsAhead = 0.02;  // of the thorax, the middle of the ears [m]; ours, a round value

// The points in space, as they are found.
class SpacePoints {
  public:
    explicit SpacePoints(size_t frames) : frames_(frames) {}

    void set(size_t t, Landmark landmark, const glm::dvec3& place) {
        const auto l = static_cast<size_t>(landmark);
        frames_[t].places[l] = Vec3(place);
        frames_[t].there.set(l);
        known_.set(l);
    }

    // Converts all places from the axes of the walking camera to those of the real one.
    void to_real_camera(const WalkingCamera& walking) {
        for (size_t t = 0; t < frames_.size(); ++t) {
            for (Vec3& place : frames_[t].places) place = walking.place(t, place);
        }
    }

    KeypointTrack track() const {
        KeypointTrack track;
        for (size_t l = 0; l < kLandmarks; ++l) {
            if (known_[l]) track.names.emplace_back(name_of(static_cast<Landmark>(l)));
        }
        for (const Frame& frame : frames_) {
            for (size_t l = 0; l < kLandmarks; ++l) {
                if (!known_[l]) continue;
                track.points.push_back(frame.places[l]);
                track.confidence.push_back(frame.there[l] ? 1.0f : 0.0f);
            }
        }
        return track;
    }

  private:
    struct Frame {
        std::array<Vec3, kLandmarks> places{};
        LandmarkSet there;
    };
    std::vector<Frame> frames_;
    LandmarkSet known_;
};

struct LimbPoints {
    LimbKind kind;
    bool left;
    LimbLandmarks at;
};

constexpr std::array kLimbs = {
    LimbPoints{LimbKind::arm, true, kArmLandmarks[0]},
    LimbPoints{LimbKind::arm, false, kArmLandmarks[1]},
    LimbPoints{LimbKind::leg, true, kLegLandmarks[0]},
    LimbPoints{LimbKind::leg, false, kLegLandmarks[1]},
};

glm::dvec3 root_of(const Trunk& trunk, const LimbPoints& limb) {
    if (limb.kind == LimbKind::arm) return limb.left ? trunk.left_shoulder : trunk.right_shoulder;
    return limb.left ? trunk.left_hip : trunk.right_hip;
}

// What is known of a clip once its trunk is lifted.
struct LiftContext {
    const CleanPicture& picture;
    const BodyScale& scale;
    const std::vector<Trunk>& trunks;             // (T)
    const std::vector<LearnedPosture>& postures;  // (T)
    double fps = 0;
};

// A limb being lifted.
struct LiftedLimb {
    LimbPoints points;
    std::vector<SeenLimb> seen;  // (T)
    LimbShape shape;
    std::vector<LimbPlace> places;  // (T)
};

// A limb swings in and out as fast as it is seen to move across, but not faster than arms do.
double swing_of(const CleanPicture& picture, const LimbPoints& points) {
    double fastest = 0;
    for (const LandmarkCutoff& cutoff : picture.cutoffs) {
        if (cutoff.landmark == points.at.mid || cutoff.landmark == points.at.end)
            fastest = std::max(fastest, cutoff.hertz);
    }
    return std::min(kFastestSwing, fastest);
}

LiftedLimb see_limb(const LiftContext& clip, const LimbPoints& points) {
    const PictureBody& body = clip.picture.body;
    const BodyLengths& lengths = clip.scale.lengths;
    const bool arm = points.kind == LimbKind::arm;
    LiftedLimb limb{.points = points, .seen = {}, .shape = {}, .places = {}};
    for (size_t t = 0; t < body.frames(); ++t) {
        limb.seen.push_back({.root = root_of(clip.trunks[t], points),
                             .mid = body.at(t, points.at.mid),
                             .tip = body.at(t, points.at.end),
                             .has_mid = body.sees(t, points.at.mid),
                             .has_tip = body.sees(t, points.at.end)});
        if (arm) limb.seen.back().learned = points.left ? clip.postures[t].left : clip.postures[t].right;
    }
    limb.shape = {.kind = points.kind,
                  .left = points.left,
                  .upper = arm ? lengths.upper_arm : lengths.thigh,
                  .lower = arm ? lengths.forearm : lengths.shin,
                  .swing = swing_of(clip.picture, points)};
    return limb;
}

// Moves the lengths of both sides closer together, because the sides of a person are about as long.
void make_alike(LimbShape& one, LimbShape& other) {
    for (double LimbShape::*const length : {&LimbShape::upper, &LimbShape::lower}) {
        const double mean = (one.*length + other.*length) / 2;
        one.*length += kAlike * (mean - one.*length);
        other.*length += kAlike * (mean - other.*length);
    }
}

LimbSight sight_of(const LiftedLimb& limb, const LiftContext& clip) {
    return {.limb = limb.seen, .trunks = clip.trunks, .camera = clip.scale.camera, .fps = clip.fps};
}

void lift_legs(std::array<LiftedLimb, 2>& legs, const LiftContext& clip) {
    for (LiftedLimb& leg : legs)
        leg.places = lift_limb(sight_of(leg, clip), standing_shape(leg.seen, leg.shape, clip.scale.camera));
}

// The first round finds how near the arms are to the camera, and so the lengths of their bones. The later rounds also
// use the postures that both arms take most often.
void lift_arms(std::array<LiftedLimb, 2>& arms, const LiftContext& clip) {
    for (LiftedLimb& arm : arms) {
        arm.places = lift_limb(sight_of(arm, clip), arm.shape);
        arm.shape = measured_shape(arm.seen, arm.places, arm.shape);
    }
    make_alike(arms[0].shape, arms[1].shape);
    for (int round = 0; round < kArmRounds; ++round) {
        const std::array before = {std::move(arms[0].places), std::move(arms[1].places)};
        for (const size_t side : {0, 1}) {
            LiftedLimb& arm = arms[side];
            arm.places =
                lift_limb(sight_of(arm, clip), arm.shape, {.own = before[side], .other = before[1 - side]});
        }
    }
}

void set_hands(SpacePoints& points, const LiftContext& clip, const LiftedLimb& arm) {
    const bool left = arm.points.left;
    std::vector<HandArm> arms;
    for (size_t t = 0; t < clip.trunks.size(); ++t) {
        arms.push_back({.shoulder = arm.seen[t].root,
                        .elbow = arm.places[t].mid,
                        .wrist = arm.places[t].tip,
                        .yaw = clip.trunks[t].yaw});
    }
    const std::vector<LiftedHand> hands = lift_hand({.body = clip.picture.body,
                                                     .camera = clip.scale.camera,
                                                     .arms = arms,
                                                     .left = left,
                                                     .fps = clip.fps});
    for (size_t t = 0; t < hands.size(); ++t) {
        for (size_t f = 0; f < 5; ++f) {
            const auto first = static_cast<size_t>(finger_models()[f].first);
            for (size_t i = 0; i < 4; ++i) {
                const auto landmark = static_cast<Landmark>(first + i);
                points.set(t, left ? landmark : mirrored(landmark), hands[t][f][i]);
            }
        }
    }
}

void set_limbs(SpacePoints& points, const LiftContext& clip) {
    const PictureBody& body = clip.picture.body;
    for (size_t first = 0; first < kLimbs.size(); first += 2) {
        if (!body.has(kLimbs[first].at.mid) && !body.has(kLimbs[first + 1].at.mid)) continue;
        std::array<LiftedLimb, 2> limbs = {see_limb(clip, kLimbs[first]), see_limb(clip, kLimbs[first + 1])};
        const auto lift_both = kLimbs[first].kind == LimbKind::arm ? lift_arms : lift_legs;
        lift_both(limbs, clip);
        for (const LiftedLimb& limb : limbs) {
            for (size_t t = 0; t < limb.places.size(); ++t) {
                points.set(t, limb.points.at.mid, limb.places[t].mid);
                points.set(t, limb.points.at.end, limb.places[t].tip);
            }
            if (limb.points.kind == LimbKind::arm) set_hands(points, clip, limb);
        }
    }
}

void set_trunk(SpacePoints& points, const std::vector<Trunk>& trunks) {
    for (size_t t = 0; t < trunks.size(); ++t) {
        points.set(t, Landmark::thorax, trunks[t].thorax);
        points.set(t, Landmark::left_shoulder, trunks[t].left_shoulder);
        points.set(t, Landmark::right_shoulder, trunks[t].right_shoulder);
        points.set(t, Landmark::pelvis, trunks[t].pelvis);
        points.set(t, Landmark::left_hip, trunks[t].left_hip);
        points.set(t, Landmark::right_hip, trunks[t].right_hip);
    }
}

// Places the turned model of a head where the middle of its seen points falls on the picture.
void set_head(SpacePoints& points, const LiftContext& clip, const std::vector<HeadAngles>& heads) {
    const PictureBody& body = clip.picture.body;
    for (size_t t = 0; t < heads.size(); ++t) {
        if (!heads[t].known) continue;
        const Quat turn = to_turn(heads[t]);
        const double depth = clip.trunks[t].thorax.z + kEarsAhead;
        glm::dvec3 off(0);
        double seen = 0;
        for (const HeadPoint& point : head_points()) {
            if (!body.sees(t, point.landmark)) continue;
            const Vec3 turned = turn * point.place;
            off += clip.scale.camera.place(body.at(t, point.landmark), depth + turned.z) - glm::dvec3(turned);
            ++seen;
        }
        for (const HeadPoint& point : head_points()) {
            const glm::dvec3 centre(off.x / seen, off.y / seen, depth);
            points.set(t, point.landmark, centre + glm::dvec3(turn * point.place));
        }
    }
}

void refuse_without_shoulders(const PictureBody& body, const std::string& source) {
    for (const Landmark shoulder : {Landmark::left_shoulder, Landmark::right_shoulder}) {
        if (body.has(shoulder)) continue;
        throw Error(
            format("{}: {} is seen in less than a tenth of its {} frames; both shoulders are needed to find "
                   "depth, choose a picture that shows them",
                   source, name_of(shoulder), body.frames()));
    }
    for (size_t t = 0; t < body.frames(); ++t) {
        if (body.sees(t, Landmark::left_shoulder) && body.sees(t, Landmark::right_shoulder) &&
            body.at(t, Landmark::left_shoulder) != body.at(t, Landmark::right_shoulder))
            return;
    }
    throw Error(format(
        "{}: none of its {} frames shows both shoulders at once, apart from each other; both are needed to "
        "find depth, choose a picture that shows them",
        source, body.frames()));
}

}  // namespace

std::optional<double> lift_cutoff_named(std::string_view name) {
    const std::string lower = to_lower(trim(name));
    if (lower == "auto") return std::nullopt;
    if (lower == "off") return 0;
    const auto hertz = parse_number(lower);
    if (hertz && *hertz >= 0.1 && *hertz <= 100) return *hertz;
    throw Error(format("lift filter: \"{}\" is not known; use auto, off or a cutoff of 0.1 to 100 Hz", name));
}

Lift lift(const Motion& motion, const LiftOptions& options) {
    assert(motion.picture);
    CleanPicture clean =
        clean_picture(*motion.picture, motion.frames, {.fps = motion.fps, .cutoff = options.cutoff});
    const PictureBody& body = clean.body;
    refuse_without_shoulders(body, motion.source);
    const RealCamera camera{
        .distance = options.distance, .size = motion.picture->size, .focal = motion.picture->focal};
    const WalkingCamera walking(body, camera, motion.fps);
    clean.body = walking.seen(std::move(clean.body));
    const BodyScale scale = find_body_scale(body, walking.distance(), walking.middle());
    const std::vector<HeadAngles> heads = lift_head(body, scale.camera, motion.fps);
    const std::vector<LearnedPosture> postures =
        steadied(LearnedDepth(find_asset("assets/models/lift.h5")).postures(body, motion.fps), motion.fps);
    const std::vector<Trunk> trunks =
        lift_trunk(body, scale, {.heads = heads, .postures = postures}, motion.fps);

    const LiftContext clip{
        .picture = clean, .scale = scale, .trunks = trunks, .postures = postures, .fps = motion.fps};
    SpacePoints points(body.frames());
    set_trunk(points, trunks);
    set_head(points, clip, heads);
    set_limbs(points, clip);
    points.to_real_camera(walking);

    Lift lifted{.motion = {},
                .scale = scale,
                .swaps = std::move(clean.swaps),
                .gaps = std::move(clean.gaps),
                .cutoffs = std::move(clean.cutoffs),
                .nearest = walking.nearest(),
                .farthest = walking.farthest()};
    lifted.motion.source = motion.source;
    lifted.motion.companions = motion.companions;
    lifted.motion.fps = motion.fps;
    lifted.motion.frames = motion.frames;
    lifted.motion.keypoints = points.track();
    lifted.motion.face = motion.face;
    lifted.motion.notes = motion.notes;
    return lifted;
}

}  // namespace chironomia
