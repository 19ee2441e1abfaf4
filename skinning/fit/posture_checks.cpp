#include "skinning/fit/posture_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr double kFloor = 0.025;    // a point of the sole below stands [m]
constexpr double kLeastTurn = 1.5;  // of a part that is still, for ratios [degrees]

// Stretches of at least `least` frames for which something holds.
std::vector<FrameSpan> stretches(size_t frames, double least, const std::function<bool(size_t)>& holds) {
    std::vector<FrameSpan> spans = spans_where(frames, holds);
    std::erase_if(spans, [&](const FrameSpan& span) { return double(span.last - span.first + 1) < least; });
    return spans;
}

// How far each frame is turned from the one before, (T) [degrees]; 0 at the first.
std::vector<double> steps_of(const std::vector<Quat>& turns) {
    std::vector<double> steps(turns.size(), 0);
    for (size_t t = 1; t < turns.size(); ++t)
        steps[t] = double(angle_between(turns[t - 1], turns[t])) / kDegree;
    return steps;
}

// What a part does around a frame: the second smallest of the four steps next to it, so that neither a turn that comes
// back nor one that takes two frames hides itself.
double usual_step(const std::vector<double>& steps, size_t t) {
    std::vector<double> around;
    for (const size_t back : {2u, 1u})
        if (t > back) around.push_back(steps[t - back]);
    for (const size_t on : {1u, 2u})
        if (t + on < steps.size()) around.push_back(steps[t + on]);
    if (around.empty()) return kLeastTurn;
    std::sort(around.begin(), around.end());
    return std::max(around[std::min<size_t>(1, around.size() - 1)], kLeastTurn);
}

bool is_hand(const std::string& part) {
    return part.ends_with("_hand") || part.ends_with("hand of the avatar");
}

// A part's turn against what carries it; the hips against the world.
using RelativeTurn = std::function<std::optional<Quat>(const Posture&)>;

RelativeTurn against(HumanJoint part, const std::function<std::optional<Quat>(const Posture&)>& carrier) {
    return [=](const Posture& posture) -> std::optional<Quat> {
        const auto base = carrier(posture);
        if (!base || !posture[part]) return std::nullopt;
        return conjugate(*base) * *posture[part];
    };
}

struct TurningPart {
    std::string name;
    RelativeTurn turn;
};

std::vector<TurningPart> turning_parts() {
    const auto of = [](HumanJoint part) { return [part](const Posture& posture) { return posture[part]; }; };
    const auto shoulders = [](const Posture& posture) { return std::optional(shoulders_of(posture)); };
    const auto hips = [](const Posture& posture) { return std::optional(posture.hips); };
    std::vector<TurningPart> parts = {
        {"hips", hips},
        {"shoulders", [](const Posture& posture) { return conjugate(posture.hips) * shoulders_of(posture); }},
        {"head", [](const Posture& posture) -> std::optional<Quat> {
             if (posture.neck.empty()) return std::nullopt;
             return conjugate(shoulders_of(posture)) * posture.neck.back();
         }}};
    const auto add = [&](HumanJoint part, const auto& carrier) {
        parts.push_back({std::string(name_of(part)), against(part, carrier)});
    };
    for (const LimbParts& arm : kArms) {
        add(arm.upper, shoulders);
        add(arm.lower, of(arm.upper));
        add(arm.end, of(arm.lower));
    }
    for (const LimbParts& leg : kLegs) {
        add(leg.upper, hips);
        add(leg.lower, of(leg.upper));
        add(leg.end, of(leg.lower));
        add(*tip_of(leg.end), of(leg.end));
    }
    return parts;
}

Finding twist_of(const std::vector<Posture>& postures, double fps, const PostureLimits& limits) {
    Finding finding{Check::trunk_twist, "shoulders", {}};
    const auto twist = [&](size_t t) {
        return double(angle_between(postures[t].hips, shoulders_of(postures[t]))) / kDegree;
    };
    finding.spans = stretches(postures.size(), limits.twist_seconds * fps,
                              [&](size_t t) { return twist(t) > limits.twist_deg; });
    for (const FrameSpan& span : finding.spans)
        for (size_t t = span.first; t <= span.last; ++t) finding.worst = std::max(finding.worst, twist(t));
    return finding;
}

// How fast a foot moves over the floor while it stands in both frames [m/s]; 0 where it does not.
double slide_at(const std::vector<Soles>& soles, size_t t, size_t foot, double fps) {
    if (t == 0) return 0;
    const size_t heel = 2 * foot;
    const size_t point = soles[t][heel].y <= soles[t][heel + 1].y ? heel : heel + 1;
    const Vec3 &now = soles[t][point], &before = soles[t - 1][point];
    if (double(now.y) >= kFloor || double(before.y) >= kFloor) return 0;
    return std::hypot(double(now.x) - double(before.x), double(now.z) - double(before.z)) * fps;
}

void keep(std::vector<Finding>& findings, Finding finding) {
    if (!finding.spans.empty()) findings.push_back(std::move(finding));
}

}  // namespace

std::vector<Finding> check_turns(const std::vector<Posture>& postures, double fps,
                                 const PostureLimits& limits) {
    std::vector<Finding> findings;
    for (const TurningPart& part : turning_parts()) {
        std::vector<Quat> turns;
        for (const Posture& posture : postures) {
            if (const auto turn = part.turn(posture)) turns.push_back(*turn);
        }
        if (turns.size() == postures.size()) keep(findings, check_jumps(turns, part.name, limits));
    }
    keep(findings, twist_of(postures, fps, limits));
    return findings;
}

Finding check_jumps(const std::vector<Quat>& turns, const std::string& part, const PostureLimits& limits) {
    const std::vector<double> steps = steps_of(turns);
    Finding finding{Check::turn_jump, part, {}};
    finding.spans = stretches(steps.size(), 1, [&](size_t t) {
        const bool flips = is_hand(part) && steps[t] >= limits.flip_deg;
        const bool jumps =
            steps[t] >= limits.jump_deg && steps[t] >= limits.jump_ratio * usual_step(steps, t);
        if (flips || jumps) finding.worst = std::max(finding.worst, steps[t]);
        return flips || jumps;
    });
    return finding;
}

Finding check_hand(const std::vector<Quat>& turns, const std::string& part, const PostureLimits& limits) {
    PostureLimits flips = limits;
    flips.jump_deg = flips.flip_deg;
    return check_jumps(turns, part, flips);
}

std::vector<Finding> check_feet(const std::vector<Soles>& soles, double fps, const PostureLimits& limits) {
    std::vector<Finding> findings;
    for (const size_t foot : {0u, 1u}) {
        Finding slide{Check::foot_slide, foot == 0 ? "left_foot" : "right_foot", {}};
        slide.spans = stretches(soles.size(), limits.slide_seconds * fps,
                                [&](size_t t) { return slide_at(soles, t, foot, fps) > limits.slide_speed; });
        for (const FrameSpan& span : slide.spans)
            for (size_t t = span.first; t <= span.last; ++t)
                slide.worst = std::max(slide.worst, slide_at(soles, t, foot, fps));
        keep(findings, std::move(slide));
    }
    const auto height = [&](size_t t) {
        const Soles& sole = soles[t];
        return double(std::min({sole[0].y, sole[1].y, sole[2].y, sole[3].y}));
    };
    Finding hover{Check::hover, "feet", {}};
    hover.spans = stretches(soles.size(), limits.hover_seconds * fps,
                            [&](size_t t) { return height(t) > limits.hover_height; });
    for (const FrameSpan& span : hover.spans)
        for (size_t t = span.first; t <= span.last; ++t) hover.worst = std::max(hover.worst, height(t));
    keep(findings, std::move(hover));
    return findings;
}

}  // namespace chironomia
