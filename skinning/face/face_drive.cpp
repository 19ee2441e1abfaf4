#include "skinning/face/face_drive.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "skinning/face/face_limits.h"
#include "skinning/face/face_map.h"
#include "skinning/face/look_angle.h"

namespace chironomia {
namespace {

constexpr float kFull = 5;                   // the largest intensity
constexpr float kEyeRange = radians(45.0f);  // an eyeball turns no further
constexpr float kJawDrop = radians(18.0f);   // at AU26 = 5
constexpr float kJawPart = radians(4.0f);    // at AU25 = 5
constexpr float kUpperLidClose = radians(30.0f);
constexpr float kLowerLidClose = radians(6.0f);
constexpr float kUpperLidRaise = radians(8.0f);  // at AU5 = 5
constexpr float kLidTighten = radians(5.0f);     // at AU7 = 5, either lid
// How far the lids go with the gaze.
constexpr float kLookDown = radians(35.0f), kLookUp = radians(30.0f);
constexpr float kCloseLookingDown = 0.45f, kRaiseLookingUp = 0.5f, kTightenLookingUp = 0.15f;

// Left, right.
using Sides = std::array<UnitIntensities, 2>;
constexpr std::array kSides = {FaceSide::left, FaceSide::right};

float& of_unit(UnitIntensities& intensities, int unit) {
    return intensities[static_cast<size_t>(unit)];
}

float of_unit(const UnitIntensities& intensities, int unit) {
    return intensities[static_cast<size_t>(unit)];
}

// A share in [0, 1] on top of another, so that both together never pass 1.
float on_top(float share, float more) {
    return 1 - (1 - share) * (1 - more);
}

class Driver {
  public:
    Driver(const FaceTrack& track, const Avatar& avatar, const FaceOptions& options)
        : track_(track),
          avatar_(avatar),
          options_(options),
          map_(map_face(avatar)),
          rig_(face_rig(avatar, map_.joints)) {
        report_.avatar = avatar.source;
        report_.morphs = map_.morphs;
    }

    Pose drive(size_t frame, Pose pose);
    FaceReport finish(size_t frames);

  private:
    Sides read_units(size_t frame);
    Gaze read_gaze(size_t frame);
    void follow_gaze(Sides& units, const Gaze& gaze) const;
    std::vector<float> weights(const Sides& units, const Gaze& gaze) const;
    FaceTurns turns(size_t frame, const Sides& units, const Gaze& gaze) const;
    void report_channels();
    void report_head_and_gaze();

    bool has_gaze() const { return options_.gaze && !track_.gaze.empty(); }

    const FaceTrack& track_;
    const Avatar& avatar_;
    const FaceOptions& options_;
    FaceMap map_;
    FaceRig rig_;
    FaceReport report_;
};

// If the track has a unit both whole and by its sides, the larger value counts.
Sides Driver::read_units(size_t frame) {
    Sides sides{};
    if (!options_.units) return sides;
    for (size_t c = 0; c < track_.channels.size(); ++c) {
        const FaceChannel& channel = track_.channels[c];
        float intensity = track_.intensities[frame * track_.channels.size() + c];
        intensity *= static_cast<float>(gain_of(options_.gains, channel.unit));
        if (intensity > kFull) ++report_.full[channel.unit];
        intensity = std::clamp(intensity, 0.0f, kFull);
        for (size_t s = 0; s < 2; ++s) {
            if (channel.side != FaceSide::both && channel.side != kSides[s]) continue;
            of_unit(sides[s], channel.unit) = std::max(of_unit(sides[s], channel.unit), intensity);
        }
    }
    for (UnitIntensities& side : sides) {
        if (!map_.lips_close) {
            of_unit(side, 26) = std::max(0.0f, of_unit(side, 26) - of_unit(side, 8));
            of_unit(side, 8) = 0;
        }
        side = limited(side);
    }
    return sides;
}

float mean_or_side(FaceSide side, float left, float right) {
    if (side == FaceSide::left) return left;
    return side == FaceSide::right ? right : (left + right) / 2;
}

// How far an eye looks the way that a look shape shows [rad].
float angle_towards(Look look, bool left_eye, const Vec2& gaze) {
    const float outward = left_eye ? gaze.x : -gaze.x;
    switch (look) {
        case Look::up:
            return std::max(0.0f, gaze.y);
        case Look::down:
            return std::max(0.0f, -gaze.y);
        case Look::left:
            return std::max(0.0f, gaze.x);
        case Look::right:
            return std::max(0.0f, -gaze.x);
        case Look::out:
            return std::max(0.0f, outward);
        case Look::in:
            return std::max(0.0f, -outward);
        default:
            return 0;
    }
}

// The mean of both eyes for a shape of both [rad].
float angle_of(const LookShape& shape, const Gaze& gaze) {
    return mean_or_side(shape.side, angle_towards(shape.look, true, gaze.left),
                        angle_towards(shape.look, false, gaze.right));
}

bool turns_eye(const LookShape& shape) {
    return std::any_of(shape.morphs.begin(), shape.morphs.end(),
                       [](const MorphShare& share) { return share.eyeball; });
}

Gaze Driver::read_gaze(size_t frame) {
    if (!has_gaze()) return {};
    const Gaze& asked = track_.gaze[frame];
    Gaze gaze = asked;
    for (Vec2* eye : {&gaze.left, &gaze.right}) *eye = glm::clamp(*eye, Vec2(-kEyeRange), Vec2(kEyeRange));
    bool held = gaze.left != asked.left || gaze.right != asked.right;
    for (const LookShape& shape : map_.looks)
        held = held || (turns_eye(shape) && angle_of(shape, gaze) > shape.whole);
    if (held) ++report_.gaze_held;
    return gaze;
}

// Lids without look shapes.
void Driver::follow_gaze(Sides& units, const Gaze& gaze) const {
    if (!has_gaze() || map_.lids_look || !turns_eyes(map_)) return;
    for (size_t s = 0; s < 2; ++s) {
        const float up = s == 0 ? gaze.left.y : gaze.right.y;
        const float down_share = std::clamp(-up / kLookDown, 0.0f, 1.0f);
        const float up_share = std::clamp(up / kLookUp, 0.0f, 1.0f);
        const float open = 1 - of_unit(units[s], 45) / kFull;
        const auto add = [&](int unit, float share) {
            float& intensity = of_unit(units[s], unit);
            intensity = kFull * on_top(intensity / kFull, share);
        };
        add(45, kCloseLookingDown * down_share);
        add(5, kRaiseLookingUp * up_share * open);
        add(7, kTightenLookingUp * up_share * open);
    }
}

// How far each morph is asked to go from its rest towards 1, (M).
std::vector<float> Driver::weights(const Sides& units, const Gaze& gaze) const {
    std::vector<float> asked(map_.morphs, 0);
    const auto ask = [&](const MorphShare& share, float value) {
        float& weight = asked[static_cast<size_t>(share.morph)];
        weight = std::max(weight, std::min(1.0f, share.weight * value));
    };
    for (const UnitShape& shape : map_.units) {
        const float intensity =
            mean_or_side(shape.side, of_unit(units[0], shape.unit), of_unit(units[1], shape.unit));
        for (const MorphShare& share : shape.morphs) ask(share, shape.weight * intensity / kFull);
    }
    for (const LookShape& shape : map_.looks) {
        const float angle = angle_of(shape, gaze);
        const float open = 1 - mean_or_side(shape.side, of_unit(units[0], 45), of_unit(units[1], 45)) / kFull;
        const float weight = weight_of_turn(std::min(angle, shape.whole), shape.whole);
        // A lid that has closed has nothing left to follow the gaze with.
        for (const MorphShare& share : shape.morphs) ask(share, share.eyeball ? weight : weight * open);
    }
    return asked;
}

FaceTurns Driver::turns(size_t frame, const Sides& units, const Gaze& gaze) const {
    FaceTurns turns{.how = options_.head};
    if (!track_.head.empty()) turns.head = track_.head[frame];
    if (has_gaze()) turns.gaze = gaze;
    const auto share = [&](size_t side, int unit) { return of_unit(units[side], unit) / kFull; };
    const auto mean = [&](int unit) { return (share(0, unit) + share(1, unit)) / 2; };
    if (map_.jaw_drops) turns.jaw_drop += kJawDrop * mean(26);
    if (map_.jaw_opens_lips) turns.jaw_drop += kJawPart * mean(25);
    for (size_t s = 0; s < 2 && map_.lids_close; ++s) {
        turns.upper_lids[s] =
            kUpperLidClose * share(s, 45) - kUpperLidRaise * share(s, 5) + kLidTighten * share(s, 7);
        turns.lower_lids[s] = kLowerLidClose * share(s, 45) + kLidTighten * share(s, 7);
    }
    return turns;
}

Pose Driver::drive(size_t frame, Pose pose) {
    const Gaze gaze = read_gaze(frame);
    Sides units = read_units(frame);
    follow_gaze(units, gaze);
    const std::vector<float> asked = weights(units, gaze);
    for (size_t m = 0; m < asked.size(); ++m) {
        const float rest = avatar_.rest_morph_weights[m];
        if (asked[m] > 0) pose.morph_weights[m] = rest + (1 - rest) * asked[m];
    }
    pose.joints = turn_face(rig_, std::move(pose.joints), turns(frame, units, gaze));
    return pose;
}

void Driver::report_channels() {
    const size_t count = track_.channels.size();
    for (size_t c = 0; c < count && options_.units; ++c) {
        bool moves = false;
        for (size_t i = c; i < track_.intensities.size(); i += count)
            moves = moves || track_.intensities[i] > 0;
        if (!moves) continue;
        const FaceChannel& channel = track_.channels[c];
        report_.channels.push_back({.channel = channel, .by = shown_by(map_, avatar_, channel)});
    }
}

void Driver::report_head_and_gaze() {
    if (!track_.head.empty()) {
        constexpr std::array kHow = {"replaced", "added", "kept"};
        report_.head = map_.joints.neck.empty() ? "no joint" : kHow[static_cast<size_t>(options_.head)];
    }
    if (!has_gaze()) return;
    const bool joints = map_.joints.eyes[0] >= 0;
    report_.gaze = joints ? "joints" : turns_eyes(map_) ? "morphs" : "none";
}

FaceReport Driver::finish(size_t frames) {
    report_.frames = frames;
    report_.bridged =
        static_cast<size_t>(std::count(track_.confidence.begin(), track_.confidence.end(), 0.0f));
    report_channels();
    report_head_and_gaze();
    return std::move(report_);
}

}  // namespace

FacedPoses drive_face(const FaceTrack& track, const Avatar& avatar, PoseTrack poses,
                      const FaceOptions& options) {
    assert(track.intensities.size() == poses.size() * track.channels.size());
    assert(track.head.empty() || track.head.size() == poses.size());
    assert(track.gaze.empty() || track.gaze.size() == poses.size());
    Driver driver(track, avatar, options);
    poses.change([&](size_t t, Pose pose) { return driver.drive(t, std::move(pose)); });
    FaceReport report = driver.finish(poses.size());
    return {.poses = std::move(poses), .report = std::move(report)};
}

}  // namespace chironomia
