// HEMVIP2's CSV: a file a participant, and the folders that its videos lie in (hemvip/hemvip.github.io:
// user_study_input.md). The platform has its own words for the question and its 5 answers, and adds its own
// attention checks. Systems and clips stand in addresses that browsers see: both are tokens.
#include <algorithm>
#include <set>

#include "core/text.h"
#include "study/exports/export_parts.h"

namespace chironomia::study {
namespace {

const std::string kHemvip2 = "hemvip2";

const KeyPage& keyed(const ExportSource& source, const Step& step) {
    return source.study.key.pages[step.page];
}

std::string system_at(const ExportSource& source, const KeyPlace& place) {
    return condition_token(source, condition_at(source.study.key, place));
}

// The place that shows the speech of another clip, if one does and the other is what it was made of.
std::optional<std::size_t> mismatched_place(const ExportSource& source, const KeyPage& page) {
    for (std::size_t place = 0; place < page.places.size(); ++place) {
        const KeyCondition& condition = source.study.key.conditions[page.places[place].condition];
        if (condition.made == "mismatched speech" && page.places[1 - place].condition == condition.from)
            return place;
        if (!condition.made.empty() && condition.made.starts_with("mismatched")) {
            refuse_export(
                kHemvip2,
                format("\"{}\" is not the same motion with other speech, beside the motion with its own",
                       condition.name));
        }
    }
    return std::nullopt;
}

void require_pair(const ExportSource& source, const Step& step) {
    if (source.study.pages.layout != Layout::pair || step.order.size() != 2) {
        refuse_export(kHemvip2, "pages must be pairs of two videos");
    }
    const Question& question = only_question(source, step, kHemvip2);
    if (question.kind != QuestionKind::preference || question.answers.size() != 5) {
        refuse_export(kHemvip2, format("question \"{}\" must be a preference with 5 answers", question.id));
    }
}

struct Row {
    std::string text;
    std::vector<ExportedVideo> videos;
};

Row row_of_pair(const ExportSource& source, const Step& step) {
    const KeyPage& page = keyed(source, step);
    const std::string clip = clip_token(source, page.clip);
    Row row{.text = clip, .videos = {}};
    for (const std::size_t place : step.order) {
        const std::string system = system_at(source, page.places[place]);
        const std::string& file = source.study.pages.pages[step.page].videos[place];
        row.text += "," + system;
        row.videos.push_back({.from = file, .to = format("videos/systems/{}/{}.mp4", system, clip)});
    }
    return row;
}

Row row_of_mismatch(const ExportSource& source, const Step& step, std::size_t mismatched) {
    const KeyPage& page = keyed(source, step);
    const std::vector<std::string>& files = source.study.pages.pages[step.page].videos;
    const std::string clip = clip_token(source, page.clip);
    const std::string other =
        clip_token(source, video_named(source.study.key, page.places[mismatched].video).speech);
    const std::string system = system_at(source, page.places[1 - mismatched]);
    return {
        .text = format("{},{},speech,{}", clip, system, other),
        .videos = {
            {.from = files[1 - mismatched], .to = format("videos/systems/{}/{}.mp4", system, clip)},
            {.from = files[mismatched],
             .to = format("videos/mismatched/speech/{}/{}_with_speech_from_{}.mp4", system, clip, other)}}};
}

bool is_mismatch_study(const ExportSource& source) {
    std::set<bool> kinds;
    for (const std::vector<Step>& sheet : source.study.sheets) {
        for (const Step& step : sheet) {
            require_pair(source, step);
            if (keyed(source, step).kind == PageKind::trial) {
                kinds.insert(mismatched_place(source, keyed(source, step)).has_value());
            }
        }
    }
    if (kinds.size() != 1)
        refuse_export(kHemvip2, "pairs of systems and mismatched speech need a study each");
    return *kinds.begin();
}

}  // namespace

Export make_hemvip2(const ExportSource& source) {
    const bool mismatch = is_mismatch_study(source);
    Export made;
    std::set<std::string> known;
    bool checks = false;
    for (std::size_t i = 0; i < source.study.sheets.size(); ++i) {
        std::string csv =
            mismatch ? "clip_name,system,mismatch_type,mismatch_data\n" : "clip_name,system_1,system_2\n";
        for (const Step& step : source.study.sheets[i]) {
            checks = checks || keyed(source, step).kind != PageKind::trial;
            if (keyed(source, step).kind != PageKind::trial) continue;
            const auto place = mismatched_place(source, keyed(source, step));
            Row row = place ? row_of_mismatch(source, step, *place) : row_of_pair(source, step);
            csv += row.text + "\n";
            for (ExportedVideo& video : row.videos) {
                if (known.insert(video.to).second) made.videos.push_back(std::move(video));
            }
        }
        made.files.push_back({.path = format("csv/{}.csv", sheet_name(i)), .text = std::move(csv)});
    }
    made.notes.push_back("HEMVIP2 asks its own question, not that of the study");
    std::vector<std::string> left_out = {"instructions"};
    if (!source.study.pages.consent.empty()) left_out.push_back("consent");
    if (!source.study.pages.questionnaire.empty()) left_out.push_back("questionnaire");
    made.notes.push_back(format("HEMVIP2 has pages of its own; left out: {}", join(left_out)));
    note_captions(made, source);
    if (checks) made.notes.push_back("attention checks are left out: HEMVIP2 puts in its own");
    if (mismatch) made.notes.push_back("HEMVIP2 chooses the sides of mismatched speech itself");
    return made;
}

}  // namespace chironomia::study
