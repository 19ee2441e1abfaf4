// From a plan to a study: a folder that can be put on any web server, and the key to it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/shard.h"
#include "study/build/draft.h"
#include "study/build/videos.h"
#include "study/design/design.h"
#include "study/plan/plan.h"

namespace chironomia::study {

struct BuildOptions {
    std::filesystem::path out;
    std::uint64_t seed = 0;
    int jobs = 1;  // videos recorded at once, each in a process of its own; the bytes do not depend on it
    bool replace = false;  // a finished study of another seed, plan, input or program
    bool quiet = false;
};

struct BuildSummary {
    std::filesystem::path folder;
    std::size_t pages = 0;  // trials
    std::size_t sheets = 0;
    std::size_t videos = 0;
    std::size_t recorded = 0;  // the others were there already
    Design design;             // of the trials; conditions are indices into Plan::conditions
    std::vector<std::string> warnings;
};

struct ShardSummary {
    std::size_t videos = 0;    // of this part; those of one recipe count once
    std::size_t recorded = 0;  // the others were there already
    // of all that show a video of this part: those of all parts are a build's
    std::vector<std::string> warnings{};
};

// How far a study has come.
struct StudyState {
    StudyDraft draft;
    std::vector<Video> distinct;  // of the draft: what parts are parts of
    bool finished = false;
    std::vector<std::size_t> missing{};  // of `distinct`, what is yet to be recorded
};

// Writes
//   out/public/   index.html with its scripts and style, pages.json, clips/<token>.mp4: all that a participant can
//                 reach
//   out/private/  key.json (which video is what), plan.json (as used), recordings.json (how each video was made),
//                 report.html, and manifest.json (SHA-256 of every input and output)
// The same plan, inputs, seed and program give the same bytes.
//
// While it is being built the study has no public/: finished videos wait in private/work/ under the hash of
// all that decides their bytes, and public/ appears by one rename at the end. Running the same command again
// after a kill goes on from there; running it on a finished study does nothing, or mends what was damaged.
// With `replace` another study takes the place of a finished one, and only what differs is recorded again.
//
// Throws Error if an input is wrong, `out` holds something else or a finished study that is not to be
// replaced, a server shows it, or, with `replace` too, people have answered it; Interrupted if the user stops
// it.
BuildSummary build_study(const Plan& plan, const BuildOptions& options, const ClipMaker& maker);

// Reads what there is of a study, and writes nothing. Throws Error as build_study if the folder may not become it.
StudyState inspect_study(StudyDraft draft, const BuildOptions& options);

// The warnings that building gave of a study which is finished in `folder`.
std::vector<std::string> warnings_of_finished(const StudyDraft& draft, const std::filesystem::path& folder);

// Records one part of the distinct videos, where `build_study` finds them. Any number of processes, on any machines
// that share the folder, may record the same or other parts at once, also while the study is laid out: nothing is
// locked, and what two of them record has the same bytes. Of a finished study nothing is recorded. Throws as
// build_study.
ShardSummary build_shard(const Plan& plan, const Shard& shard, const BuildOptions& options,
                         const ClipMaker& maker);

}  // namespace chironomia::study
