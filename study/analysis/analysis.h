// From files of answers to everything that is reported about them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/analysis/results.h"

namespace chironomia::study::analysis {

struct AnalysisJob {
    // its folder; none: the answers name their conditions themselves
    std::optional<std::filesystem::path> study;
    std::vector<std::filesystem::path> answers;  // files and folders
    Resampling resampling;
};

struct InputOfAnalysis {
    std::string name;
    std::string sha256;
};

struct Analysis {
    std::string title;
    std::vector<InputOfAnalysis> inputs;
    Resampling resampling;
    Dataset data;  // of all raters
    Results strict;
    Results lenient;

    // Whether both rules count the same raters.
    bool rules_agree() const;
};

// Throws Error if the study or an answer is missing, damaged or does not fit the other.
Analysis analyse(const AnalysisJob& job);

Json to_json(const Analysis& analysis);

// The main numbers for a terminal.
std::string to_text(const Analysis& analysis);

// report.html, tables.tex, analysis.json, answers.csv, participants.csv, a CSV for each kind of result with
// both rules, battles.csv and elo_samples.csv where there are votes, and plots/*.svg. Files of the same
// names, other plots, and tables of an earlier analysis are replaced, all of them or, if the folder cannot be
// written, none. Throws Error then.
void write_analysis(const Analysis& analysis, const std::filesystem::path& folder);

}  // namespace chironomia::study::analysis
