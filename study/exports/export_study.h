// A study in the form of other front ends, as blind as these forms allow.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace chironomia::study {

enum class ExportForm { hemvip, hemvip2, webmushra, jspsych, qualtrics };

struct ExportOptions {
    std::filesystem::path study;  // its folder
    std::filesystem::path out;    // a new folder
    ExportForm form = ExportForm::jspsych;
    std::string video_url;  // where the videos will lie, with a slash at its end; empty: beside the pages
    std::string pipe;       // jspsych: the experiment of DataPipe that keeps each answer; empty: none
};

struct ExportSummary {
    std::size_t sheets = 0;
    std::size_t videos = 0;
    std::vector<std::string> notes;  // what of the study the form leaves out or shows
};

// Writes OUT/public, which browsers may reach, and OUT/private/mapping.json, which gives the meaning of the tokens.
// Throws Error if the form cannot express the study, the study is damaged, OUT holds something, or
// the pipe is not of jsPsych or no ID.
ExportSummary export_study(const ExportOptions& options);

}  // namespace chironomia::study
