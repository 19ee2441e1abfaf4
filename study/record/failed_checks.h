// Which attention checks a participant failed, and how much of a sheet is answered: the rules by which the server
// lets people finish and sends them away, and the analysis leaves answers out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/record/key.h"
#include "study/record/pages.h"

namespace chironomia::study {

// One pass of one page, as a participant answered it.
struct PageAnswer {
    std::size_t page = 0;            // of the key
    std::size_t pass = 0;            // which showing of the page it was, StudyPage::passes
    std::vector<std::size_t> order;  // places of the key's page from left to right as shown; of one video
                                     // that shows all {0} is enough
    Json values;                     // {question id: value}; empty if skipped
    Json reasons;                    // {question id: {"chosen": [ids], "other": text}}
    bool skipped = false;
    std::optional<double> seconds;  // none: unknown
};

struct FailedCheck {
    std::string page;  // token
    std::string question;
    std::string expected;
    std::string given;
    double fastest = 0;  // not 0: the page was answered in less [s]
};

// The pages that were failed, in the order of their answers. A check is failed if one of its passes was skipped, or
// answers a question of that pass otherwise than expected (is_as_expected(), answer_values.h); and any page is failed
// like a check if one of its passes was answered, not skipped, in less than the key's fastest_seconds. A page is failed
// once, however many of its passes are. Pages for practice are not judged. `answers` have pages and passes that `pages`
// has, and values that their questions allow.
std::vector<FailedCheck> failed_checks(const StudyKey& key, const StudyPages& pages,
                                       const std::vector<PageAnswer>& answers);

// How many steps of a sheet are answered or were skipped. A participant who has finished answered all of them.
std::size_t count_answered(const std::vector<Step>& sheet, const std::vector<PageAnswer>& answers);

}  // namespace chironomia::study
