// What a participant's browser gets: the pages as data, and the page that shows them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"
#include "study/build/draft.h"
#include "study/record/pages.h"

namespace chironomia::study {

// What participants are shown and asked. `seconds` is how long the videos of each page last.
StudyPages pages_of_study(const StudyDraft& draft, const std::vector<double>& seconds);

// index.html: the player's page with the texts and the data in it, because a page that is opened as a file
// may not load others.
std::string make_index_page(const Json& pages);

// `page` with other data in it: another page of that kind, or the same where it holds none.
std::string with_data(std::string page, const Json& pages);

// The files of the player that are the same in every study, by their public name.
struct PlayerFile {
    std::string name;
    std::string content;
};
std::vector<PlayerFile> player_files();

// "clips/0123456789abcdef.mp4", "clips/0123456789abcdef.wav"
std::string video_path(const std::string& token, const std::string& format);
std::string sound_path(const std::string& token);

}  // namespace chironomia::study
