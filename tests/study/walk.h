// A scripted participant, who walks through the whole page of a study in a browser.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/study/browser.h"

namespace chironomia::testing {

// What the participant sees, as the page's data names it.
struct ShownPage {
    std::string page;                 // id
    int pass = 0;                     // of this page
    bool practice = false;            // before the first trial
    std::vector<std::string> videos;  // tokens from left to right
};

// An answer to any question that is allowed: the middle of scales, the first of options, nothing where
// nothing must be. Of `places` videos.
Json plain_answer(const Json& question, std::size_t places);

struct Walker {
    // The value of an answer in the form of `chironomia answers 2`; called for each question of each page.
    // Where a reason is needed, the first is given.
    std::function<Json(const ShownPage&, const Json& question)> answer = [](const ShownPage& page,
                                                                            const Json& question) {
        return plain_answer(question, page.videos.size());
    };
    // Of the questionnaire at the end.
    std::function<Json(const Json& question)> about_me = [](const Json& question) {
        return plain_answer(question, 1);
    };
    bool play = false;       // plays the videos; otherwise only sends their "ended"
    int pages_at_most = -1;  // stops before another page is answered; -1: goes to the end
};

// Opens `url` (of a file or a server) and goes through the page, from where its participant was to the end.
// Returns the answers as the participant would save them. Fails the test if the page does not go on.
Json walk_study(Browser& browser, const std::string& url, const Walker& walker = {});

}  // namespace chironomia::testing
