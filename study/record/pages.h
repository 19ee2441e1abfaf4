// What participants are shown and asked, as public/pages.json holds it (docs/study_files.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/design/design.h"
#include "study/record/page_kinds.h"
#include "study/record/questions.h"

namespace chironomia::study {

inline constexpr std::string_view kPagesFormat = "chironomia pages 2";

// A page is shown once for each pass.
struct PagePass {
    bool sound = true;
    std::vector<std::size_t> questions;
};

struct StudyPage {
    std::string id;
    std::vector<std::string> videos;  // paths below public/
    double seconds = 0;
    std::string caption;
    std::vector<PagePass> passes;
};

struct StudyPages {
    std::string study;
    std::string language;
    std::string title;
    Layout layout = Layout::single;
    bool one_by_one = false;
    int width = 0;
    int height = 0;
    bool sound = false;
    bool shuffle_questions = false;
    std::optional<double> skip_after = {};  // [s]; none: no page can be skipped
    std::string instructions = {};
    Json texts = Json::object();             // that replace the page's defaults, by key
    std::string consent = {};                // empty: none is asked for
    std::string agreement = {};              // on the button of those who consent
    std::string training = {};               // empty: none
    std::vector<std::size_t> practice = {};  // pages of the training
    std::vector<Question> questions = {};
    std::vector<StudyPage> pages = {};
    std::vector<Sheet> sheets = {};        // orders are of the videos of a page
    std::vector<std::string> sounds = {};  // of the sound check, paths below public/; file i has i + 1 tones
    std::vector<Question> questionnaire = {};
    std::string completion_url = {};   // empty: none
    std::string completion_code = {};  // empty: none
    std::string declined_url = {};     // for those who do not consent; empty: none
};

// One thing to answer: a page in one of its passes.
struct Step {
    std::size_t page = 0;
    std::size_t pass = 0;
    std::vector<std::size_t> order;
    std::size_t at = 0;  // position of the page on its sheet
};

// Throws Error, naming the file and the key, if the file is missing, of another format, or does not fit
// together.
StudyPages read_study_pages(const std::filesystem::path& file);

// As read_study_pages reads it.
Json to_json(const StudyPages& pages);

// All steps of a sheet, from first to last.
std::vector<Step> steps_of_sheet(const StudyPages& pages, std::size_t sheet);

// How many figures stand side by side on a page; a pair may share one video.
std::size_t count_places(const StudyPages& pages, const StudyPage& page);

// "77…" of "clips/77….mp4"
std::string token_of(const std::string& video);

// The tokens of a page's videos from left to right as shown.
std::vector<std::string> tokens_as_shown(const StudyPage& page, const std::vector<std::size_t>& order);

}  // namespace chironomia::study
