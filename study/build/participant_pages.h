// What a participant is given of pages.json by a server: what all may see before they begin, and then the
// pages of their own sheet. Neither reveals which pages are attention checks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/files/json.h"

namespace chironomia {

// pages.json (`pages`) without its sheets, without all pages but those for practice, and without a completion
// but where those go who decline.
Json open_pages(const Json& pages);

// The pages of a sheet in their order, each with its videos from left to right as shown. Each showing of a
// video has a name of its own: which videos come twice, and which once as those of checks do, is not to be
// seen.
Json pages_of_sheet(const Json& pages, std::size_t sheet, std::string_view secret);

// The name of a showing: "clips/0123456789abcdef.mp4" for the video at `place` from the left of the page at
// position `at` of a sheet.
struct VideoShowing {
    std::size_t sheet = 0;
    std::size_t at = 0;
    std::size_t place = 0;
};
std::string video_of_showing(const std::string& video, const VideoShowing& showing, std::string_view secret);

}  // namespace chironomia
