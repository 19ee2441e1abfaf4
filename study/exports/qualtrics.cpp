// Qualtrics: a survey to import (Advanced Format TXT), and for each sheet the rows of Loop & Merge (CSV) with
// the addresses of its videos. Its own .qsf is not documented.
#include <algorithm>

#include "core/text.h"
#include "study/exports/export_parts.h"

namespace chironomia::study {
namespace {

const std::string kQualtrics = "qualtrics";

// Text as HTML that Qualtrics does not take for a tag of its own, such as [[Choices]].
std::string survey_html(const std::string& text) {
    std::string html = html_of(text);
    for (std::size_t at = html.find("[["); at != std::string::npos; at = html.find("[[", at))
        html.replace(at, 2, "&#91;&#91;");
    return html;
}

// In a loop ${lm://Field/N} is column N of the row.
std::string field(std::size_t column) {
    return format("${{lm://Field/{}}}", column);
}

// Above each video its name; one video may show both figures.
std::string videos_html(const ExportSource& source, const PagePass& pass, std::size_t videos,
                        std::size_t figures) {
    const bool muted = !pass.sound || !source.study.pages.sound;
    const std::vector<std::string> names = names_of_figures(source.study.pages, figures);
    const auto name_html = [](const std::string& name) {
        return format("<b style=\"flex:1;text-align:center\">{}</b>", survey_html(name));
    };
    std::string html, shown;
    for (const std::string& name : names) html += name_html(name);
    if (!names.empty()) html = format("<div style=\"display:flex;gap:1em\">{}</div>", html);
    for (std::size_t i = 0; i < videos; ++i) {
        shown += format(
            "<video src=\"{}\" controls playsinline preload=\"auto\"{} style=\"flex:1;min-width:0\"></video>",
            field(i + 2), muted ? " muted" : "");
    }
    return format("{}<div style=\"display:flex;gap:1em\">{}</div>", html, shown);
}

std::string question_head(const std::string& kind, const std::string& id, const std::string& html) {
    return format("[[Question:{}]]\n[[ID:{}]]\n{}\n", kind, id, html);
}

std::string list_of(const std::string& name, const std::vector<std::string>& texts) {
    std::string lines;
    for (const std::string& text : texts) lines += survey_html(text) + "\n";
    return format("[[{}]]\n{}", name, lines);
}

std::vector<std::string> points_of(const Question& question) {
    std::vector<std::string> points;
    for (int point = 1; point <= question.points; ++point) {
        const auto label = question.labels.find(point);
        points.push_back(label == question.labels.end() ? std::to_string(point)
                                                        : format("{} {}", point, label->second));
    }
    return points;
}

// A word of the page in English, and its name in "texts" of a plan.
struct PageWord {
    const char* name;
    const char* english;
};
constexpr PageWord kDecline = {"decline", "I do not agree"};
constexpr PageWord kVideo = {"video", "Video"};
constexpr PageWord kReference = {"reference", "Reference"};

std::string say(const ExportSource& source, const PageWord& word) {
    return source.study.pages.texts.value(word.name, std::string(word.english));
}

// A video that stands alone has no name of its own.
std::vector<std::string> names_of_videos(const ExportSource& source, std::size_t places) {
    return places < 2 ? std::vector{say(source, kVideo)} : names_of_figures(source.study.pages, places);
}

std::vector<std::string> texts_of(const std::vector<QuestionOption>& options) {
    std::vector<std::string> texts;
    for (const QuestionOption& option : options) texts.push_back(option.text);
    return texts;
}

std::vector<std::string> options_of(const ExportSource& source, const Question& question,
                                    std::size_t places) {
    return is_of_videos(question) ? names_of_videos(source, places) : texts_of(question.options);
}

std::string reasons_text(const Question& question) {
    if (!question.reasons) return "";
    std::vector<std::string> options = texts_of(question.reasons->options);
    if (!question.reasons->other.empty()) options.push_back(question.reasons->other);
    return question_head("MC:MultipleAnswer:Vertical", question.id + "_reasons",
                         survey_html(question.reasons->text)) +
           list_of("Choices", options);
}

std::string question_text(const ExportSource& source, const Question& question, std::size_t places) {
    const std::string html = survey_html(question.text);
    switch (question.kind) {
        case QuestionKind::preference:
            return question_head("MC:SingleAnswer:Horizontal", question.id, html) +
                   list_of("Choices", question.answers) + reasons_text(question);
        case QuestionKind::rating:
            if (!question.each) {
                return question_head("MC:SingleAnswer:Horizontal", question.id, html) +
                       list_of("Choices", points_of(question));
            }
            return question_head("Matrix", question.id, html) +
                   list_of("Choices", names_of_videos(source, places)) +
                   list_of("Answers", points_of(question));
        case QuestionKind::choice:
            return question_head("MC:SingleAnswer:Vertical", question.id, html) +
                   list_of("Choices", options_of(source, question, places));
        case QuestionKind::rank:
            return question_head("RO", question.id, html) +
                   list_of("Choices", options_of(source, question, places));
        case QuestionKind::text:
            return question_head("TE:Essay", question.id, html);
        case QuestionKind::number:
            return question_head("TE:SingleLine", question.id, html);
        case QuestionKind::slider:
            break;
    }
    refuse_export(kQualtrics,
                  format("question \"{}\" is a slider, which its text files do not know", question.id));
}

// All pages must ask the same: the loop has one block.
const PagePass& pass_of_all(const ExportSource& source) {
    const std::vector<StudyPage>& pages = source.study.pages.pages;
    const StudyPage& first = pages.front();
    for (const StudyPage& page : pages) {
        const bool same = page.passes.size() == 1 && page.videos.size() == first.videos.size() &&
                          page.passes.front().questions == first.passes.front().questions &&
                          page.passes.front().sound == first.passes.front().sound;
        if (!same)
            refuse_export(kQualtrics, "pages must be shown once each, all with the same questions and sound");
    }
    return first.passes.front();
}

std::string survey_text(const ExportSource& source) {
    const StudyPages& study = source.study.pages;
    const PagePass& pass = pass_of_all(source);
    const StudyPage& first = study.pages.front();
    std::string text = "[[AdvancedFormat]]\n\n";
    for (const char* name : {"PROLIFIC_PID", "STUDY_ID", "SESSION_ID"}) text += format("[[ED:{}]]\n", name);
    text += "\n[[Block:Beginning]]\n" + question_head("DB", "instructions", survey_html(study.instructions));
    if (!study.consent.empty()) {
        text += question_head("MC:SingleAnswer:Vertical", "consent", survey_html(study.consent)) +
                list_of("Choices",
                        {study.agreement.empty() ? "I agree" : study.agreement, say(source, kDecline)});
    }
    text += "\n[[Block:Trials]]\n" +
            question_head("DB", "videos",
                          videos_html(source, pass, first.videos.size(), count_places(study, first)));
    for (const std::size_t question : pass.questions) {
        text += question_text(source, study.questions[question], count_places(study, first));
    }
    if (!study.questionnaire.empty()) text += "\n[[Block:End]]\n";
    for (const Question& question : study.questionnaire) text += question_text(source, question, 1);
    return text;
}

void note_words(Export& made, const ExportSource& source) {
    const StudyPages& study = source.study.pages;
    const std::vector<std::size_t>& asked = pass_of_all(source).questions;
    const bool names_videos = std::any_of(asked.begin(), asked.end(), [&](std::size_t i) {
        return study.questions[i].each || is_of_videos(study.questions[i]);
    });
    std::vector<PageWord> words;
    if (!study.consent.empty()) words.push_back(kDecline);
    if (names_videos && count_places(study, study.pages.front()) < 2) words.push_back(kVideo);
    if (study.layout == Layout::triplet) words.push_back(kReference);
    for (const PageWord& word : words) {
        if (study.texts.contains(word.name)) continue;
        note_english(made, source,
                     format("without \"{}\" in \"texts\" of the plan \"{}\" is", word.name, word.english));
    }
}

std::string heading_of(std::size_t videos) {
    if (videos == 1) return "clip,url,code";
    if (videos == 2) return "clip,urlLeft,urlRight,code";
    std::string heading = "clip";
    for (std::size_t i = 0; i < videos; ++i) heading += format(",url{}", i + 1);
    return heading + ",code";
}

std::string rows_of(const ExportSource& source, const std::vector<Step>& steps) {
    std::string csv = heading_of(steps.front().order.size()) + "\n";
    for (const Step& step : steps) {
        csv += clip_token(source, source.study.key.pages[step.page].clip);
        for (std::size_t place = 0; place < step.order.size(); ++place)
            csv += "," + video_address(source, step, place);
        csv += "," + source.study.pages.pages[step.page].id + "\n";
    }
    return csv;
}

}  // namespace

Export make_qualtrics(const ExportSource& source) {
    if (!source.video_url.starts_with("https://")) {
        refuse_export(
            kQualtrics,
            "its pages lie elsewhere and need the full address of the videos: give --video-url https://…/");
    }
    Export made{.files = {{.path = "survey.txt", .text = survey_text(source)}},
                .videos = all_videos(source),
                .notes = {}};
    for (std::size_t i = 0; i < source.study.sheets.size(); ++i) {
        made.files.push_back({.path = format("loop_and_merge/{}.csv", sheet_name(i)),
                              .text = rows_of(source, source.study.sheets[i])});
    }
    made.notes = {
        "import survey.txt, copy the block \"Trials\" for each sheet, paste its CSV into Loop & Merge, and "
        "put the blocks below a Randomizer that shows 1 of them with Evenly Present Elements",
        "Qualtrics does not judge attention checks, nor wait for the end of videos"};
    if (!source.study.pages.consent.empty()) {
        made.notes.push_back(
            "a text file for Qualtrics cannot branch: add a branch after the first block, where \"consent\" is its "
            "second choice, to the end of the survey; else those who do not agree go on to the trials");
    }
    note_words(made, source);
    note_captions(made, source);
    return made;
}

}  // namespace chironomia::study
