// What a participant's browser gets: the pages as data, and the page that shows them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.h"
#include "study/design.h"
#include "study/plan.h"

namespace chironomia {

inline constexpr std::string_view kPagesFormat = "chironomia pages 1";

// The opaque names of a study's parts.
struct PublicNames {
    std::string study;
    std::vector<std::string> pages;                // one per page of the design
    std::vector<std::vector<std::string>> videos;  // of each page: left and right, or one for both
};

// pages.json: texts, pages with their videos, and orders. `seconds` is how long the videos of each page last.
Json make_pages_json(const Plan& plan, const Design& design, const PublicNames& names,
                     const std::vector<double>& seconds);

// index.html: the player's page with the texts and the data in it, because a page that is opened as a file
// may not load others.
std::string make_index_page(const Json& pages);

// The text with &, < and > written so that a page shows them.
std::string escape_html(std::string_view text);

// The files of the player that are the same in every study, by their public name.
struct PlayerFile {
    std::string name;
    std::string content;
};
std::vector<PlayerFile> player_files();

// "clips/0123456789abcdef.mp4"
std::string video_path(const std::string& token, const std::string& format);

}  // namespace chironomia
