#include "study/fit/fit_page.h"

#include <algorithm>
#include <map>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "study/html/html.h"

namespace chironomia::study {
namespace {

constexpr double kChartTop = 0.25;  // of a shoulder width; VerdictLimits::wrong_error

std::string badge(Verdict verdict) {
    constexpr const char* kClasses[] = {"yes", "look", "no"};
    return format("<span class=\"badge {}\">{}</span>", kClasses[static_cast<std::size_t>(verdict)],
                  to_text(verdict));
}

std::string readable(std::string text) {
    std::replace(text.begin(), text.end(), '_', ' ');
    return escape_html(text);
}

// "24 mm: right forearm in trunk", or nothing.
std::string deepest_of(const FitReport& report) {
    const auto& all = report.interpenetrations;
    if (all.empty()) return "";
    const auto deepest = std::max_element(
        all.begin(), all.end(),
        [](const Interpenetration& a, const Interpenetration& b) { return a.deepest < b.deepest; });
    return format("{:.0f} mm: {} in {}", 1000 * deepest->deepest, deepest->part, deepest->in);
}

std::string overview(const FittedClips& fitted) {
    std::string html =
        "<table class=\"overview\">\n<tr><th>clip</th><th>verdict</th><th>deepest in the "
        "body</th><th>first reason</th></tr>\n";
    for (std::size_t i = 0; i < fitted.clips.size(); ++i) {
        const FittedClip& clip = fitted.clips[i];
        const auto& reasons = clip.judgement.reasons;
        html += format("<tr><td><a href=\"#clip{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td></tr>\n", i,
                       escape_html(clip.name), badge(clip.judgement.verdict), deepest_of(clip.report),
                       reasons.empty() ? "" : escape_html(reasons.front().text));
    }
    return html + "</table>\n";
}

std::string reasons_of(const Judgement& judgement) {
    if (judgement.reasons.empty()) return "<p class=\"quiet\">Nothing was found.</p>\n";
    std::string html = "<ul class=\"reasons\">\n";
    for (const Reason& reason : judgement.reasons)
        html += format("<li>{} {}</li>\n", badge(reason.verdict), escape_html(reason.text));
    return html + "</ul>\n";
}

std::string strip_of(const FittedClip& clip) {
    if (clip.strip.empty()) return "";
    std::string html = "<div class=\"strip\">\n";
    for (const OverlayPicture& picture : clip.strip) {
        html += format(
            "<figure><img alt=\"frame {0}\" src=\"{1}\"><figcaption>frame {0}, {2:.2f} "
            "s</figcaption></figure>\n",
            picture.frame, png_source(picture.png), static_cast<double>(picture.frame) / clip.report.fps);
    }
    return html + "</div>\n";
}

// A row for each finding, the frames of the motion from left to right.
std::string timeline_of(const FitReport& report) {
    if (report.findings.empty()) return "";
    constexpr int kLeft = 190, kWidth = 760, kRow = 18;
    const int height = kRow * static_cast<int>(report.findings.size()) + 22;
    const double scale = kWidth / static_cast<double>(std::max<std::size_t>(report.source_frames, 1));
    std::string svg = format(
        "<svg class=\"timeline\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"what was found when\">\n",
        kLeft + kWidth + 10, height);
    for (std::size_t i = 0; i < report.findings.size(); ++i) {
        const Finding& finding = report.findings[i];
        const int y = kRow * static_cast<int>(i);
        svg += format(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}: {}</text><rect class=\"lane\" x=\"{}\" y=\"{}\" "
            "width=\"{}\" height=\"10\"/>\n",
            kLeft - 8, y + 13, readable(std::string(name_of(finding.check))), readable(finding.part), kLeft,
            y + 4, kWidth);
        for (const FrameSpan& span : finding.spans) {
            svg += format(
                "<rect class=\"{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"10\"><title>frames {} to "
                "{}</title></rect>\n",
                name_of(finding.check), kLeft + scale * static_cast<double>(span.first), y + 4,
                std::max(2.0, scale * static_cast<double>(span.last - span.first + 1)), span.first,
                span.last);
        }
    }
    svg += format(
        "<text x=\"{}\" y=\"{}\">frame 0</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
        kLeft, height - 4, kLeft + kWidth, height - 4, report.source_frames - 1);
    return svg + "</svg>\n";
}

// A value over the frames of a clip.
struct Chart {
    std::string label;
    const std::vector<float>& course;  // (T); below 0: not known
    double limit = 0;                  // a dashed line
    double top = 1;                    // what is above is drawn there
};

// The greatest value of each step; gaps where it is not known.
std::string chart_of(const Chart& chart) {
    constexpr int kWidth = 260, kHeight = 34;
    constexpr std::size_t kMostSteps = 260;
    const std::size_t frames = chart.course.size(), steps = std::min(frames, kMostSteps);
    std::string path;
    bool drawing = false;
    for (std::size_t step = 0; step < steps; ++step) {
        const std::size_t first = step * frames / steps,
                          last = std::max(first + 1, (step + 1) * frames / steps);
        const float worst = *std::max_element(chart.course.begin() + static_cast<std::ptrdiff_t>(first),
                                              chart.course.begin() + static_cast<std::ptrdiff_t>(last));
        if (worst < 0) {
            drawing = false;
            continue;
        }
        const double share = std::min(static_cast<double>(worst) / chart.top, 1.0);
        path += format("{}{:.1f} {:.1f}", drawing ? "L" : "M",
                       kWidth * (static_cast<double>(step) + 0.5) / static_cast<double>(steps),
                       kHeight - 1 - (kHeight - 2) * share);
        drawing = true;
    }
    const double limit = kHeight - 1 - (kHeight - 2) * chart.limit / chart.top;
    return format(
        "<svg class=\"chart\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\"><path class=\"limit\" "
        "d=\"M0 {3:.1f}H{0}\"/><path class=\"course\" d=\"{4}\"/></svg>",
        kWidth, kHeight, chart.label, limit, path);
}

std::string errors_of(const FitReport& report, double shoulder_pixels) {
    if (report.errors.empty()) return "";
    std::string html =
        "<table class=\"errors\">\n<tr><th>joint</th><th>n</th><th>median</th><th>95 "
        "%</th><th>most</th><th>median, "
        "px</th><th>95 %, px</th><th>median in space</th><th>over the clip</th></tr>\n";
    for (const JointError& error : report.errors) {
        const ErrorSpread& seen = error.reprojected;
        html += format(
            "<tr><td>{}</td><td>{}</td><td>{:.1f} %</td><td>{:.1f} %</td><td>{:.1f} "
            "%</td><td>{:.1f}</td><td>{:.1f}</td><td>{}</td><td>{}</td></tr>\n",
            readable(error.part), seen.n, 100 * seen.median, 100 * seen.p95, 100 * seen.max,
            shoulder_pixels * seen.median, shoulder_pixels * seen.p95,
            error.in_space ? format("{:.1f} %", 100 * error.in_space->median) : "not known",
            chart_of({.label = format("error of {} over the clip", readable(error.part)),
                      .course = error.course,
                      .limit = VerdictLimits().median_error,
                      .top = kChartTop}));
    }
    return html + "</table>\n";
}

// A row for each two parts that are in each other, with their depth over the clip.
std::string interpenetrations_of(const FitReport& report) {
    if (report.interpenetrations.empty()) return "";
    constexpr double kDeepest = 0.12;  // [m] at the top of a chart
    std::string html =
        "<table class=\"inside\">\n<tr><th>in the body</th><th>deepest, mm</th><th>frames</th><th>longest, "
        "s</th><th>depth over the clip</th></tr>\n";
    for (const Interpenetration& one : report.interpenetrations) {
        const InsideTimes times = times_of(one);
        html += format("<tr><td>{} in {}</td><td>{:.0f}</td><td>{}</td><td>{:.2f}</td><td>{}</td></tr>\n",
                       one.part, one.in, 1000 * one.deepest, times.frames,
                       static_cast<double>(times.longest) / report.fps,
                       chart_of({.label = format("depth of {} in {}", one.part, one.in),
                                 .course = one.course,
                                 .limit = VerdictLimits().inside_depth,
                                 .top = kDeepest}));
    }
    return html + "</table>\n";
}

// Lines such as "left_thumb_3: 12 frames" become one line for all fingers of a hand, with the largest count.
std::vector<std::string> with_fingers_together(const std::vector<std::string>& gaps) {
    std::vector<std::string> kept;
    std::map<std::string, long long> most;
    for (const std::string& gap : gaps) {
        const auto landmark = landmark_named(gap.substr(0, gap.find(':')));
        if (!landmark || *landmark < Landmark::left_thumb_1) {
            kept.push_back(gap);
            continue;
        }
        const std::string_view count = std::string_view(gap).substr(gap.find(':') + 1);
        long long& frames = most[gap.starts_with("left") ? "left fingers" : "right fingers"];
        frames = std::max(frames, parse_integer(split_words(count).front()).value_or(0));
    }
    for (const auto& [fingers, frames] : most) kept.push_back(format("{}: up to {} frames", fingers, frames));
    return kept;
}

std::string fact(const std::string& name, const std::string& text) {
    return text.empty() ? "" : format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, readable(text));
}

// "in 21 frames, a wrist by up to 23 mm, an elbow by up to 2 degrees", or nothing.
std::string moved_of(const FitReport& report) {
    const auto& kept = report.interpenetration_moves;
    if (!kept || kept->frames == 0) return "";
    return format("in {} frames, a wrist by up to {:.0f} mm, an elbow by up to {:.0f} degrees", kept->frames,
                  1000 * kept->most_wrist, kept->most_swivel / kDegree);
}

std::string facts_of(const FitReport& report) {
    std::vector<std::string> unreachable, limits;
    for (const Reached& limb : report.reached) {
        if (limb.unreachable > 0) unreachable.push_back(format("{}: {} frames", limb.limb, limb.unreachable));
    }
    for (const LimitCount& count : report.limits)
        limits.push_back(format("{}: {} frames", count.limit, count.frames));
    return "<dl>\n" +
           fact("motion",
                format("{} of {} frames at {:g} a second, {:.2f} s", report.source, report.source_frames,
                       report.source_fps, static_cast<double>(report.source_frames) / report.source_fps)) +
           fact("rest pose", report.rest_is_twisted
                                 ? "nobody could stand in it; trunk and head face as the motion shows"
                                 : "") +
           fact("doubtful", join(warnings_of(report))) + fact("out of reach", join(unreachable)) +
           fact(report.limits_applied ? "held back at a joint's limit" : "beyond a joint's usual range",
                join(limits)) +
           fact("arms moved out of the body", moved_of(report)) +
           fact("gaps bridged", join(with_fingers_together(report.bridged))) +
           fact("gaps in which a part rests", join(with_fingers_together(report.rested))) +
           fact("not in the motion", join(report.held)) + "</dl>\n";
}

std::string section_of(const FittedClip& clip, std::size_t index, double shoulder_pixels) {
    std::string html = format("<section id=\"clip{}\">\n<h2>{}</h2>\n", index, escape_html(clip.name));
    if (clip.error.empty()) {
        html += strip_of(clip) + timeline_of(clip.report) + errors_of(clip.report, shoulder_pixels) +
                interpenetrations_of(clip.report) + facts_of(clip.report);
    }
    return html + format("<h3>Verdict: {}</h3>\n", badge(clip.judgement.verdict)) +
           reasons_of(clip.judgement) + "</section>\n";
}

std::string summary_of(const FittedClips& fitted) {
    std::string text =
        format("{} of {} fit to show", fitted.count(Verdict::fit_to_show), fitted.clips.size());
    for (const Verdict verdict : {Verdict::look_first, Verdict::do_not_show}) {
        if (const std::size_t count = fitted.count(verdict))
            text += format(", {}: {}", to_text(verdict), count);
    }
    if (fitted.broken() > 0) text += format(", of these {} could not be read", fitted.broken());
    return text;
}

std::string notes_of(const FittedClips& fitted) {
    std::string html;
    if (fitted.clips.size() > kMostStrips)
        html += format("<p>Only the first {} clips have pictures.</p>\n", kMostStrips);
    if (!fitted.left_out.empty())
        html +=
            format("<p>Left out, as they hold a face alone: {}.</p>\n", escape_html(join(fitted.left_out)));
    return html;
}

std::string meaning() {
    const VerdictLimits verdict;
    const CheckLimits check;
    return format(
        "<table class=\"meaning\">\n"
        "<tr><th></th><th>look first</th><th>do not show</th></tr>\n"
        "<tr><td>drop out</td>"
        "<td>a part is unseen for more than {:.1f} s: shorter gaps are bridged, in longer ones it rests</td>"
        "<td>a shoulder, or both wrists, unseen in more than {:.0f} % of the frames</td></tr>\n"
        "<tr><td>speed</td>"
        "<td>wrists or ankles over {:.0f}, elbows or knees over {:.0f}, trunk or head over {:.0f} shoulder "
        "widths a second; or away by {:.1f} and back in one frame</td>"
        "<td>in more than {:.0f} % of the frames</td></tr>\n"
        "<tr><td>sign flip</td>"
        "<td>a bone of an arm turns over in depth faster than {:.0f} degrees a second</td>"
        "<td>more than {:g} a second</td></tr>\n"
        "<tr><td>frozen hand</td>"
        "<td>fingers that move elsewhere stand still for {:g} s or more while the wrist travels {:g} "
        "shoulder widths or more</td>"
        "<td></td></tr>\n"
        "<tr><td>T-pose</td>"
        "<td>both arms straight out within {:.0f} degrees, and still, or in one frame alone</td>"
        "<td>in more than {:.0f} % of the frames</td></tr>\n"
        "<tr><td>error of a joint</td><td>median over {:.0f} % of a shoulder width</td>"
        "<td>median over {:.0f} %</td></tr>\n"
        "<tr><td>joint limits</td><td>keypoints held back in more than {:.0f} % of the frames</td>"
        "<td></td></tr>\n"
        "<tr><td>in the body</td>"
        "<td>a hand or forearm of the avatar deeper than {:.0f} cm in its trunk, neck, head, thigh or "
        "other arm for {:.1f} s</td>"
        "<td>deeper than {:.0f} cm for {:.1f} s</td></tr>\n"
        "<tr><td>numbers</td><td></td><td>any that is none; a file that cannot be read</td></tr>\n"
        "</table>\n",
        verdict.gap_seconds, 100 * verdict.gap_share, check.limb_speed, check.joint_speed, check.trunk_speed,
        check.spike, 100 * verdict.speed_share, check.flip_speed, verdict.flips_a_second,
        check.frozen_seconds, check.frozen_travel, check.t_pose_degrees, 100 * verdict.t_pose_share,
        100 * verdict.median_error, 100 * verdict.wrong_error, 100 * verdict.limit_share,
        100 * verdict.inside_depth, verdict.inside_seconds, 100 * verdict.hidden_depth,
        verdict.hidden_seconds);
}

std::string avatar_of(const FittedClips& fitted) {
    for (const FittedClip& clip : fitted.clips) {
        if (clip.error.empty()) return std::filesystem::path(clip.report.avatar).filename().string();
    }
    return "no avatar: nothing could be read";
}

}  // namespace

std::string make_fit_page(const FittedClips& fitted) {
    std::string sections;
    for (std::size_t i = 0; i < fitted.clips.size(); ++i)
        sections += section_of(fitted.clips[i], i, fitted.shoulder_pixels);
    std::string page = read_text(find_asset("study/web/fit.html"));
    replace_mark(page, "<!--summary-->", escape_html(summary_of(fitted)));
    replace_mark(page, "<!--avatar-->", escape_html(avatar_of(fitted)));
    replace_mark(page, "<!--pixels-->", format("{:.0f}", fitted.shoulder_pixels));
    replace_mark(page, "<!--overview-->", overview(fitted));
    replace_mark(page, "<!--notes-->", notes_of(fitted));
    replace_mark(page, "<!--meaning-->", meaning());
    replace_mark(page, "<!--clips-->", sections);
    return page;
}

}  // namespace chironomia::study
