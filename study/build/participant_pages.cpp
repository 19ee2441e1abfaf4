#include "study/build/participant_pages.h"

#include "core/hash.h"
#include "core/text.h"

namespace chironomia::study {

Json open_pages(const Json& pages) {
    Json open = pages;
    open["pages"] = open["sheets"] = Json::array();
    if (Json& training = open["training"]; training.is_object()) {
        Json practised = Json::array();
        for (const Json& page : training["pages"]) {
            practised.push_back(open["pages"].size());
            open["pages"].push_back(pages["pages"][page.get<std::size_t>()]);
        }
        training["pages"] = std::move(practised);
    }
    const Json completion = pages.value("completion", Json());
    open["completion"] = nullptr;
    if (completion.is_object() && completion.contains("declined_url"))
        open["completion"] = {{"declined_url", completion["declined_url"]}};
    return open;
}

Json pages_of_sheet(const Json& pages, std::size_t sheet, std::string_view secret) {
    Json shown = Json::array();
    for (const Json& entry : pages["sheets"][sheet]["pages"]) {
        Json page = pages["pages"][entry[0].get<std::size_t>()];
        Json videos = Json::array();
        for (const Json& video : entry[1]) {
            videos.push_back(video_of_showing(page["videos"][video.get<std::size_t>()].get<std::string>(),
                                              {.sheet = sheet, .at = shown.size(), .place = videos.size()},
                                              secret));
        }
        page["videos"] = std::move(videos);
        shown.push_back(std::move(page));
    }
    return shown;
}

std::string video_of_showing(const std::string& video, const VideoShowing& showing, std::string_view secret) {
    const std::string name =
        keyed_sha256(secret, format("showing {} {} {}", showing.sheet, showing.at, showing.place));
    return format("clips/{}{}", name.substr(0, 16), video.substr(video.rfind('.')));
}

}  // namespace chironomia::study
