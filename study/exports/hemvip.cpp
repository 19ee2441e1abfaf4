// HEMVIP's JSON: a file a participant, in configs/<testId>/ (jonepatr/hemvip: doc/experimenter.md, and the
// branch genea2022 for videopc). Votes come back by the keys of the stimuli, which the browser sees: they are
// video tokens.
#include <algorithm>

#include "core/text.h"
#include "study/exports/export_parts.h"

namespace chironomia::study {
namespace {

const std::string kHemvip = "hemvip";

bool is_check(const ExportSource& source, const Step& step) {
    return source.study.key.pages[step.page].kind == PageKind::check;
}

// Sliders from 0 to 100 for two to eight videos.
void require_video_page(const ExportSource& source, const Step& step) {
    const Question& question = only_question(source, step, kHemvip);
    const bool right =
        question.kind == QuestionKind::slider && question.each && question.least == 0 && question.most == 100;
    if (!right) {
        refuse_export(
            kHemvip,
            format("question \"{}\" of several videos at a time must be a slider from 0 to 100 of each",
                   question.id));
    }
}

void require_pair_page(const ExportSource& source, const Step& step) {
    const Question& question = only_question(source, step, kHemvip);
    if (question.kind != QuestionKind::preference || question.answers.size() != 3) {
        refuse_export(
            kHemvip,
            format("question \"{}\" of a pair must be a preference with 3 answers: left, equal, right",
                   question.id));
    }
    if (step.order.size() != 2) refuse_export(kHemvip, "the figures of a pair need a video each");
}

Json stimuli_of(const ExportSource& source, const Step& step) {
    const Json& expected = source.study.key.pages[step.page].expected;
    const std::string& question = only_question(source, step, kHemvip).id;
    Json stimuli = Json::array();
    for (std::size_t place = 0; place < step.order.size(); ++place) {
        const std::string token = token_of(source.study.pages.pages[step.page].videos[step.order[place]]);
        Json stimulus = {token, video_address(source, step, place)};
        // "at" and the value that is needed are HEMVIP's way to mark the video of an attention check of
        // sliders.
        const bool marked = is_check(source, step) && expected.contains(question) &&
                            expected[question].is_array() && !expected[question][step.order[place]].is_null();
        if (marked) {
            stimulus[0] = "at";
            stimulus.push_back(expected[question][step.order[place]]);
        }
        stimuli.push_back(std::move(stimulus));
    }
    return stimuli;
}

Json hemvip_page(const ExportSource& source, const Step& step, const std::string& name) {
    const StudyPages& pages = source.study.pages;
    const bool pair = pages.layout == Layout::pair;
    if (pair) {
        require_pair_page(source, step);
    } else {
        require_video_page(source, step);
    }
    const StudyPage& page = pages.pages[step.page];
    return {{"type", pair ? "videopc" : "video"},
            {"id", page.id},
            {"name", name},
            {"content", html_of(page.caption)},
            {"question", only_question(source, step, kHemvip).text},
            {"stimuli", stimuli_of(source, step)}};
}

// HEMVIP's questionnaire knows number, options and long_text.
Json hemvip_question(const Question& question) {
    const std::string label = (question.optional ? "" : "*") + question.text;
    Json asked = {{"name", question.id}, {"label", label}, {"optional", question.optional}};
    switch (question.kind) {
        case QuestionKind::number:
            asked["type"] = "number";
            if (question.least) asked["min"] = *question.least;
            if (question.most) asked["max"] = *question.most;
            break;
        case QuestionKind::text:
            asked["type"] = "long_text";
            break;
        case QuestionKind::choice:
            asked["type"] = "options";
            for (const QuestionOption& option : question.options) {
                asked["response"].push_back({{"value", option.id}, {"label", option.text}});
            }
            break;
        default:
            refuse_export(kHemvip, format("question \"{}\" at the end must be a number, a text or a choice",
                                          question.id));
    }
    return asked;
}

Json generic_page(const std::string& id, const std::string& name, const std::string& text) {
    return {{"type", "generic"}, {"id", id}, {"name", name}, {"content", html_of(text)}};
}

Json hemvip_config(const ExportSource& source, const std::vector<Step>& steps) {
    const StudyPages& pages = source.study.pages;
    Json shown = Json::array();
    shown.push_back(generic_page("first_page", pages.title, pages.instructions));
    if (!pages.consent.empty()) shown.push_back(generic_page("consent", "Consent", pages.consent));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        shown.push_back(hemvip_page(source, steps[i], format("Page {} of {}", i + 1, steps.size())));
    }
    Json finish = {{"type", "finish"},     {"name", "Thank you"},  {"content", "Thank you for taking part."},
                   {"showResults", false}, {"writeResults", true}, {"questionnaire", Json::array()}};
    for (const Question& question : pages.questionnaire)
        finish["questionnaire"].push_back(hemvip_question(question));
    shown.push_back(std::move(finish));
    return {{"testname", pages.title},      {"testId", pages.study},           {"language", pages.language},
            {"stopOnErrors", true},         {"showButtonPreviousPage", false}, {"remoteService", "/save"},
            {"remoteFailService", "/fail"}, {"pages", std::move(shown)}};
}

}  // namespace

Export make_hemvip(const ExportSource& source) {
    const StudyPages& pages = source.study.pages;
    if (pages.layout != Layout::pair && pages.layout != Layout::parallel) {
        refuse_export(kHemvip,
                      format("layout \"{}\"; pair and parallel are possible", to_text(pages.layout)));
    }
    Export made{.files = {}, .videos = all_videos(source), .notes = {}};
    bool checks = false, silent = false;
    for (std::size_t i = 0; i < source.study.sheets.size(); ++i) {
        const std::vector<Step>& steps = source.study.sheets[i];
        made.files.push_back({.path = format("configs/{}/{}.json", pages.study, sheet_name(i)),
                              .text = hemvip_config(source, steps).dump(2) + "\n"});
        for (const Step& step : steps) {
            checks = checks || is_check(source, step);
            silent = silent || !pages.pages[step.page].passes[step.pass].sound;
        }
    }
    if (checks && pages.layout == Layout::parallel) {
        made.notes.push_back("HEMVIP marks attention checks where browsers can read it");
    } else if (checks) {
        made.notes.push_back(
            "HEMVIP does not judge attention checks of pairs; judge them from private/mapping.json");
    }
    const bool reasons = std::any_of(pages.questions.begin(), pages.questions.end(),
                                     [](const Question& question) { return question.reasons.has_value(); });
    if (pages.layout == Layout::pair) made.notes.push_back("HEMVIP names the three answers in its own words");
    if (reasons) made.notes.push_back("the reasons for preferences are left out");
    note_marks(made, source);
    note_english(made, source, "the titles of pages, such as \"Thank you\", are");
    if (silent) made.notes.push_back("HEMVIP does not mute videos; give it videos without sound");
    return made;
}

}  // namespace chironomia::study
