// webMUSHRA's YAML with the pages that its fork for videos adds: video_believable for silent videos and
// video_synchronized for videos with sound, several at a time, each with a slider from 0 to 100. webMUSHRA
// itself plays WAV alone.
#include "core/text.h"
#include "study/exports/export_parts.h"
#include "study/exports/yaml.h"

namespace chironomia::study {
namespace {

const std::string kWebmushra = "webmushra";

Json page_with(const std::string& type, const std::string& id, const std::string& name,
               const std::string& content) {
    return {{"type", type}, {"id", id}, {"name", name}, {"content", html_of(content)}};
}

Json webmushra_page(const ExportSource& source, const Step& step, const std::string& name) {
    const Question& question = only_question(source, step, kWebmushra);
    if (question.kind != QuestionKind::slider || !question.each || question.least != 0 ||
        question.most != 100) {
        refuse_export(kWebmushra,
                      format("question \"{}\" must be a slider from 0 to 100 of each video", question.id));
    }
    const StudyPage& page = source.study.pages.pages[step.page];
    const bool sound = page.passes[step.pass].sound && source.study.pages.sound;
    Json shown = page_with(sound ? "video_synchronized" : "video_believable",
                           format("{}_{}", page.id, step.pass), name, page.caption);
    shown["question"] = question.text;
    for (std::size_t place = 0; place < step.order.size(); ++place) {
        const std::string token = token_of(page.videos[step.order[place]]);
        shown["stimuli"][format("C{}", place + 1)] = {token, video_address(source, step, place)};
    }
    return shown;
}

Json webmushra_question(const Question& question) {
    Json asked = {
        {"type", "text"}, {"label", question.text}, {"name", question.id}, {"optional", question.optional}};
    if (question.kind == QuestionKind::number) {
        asked["type"] = "number";
        if (question.least) asked["min"] = *question.least;
        if (question.most) asked["max"] = *question.most;
        if (question.least) asked["default"] = *question.least;
    } else if (question.kind == QuestionKind::choice) {
        asked["type"] = "likert";
        for (const QuestionOption& option : question.options) {
            asked["response"].push_back({{"value", option.id}, {"label", option.text}});
        }
    } else if (question.kind != QuestionKind::text) {
        refuse_export(kWebmushra,
                      format("question \"{}\" at the end must be a number, a text or a choice", question.id));
    }
    return asked;
}

Json webmushra_config(const ExportSource& source, const std::vector<Step>& steps) {
    const StudyPages& study = source.study.pages;
    Json pages = Json::array();
    pages.push_back(page_with("generic", "first_page", study.title, study.instructions));
    if (!study.consent.empty()) pages.push_back(page_with("generic", "consent", "Consent", study.consent));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        pages.push_back(webmushra_page(source, steps[i], format("Page {} of {}", i + 1, steps.size())));
    }
    pages.push_back({{"type", "finish"},
                     {"name", "Thank you"},
                     {"content", "Thank you for taking part."},
                     {"showResults", false},
                     {"writeResults", true}});
    for (const Question& question : study.questionnaire) {
        pages.back()["questionnaire"].push_back(webmushra_question(question));
    }
    return {
        {"testname", study.title},  {"testId", study.study},           {"bufferSize", 2048},
        {"stopOnErrors", true},     {"showButtonPreviousPage", false}, {"remoteService", "service/write.php"},
        {"pages", std::move(pages)}};
}

}  // namespace

Export make_webmushra(const ExportSource& source) {
    if (source.study.pages.layout != Layout::parallel) {
        refuse_export(kWebmushra,
                      format("layout \"{}\"; only several videos at a time, \"parallel\", are possible",
                             to_text(source.study.pages.layout)));
    }
    Export made{.files = {}, .videos = all_videos(source), .notes = {}};
    for (std::size_t i = 0; i < source.study.sheets.size(); ++i) {
        made.files.push_back({.path = format("configs/{}.yaml", sheet_name(i)),
                              .text = to_yaml(webmushra_config(source, source.study.sheets[i]))});
    }
    made.notes.push_back(
        "webMUSHRA itself plays WAV alone; its fork with video_believable and video_synchronized is needed");
    made.notes.push_back("a participant's file is chosen by the address: ?config=sheet-001.yaml");
    if (!source.study.pages.consent.empty()) {
        made.notes.push_back(
            "webMUSHRA has no page that asks for consent: continuing counts as consent; say so in \"consent\" of "
            "the plan");
    }
    note_marks(made, source);
    note_english(made, source, "the titles of pages, such as \"Thank you\", are");
    made.notes.push_back("webMUSHRA does not judge attention checks; judge them from private/mapping.json");
    return made;
}

}  // namespace chironomia::study
