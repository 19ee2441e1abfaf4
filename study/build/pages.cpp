#include "study/build/pages.h"

#include "core/files/files.h"
#include "core/text.h"
#include "study/html/html.h"
#include "study/plan/default_texts.h"
#include "study/record/pages.h"

namespace chironomia::study {
namespace {

std::string read_player_file(const std::string& name) {
    return read_text(find_asset("study/web/" + name));
}

void replace_once(std::string& text, std::string_view mark, std::string_view with) {
    text.replace(text.find(mark), mark.size(), with);
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

Json videos_of(const StudyDraft& draft, std::size_t page) {
    Json videos = Json::array();
    for (const std::size_t video : draft.videos_of_page[page])
        videos.push_back(video_path(draft.videos[video].token, draft.plan.render.format));
    return videos;
}

Json passes_of(const Plan& plan) {
    Json passes = Json::array();
    for (const PagePass& pass : plan.passes)
        passes.push_back({{"sound", pass.sound}, {"questions", pass.questions}});
    return passes;
}

// Where both figures share a video there is one to order.
Json sheet_of(const StudyDraft& draft, const Sheet& sheet) {
    Json pages = Json::array();
    for (const Showing& shown : sheet.pages) {
        const bool one = draft.videos_of_page[shown.page].size() == 1;
        pages.push_back({shown.page, one ? Json::array({0}) : Json(shown.order)});
    }
    return {{"pages", std::move(pages)}};
}

Json all_questions(const std::vector<Question>& questions) {
    Json list = Json::array();
    for (const Question& question : questions) list.push_back(to_json(question));
    return list;
}

Json sound_check_of(const StudyDraft& draft) {
    if (draft.names_of_sounds.empty()) return nullptr;
    Json check;
    for (std::size_t i = 0; i < draft.names_of_sounds.size(); ++i) {
        check["files"].push_back(sound_path(draft.names_of_sounds[i]));
        check["choices"].push_back(std::to_string(i + 1));
    }
    return check;
}

Json completion_of(const PlanCompletion& completion) {
    if (completion.by_server) {
        if (completion.declined_url.empty()) return nullptr;
        return {{"declined_url", completion.declined_url}};
    }
    Json json = Json::object();
    if (!completion.url.empty()) json["url"] = completion.url;
    if (!completion.code.empty()) json["code"] = completion.code;
    if (!completion.declined_url.empty()) json["declined_url"] = completion.declined_url;
    return json.empty() ? Json() : json;
}

// What comes before the first page and after the last.
void add_frame(const StudyDraft& draft, Json& json) {
    const PlanTexts& texts = draft.plan.texts;
    json["instructions"] = texts.instructions;
    // The page has the words of its button among its texts; exports take them from here.
    const Json agree = texts.page.value("agree", Json(default_agreement(texts.language)));
    json["consent"] = texts.consent.empty() ? Json() : Json{{"text", texts.consent}, {"agree", agree}};
    const bool trains = !texts.training.empty() || !draft.all.practice.empty();
    json["training"] = trains ? Json{{"text", texts.training}, {"pages", draft.all.practice}} : Json();
    json["sound_check"] = sound_check_of(draft);
    json["questionnaire"] = all_questions(draft.plan.questionnaire);
    json["completion"] = completion_of(draft.plan.completion);
}

}  // namespace

std::string video_path(const std::string& token, const std::string& format) {
    return chironomia::format("clips/{}.{}", token, format);
}

std::string sound_path(const std::string& token) {
    return format("clips/{}.wav", token);
}

Json make_pages_json(const StudyDraft& draft, const std::vector<double>& seconds) {
    const Plan& plan = draft.plan;
    Json pages = Json::array();
    for (std::size_t i = 0; i < draft.all.pages.size(); ++i) {
        pages.push_back({{"id", draft.names_of_pages[i]},
                         {"videos", videos_of(draft, i)},
                         {"seconds", seconds[i]},
                         {"caption", plan.clips[draft.all.pages[i].clip].caption},
                         {"passes", passes_of(plan)}});
    }
    Json sheets = Json::array();
    for (const Sheet& sheet : draft.all.sheets) sheets.push_back(sheet_of(draft, sheet));

    Json json = {{"format", kPagesFormat},
                 {"study", draft.name},
                 {"language", plan.texts.language},
                 {"title", plan.texts.title},
                 {"texts", plan.texts.page},
                 {"layout", to_text(plan.layout)},
                 {"one_by_one", plan.presentation == Presentation::one_by_one},
                 {"width", plan.render.size.width},
                 {"height", plan.render.size.height},
                 {"sound", has_sound(plan)},
                 {"shuffle_questions", plan.shuffle_questions},
                 {"skip_after", plan.skip_after ? Json(*plan.skip_after) : Json()}};
    add_frame(draft, json);
    json["questions"] = all_questions(plan.questions);
    json["pages"] = std::move(pages);
    json["sheets"] = std::move(sheets);
    return json;
}

std::string make_index_page(const Json& pages) {
    std::string page = read_player_file("index.html");
    replace_once(page, "{{title}}", escape_html(pages.at("title").get<std::string>()));
    replace_once(page, "{{pages}}", escape_script(pages.dump()));
    return page;
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
