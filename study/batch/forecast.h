// What building a study will take, measured on a few frames of it: hours, disk, and the array of tasks to ask for.
#pragma once

#include <cstddef>
#include <string>

#include "study/build/build.h"

namespace chironomia::study {

struct Forecast {
    std::size_t videos = 0;   // distinct ones of the study
    std::size_t missing = 0;  // of them, those to be rendered
    std::size_t frames = 0;   // of these
    RenderSize size;
    double cpu_seconds = 0;     // of one core of this machine, for these
    double distinct_bytes = 0;  // of the distinct videos, which wait until the study is laid out
    double bytes = 0;           // of the study, in which each place of a page has a file of its own
    double draft_seconds = 0;   // of a core, that each process takes before it records
    double peak_mb = 0;         // largest resident memory so far
    int jobs = 1;               // videos that are to be recorded at once, each in a process of its own
    std::size_t measured_frames = 0;
    std::size_t measured_videos = 0;
};

struct SlurmArray {
    std::size_t tasks = 1;
    std::size_t minutes = 1;    // time limit of a task
    std::size_t megabytes = 1;  // memory of a task
};

// Reads all inputs and renders a few frames of up to four videos into a folder that is removed; nothing is written to
// `options.out`. Throws as build_study.
Forecast forecast_build(const Plan& plan, const BuildOptions& options, const ClipMaker& maker);

// An array whose tasks take about half an hour each.
SlurmArray array_for(const Forecast& forecast);

std::string to_text(const Forecast& forecast);

}  // namespace chironomia::study
