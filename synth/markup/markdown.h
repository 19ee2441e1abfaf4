// Plain texts that are written in Markdown, as chat models answer.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// A stretch of bytes of the spoken text: *one*, _one_ or **one**, __one__.
struct WrittenEmphasis {
    std::size_t begin = 0, end = 0;
    bool is_strong = false;
};

struct SpokenMarkdown {
    std::string text;  // without the signs; headings and items of lists end as sentences do
    std::vector<WrittenEmphasis> emphases;
};

// What of `text` (UTF-8) is to be spoken: CommonMark without HTML; of links and pictures their texts. Nothing where it
// holds no sign that a voice would read aloud: no emphasis, code, link, heading, nor item that begins with * or +.
std::optional<SpokenMarkdown> read_markdown(std::string_view text);

}  // namespace chironomia
