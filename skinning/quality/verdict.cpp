#include "skinning/quality/verdict.h"

#include <algorithm>
#include <array>

#include "core/text.h"

namespace chironomia {
namespace {

// "frame 7", "frames 3 to 9", "frames 3 to 9 and 2 more stretches"
std::string where(const std::vector<FrameSpan>& spans) {
    const FrameSpan& first = spans.front();
    std::string text = first.first == first.last ? format("frame {}", first.first)
                                                 : format("frames {} to {}", first.first, first.last);
    if (spans.size() == 2) text += " and 1 more stretch";
    if (spans.size() > 2) text += format(" and {} more stretches", spans.size() - 1);
    return text;
}

std::vector<FrameSpan> longer_than(const std::vector<FrameSpan>& spans, double frames) {
    std::vector<FrameSpan> kept;
    for (const FrameSpan& span : spans) {
        if (static_cast<double>(span.last - span.first + 1) > frames + 1e-6) kept.push_back(span);
    }
    return kept;
}

// Where one part is deeper than `depth` in the other, for at least so many frames.
std::vector<FrameSpan> spans_inside(const Interpenetration& one, double depth, double frames) {
    return longer_than(
        spans_where(one.course.size(), [&](size_t t) { return static_cast<double>(one.course[t]) > depth; }),
        std::ceil(frames - 1e-6) - 1);
}

constexpr double kFlip = 120;  // what is called a flip [degrees]

class Judge {
  public:
    Judge(const FitFacts& facts, const VerdictLimits& limits) : facts_(facts), limits_(limits) {}

    Judgement judge(const std::vector<Finding>& findings) {
        for (const Finding& finding : findings) judge(finding);
        judge_wrists(findings);
        for (const JointError& error : facts_.errors) judge(error);
        for (const auto& [joint, frames] : facts_.limited) {
            const double share =
                static_cast<double>(frames) / static_cast<double>(std::max<size_t>(facts_.fit_frames, 1));
            if (!facts_.limits_applied || share <= limits_.limit_share) continue;
            give(Verdict::look_first, format("{} was held back at the limit of its joint in {:.0f} % of the "
                                             "frames; more than {:.0f} % is not how people move",
                                             joint, 100 * share, 100 * limits_.limit_share));
        }
        for (const Interpenetration& one : facts_.interpenetrations) judge(one);
        std::stable_sort(result_.reasons.begin(), result_.reasons.end(),
                         [](const Reason& a, const Reason& b) { return a.verdict > b.verdict; });
        if (!result_.reasons.empty()) result_.verdict = result_.reasons.front().verdict;
        return std::move(result_);
    }

  private:
    void give(Verdict verdict, std::string text) { result_.reasons.push_back({verdict, std::move(text)}); }

    double share(const Finding& finding) const {
        return static_cast<double>(frames_of(finding)) /
               static_cast<double>(std::max<size_t>(facts_.frames, 1));
    }

    void judge(const Finding& finding) {
        const std::string place = where(finding.spans);
        switch (finding.check) {
            case Check::not_finite:
                return give(Verdict::do_not_show, format("{} is no number in {}", finding.part, place));
            case Check::drop_out:
                return judge_gap(finding);
            case Check::speed:
                return give(share(finding) > limits_.speed_share ? Verdict::do_not_show : Verdict::look_first,
                            format("{} jumps in {}, at up to {:.0f} shoulder widths a second", finding.part,
                                   place, finding.worst));
            case Check::sign_flip:
                return give(is_rare(finding) ? Verdict::look_first : Verdict::do_not_show,
                            format("{} flips between before and behind in {}", finding.part, place));
            case Check::frozen_hand:
                return give(
                    Verdict::look_first,
                    format("the fingers of the {} stand still in {}, while it travels {:.1f} shoulder widths",
                           finding.part, place, finding.worst));
            case Check::t_pose:
                return give(
                    share(finding) > limits_.t_pose_share ? Verdict::do_not_show : Verdict::look_first,
                    format("stands in a T-pose in {}, {:.0f} % of the clip", place, 100 * share(finding)));
            case Check::turn_jump:
                return give(is_rare(finding) ? Verdict::look_first : Verdict::do_not_show,
                            format("{} {}{} by up to {:.0f} degrees from one frame to the next in {}{}",
                                   finding.part, finding.worst >= kFlip ? "flip" : "turn",
                                   is_plural(finding.part) ? "" : "s", finding.worst, place,
                                   finding.part.ends_with("of the avatar") ? "" : ", in the source"));
            case Check::trunk_twist:
                return give(Verdict::look_first,
                            format("{} are turned by up to {:.0f} degrees against the hips in {}",
                                   finding.part, finding.worst, place));
            case Check::foot_slide:
                return give(Verdict::look_first, format("{} slides over the floor in {}, at up to {:.2f} m/s",
                                                        finding.part, place, finding.worst));
            case Check::hover:
                return give(Verdict::look_first, format("{} hover in {}, up to {:.2f} m above the floor",
                                                        finding.part, place, finding.worst));
            case Check::out_of_view:
                return give(Verdict::look_first,
                            format("{} {} leaves the picture of the scene \"full\" in {}; show it with {}",
                                   finding.part == "head" ? "the" : "a", finding.part, place,
                                   finding.part == "hand" ? "a wider scene" : "--follow or --in-place"));
        }
    }

    static bool is_plural(std::string_view part) {
        return part.starts_with("hips") || part.starts_with("shoulders");
    }

    // What happens less often than once a second may be a glitch.
    bool is_rare(const Finding& finding) const {
        const double seconds = static_cast<double>(facts_.frames) / facts_.fps;
        return static_cast<double>(frames_of(finding)) <= limits_.flips_a_second * std::max(seconds, 1.0);
    }

    void judge_gap(const Finding& finding) {
        const std::vector<FrameSpan> gaps = longer_than(finding.spans, limits_.gap_seconds * facts_.fps);
        if (gaps.empty()) return;
        const bool shoulder = finding.part.ends_with("_shoulder") && share(finding) > limits_.gap_share;
        const std::string limit = format("{:.1f} s", limits_.gap_seconds);
        give(shoulder ? Verdict::do_not_show : Verdict::look_first,
             format("{} is not seen in {}, at longest {:.1f} s; {}", finding.part, where(gaps),
                    static_cast<double>(longest_of(finding)) / facts_.fps,
                    facts_.is_picture ? "gaps over " + limit + " are not bridged, it rests there"
                                      : "gaps are bridged by a straight line, which is seen over " + limit));
    }

    void judge_wrists(const std::vector<Finding>& findings) {
        int lost = 0;
        for (const Finding& finding : findings) {
            lost += finding.check == Check::drop_out && finding.part.ends_with("_wrist") &&
                    share(finding) > limits_.gap_share;
        }
        if (lost == 2)
            give(Verdict::do_not_show, format("both wrists are unseen in more than {:.0f} % of the frames",
                                              100 * limits_.gap_share));
    }

    void judge(const JointError& error) {
        const bool known = error.in_space.has_value();
        const ErrorSpread& spread = known ? *error.in_space : error.reprojected;
        if (spread.n == 0 || spread.median <= limits_.median_error) return;
        const bool wrong = spread.median > limits_.wrong_error;
        give(wrong ? Verdict::do_not_show : Verdict::look_first,
             format("{} of the avatar is {:.0f} % of a shoulder width from the motion's{}, by the median; "
                    "the limit is {:.0f} %",
                    error.part, 100 * spread.median, known ? "" : " in the picture",
                    100 * (wrong ? limits_.wrong_error : limits_.median_error)));
    }

    void judge(const Interpenetration& one) {
        const auto inside = spans_inside(one, limits_.inside_depth, limits_.inside_seconds * facts_.fit_fps);
        if (inside.empty()) return;
        const auto hidden = spans_inside(one, limits_.hidden_depth, limits_.hidden_seconds * facts_.fit_fps);
        const bool gone = !hidden.empty();
        give(gone ? Verdict::do_not_show : Verdict::look_first,
             format("{} of the avatar is in its {} in {}, up to {:.0f} cm deep; the limit is {:.0f} cm for "
                    "{:.1f} s",
                    one.part, one.in, where(gone ? hidden : inside), 100 * one.deepest,
                    100 * (gone ? limits_.hidden_depth : limits_.inside_depth),
                    gone ? limits_.hidden_seconds : limits_.inside_seconds));
    }

    const FitFacts& facts_;
    VerdictLimits limits_;
    Judgement result_;
};

}  // namespace

std::string_view to_text(Verdict verdict) {
    constexpr std::array<std::string_view, 3> kTexts = {"fit to show", "look first", "do not show"};
    return kTexts[static_cast<size_t>(verdict)];
}

Judgement judge(const std::vector<Finding>& findings, const FitFacts& facts, const VerdictLimits& limits) {
    return Judge(facts, limits).judge(findings);
}

Json to_json(const ErrorSpread& spread) {
    return {{"n", spread.n}, {"median", spread.median}, {"p95", spread.p95}, {"max", spread.max}};
}

Json to_json(const std::vector<Finding>& findings, double fps) {
    Json json = Json::object();
    for (int check = 0; check < kChecks; ++check)
        json[std::string(name_of(static_cast<Check>(check)))] = Json::array();
    for (const Finding& finding : findings) {
        Json spans = Json::array();
        for (const FrameSpan& span : finding.spans) spans.push_back({span.first, span.last});
        Json one = {{"part", finding.part},
                    {"frames", frames_of(finding)},
                    {"longest_s", static_cast<double>(longest_of(finding)) / fps},
                    {"spans", std::move(spans)}};
        if (finding.check == Check::speed) one["fastest_shoulder_widths_per_s"] = finding.worst;
        if (finding.check == Check::frozen_hand) one["travelled_shoulder_widths"] = finding.worst;
        if (finding.check == Check::turn_jump || finding.check == Check::trunk_twist)
            one["worst_deg"] = finding.worst;
        if (finding.check == Check::foot_slide) one["fastest_m_per_s"] = finding.worst;
        if (finding.check == Check::hover) one["highest_m"] = finding.worst;
        json[std::string(name_of(finding.check))].push_back(std::move(one));
    }
    return json;
}

Json to_json(const std::vector<Interpenetration>& interpenetrations, double fps) {
    Json found = Json::array();
    for (const Interpenetration& one : interpenetrations) {
        Json spans = Json::array();
        for (const FrameSpan& span : one.spans) spans.push_back({span.first, span.last});
        const InsideTimes times = times_of(one);
        found.push_back({{"part", one.part},
                         {"in", one.in},
                         {"deepest_mm", 1000 * one.deepest},
                         {"frames", times.frames},
                         {"longest_s", static_cast<double>(times.longest) / fps},
                         {"spans", std::move(spans)}});
    }
    return {{"touch_mm", 1000 * kTouchDepth}, {"found", std::move(found)}};
}

Json to_json(const Judgement& judgement) {
    Json reasons = Json::array();
    for (const Reason& reason : judgement.reasons)
        reasons.push_back({{"verdict", to_text(reason.verdict)}, {"reason", reason.text}});
    return {{"verdict", to_text(judgement.verdict)}, {"reasons", std::move(reasons)}};
}

}  // namespace chironomia
