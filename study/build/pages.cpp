#include "study/build/pages.h"

#include <functional>
#include <map>

#include "core/files/files.h"
#include "core/text.h"
#include "study/html/html.h"
#include "study/plan/default_texts.h"

namespace chironomia::study {
namespace {

std::string read_player_file(const std::string& name) {
    return read_text(find_asset("study/web/" + name));
}

// Each {{name}} of the page filled in. A value may hold such a mark itself, and keeps it.
std::string filled_in(std::string_view page, const std::map<std::string, std::string, std::less<>>& values) {
    std::string text;
    for (std::size_t at; (at = page.find("{{")) != std::string::npos;) {
        const std::size_t end = page.find("}}", at);
        text.append(page.substr(0, at)).append(values.find(page.substr(at + 2, end - at - 2))->second);
        page.remove_prefix(end + 2);
    }
    return text.append(page);
}

// JSON inside a script element: nothing in it may look like the element's end.
std::string escape_script(const std::string& json) {
    std::string escaped;
    for (const char c : json) {
        if (c == '<') {
            escaped += "\\u003c";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

// Where both figures share a video there is one to order.
Sheet sheet_of(const StudyDraft& draft, Sheet sheet) {
    for (Showing& shown : sheet.pages) {
        if (draft.videos_of_page[shown.page].size() == 1) shown.order = {0};
    }
    return sheet;
}

// What comes before the first page and after the last.
void add_frame(const StudyDraft& draft, StudyPages& pages) {
    const PlanTexts& texts = draft.plan.texts;
    pages.instructions = texts.instructions;
    pages.consent = texts.consent;
    // The page has the words of its button among its texts; exports take them from here.
    pages.agreement = texts.page.value("agree", default_agreement(texts.language));
    pages.training = texts.training;
    pages.practice = draft.all.practice;
    for (const std::string& token : draft.names_of_sounds) pages.sounds.push_back(sound_path(token));
    pages.questionnaire = draft.plan.questionnaire;
    const PlanCompletion& completion = draft.plan.completion;
    pages.declined_url = completion.declined_url;
    if (completion.by_server) return;
    pages.completion_url = completion.url;
    pages.completion_code = completion.code;
}

}  // namespace

std::string video_path(const std::string& token, const std::string& format) {
    return chironomia::format("clips/{}.{}", token, format);
}

std::string sound_path(const std::string& token) {
    return format("clips/{}.wav", token);
}

StudyPages pages_of_study(const StudyDraft& draft, const std::vector<double>& seconds) {
    const Plan& plan = draft.plan;
    StudyPages study{.study = draft.name,
                     .language = plan.texts.language,
                     .title = plan.texts.title,
                     .layout = plan.layout,
                     .one_by_one = plan.presentation == Presentation::one_by_one,
                     .width = plan.render.size.width,
                     .height = plan.render.size.height,
                     .sound = has_sound(plan),
                     .shuffle_questions = plan.shuffle_questions,
                     .skip_after = plan.skip_after,
                     .texts = plan.texts.page,
                     .questions = plan.questions};
    add_frame(draft, study);
    for (std::size_t i = 0; i < draft.all.pages.size(); ++i) {
        StudyPage page{.id = draft.names_of_pages[i],
                       .videos = {},
                       .seconds = seconds[i],
                       .caption = plan.clips[draft.all.pages[i].clip].caption,
                       .passes = plan.passes};
        for (const std::size_t video : draft.videos_of_page[i])
            page.videos.push_back(video_path(draft.videos[video].token, plan.render.format));
        study.pages.push_back(std::move(page));
    }
    for (const Sheet& sheet : draft.all.sheets) study.sheets.push_back(sheet_of(draft, sheet));
    return study;
}

std::string make_index_page(const Json& pages) {
    return filled_in(read_player_file("index.html"),
                     {{"title", escape_html(pages.at("title").get<std::string>())},
                      {"language", escape_html(pages.at("language").get<std::string>())},
                      {"pages", escape_script(pages.dump())}});
}

std::string with_data(std::string page, const Json& pages) {
    constexpr std::string_view kBegin = "<script type=\"application/json\" id=\"pages\">";
    const std::size_t begin = page.find(kBegin);
    if (begin == std::string::npos) return page;
    const std::size_t data = begin + kBegin.size();
    const std::size_t end = page.find("</script>", data);
    return page.replace(data, end == std::string::npos ? end : end - data, escape_script(pages.dump()));
}

std::vector<PlayerFile> player_files() {
    std::vector<PlayerFile> files;
    for (const char* name : {"answers.js", "basics.js", "player.js", "questions.js", "style.css", "texts.js",
                             "trial.js", "videos.js"}) {
        files.push_back({name, read_player_file(name)});
    }
    return files;
}

}  // namespace chironomia::study
