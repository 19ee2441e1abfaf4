// What stands on a page and what the page is for, by their names in plans, in pages.json and in key.json.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json_value.h"

namespace chironomia::study {

// What stands on a page.
enum class Layout {
    single,    // one condition
    pair,      // two
    triplet,   // A | Reference | B
    parallel,  // 2 to 8, one visible at a time
};

enum class PageKind { trial, check, practice };

// "pair"; "trial"
const std::string& to_text(Layout layout);
const std::string& to_text(PageKind kind);

// Throw Error, naming the key, if the value is another word.
std::size_t index_of_choice(const JsonValue& value, const std::vector<std::string>& names);
Layout layout_named(const JsonValue& value);
PageKind page_kind_named(const JsonValue& value);

}  // namespace chironomia::study
