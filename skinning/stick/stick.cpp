#include "skinning/stick/stick.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/quantile.h"
#include "core/text.h"
#include "skinning/signal/resample.h"
#include "skinning/sketch/sketch_motion.h"
#include "skinning/sketch/stick_points.h"
#include "skinning/stick/stick_solids.h"

namespace chironomia {
namespace {

constexpr double kLowest = 0.05;  // share of the frames whose feet may sink below the floor

std::string source_of(const Motion& motion) {
    return motion.joints ? "joint turns" : motion.keypoints ? "keypoints" : "picture";
}

// The middle of a pair of points, in the frames that show both.
struct Middle {
    size_t left, right;

    Middle(const StickSketch& sketch, HumanJoint part)
        : left(static_cast<size_t>(sketch.parts[part])),
          right(static_cast<size_t>(sketch.parts[mirrored(part)])) {}

    std::optional<Vec3> at(const StickSketch& sketch, size_t frame) const {
        if (!sketch.sees(frame, left) || !sketch.sees(frame, right)) return std::nullopt;
        return (sketch.place(frame, left) + sketch.place(frame, right)) * 0.5f;
    }
    std::optional<Vec3> first(const StickSketch& sketch) const {
        for (size_t t = 0; t < sketch.frames; ++t) {
            if (const auto place = at(sketch, t)) return place;
        }
        return std::nullopt;
    }
    Vec3 rest(const StickSketch& sketch) const {
        return (sketch.points[left].rest + sketch.points[right].rest) * 0.5f;
    }
};

// The hips where they are known and ever seen, else the shoulders.
Middle anchor_of(const StickSketch& sketch) {
    const Middle shoulders(sketch, HumanJoint::left_upper_arm);
    if (!sketch.parts.has(HumanJoint::left_upper_leg) || !sketch.parts.has(HumanJoint::right_upper_leg))
        return shoulders;
    const Middle hips(sketch, HumanJoint::left_upper_leg);
    return hips.first(sketch) ? hips : shoulders;
}

// How far a figure must rise for its feet to stand on the floor, or, without feet, for its shoulders to be
// where those of a standing person are.
float rise_of(const StickSketch& sketch) {
    std::vector<float> feet, shoulders;
    const Middle between(sketch, HumanJoint::left_upper_arm);
    for (size_t t = 0; t < sketch.frames; ++t) {
        std::optional<float> lowest;
        for (size_t p = 0; p < sketch.points.size(); ++p) {
            if (!sketch.points[p].foot || !sketch.sees(t, p)) continue;
            const float height = sketch.place(t, p).y - sketch.points[p].rest.y;
            lowest = std::min(lowest.value_or(height), height);
        }
        if (lowest) feet.push_back(*lowest);
        if (const auto middle = between.at(sketch, t)) shoulders.push_back(middle->y);
    }
    if (2 * feet.size() > sketch.frames) return -quantile(std::move(feet), kLowest);
    if (shoulders.empty()) return 0;
    return between.rest(sketch).y - quantile(std::move(shoulders), 0.5);
}

void stand_on_floor(StickSketch& sketch, bool in_space) {
    Vec3 shift(0, rise_of(sketch), 0);
    const Middle anchor = anchor_of(sketch);
    if (const auto begin = anchor.first(sketch); begin && in_space) {
        const Vec3 rest = anchor.rest(sketch);
        shift.x = rest.x - begin->x;
        shift.z = rest.z - begin->z;
    }
    for (Vec3& place : sketch.places) place += shift;
}

// The turn that takes away where the hips (or shoulders) head.
Quat heading_back(const StickSketch& sketch, size_t frame, const Middle& anchor) {
    const Vec3 line = sketch.place(frame, anchor.left) - sketch.place(frame, anchor.right);
    const Vec3 level(line.x, 0, line.z);
    if (length(level) < 1e-4f) return kNoTurn;
    return glm::angleAxis(std::atan2(level.z, level.x), Vec3(0, 1, 0));
}

// Where the anchor is not seen the figure stays held as in the frame before.
void hold_root(StickSketch& sketch, bool in_space) {
    const Middle anchor = anchor_of(sketch);
    const Vec3 rest = anchor.rest(sketch);
    Vec3 middle = anchor.first(sketch).value_or(rest);
    Quat back = kNoTurn;
    for (size_t t = 0; t < sketch.frames; ++t) {
        if (const auto seen = anchor.at(sketch, t)) {
            middle = *seen;
            if (in_space) back = heading_back(sketch, t, anchor);
        }
        for (size_t p = 0; p < sketch.points.size(); ++p) {
            Vec3& place = sketch.places[t * sketch.points.size() + p];
            const float layer = in_space ? rest.z - middle.z : 0;
            place =
                back * (place - Vec3(middle.x, middle.y, middle.z)) + Vec3(rest.x, rest.y, middle.z + layer);
        }
    }
}

template <typename Hides>
void hide(StickSketch& sketch, Hides hides) {
    for (size_t i = 0; i < sketch.places.size(); ++i) {
        if (hides(sketch.points[i % sketch.points.size()].kind)) sketch.seen[i] = false;
    }
}

// Legs are hidden from the knees down: the hips carry the trunk.
void hide_legs(StickSketch& sketch) {
    std::vector<bool> kept(sketch.points.size(), true);
    for (size_t p = 0; p < kept.size(); ++p) {
        const StickKind kind = sketch.points[p].kind;
        kept[p] = kind != StickKind::left_leg && kind != StickKind::right_leg;
    }
    for (const HumanJoint part : {HumanJoint::left_upper_leg, HumanJoint::right_upper_leg}) {
        if (sketch.parts.has(part)) kept[static_cast<size_t>(sketch.parts[part])] = true;
    }
    for (size_t i = 0; i < sketch.places.size(); ++i) {
        if (!kept[i % sketch.points.size()]) sketch.seen[i] = false;
    }
}

}  // namespace

StickFigure make_stick_figure(const Motion& motion, const StickOptions& options) {
    const bool in_space = motion.joints || motion.keypoints;
    StickSketch sketch = sketch_motion(resample(motion, options.fps));
    options.face ? prefer_outline(sketch) : keep_nose_and_eyes(sketch);
    if (options.upper_body) {
        hold_root(sketch, in_space);
        hide_legs(sketch);
    } else {
        stand_on_floor(sketch, in_space);
    }
    if (!options.hands) {
        hide(sketch,
             [](StickKind kind) { return kind == StickKind::left_hand || kind == StickKind::right_hand; });
    }
    StickFigure figure{.avatar = make_stick_avatar(sketch), .fit = {.fps = options.fps}};
    figure.fit.poses = stick_poses(sketch);
    FitReport& report = figure.fit.report;
    report.motion = motion.source;
    report.avatar = figure.avatar.source;
    report.source = source_of(motion);
    report.frames = sketch.frames;
    report.fps = options.fps;
    return figure;
}

}  // namespace chironomia
