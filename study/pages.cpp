#include "study/pages.h"

#include "core/files.h"
#include "core/text.h"

namespace chironomia {
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

}  // namespace

std::string escape_html(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&') {
            escaped += "&amp;";
        } else if (c == '<') {
            escaped += "&lt;";
        } else if (c == '>') {
            escaped += "&gt;";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string video_path(const std::string& token, const std::string& format) {
    return chironomia::format("clips/{}.{}", token, format);
}

Json make_pages_json(const Plan& plan, const Design& design, const PublicNames& names,
                     const std::vector<double>& seconds) {
    Json pages = Json::array();
    for (std::size_t i = 0; i < design.pages.size(); ++i) {
        Json videos = Json::array();
        for (const std::string& token : names.videos[i]) {
            videos.push_back(video_path(token, plan.render.format));
        }
        pages.push_back({{"id", names.pages[i]}, {"videos", std::move(videos)}, {"seconds", seconds[i]}});
    }
    Json orders = Json::array();
    for (const PageOrder& order : design.orders) {
        orders.push_back({{"pages", order.pages}, {"swapped", order.swapped}});
    }
    return {{"format", kPagesFormat},
            {"study", names.study},
            {"title", plan.title},
            {"instructions", plan.instructions},
            {"question", plan.question},
            {"answers", plan.answers},
            {"width", plan.render.size.width},
            {"height", plan.render.size.height},
            {"sound", !plan.clips.front().audio.empty()},
            {"pages", std::move(pages)},
            {"orders", std::move(orders)}};
}

std::string make_index_page(const Json& pages) {
    std::string page = read_player_file("index.html");
    replace_once(page, "{{title}}", escape_html(pages.at("title").get<std::string>()));
    replace_once(page, "{{pages}}", escape_script(pages.dump()));
    return page;
}

std::vector<PlayerFile> player_files() {
    std::vector<PlayerFile> files;
    for (const char* name : {"answers.js", "basics.js", "player.js", "questions.js", "style.css", "texts.js",
                             "trial.js", "videos.js"}) {
        files.push_back({name, read_player_file(name)});
    }
    return files;
}

}  // namespace chironomia
