// What the exports have in common: what they read, and what they hand back to be written.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "study/server/served_study.h"

namespace chironomia::study {

struct ExportSource {
    const server::ServedStudy& study;
    std::string video_url;  // before the name of a video; may be empty
    std::string pipe{};     // the experiment of DataPipe; empty: none
};

struct ExportFile {
    std::string path;  // below public/
    std::string text;
};

struct ExportedVideo {
    std::string from;  // below the study's public/
    std::string to;    // below the export's public/
};

struct Export {
    std::vector<ExportFile> files;
    std::vector<ExportedVideo> videos;
    std::vector<std::string> notes;
};

// Each throws Error if its form cannot express the study.
Export make_hemvip(const ExportSource& source);
Export make_hemvip2(const ExportSource& source);
Export make_webmushra(const ExportSource& source);
Export make_jspsych(const ExportSource& source);
Export make_qualtrics(const ExportSource& source);

// Notes for those who export a study, where it has what the form lacks. `what` is written in English by the export:
// "the buttons are".
void note_english(Export& made, const ExportSource& source, const std::string& what);
void note_captions(Export& made, const ExportSource& source);
void note_marks(Export& made, const ExportSource& source);

// What the study's own page calls the figures of a page, from left to right; none where one stands alone.
std::vector<std::string> names_of_figures(const StudyPages& pages, std::size_t places);

// Opaque names in place of those that participants may not read, by the study's secret key: always the same.
std::string condition_token(const ExportSource& source, const std::string& condition);
std::string clip_token(const ExportSource& source, const std::string& clip);

// "sheet-001"
std::string sheet_name(std::size_t sheet);

// Where a browser finds the video at a place of a step, places counted from the left.
std::string video_address(const ExportSource& source, const Step& step, std::size_t place);

// All videos of the sheets under the names that they have.
std::vector<ExportedVideo> all_videos(const ExportSource& source);

// The one question of a step. Throws Error that names `form` if there are several or none.
const Question& only_question(const ExportSource& source, const Step& step, const std::string& form);

// Throws Error `FORM cannot express this study: WHY`.
[[noreturn]] void refuse_export(const std::string& form, const std::string& why);

// Plain text as HTML, line by line.
std::string html_of(const std::string& text);

}  // namespace chironomia::study
