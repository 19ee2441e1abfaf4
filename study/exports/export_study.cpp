#include "study/exports/export_study.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <set>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/build/blinding.h"
#include "study/exports/export_parts.h"
#include "study/html/html.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

struct Form {
    const char* name;
    Export (*make)(const ExportSource&);
};
// In the order of ExportForm.
constexpr std::array kForms = {Form{"hemvip", make_hemvip}, Form{"hemvip2", make_hemvip2},
                               Form{"webmushra", make_webmushra}, Form{"jspsych", make_jspsych},
                               Form{"qualtrics", make_qualtrics}};

Json mapping_of(const ExportSource& source, const std::string& form) {
    const server::ServedStudy& study = source.study;
    Json conditions = Json::object(), clips = Json::object(), pages = Json::object(), sheets = Json::object();
    for (const KeyCondition& condition : study.key.conditions) {
        conditions[condition_token(source, condition.name)] = condition.name;
    }
    for (const KeyVideo& video : study.key.videos) clips[clip_token(source, video.clip)] = video.clip;
    for (const KeyPage& page : study.key.pages) {
        Json places = Json::array();
        for (const KeyPlace& place : page.places) {
            places.push_back({{"condition", condition_at(study.key, place)}, {"video", place.video}});
        }
        pages[page.token] = {{"kind", to_text(page.kind)},
                             {"clip", page.clip},
                             {"places", places},
                             {"expected", page.expected}};
    }
    for (std::size_t i = 0; i < study.sheets.size(); ++i) {
        Json shown = Json::array();
        for (const Step& step : study.sheets[i]) {
            const StudyPage& page = study.pages.pages[step.page];
            shown.push_back(
                {{"page", page.id}, {"pass", step.pass}, {"videos", tokens_as_shown(page, step.order)}});
        }
        sheets[sheet_name(i)] = std::move(shown);
    }
    return {{"format", "chironomia export 1"},
            {"study", study.pages.study},
            {"as", form},
            {"conditions", conditions},
            {"clips", clips},
            {"pages", pages},
            {"sheets", sheets}};
}

void copy_videos(const Export& made, const fs::path& study, const fs::path& out) {
    const auto same_for_all =
        std::chrono::file_clock::from_sys(std::chrono::sys_seconds(std::chrono::seconds(kNeutralTime)));
    for (const ExportedVideo& video : made.videos) {
        const fs::path from = study / "public" / video.from;
        if (!fs::is_regular_file(from)) {
            throw Error(format("{}: is missing; build the study again", from.string()));
        }
        fs::create_directories((out / video.to).parent_path());
        fs::copy_file(from, out / video.to, fs::copy_options::overwrite_existing);
        fs::last_write_time(out / video.to, same_for_all);
    }
}

// Addresses go into tables and pages as they are.
void require_address(const std::string& url) {
    const auto wrong = std::find_if(url.begin(), url.end(), [](unsigned char c) {
        return c <= ' ' || c == 0x7f || c == '"' || c == ',';
    });
    if (wrong == url.end()) return;
    throw Error(format(
        "--video-url: {} has at place {} a character that no table of addresses can hold; write it as %{:02X}",
        Json(url).dump(-1, ' ', true, Json::error_handler_t::replace), wrong - url.begin() + 1,
        static_cast<unsigned char>(*wrong)));
}

// What no form has.
std::vector<std::string> left_out_by_all(const server::ServedStudy& study) {
    const StudyPages& pages = study.pages;
    std::vector<std::string> notes;
    if (!pages.training.empty() || !pages.practice.empty())
        notes.push_back(
            format("the training is left out, its text and {} for practice",
                   pages.practice.size() == 1 ? "1 page" : format("{} pages", pages.practice.size())));
    if (!pages.sounds.empty()) notes.push_back("the sound check is left out");
    if (pages.skip_after) notes.push_back("no page can be skipped: \"skip_after\" is left out");
    if (pages.one_by_one)
        notes.push_back("videos are not shown one after the other: \"presentation\" is left out");
    if (study.data.value("shuffle_questions", Json()) == true)
        notes.push_back("questions keep their order: \"shuffle_questions\" is left out");
    return notes;
}

// Only the page for jsPsych leads people on at its end.
std::vector<std::string> left_out_at_the_end(const server::ServedStudy& study, ExportForm form) {
    const server::Completion& completion = study.completion;
    const StudyPages& pages = study.pages;
    const bool in_page = !pages.completion_url.empty() || !pages.completion_code.empty();
    const bool in_plan = !completion.url.empty() || !completion.code.empty();
    std::vector<std::string> notes;
    if (form != ExportForm::jspsych && (in_page || in_plan))
        notes.push_back("the completion link and code are left out; give them to the platform");
    if (form == ExportForm::jspsych && in_plan && !in_page)
        notes.push_back(
            "the completion link and code are left out: \"shown_by\" of the plan leaves them to the server");
    if (!completion.failed_url.empty() || !completion.failed_code.empty())
        notes.push_back("link and code of those who fail attention checks are left out");
    if (!completion.declined_url.empty()) notes.push_back("the link of those who decline is left out");
    return notes;
}

// DataPipe gives its experiments names of letters and digits.
void require_pipe_of_jspsych(const ExportOptions& options) {
    if (options.pipe.empty()) return;
    if (options.form != ExportForm::jspsych)
        throw Error("--pipe: is for jspsych alone; the other forms keep answers with their own platform");
    const bool plain = std::all_of(options.pipe.begin(), options.pipe.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    });
    if (!plain)
        throw Error(
            format("--pipe: \"{}\" is no ID of an experiment of DataPipe; it has letters and digits alone",
                   options.pipe));
}

}  // namespace

ExportSummary export_study(const ExportOptions& options) {
    require_pipe_of_jspsych(options);
    require_address(options.video_url);
    const server::ServedStudy study = server::read_served_study(options.study);
    const ExportSource source = {.study = study, .video_url = options.video_url, .pipe = options.pipe};
    const Form& form = kForms[static_cast<std::size_t>(options.form)];
    Export made = form.make(source);
    for (std::string& note : left_out_by_all(study)) made.notes.push_back(std::move(note));
    for (std::string& note : left_out_at_the_end(study, options.form)) made.notes.push_back(std::move(note));

    PendingOutput pending(options.out, PendingOutput::Kind::folder);
    const fs::path open = pending.path() / "public";
    for (const ExportFile& file : made.files) {
        fs::create_directories((open / file.path).parent_path());
        write_text(open / file.path, file.text);
    }
    copy_videos(made, options.study, open);
    fs::create_directories(pending.path() / "private");
    write_json(pending.path() / "private/mapping.json", mapping_of(source, form.name));
    pending.commit();
    return {.sheets = study.sheets.size(), .videos = made.videos.size(), .notes = std::move(made.notes)};
}

void note_english(Export& made, const ExportSource& source, const std::string& what) {
    const std::string& language = source.study.pages.language;
    if (language != "en") made.notes.push_back(format("{} in English, not in \"{}\"", what, language));
}

void note_captions(Export& made, const ExportSource& source) {
    const StudyPages& study = source.study.pages;
    bool captions = false;
    for (std::size_t i = 0; i < study.pages.size(); ++i) {
        const bool practised = std::count(study.practice.begin(), study.practice.end(), i) > 0;
        captions = captions || (!practised && !study.pages[i].caption.empty());
    }
    if (captions) made.notes.push_back("the captions of the pages are left out");
}

void note_marks(Export& made, const ExportSource& source) {
    const std::vector<Question>& questions = source.study.pages.questions;
    if (std::any_of(questions.begin(), questions.end(),
                    [](const Question& question) { return !question.marks.empty(); }))
        made.notes.push_back("the labels of the slider are left out");
}

std::vector<std::string> names_of_figures(const StudyPages& pages, std::size_t places) {
    const auto name_of = [&](const std::string& text, const std::string& english) {
        return pages.texts.value(text, english);
    };
    const auto letter = [&](std::size_t number) {
        return name_of(format("video_{}", number), std::string(1, static_cast<char>('A' + number - 1)));
    };
    if (places < 2) return {};
    if (pages.layout == Layout::triplet) return {letter(1), name_of("reference", "Reference"), letter(2)};
    std::vector<std::string> names;
    for (std::size_t number = 1; number <= places; ++number) names.push_back(letter(number));
    return names;
}

std::string condition_token(const ExportSource& source, const std::string& condition) {
    return condition_token(source.study.key, condition);
}

std::string clip_token(const ExportSource& source, const std::string& clip) {
    return clip_token(source.study.key, clip);
}

std::string sheet_name(std::size_t sheet) {
    return format("sheet-{:03}", sheet + 1);
}

std::string video_address(const ExportSource& source, const Step& step, std::size_t place) {
    return source.video_url + source.study.pages.pages[step.page].videos[step.order.at(place)];
}

std::vector<ExportedVideo> all_videos(const ExportSource& source) {
    std::set<std::string> files;
    for (const std::vector<Step>& sheet : source.study.sheets) {
        for (const Step& step : sheet) {
            for (const std::string& video : source.study.pages.pages[step.page].videos) files.insert(video);
        }
    }
    std::vector<ExportedVideo> videos;
    for (const std::string& file : files) videos.push_back({.from = file, .to = file});
    return videos;
}

const Question& only_question(const ExportSource& source, const Step& step, const std::string& form) {
    const StudyPages& pages = source.study.pages;
    const PagePass& pass = pages.pages[step.page].passes[step.pass];
    if (pass.questions.size() != 1) {
        refuse_export(form, format("page {} asks {} questions at a time, one is possible",
                                   pages.pages[step.page].id, pass.questions.size()));
    }
    return pages.questions[pass.questions.front()];
}

void refuse_export(const std::string& form, const std::string& why) {
    throw Error(format(
        "{} cannot express this study: {}; export it as jspsych, or run it with `chironomia study serve`",
        form, why));
}

std::string html_of(const std::string& text) {
    std::string html;
    for (const char letter : escape_html(text)) {
        html += letter == '\n' ? std::string("<br>") : std::string(1, letter);
    }
    return html;
}

}  // namespace chironomia::study
