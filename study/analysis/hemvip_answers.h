// What HEMVIP saved of a study that was exported to it: its tokens become pages and videos of the study's key, so that
// these answers are joined and judged like all others.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"
#include "core/files/json_value.h"
#include "study/analysis/answers.h"
#include "study/record/key.h"
#include "study/record/pages.h"

namespace chironomia::study::analysis {

// Whether a file, JSON, holds what HEMVIP saves (foreign.h) rather than answers of this program.
bool is_of_hemvip(const std::filesystem::path& file);

// The value of a slider or of a number, which a browser may have as a text; anything else as it is.
Json as_number(const Json& value);

// Whether the name of a stimulus marks an attention check, as on HEMVIP's pages: "at"; on the branch genea2022
// "attn_check_40" among sliders (lib/webmushra/pages/VideoPage.js), and "attn" in pairs (VideoPC.js). There it is
// sought anywhere in the name. Here it is a word of its own, because systems may be called "attngan".
bool marks_check(std::string_view stimulus, bool is_pair);

// Who answered, in one form (plain_name(), link_parameters.h). Throws Error if it is no text or empty.
std::string user_of(const JsonValue& whole);

struct HemvipAnswers {
    std::vector<Respondent> participants;
    std::vector<std::string> notes;
};

// The sheet of a participant is one that shows all pages of the file in this order, with the videos at these places.
// "at" marks the video of an attention check (study/exports/hemvip.cpp). A page that was reported as broken counts as
// skipped. Throws Error, naming the file and the key, if a page is none of the study, no sheet fits, a score answers no
// question of its page, or a participant comes twice.
HemvipAnswers read_hemvip_answers(const std::vector<std::filesystem::path>& files, const StudyKey& key,
                                  const StudyPages& pages);

}  // namespace chironomia::study::analysis
