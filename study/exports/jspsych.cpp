// A page for jsPsych 7 and 8: the study as data, and a timeline made of it in the browser. One figure with
// one question is a video-button-response, a preference between videos an html-button-response, all else a
// survey-html-form: two videos at a time are in no plugin of jsPsych.
#include "core/files/files.h"
#include "core/text.h"
#include "study/exports/export_parts.h"
#include "study/html/html.h"

namespace chironomia::study {
namespace {

const std::string kJspsych = "jspsych";
constexpr const char* kDataPipe = "https://pipe.jspsych.org/api/data/";

Json questions_json(const std::vector<Question>& questions) {
    Json list = Json::array();
    for (const Question& question : questions) {
        if (question.kind == QuestionKind::rank) {
            refuse_export(kJspsych, format("question \"{}\" is a ranking, for which jsPsych has no plugin",
                                           question.id));
        }
        list.push_back(to_json(question));
    }
    return list;
}

Json step_json(const ExportSource& source, const Step& step) {
    const StudyPage& page = source.study.pages.pages[step.page];
    Json addresses = Json::array();
    for (std::size_t place = 0; place < step.order.size(); ++place) {
        addresses.push_back(video_address(source, step, place));
    }
    return {{"page", page.id},
            {"pass", step.pass},
            {"videos", tokens_as_shown(page, step.order)},
            {"addresses", std::move(addresses)},
            {"places", count_places(source.study.pages, page)},
            {"names", names_of_figures(source.study.pages, count_places(source.study.pages, page))},
            {"sound", page.passes[step.pass].sound},
            {"caption", page.caption},
            {"questions", page.passes[step.pass].questions}};
}

Json study_json(const ExportSource& source) {
    const StudyPages& pages = source.study.pages;
    Json sheets = Json::array();
    for (const std::vector<Step>& sheet : source.study.sheets) {
        Json steps = Json::array();
        for (const Step& step : sheet) steps.push_back(step_json(source, step));
        sheets.push_back(std::move(steps));
    }
    return {{"study", pages.study},
            {"language", pages.language},
            {"texts", pages.texts},
            {"title", pages.title},
            {"width", pages.width},
            {"instructions", html_of(pages.instructions)},
            {"consent", html_of(pages.consent)},
            {"agreement", pages.agreement},
            {"questions", questions_json(pages.questions)},
            {"questionnaire", questions_json(pages.questionnaire)},
            {"sheets", std::move(sheets)},
            {"completion_url", pages.completion_url},
            {"completion_code", pages.completion_code},
            {"pipe",
             source.pipe.empty() ? Json(nullptr) : Json{{"url", kDataPipe}, {"experiment", source.pipe}}}};
}

}  // namespace

Export make_jspsych(const ExportSource& source) {
    std::string page = read_text(find_asset("study/exports/web/index.html"));
    replace_mark(page, "<!--language-->", escape_html(source.study.pages.language));
    replace_mark(page, "<!--title-->", escape_html(source.study.pages.title));
    Export made = {
        .files = {{.path = "index.html", .text = page},
                  {.path = "experiment.js", .text = read_text(find_asset("study/exports/web/experiment.js"))},
                  {.path = "texts.js", .text = read_text(find_asset("study/web/texts.js"))},
                  {.path = "study.js", .text = "const study = " + study_json(source).dump(1) + ";\n"}},
        .videos = all_videos(source),
        .notes = {
            "put the files of jsPsych 7 or 8 into public/jspsych: jspsych.js and jspsych.css, and of its "
            "plugins preload.js, html-button-response.js, video-button-response.js, survey-html-form.js",
            "jsPsych does not judge attention checks; `study analyse` judges them in its answers",
            source.pipe.empty()
                ? "answers are kept by the participant's browser alone until they are saved; --pipe keeps "
                  "each one with DataPipe as soon as it is given"
                : "DataPipe writes a file of all answers so far after each page; switch its validation of "
                  "data off, and give all files to `study analyse`"}};
    if (!source.study.pages.language.starts_with("fr"))
        note_english(made, source, "buttons and messages that \"texts\" of the plan leaves out are");
    return made;
}

}  // namespace chironomia::study
