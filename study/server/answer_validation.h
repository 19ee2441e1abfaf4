// Whether what a browser sends fits what was asked.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/json.h"
#include "study/record/pages.h"

namespace chironomia::study::server {

// The JSON of a body, or nothing if it is none, or is nested deeper than any message of a page (16).
std::optional<Json> parse_body(std::string_view body);

// What is wrong with an entry of `answers` for a step of a sheet; "" if nothing is.
//   order      "it is of page 77…, but page 0a… is next"
//   fit        "realism: 9 is no answer; a whole number from 1 to 5 is needed"
struct EntryFault {
    std::string order;  // the entry is of another page, pass or order of videos
    std::string fit;    // it does not fit the questions
};
EntryFault fault_of_entry(const StudyPages& study, const Step& step, const Json& entry);

// What is wrong with the answers to the questionnaire, an object of values; "" if nothing is.
std::string fault_of_questionnaire(const StudyPages& study, const Json& answers);

// The entry with its keys in one order and without those that may be left out, so that equal answers are
// equal texts.
Json as_stored(const Json& entry);

}  // namespace chironomia::study::server
