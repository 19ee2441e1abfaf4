#include "skinning/fit/fit_report.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr float kStanding = 0.025f;  // [m]

// "left_wrist" where the joint that ends the forearm is called left_hand.
std::string place_name(HumanJoint part) {
    switch (part) {
        case HumanJoint::left_lower_arm:
            return "left_elbow";
        case HumanJoint::right_lower_arm:
            return "right_elbow";
        case HumanJoint::left_hand:
            return "left_wrist";
        case HumanJoint::right_hand:
            return "right_wrist";
        case HumanJoint::left_lower_leg:
            return "left_knee";
        case HumanJoint::right_lower_leg:
            return "right_knee";
        case HumanJoint::left_foot:
            return "left_ankle";
        case HumanJoint::right_foot:
            return "right_ankle";
        default:
            return std::string(name_of(part));
    }
}

bool both_have(const BodyTrack& a, const BodyTrack& b, HumanJoint part) {
    return a.has(part) && b.has(part);
}

double ratio(double avatar, double source) {
    return source > 0 && avatar > 0 ? avatar / source : 1;
}

Json to_json(const Spread& spread) {
    return {{"n", spread.n}, {"mean", spread.mean}, {"p95", spread.p95}, {"max", spread.max}};
}

Json to_json(const std::vector<NamedSpread>& spreads) {
    Json json = Json::object();
    for (const NamedSpread& named : spreads) json[named.part] = to_json(named.spread);
    return json;
}

Json to_json(const Jerk& jerk) {
    return {{"n", jerk.n}, {"wrists_mean_m_per_s3", jerk.wrists}, {"all_mean_m_per_s3", jerk.all}};
}

Json interpenetration_of(const FitReport& report) {
    Json json = to_json(report.interpenetrations, report.fps);
    json["resolved"] = Json();
    if (const auto& kept = report.interpenetration_moves) {
        json["resolved"] = {{"frames_moved", kept->frames},
                            {"most_wrist_mm", 1000 * kept->most_wrist},
                            {"most_swivel_deg", kept->most_swivel / kDegree}};
    }
    return json;
}

// Sum and count of the third differences of one part.
struct Sum {
    double total = 0;
    size_t n = 0;
};
Sum third_differences(const BodyTrack& track, HumanJoint part) {
    Sum sum;
    if (!track.has(part)) return sum;
    for (size_t t = 0; t + 3 < track.places.size(); ++t) {
        const glm::dvec3 a = track.at(t, part);
        const glm::dvec3 b = track.at(t + 1, part);
        const glm::dvec3 c = track.at(t + 2, part);
        const glm::dvec3 d = track.at(t + 3, part);
        sum.total += glm::length(d - 3.0 * c + 3.0 * b - a);
        ++sum.n;
    }
    return sum;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    Spread spread{.n = values.size()};
    if (values.empty()) return spread;
    std::sort(values.begin(), values.end());
    double sum = 0;
    for (const double value : values) sum += value;
    spread.mean = sum / double(values.size());
    spread.p95 = values[size_t(std::ceil(0.95 * double(values.size()))) - 1];
    spread.max = values.back();
    return spread;
}

std::vector<NamedSpread> limb_distances_mm(const BodyTrack& source, const BodyTrack& avatar) {
    std::vector<NamedSpread> all;
    const auto add = [&](const LimbParts& limb, double scale) {
        if (!both_have(source, avatar, limb.upper)) return;
        for (const HumanJoint part : {limb.lower, limb.end}) {
            if (!both_have(source, avatar, part)) continue;
            std::vector<double> distances;
            for (size_t t = 0; t < avatar.places.size(); ++t) {
                const Vec3 wanted = float(scale) * (source.at(t, part) - source.at(t, limb.upper));
                distances.push_back(1000.0 * distance(wanted, avatar.at(t, part) - avatar.at(t, limb.upper)));
            }
            all.push_back({place_name(part), spread_of(std::move(distances))});
        }
    };
    const double arms = ratio(arm_length(avatar), arm_length(source));
    const double legs = ratio(leg_length(avatar), leg_length(source));
    for (const LimbParts& limb : kArms) add(limb, arms);
    for (const LimbParts& limb : kLegs) add(limb, legs);
    return all;
}

std::vector<NamedSpread> bone_errors_deg(const BodyTrack& source, const BodyTrack& avatar) {
    std::vector<NamedSpread> all;
    for (const auto& limbs : {kArms, kLegs}) {
        for (const LimbParts& limb : limbs) {
            for (const HumanJoint part : {limb.upper, limb.lower}) {
                const HumanJoint tip = *tip_of(part);
                if (!both_have(source, avatar, part) || !both_have(source, avatar, tip)) continue;
                std::vector<double> errors;
                for (size_t t = 0; t < avatar.places.size(); ++t) {
                    const Vec3 wanted = source.at(t, tip) - source.at(t, part);
                    const Vec3 given = avatar.at(t, tip) - avatar.at(t, part);
                    if (length(wanted) > 0 && length(given) > 0) {
                        errors.push_back(double(angle_between(wanted, given)) / kDegree);
                    }
                }
                all.push_back({std::string(name_of(part)), spread_of(std::move(errors))});
            }
        }
    }
    return all;
}

FootSlide foot_slide(const std::vector<Soles>& soles, double fps) {
    FootSlide slide;
    for (size_t t = 1; t < soles.size(); ++t) {
        for (size_t foot = 0; foot < 2; ++foot) {
            const size_t heel = 2 * foot;
            const size_t point = soles[t][heel].y <= soles[t][heel + 1].y ? heel : heel + 1;
            const Vec3& now = soles[t][point];
            const Vec3& before = soles[t - 1][point];
            if (now.y >= kStanding || before.y >= kStanding) continue;
            ++slide.frames;
            slide.metres += std::hypot(double(now.x) - before.x, double(now.z) - before.z);
        }
    }
    if (slide.frames > 0) slide.mm_per_second = 1000 * slide.metres * fps / double(slide.frames);
    return slide;
}

Jerk jerk_of(const BodyTrack& track, double fps, double scale) {
    const double factor = scale * fps * fps * fps;
    Sum wrists;
    for (const LimbParts& arm : kArms) {
        const Sum sum = third_differences(track, arm.end);
        wrists.total += sum.total;
        wrists.n += sum.n;
    }
    Sum all;
    for (int i = 0; i < static_cast<int>(HumanJoint::left_thumb_1); ++i) {
        const Sum sum = third_differences(track, static_cast<HumanJoint>(i));
        all.total += sum.total;
        all.n += sum.n;
    }
    Jerk jerk{.n = all.n};
    if (wrists.n > 0) jerk.wrists = factor * wrists.total / double(wrists.n);
    if (all.n > 0) jerk.all = factor * all.total / double(all.n);
    return jerk;
}

Json to_json(const LiftReport& lift) {
    Json cutoffs = Json::object();
    for (const auto& [point, hertz] : lift.cutoffs_hz) cutoffs[point] = hertz;
    const Json filter = !lift.cutoff ? Json("auto") : *lift.cutoff > 0 ? Json(*lift.cutoff) : Json("off");
    return {{"filter", filter},
            {"cutoffs_hz", cutoffs},
            {"camera_distance_m", lift.camera_distance_m},
            {"person_distance_m", {{"nearest", lift.nearest_m}, {"farthest", lift.farthest_m}}},
            {"pixels_per_metre", lift.pixels_per_metre}};
}

Judgement judge(const FitReport& report) {
    FitFacts facts{.frames = report.source_frames,
                   .fps = report.source_fps,
                   .is_picture = report.lift.has_value(),
                   .errors = report.errors,
                   .limits_applied = report.limits_applied,
                   .fit_frames = report.frames,
                   .fit_fps = report.fps,
                   .interpenetrations = report.interpenetrations};
    for (const LimitCount& count : report.limits) facts.limited.emplace_back(count.limit, count.frames);
    return judge(report.findings, facts);
}

Json to_json(const FitReport& report) {
    Json reached = Json::object();
    for (const Reached& limb : report.reached) {
        reached[limb.limb] = {{"unreachable_frames", limb.unreachable},
                              {"end_distance_when_reachable_mm", to_json(limb.end_distance_mm)}};
    }
    Json limits = Json::object();
    for (const LimitCount& count : report.limits) limits[count.limit] = count.frames;
    Json errors = Json::object();
    for (const JointError& error : report.errors) {
        errors[error.part] = {{"reprojected", to_json(error.reprojected)},
                              {"in_space", error.in_space ? to_json(*error.in_space) : Json()}};
    }
    Json json = {{"verdict", to_json(judge(report))},
                 {"motion", report.motion},
                 {"avatar", report.avatar},
                 {"source", report.source},
                 {"rest_pose_is_twisted", report.rest_is_twisted},
                 {"stands_still", report.stands_still},
                 {"frames", report.frames},
                 {"fps", report.fps},
                 {"travel_scale", report.travel_scale},
                 {"furthest_from_start_m", report.furthest_m},
                 {"distance_to_scaled_source_mm", to_json(report.distance_mm)},
                 {"bone_direction_error_deg", to_json(report.direction_deg)},
                 {"reach", reached},
                 {"joint_limits", {{"applied", report.limits_applied}, {"frames", limits}}},
                 {"foot_slide",
                  {{"n_frames_standing", report.foot_slide.frames},
                   {"moved_m", report.foot_slide.metres},
                   {"mean_mm_per_s", report.foot_slide.mm_per_second}}},
                 {"jerk_in", to_json(report.jerk_in)},
                 {"jerk_out", to_json(report.jerk_out)},
                 {"held_at_rest", report.held},
                 {"lift", report.lift ? to_json(*report.lift) : Json()},
                 {"joint_error_shoulder_widths", errors},
                 {"interpenetration", interpenetration_of(report)},
                 {"motion_checks",
                  {{"fps", report.source_fps},
                   {"frames", report.source_frames},
                   {"found", to_json(report.findings, report.source_fps)}}},
                 {"bridged_gaps", report.bridged},
                 {"rested_gaps", report.rested},
                 {"sides_put_back", report.put_back}};
    if (const auto& kept = report.contact_moves) {
        json["touch"] = {{"frames_moved", kept->frames},
                         {"most_wrist_mm", 1000 * kept->most_wrist},
                         {"hands_too_far_frames", kept->too_far}};
    }
    if (report.sides_look_exchanged) json["sides_look_exchanged"] = true;
    if (report.doubtful_up) json["doubtful_up_axis"] = *report.doubtful_up;
    if (report.pelvis_aside_deg || report.chest_aside_deg) {
        const auto degrees = [](const std::optional<double>& angle) { return angle ? Json(*angle) : Json(); };
        json["trunk_faces_by_joints"] = {{"pelvis_was_aside_deg", degrees(report.pelvis_aside_deg)},
                                         {"chest_was_aside_deg", degrees(report.chest_aside_deg)}};
    }
    return json;
}

std::vector<std::string> warnings_of(const FitReport& report) {
    std::vector<std::string> faults;
    if (report.pelvis_aside_deg)
        faults.push_back(
            format("its pelvis {:.0f} degrees aside from its hip joints", *report.pelvis_aside_deg));
    if (report.chest_aside_deg)
        faults.push_back(
            format("its chest {:.0f} degrees aside from its shoulders", *report.chest_aside_deg));
    std::vector<std::string> warnings;
    if (!faults.empty()) {
        warnings.push_back(format(
            "{}: its turns contradict its joints: in most frames it turns {}; the trunk was turned to where "
            "the joints lie",
            report.motion, join(faults, " and ")));
    }
    if (report.sides_look_exchanged) {
        warnings.push_back(format(
            "{}: its left and right look exchanged, as feet, face or knees show: if its axes are left-handed "
            "(Unity, Unreal), it is shown mirrored; export it with right-handed axes",
            report.motion));
    }
    if (report.doubtful_up) warnings.push_back(format("{}: {}", report.motion, *report.doubtful_up));
    if (report.contact_moves && report.contact_moves->too_far > 0) {
        warnings.push_back(format(
            "{}: in {} frames a hand is too far from what it should rest on on this avatar, and stays there",
            report.motion, report.contact_moves->too_far));
    }
    return warnings;
}

}  // namespace chironomia
