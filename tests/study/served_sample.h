// Small finished studies without pictures, for all who only need pages, a key, and answers to them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/files/json.h"
#include "study/record/pages.h"

namespace chironomia::testing {

using namespace study;

struct SampleStudy {
    std::string layout = "pair";
    std::size_t trials = 4;  // pages; on every sheet
    std::size_t checks = 1;  // pages whose expected answer is "left clearly" of all questions
    std::size_t sheets = 4;
    bool may_skip = false;
};

// Conditions are "ours", "baseline", then "third", "fourth", ... as the layout needs them; clips "c0", "c1",
// ... Sheet n shows the pages from page n on, and every second sheet shows the videos from right to left. Of
// a pair it is asked for a preference with reasons ("realism") and for a rating of each video ("human").
Json sample_pages(const SampleStudy& sample);
Json sample_key(const SampleStudy& sample);

// public/ with index.html, pages.json and a file of known bytes for each video; private/ with key.json, and
// plan.json if it is not null.
void write_sample_study(const std::filesystem::path& folder, const SampleStudy& sample,
                        const Json& plan = nullptr);

// A valid answer to a step of a pair's sheet; `mark` distinguishes it from all others.
Json sample_entry(const StudyPages& study, const Step& step, const std::string& mark);

}  // namespace chironomia::testing
