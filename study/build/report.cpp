#include "study/build/report.h"

#include <algorithm>

#include "core/text.h"
#include "core/version.h"
#include "study/build/pages.h"
#include "study/design/balance.h"
#include "study/html/html.h"

namespace chironomia::study {
namespace {

constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0}: report</title>
<style>
body {{ max-width: 72rem; margin: 2rem auto; padding: 0 1.5rem; color: #1d2329; font: 1rem/1.5 system-ui, sans-serif; }}
h1 {{ margin-bottom: 0; font-size: 1.6rem; }}
h2 {{ margin-top: 2rem; padding-bottom: .2rem; border-bottom: 1px solid #c3cad1; font-size: 1.2rem; }}
.note {{ color: #8a2a12; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .25rem 1.25rem .25rem 0; border-bottom: 1px solid #e1e5e9; text-align: left; vertical-align: top; }}
.clips {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1rem; }}
figure {{ margin: 0; }}
video {{ width: 100%; border-radius: .3rem; background: #d7dce1; }}
figcaption {{ font-size: .9rem; }}
code {{ font-size: .85em; overflow-wrap: anywhere; }}
</style>
</head>
<body>
<h1>{0}</h1>
<p class="note">For the researcher alone: this page names the conditions. Participants get the folder public/ and nothing else.</p>
)";

std::string row(const std::vector<std::string>& cells, std::string_view kind = "td") {
    std::string html = "<tr>";
    for (const std::string& cell : cells) html += format("<{0}>{1}</{0}>", kind, escape_html(cell));
    return html + "</tr>\n";
}

std::string description_of(const Drawing& drawing) {
    if (drawing.renderer == RendererKind::gl) return "OpenGL";
    if (drawing.renderer == RendererKind::tiles) return "the tile renderer";
    return format("the ray tracer with {} samples a pixel, shutter open for {:g} of a frame", drawing.samples,
                  drawing.motion_blur);
}

// "mask, hands hidden", or for each condition where they differ.
std::string modes_of_conditions(const Plan& plan) {
    const auto text = [](const Modes& modes) {
        return format("face {}, hands {}", to_text(modes.face_mode), to_text(modes.hands));
    };
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i)
        texts.push_back(format("{}: {}", plan.conditions[i].name, text(plan.modes[i])));
    const bool same = std::all_of(plan.modes.begin(), plan.modes.end(),
                                  [&](const Modes& modes) { return modes == plan.modes.front(); });
    return same ? text(plan.modes.front()) : join(texts, "; ");
}

// "1 clip", "2 clips"
std::string count_text(std::size_t count, std::string_view what) {
    return format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string facts(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded) {
    const Plan& plan = draft.plan;
    double seconds = 0;  // of one participant
    for (const Showing& shown : draft.all.sheets.front().pages) {
        for (const std::size_t video : draft.videos_of_page[shown.page])
            seconds += recorded[video].result.seconds * static_cast<double>(plan.passes.size());
    }
    std::vector<std::string> questions;
    for (const Question& question : plan.questions) questions.push_back(question.text);
    const PlanRender& render = plan.render;
    return "<h2>The study</h2>\n<table>\n" + row({"Questions", join(questions, " | ")}) +
           row({"Conditions", join(condition_names(plan))}) +
           row({"Pages", format("{} of {}, {}", count_text(draft.all.design.pages.size(), "trial"),
                                count_text(draft.all.judged.size(), "clip"),
                                count_text(plan.checks.count, "attention check"))}) +
           row({"A participant sees",
                format("{} pages, {:.0f} s of video", draft.all.sheets.front().pages.size(), seconds)}) +
           row({"Sheets", format("{}; participant n takes sheet n modulo {}", draft.all.sheets.size(),
                                 draft.all.sheets.size())}) +
           row({"Videos", format("{} of {}x{} at {} frames a second", draft.videos.size(), render.size.width,
                                 render.size.height, to_text(render.fps))}) +
           row({"Drawn by", description_of(render.drawing)}) +
           row({"Face and hands", modes_of_conditions(plan)}) + row({"Seed", format("{}", draft.seed)}) +
           row({"Program", format("chironomia {}", program_version())}) + "</table>\n";
}

std::string balance(const StudyDraft& draft) {
    return format("<h2>Balance</h2>\n<pre>{}</pre>\n",
                  escape_html(balance_table(draft.all.design, condition_names(draft.plan))));
}

// What an object holds under a key; null if it is no object or has no such key.
Json value_in(const Json& object, const char* key) {
    return object.is_object() ? object.value(key, Json()) : Json();
}

// The part of the body that follows its motion worst, or "" if the recorder measured none.
std::string worst_fit(const Json& report) {
    std::string worst_part;
    double worst = -1;  // [mm]
    const Json motions = value_in(report, "motions");
    for (std::size_t i = 0; motions.is_array() && i < motions.size(); ++i) {
        const Json errors = value_in(value_in(motions[i], "fit"), "distance_to_scaled_source_mm");
        for (const auto& [part, error] : errors.items()) {
            const Json mean = value_in(error, "mean");
            if (!mean.is_number() || mean.get<double>() <= worst) continue;
            worst = mean.get<double>();
            worst_part = part;
        }
    }
    std::replace(worst_part.begin(), worst_part.end(), '_', ' ');
    return worst < 0 ? "" : format("; {} {:.1f} mm off on average", worst_part, worst);
}

// "ours", "ours | baseline", and what makes it unlike the clip itself.
std::string description_of(const StudyDraft& draft, const Video& video) {
    std::vector<std::string> names;
    for (const std::size_t condition : video.shows.conditions)
        names.push_back(draft.plan.conditions[condition].name);
    std::string text = join(names, " | ");
    if (video.speech != video.shows.clip) text += format(", speech of {}", draft.plan.clips[video.speech].id);
    if (video.shows.notice) text += format(", check: {}", video.shows.notice->text);
    return text;
}

std::string figure_of(const StudyDraft& draft, std::size_t index, const RecordedVideo& recorded) {
    const Video& video = draft.videos[index];
    std::string html = format(
        "<figure>\n<video controls preload=\"metadata\" src=\"../public/{}\"></video>\n"
        "<figcaption><strong>{}</strong> {} frames, {:.2f} s{}<br><code>{}</code>",
        video_path(video.token, draft.plan.render.format), escape_html(description_of(draft, video)),
        recorded.result.frames, recorded.result.seconds, worst_fit(recorded.result.report), video.token);
    for (const std::string& warning : recorded.result.warnings) {
        html += format("<br><span class=\"note\">{}</span>", escape_html(warning));
    }
    return html + "</figcaption>\n</figure>\n";
}

std::string clips(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded) {
    std::string html;
    std::size_t next = 0;  // the videos are in the order of the clips
    for (std::size_t clip = 0; clip < draft.plan.clips.size(); ++clip) {
        html += format("<h2>Clip {}</h2>\n<div class=\"clips\">\n", escape_html(draft.plan.clips[clip].id));
        for (; next < draft.videos.size() && draft.videos[next].shows.clip == clip; ++next)
            html += figure_of(draft, next, recorded[next]);
        html += "</div>\n";
    }
    return html;
}

std::string inputs(const StudyDraft& draft) {
    std::string html = "<h2>Inputs</h2>\n<table>\n" + row({"File", "Bytes", "SHA-256"}, "th");
    for (const InputFile& input : draft.inputs) {
        html += format("<tr><td>{}</td><td>{}</td><td><code>{}</code></td></tr>\n", escape_html(input.path),
                       input.bytes, input.sha256);
    }
    return html + "</table>\n";
}

}  // namespace

std::string make_report(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded) {
    return format(kHead, escape_html(draft.plan.texts.title)) + facts(draft, recorded) + balance(draft) +
           clips(draft, recorded) + inputs(draft) + "</body>\n</html>\n";
}

}  // namespace chironomia::study
