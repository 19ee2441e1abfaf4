// The parts of pages.json that a server gives to a participant: first what all may see, then the pages of their own
// sheet. Neither reveals which pages are attention checks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/files/json.h"

namespace chironomia::study {

// pages.json (`pages`) without its sheets, with no pages but those for practice. Of the completion only the address for
// those who decline stays.
Json open_pages(const Json& pages);

// The pages of a sheet in their order, each with its videos from left to right as shown. Each showing of a
// video has a name of its own: the videos of attention checks come only once, which nobody must see.
Json pages_of_sheet(const Json& pages, std::size_t sheet, std::string_view secret);

// The name of a showing: "clips/0123456789abcdef.mp4" for the video at `place` from the left of the page at
// position `at` of a sheet.
struct VideoShowing {
    std::size_t sheet = 0;
    std::size_t at = 0;
    std::size_t place = 0;
};
std::string video_of_showing(const std::string& video, const VideoShowing& showing, std::string_view secret);

}  // namespace chironomia::study
