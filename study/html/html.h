// Parts of HTML pages that need no other file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace chironomia::study {

// The text with &, < and > written so that a page shows them.
std::string escape_html(std::string_view text);

// An image for the `src` of a page, from the bytes of a PNG.
std::string png_source(std::span<const std::byte> png);

// Puts a text where the template has its mark, such as "<!--cases-->"; the mark must be there.
void replace_mark(std::string& page, std::string_view mark, const std::string& with);

}  // namespace chironomia::study
