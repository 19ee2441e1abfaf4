#include "study/fit/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/quantile.h"
#include "core/render/camera.h"
#include "raster/studio/srgb.h"
#include "skinning/lift/lift.h"
#include "skinning/sketch/sketch_motion.h"
#include "skinning/stick/stick_solids.h"

namespace chironomia::study {
namespace {

using enum HumanJoint;

constexpr std::array<std::pair<HumanJoint, HumanJoint>, 4> kArmBones = {{{left_upper_arm, left_lower_arm},
                                                                         {left_lower_arm, left_hand},
                                                                         {right_upper_arm, right_lower_arm},
                                                                         {right_lower_arm, right_hand}}};

std::optional<Vec3> place_of(const StickSketch& sketch, std::size_t frame, HumanJoint part) {
    if (!sketch.parts.has(part)) return std::nullopt;
    const auto point = static_cast<std::size_t>(sketch.parts[part]);
    if (!sketch.sees(frame, point)) return std::nullopt;
    return sketch.place(frame, point);
}

// A line in the picture with round ends, `radius` wide on both sides [px].
struct Stroke {
    Vec2 from, to;
    float radius;
    Vec3 colour;  // linear rgb
};

void draw(Frame& frame, const Stroke& stroke) {
    const Vec2 low = glm::min(stroke.from, stroke.to) - Vec2(stroke.radius + 1);
    const Vec2 high = glm::max(stroke.from, stroke.to) + Vec2(stroke.radius + 1);
    const auto clamped = [](float value, int most) { return std::clamp(static_cast<int>(value), 0, most); };
    const Vec2 along = stroke.to - stroke.from;
    const float square = std::max(dot(along, along), 1e-6f);
    const SrgbTables& tables = SrgbTables::get();
    for (int y = clamped(low.y, frame.height); y < clamped(high.y + 1, frame.height); ++y) {
        for (int x = clamped(low.x, frame.width); x < clamped(high.x + 1, frame.width); ++x) {
            const Vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const float share = std::clamp(dot(pixel - stroke.from, along) / square, 0.0f, 1.0f);
            const float away = distance(pixel, stroke.from + share * along);
            const float cover = std::clamp(stroke.radius + 0.5f - away, 0.0f, 1.0f);
            if (cover == 0) continue;
            const auto first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                static_cast<std::size_t>(x)) *
                               4;
            for (int i = 0; i < 3; ++i) {
                std::uint8_t& level = frame.rgba[first + static_cast<std::size_t>(i)];
                level = tables.rounded(glm::mix(tables.linear(level), stroke.colour[i], cover));
            }
        }
    }
}

// Brings the places of a sketch into a picture of the avatar.
class Placer {
  public:
    Placer(const Overlay& overlay, std::size_t index, const AvatarView& view, RenderSize size)
        : overlay_(overlay), camera_(view.camera), picture_(size) {
        const auto world = world_from_joints(view.avatar.skeleton, view.pose.joints);
        const auto joint = [&](HumanJoint part) {
            return origin(world[static_cast<std::size_t>(view.avatar.humanoid[part])]);
        };
        const Vec3 own = joint(left_upper_arm) - joint(right_upper_arm);
        anchor_ = (joint(left_upper_arm) + joint(right_upper_arm)) * 0.5f;
        const auto left = place_of(overlay.sketch, index, left_upper_arm);
        const auto right = place_of(overlay.sketch, index, right_upper_arm);
        if (!left || !right) return;
        known_ = true;
        middle_ = (*left + *right) * 0.5f;
        const Vec3 theirs = *left - *right;
        if (!overlay.flat)
            turn_ = glm::angleAxis(std::atan2(theirs.z, theirs.x) - std::atan2(own.z, own.x), Vec3(0, 1, 0));
        const Vec3 sideways = normalize(cross(camera_.target - camera_.eye, camera_.up));
        pixels_ = 100 * distance(pixel_of(camera_, size, anchor_),
                                 pixel_of(camera_, size, anchor_ + 0.01f * sideways));
    }

    bool known() const { return known_; }

    Vec2 operator()(const Vec3& place) const {
        const Vec3 off = overlay_.size * (turn_ * (place - middle_));
        if (!overlay_.flat) return pixel_of(camera_, picture_, anchor_ + off);
        return pixel_of(camera_, picture_, anchor_) + pixels_ * Vec2(off.x, -off.y);
    }

  private:
    const Overlay& overlay_;
    const Camera& camera_;
    RenderSize picture_;
    bool known_ = false;  // both shoulders are seen
    Vec3 anchor_{0}, middle_{0};
    Quat turn_ = kNoTurn;
    float pixels_ = 0;  // a metre at the anchor [px]
};

bool is_thin(StickKind kind) {
    return kind == StickKind::left_hand || kind == StickKind::right_hand || kind == StickKind::face;
}

}  // namespace

float arm_length(const Motion& motion) {
    const bool flat = !motion.joints && !motion.keypoints;
    const StickSketch sketch = sketch_motion(flat ? lift(motion).motion : motion);
    float whole = 0;
    for (const auto& [from, to] : kArmBones) {
        std::vector<float> lengths;
        for (std::size_t t = 0; t < sketch.frames; ++t) {
            const auto a = place_of(sketch, t, from), b = place_of(sketch, t, to);
            if (a && b) lengths.push_back(distance(*a, *b));
        }
        if (lengths.empty()) return 0;
        whole += median(std::move(lengths)) / 2;
    }
    return whole;
}

float arm_length(const Avatar& avatar) {
    const auto world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    float whole = 0;
    for (const auto& [from, to] : kArmBones) {
        if (!avatar.humanoid.has(from) || !avatar.humanoid.has(to)) return 0;
        whole += distance(origin(world[static_cast<std::size_t>(avatar.humanoid[from])]),
                          origin(world[static_cast<std::size_t>(avatar.humanoid[to])])) /
                 2;
    }
    return whole;
}

void draw_overlay(Frame& frame, const Overlay& overlay, std::size_t index, const AvatarView& view) {
    const StickSketch& sketch = overlay.sketch;
    const Placer place(overlay, index, view, {.width = frame.width, .height = frame.height});
    if (!place.known()) return;
    const float width = static_cast<float>(frame.height) / 270;
    // A pale edge first, so that the lines stand out from clothes of any colour.
    for (const bool edge : {true, false}) {
        for (const StickLine& line : sketch.lines) {
            if (!sketch.sees(index, line.from) || !sketch.sees(index, line.to)) continue;
            const float radius = width * (is_thin(line.kind) ? 0.6f : 1.3f);
            draw(frame, {.from = place(sketch.place(index, line.from)),
                         .to = place(sketch.place(index, line.to)),
                         .radius = edge ? radius + 0.7f * width : radius,
                         .colour = edge ? Vec3(1) : colour_of(line.kind)});
        }
    }
}

}  // namespace chironomia::study
