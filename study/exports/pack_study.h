// A study as one file to keep or to hand on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace chironomia::study {

struct PackJob {
    std::filesystem::path study;  // its folder
    std::filesystem::path out;    // a zip archive
    bool with_key = false;        // private/ as the build wrote it: the key, the plan, the records
    // answers.json, with "p-1", "p-2", ... for names and nothing of links and browsers
    bool with_answers = false;
    std::filesystem::path database;  // of the answers; empty: private/answers.sqlite
};

struct PackSummary {
    std::size_t files = 0;    // in the archive, its manifest among them
    std::uint64_t bytes = 0;  // of the archive
    std::size_t participants = 0;
};

// The archive holds public/, what was asked for beside it, SHA256SUMS (which `sha256sum -c` reads), and archive.json:
//   {"format": "chironomia archive 1", "study", "title", "program", "key": false, "answers": false,
//    "files": [{"path", "sha256", "bytes"}]}
// The same study, answers and program give the same bytes. The number of a participant is that of their row in the
// database, so that it stays the same from one archive to the next.
// Throws Error if the study is damaged (a file is not as private/manifest.json says), or there are no answers to pack.
PackSummary pack_study(const PackJob& job);

}  // namespace chironomia::study
